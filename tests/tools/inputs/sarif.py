"""Checks a SARIF log: what the standard requires of the objects that we write, and the results that are expected.

sarif.py LOG [FILE:LINE:COLUMN:CODE...]: exactly these results, in this order.
"""

import json
import sys

LEVELS = {"none", "note", "warning", "error"}


def require(condition, what):
    if not condition:
        sys.exit(f"not as the standard or the test wants it: {what}")


def keys(object, needed, allowed, what):
    """`object` has all of `needed` and nothing but `needed` and `allowed`."""
    require(isinstance(object, dict), what)
    require(needed <= set(object), f"{what} lacks {needed - set(object)}")
    require(set(object) <= needed | allowed, f"{what} has {set(object) - needed - allowed}")


def check_message(message):
    keys(message, {"text"}, set(), "message")
    require(isinstance(message["text"], str) and message["text"], "message.text")


def check_region(region):
    keys(region, {"startLine", "startColumn", "endLine", "endColumn"}, set(), "region")
    require(all(isinstance(x, int) and x >= 1 for x in region.values()), f"region {region}")
    begin = (region["startLine"], region["startColumn"])
    require(begin <= (region["endLine"], region["endColumn"]), f"region {region}")


def check_artifact(artifact):
    keys(artifact, {"uri"}, set(), "artifactLocation")
    allowed = "-._~:/?#[]@!$&'()*+,;=%"
    require(all(c.isascii() and (c.isalnum() or c in allowed) for c in artifact["uri"]), f"uri {artifact['uri']}")


def check_location(location):
    keys(location, set(), {"id", "message", "physicalLocation"}, "location")
    if "message" in location:
        check_message(location["message"])
    if "physicalLocation" in location:
        keys(location["physicalLocation"], {"artifactLocation", "region"}, set(), "physicalLocation")
        check_artifact(location["physicalLocation"]["artifactLocation"])
        check_region(location["physicalLocation"]["region"])


def check_fix(fix):
    keys(fix, {"artifactChanges"}, {"description"}, "fix")
    for change in fix["artifactChanges"]:
        keys(change, {"artifactLocation", "replacements"}, set(), "artifactChange")
        check_artifact(change["artifactLocation"])
        require(len(change["replacements"]) >= 1, "replacements")
        for replacement in change["replacements"]:
            keys(replacement, {"deletedRegion"}, {"insertedContent"}, "replacement")
            check_region(replacement["deletedRegion"])


def check_result(result, rules):
    keys(result, {"message", "ruleId", "ruleIndex", "level"}, {"locations", "relatedLocations", "fixes"}, "result")
    check_message(result["message"])
    require(result["level"] in LEVELS, f"level {result['level']}")
    require(0 <= result["ruleIndex"] < len(rules), "ruleIndex")
    require(rules[result["ruleIndex"]]["id"] == result["ruleId"], "ruleIndex and ruleId")
    for location in result.get("locations", []) + result.get("relatedLocations", []):
        check_location(location)
    ids = [x["id"] for x in result.get("relatedLocations", [])]
    require(len(set(ids)) == len(ids), "ids of the related locations")
    for fix in result.get("fixes", []):
        check_fix(fix)


def check_log(log):
    keys(log, {"version", "runs"}, {"$schema"}, "log")
    require(log["version"] == "2.1.0", "version")
    require(len(log["runs"]) == 1, "one run")
    run = log["runs"][0]
    keys(
        run,
        {"tool", "results", "columnKind"},
        {"defaultEncoding", "defaultSourceLanguage", "newlineSequences"},
        "run",
    )
    require(run["columnKind"] in {"utf16CodeUnits", "unicodeCodePoints"}, "columnKind")
    driver = run["tool"]["driver"]
    keys(driver, {"name", "version", "rules"}, {"semanticVersion"}, "driver")
    rules = driver["rules"]
    require(len({rule["id"] for rule in rules}) == len(rules), "each rule once")
    for result in run["results"]:
        check_result(result, rules)
    return run["results"]


def place(result):
    where = result["locations"][0]["physicalLocation"]
    name = where["artifactLocation"]["uri"].rsplit("/", 1)[-1]
    return f"{name}:{where['region']['startLine']}:{where['region']['startColumn']}:{result['ruleId']}"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        results = check_log(json.load(file))
    met = [place(result) for result in results]
    require(met == sys.argv[2:], f"results {met}")


main()
