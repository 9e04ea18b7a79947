# What --describe must say of shapes.lua.
import json
import sys

shader = json.load(open(sys.argv[1]))
entries = {entry["name"]: entry for entry in shader["entries"]}
assert set(entries) == {"color", "height", "counts", "constant"}, entries
assert entries["color"]["inputs"] == [{"name": "p", "type": "vec3"}, {"name": "n", "type": "vec3"}]
assert entries["color"]["result"] == "vec3"
assert entries["counts"]["results"] == ["integer", "integer", "boolean"]
assert "result" not in entries["counts"]
parameters = {parameter["name"]: parameter for parameter in shader["parameters"]}
assert list(parameters) == ["scale", "tint", "count", "shiny"]
assert parameters["scale"] == {"name": "scale", "type": "number", "default": 2.0, "min": 0.1, "max": 40, "step": 0.1,
                               "doc": "size of it", "label": "Scale"}, parameters["scale"]
assert parameters["tint"]["default"] == [1, 0.5, 0.25] and parameters["tint"]["type"] == "vec3"
assert parameters["count"] == {"name": "count", "type": "integer", "default": 3}
assert parameters["shiny"] == {"name": "shiny", "type": "boolean", "default": False}
assert shader["modules"] == [] and shader["images"] == []
