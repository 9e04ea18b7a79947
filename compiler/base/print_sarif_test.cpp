// SARIF output against what the standard (SARIF 2.1.0, OASIS) requires of each object that we write.
#include "compiler/base/diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace moonshade {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr auto kSomeError = DiagnosticCode::UnknownAttribute;

struct Fixture : testing::Test {
  SourceSet sources;
  Diagnostics diagnostics;

  Span place(std::string text, uint32_t begin, uint32_t end, std::string name = "a.lua") {
    return {sources.add(std::move(name), std::move(text)), begin, end};
  }
  json log() const {
    std::ostringstream out;
    print_diagnostics(diagnostics, sources, out, {.format = DiagnosticFormat::Sarif});
    return json::parse(out.str());
  }
  json run() const { return log()["runs"][0]; }
  json result() const { return run()["results"].at(0); }
  json region() const { return result()["locations"][0]["physicalLocation"]["region"]; }
  std::string uri() const { return result()["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]; }
};
using SarifTest = Fixture;

json region(int line, int column, int end_line, int end_column) {
  return {{"startLine", line}, {"startColumn", column}, {"endLine", end_line}, {"endColumn", end_column}};
}

TEST_F(SarifTest, ALogOfNothingIsOneRunWithoutResults) {
  const json log = this->log();
  EXPECT_EQ(log["version"], "2.1.0");
  EXPECT_THAT(std::string(log["$schema"]), HasSubstr("sarif-2.1.0.json"));
  ASSERT_EQ(log["runs"].size(), 1u);
  const json& run = log["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["name"], "Moonshade");
  EXPECT_TRUE(run["tool"]["driver"]["version"].is_string());
  EXPECT_EQ(run["tool"]["driver"]["rules"], json::array());
  EXPECT_EQ(run["results"], json::array()); // not absent: that would mean that nothing was looked for (3.14.23)
  EXPECT_EQ(run["columnKind"], "unicodeCodePoints");
}

TEST_F(SarifTest, AResultHasAllFacts) {
  const Span span = place("ab\ncd  ef\n", 3, 5);
  diagnostics.report(kSomeError, span, {"foo"})
      .note(DiagnosticCode::NoteDeclaredHere, {span.file, 0, 2}, {"ab"})
      .note(DiagnosticCode::NoteDeclaredHere, {}, {"nowhere"})
      .suggest({span.file, 7, 9}, "close");
  const json result = this->result();
  EXPECT_EQ(result["ruleId"], "unknown-attribute");
  EXPECT_EQ(result["level"], "error");
  EXPECT_THAT(std::string(result["message"]["text"]), HasSubstr("unknown attribute 'foo'"));
  EXPECT_EQ(uri(), "a.lua");
  EXPECT_EQ(region(), moonshade::region(2, 1, 2, 3));

  const json related = result["relatedLocations"];
  ASSERT_EQ(related.size(), 2u);
  EXPECT_EQ(related[0]["message"]["text"], "'ab' is declared here");
  EXPECT_EQ(related[0]["physicalLocation"]["region"], moonshade::region(1, 1, 1, 3));
  EXPECT_FALSE(related[1].contains("physicalLocation"));
  EXPECT_NE(related[0]["id"], related[1]["id"]);

  ASSERT_EQ(result["fixes"].size(), 1u);
  EXPECT_EQ(result["fixes"][0]["description"]["text"], "write 'close' instead");
  const json change = result["fixes"][0]["artifactChanges"][0];
  EXPECT_EQ(change["artifactLocation"]["uri"], "a.lua");
  EXPECT_EQ(change["replacements"][0]["deletedRegion"], moonshade::region(2, 5, 2, 7));
  EXPECT_EQ(change["replacements"][0]["insertedContent"]["text"], "close");
}

TEST_F(SarifTest, WhatIsAbsentIsLeftOut) {
  diagnostics.report(kSomeError, Span{}, {"foo"}).suggest(Span{}, "x");
  const json result = this->result();
  for (const char* key : {"locations", "relatedLocations", "fixes"})
    EXPECT_FALSE(result.contains(key)) << key;
}

TEST_F(SarifTest, EachCodeIsOneRuleOfItsIndex) {
  const Span span = place("abcdef", 0, 1);
  diagnostics.report(kSomeError, {span.file, 2, 3}, {"x"});
  diagnostics.report(DiagnosticCode::BreakOutsideLoop, {span.file, 1, 2});
  diagnostics.report(kSomeError, span, {"y"});
  const json run = this->run();
  const json rules = run["tool"]["driver"]["rules"];
  ASSERT_EQ(rules.size(), 2u);
  ASSERT_EQ(run["results"].size(), 3u);
  for (const json& result : run["results"]) {
    const json& rule = rules.at(size_t(result["ruleIndex"]));
    EXPECT_EQ(rule["id"], result["ruleId"]);
    EXPECT_EQ(rule["defaultConfiguration"]["level"], result["level"]);
  }
}

TEST_F(SarifTest, LevelsAreThoseOfTheStandard) {
  const std::set<std::string_view> levels = {"none", "note", "warning", "error"};
  for (Severity severity : {Severity::Error, Severity::Warning, Severity::Note})
    EXPECT_TRUE(levels.contains(name_of(severity)));
}

TEST_F(SarifTest, ColumnsCountCodePoints) {
  // U+00E4, U+1F319 (two UTF-16 units), a byte that is no UTF-8, and a tab: one column each
  diagnostics.report(kSomeError, place("x\n\xC3\xA4\xF0\x9F\x8C\x99\xFF\tfoo\n", 10, 13));
  EXPECT_EQ(region(), moonshade::region(2, 5, 2, 8));
}

TEST_F(SarifTest, AByteOrderMarkIsNoColumn) {
  diagnostics.report(kSomeError, place("\xEF\xBB\xBF"
                                       "foo bar",
                                       3, 6));
  EXPECT_EQ(region(), moonshade::region(1, 1, 1, 4));
}

TEST_F(SarifTest, EmptySpansAreInsertionPointsAlsoAtTheEnd) {
  diagnostics.report(kSomeError, place("ab\r\ncd", 6, 6));
  EXPECT_EQ(region(), moonshade::region(2, 3, 2, 3));
}

TEST_F(SarifTest, SpansMayCrossEveryKindOfLineBreak) {
  diagnostics.report(kSomeError, place("a\r\nb\n\rc\rd\ne", 0, 11));
  EXPECT_EQ(region(), moonshade::region(1, 1, 5, 2));
  EXPECT_EQ(run()["newlineSequences"], json({"\r\n", "\n\r", "\n", "\r"}));
}

TEST_F(SarifTest, NamesBecomeUris) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"a.lua", "a.lua"},
      {"./b/../c d.lua", "c%20d.lua"},
      {"/tmp/x.lua", "file:///tmp/x.lua"},
      {"\xC3\xA4%:#?.lua", "%C3%A4%25%3A%23%3F.lua"},
      {"\xFF", "%FF"},
  };
  for (const auto& [name, expected] : cases) {
    Diagnostics one;
    one.report(kSomeError, place("x", 0, 1, name));
    std::ostringstream out;
    print_sarif(one, sources, out);
    const json result = json::parse(out.str())["runs"][0]["results"][0];
    EXPECT_EQ(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], expected) << name;
  }
}

TEST_F(SarifTest, MessagesAreNeitherPlaceholdersNorLinks) {
  diagnostics.report(kSomeError, place("abc", 0, 1), {"{0}"});
  EXPECT_THAT(std::string(result()["message"]["text"]), HasSubstr("attribute '{{0}}';"));
  diagnostics = {};
  diagnostics.report(kSomeError, {0, 0, 1}, {"[here](http://x)"});
  EXPECT_THAT(std::string(result()["message"]["text"]), HasSubstr("'\\[here](http://x)'"));
  diagnostics = {};
  diagnostics.report(kSomeError, {0, 0, 1}, {"a[1]"});
  EXPECT_THAT(std::string(result()["message"]["text"]), HasSubstr("'a[1]'"));
}

TEST_F(SarifTest, StrangeBytesAreMadeSafe) {
  diagnostics.report(kSomeError, place("\xFF", 0, 1), {"\x1b\xFF"}).suggest({0, 0, 1}, "\xFE");
  EXPECT_THAT(std::string(result()["message"]["text"]), HasSubstr("'\\x1B\\xFF'"));
  EXPECT_EQ(result()["fixes"][0]["artifactChanges"][0]["replacements"][0]["insertedContent"]["text"], "\uFFFD");
}

TEST(SarifLog, GathersSeveralCompilationsInOneRun) {
  SarifLog log;
  EXPECT_TRUE(log.empty());
  for (const char* name : {"a.lua", "b.lua"}) {
    SourceSet sources;
    Diagnostics diagnostics;
    diagnostics.report(kSomeError, {sources.add(name, "abc"), 0, 1}, {"x"});
    log.add(diagnostics, sources);
  }
  EXPECT_FALSE(log.empty());
  std::ostringstream out;
  log.print(out);
  const json run = json::parse(out.str())["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["rules"].size(), 1u);
  ASSERT_EQ(run["results"].size(), 2u);
  EXPECT_EQ(run["results"][1]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "b.lua");
}

} // namespace
} // namespace moonshade
