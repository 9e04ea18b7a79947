#include "compiler/base/diagnostics.h"
#include "compiler/base/printable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace moonshade {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr auto kSomeError = DiagnosticCode::UnknownAttribute;

struct Fixture : testing::Test {
  SourceSet sources;
  Diagnostics diagnostics;

  Span place(std::string text, uint32_t begin, uint32_t end) {
    return {sources.add("a.lua", std::move(text)), begin, end};
  }
  std::string text(bool colour = false) const {
    std::ostringstream out;
    print_text(diagnostics, sources, out, colour);
    return out.str();
  }
};
using DiagnosticsTest = Fixture;

TEST_F(DiagnosticsTest, CodesAreKebabCase) {
#define MOONSHADE_DIAGNOSTIC(name, code, severity, message)                                                            \
  EXPECT_EQ(std::string_view(code).find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string::npos)      \
      << code;                                                                                                         \
  EXPECT_FALSE(std::string_view(message).ends_with(".")) << message;
#include "compiler/base/diagnostic_codes.def"
}

TEST_F(DiagnosticsTest, ACodeHasOneSeverityAndNoWordingTwice) {
  std::map<std::string_view, Severity> severities;
  std::set<std::pair<std::string_view, std::string_view>> wordings;
#define MOONSHADE_DIAGNOSTIC(name, code, severity, message)                                                            \
  EXPECT_EQ(severities.try_emplace(code, Severity::severity).first->second, Severity::severity) << code;               \
  EXPECT_TRUE(wordings.emplace(code, message).second) << code << ": " << message;
#include "compiler/base/diagnostic_codes.def"
}

TEST_F(DiagnosticsTest, TextShowsPlaceMessageCodeAndUnderline) {
  diagnostics.report(kSomeError, place("x = 1\nlocal a <foo> = 2\n", 15, 18), {"foo"});
  EXPECT_EQ(text(), "a.lua:2:10: error: unknown attribute 'foo'; there are 'const' and 'close' [unknown-attribute]\n"
                    "    2 | local a <foo> = 2\n"
                    "      |          ^~~\n");
}

TEST_F(DiagnosticsTest, NotesAndFixFollow) {
  const Span span = place("abc def", 4, 7);
  diagnostics.report(kSomeError, span, {"foo"})
      .note(DiagnosticCode::NoteDeclaredHere, {span.file, 0, 3}, {"abc"})
      .suggest(span, "close");
  EXPECT_THAT(text(), HasSubstr("a.lua:1:1: note: 'abc' is declared here\n    1 | abc def\n      | ^~~\n"));
  EXPECT_THAT(text(), HasSubstr("a.lua:1:5: note: write 'close' instead\n"));
}

TEST_F(DiagnosticsTest, EmptySpansGetACaret) {
  const Span span = place("abc\n", 1, 1);
  diagnostics.report(kSomeError, span);
  diagnostics.report(kSomeError, {span.file, 3, 3});
  EXPECT_THAT(text(), HasSubstr("    1 | abc\n      |  ^\n"));
  EXPECT_THAT(text(), HasSubstr("    1 | abc\n      |    ^\n"));
}

TEST_F(DiagnosticsTest, SpansOverSeveralLinesUnderlineTheFirst) {
  diagnostics.report(kSomeError, place("f(a,\n  b)\n", 0, 9));
  EXPECT_THAT(text(), HasSubstr("    1 | f(a,\n      | ^~~~\n"));
}

TEST_F(DiagnosticsTest, StrangeBytesAreMadeSafe) {
  diagnostics.report(kSomeError, place(std::string("\t\x1b[31m\xff\0x\xC3\xA4 y\xE2\x80\xAE", 16), 11, 12), {"\x1b\n"});
  const std::string shown = text();
  EXPECT_THAT(shown, HasSubstr("    1 |     \\x1B[31m\\xFF\\x00x\xC3\xA4 y\\u{202E}\n"));
  EXPECT_THAT(shown, HasSubstr("unknown attribute '\\x1B\\x0A'"));
  EXPECT_THAT(shown, Not(HasSubstr("\x1b")));
}

TEST_F(DiagnosticsTest, UnderlineStandsUnderItsTextBehindTabsAndUtf8) {
  diagnostics.report(kSomeError, place("\t\xC3\xA4\tfoo", 4, 7));
  EXPECT_THAT(text(), HasSubstr("|     \xC3\xA4    foo\n      |          ^~~\n"));
}

TEST_F(DiagnosticsTest, LongLinesAreCutAroundTheSpan) {
  const std::string line = std::string(5000, 'a') + "HERE" + std::string(5000, 'b');
  diagnostics.report(kSomeError, place(line, 5000, 5004));
  const std::string shown = text();
  EXPECT_LT(shown.size(), 500u);
  EXPECT_THAT(shown, HasSubstr("aaaHEREbbb"));
  EXPECT_THAT(shown, HasSubstr("    1 | ..."));
  const size_t here = shown.find("HERE"), caret = shown.find("^~~~\n");
  ASSERT_NE(caret, std::string::npos);
  EXPECT_EQ(here - shown.rfind('\n', here), caret - shown.rfind('\n', caret));
}

TEST_F(DiagnosticsTest, SpansBehindManyEscapesAreStillShown) {
  // 50 bytes that take 200 columns; spans that are empty, within the line and at its end
  const std::string line = "a" + std::string(50, '\xff') + "HERE" + std::string(50, '\xff');
  const Span span = place(line, 51, 55);
  diagnostics.report(kSomeError, span);
  diagnostics.report(kSomeError, {span.file, 51, 51});
  diagnostics.report(kSomeError, {span.file, 105, 105});
  const std::string shown = text();
  for (const char* underline : {"^~~~\n", "^\n"})
    EXPECT_THAT(shown, HasSubstr(underline));
  const size_t here = shown.find("HERE"), caret = shown.find("^~~~\n");
  ASSERT_NE(caret, std::string::npos);
  EXPECT_EQ(here - shown.rfind('\n', here), caret - shown.rfind('\n', caret));
}

TEST_F(DiagnosticsTest, SpansWithoutAPlacePrintTheMessageAlone) {
  diagnostics.report(kSomeError, Span{}, {"foo"});
  EXPECT_TRUE(text().starts_with("error: unknown attribute 'foo'"));
}

TEST_F(DiagnosticsTest, ColourOnlyWhenAsked) {
  diagnostics.report(kSomeError, place("abc", 0, 1));
  EXPECT_THAT(text(false), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(text(true), HasSubstr("\x1b[1;31merror: "));
}

TEST_F(DiagnosticsTest, SortedByPlaceAndWithoutRepetition) {
  const Span span = place("abcdef", 4, 5);
  diagnostics.report(kSomeError, span, {"late"});
  diagnostics.report(kSomeError, {span.file, 1, 2}, {"early"});
  diagnostics.report(kSomeError, span, {"again"});
  const auto sorted = diagnostics.sorted();
  ASSERT_EQ(sorted.size(), 2u);
  EXPECT_THAT(sorted[0]->message, HasSubstr("early"));
  EXPECT_THAT(sorted[1]->message, HasSubstr("late"));
}

TEST_F(DiagnosticsTest, ErrorsAreCapped) {
  const Span span = place(std::string(1000, 'x'), 0, 1);
  EXPECT_FALSE(diagnostics.has_errors());
  for (uint32_t i = 1000; i-- > 0;)
    diagnostics.report(kSomeError, {span.file, i, i + 1}, {"x"});
  const auto sorted = diagnostics.sorted();
  ASSERT_EQ(sorted.size(), Diagnostics::kMaxErrors + 1);
  EXPECT_EQ(sorted.back()->code, DiagnosticCode::TooManyErrors);
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST_F(DiagnosticsTest, FormatReplacesArguments) {
  EXPECT_EQ(format_message(DiagnosticCode::UnclosedBlock, {"end", "if", "3", "'x'"}),
            "'end' expected (to close 'if' at line 3) near 'x'");
}

TEST_F(DiagnosticsTest, JsonHasAllFacts) {
  const Span span = place("ab\ncd \xff ef\n", 4, 9);
  diagnostics.report(kSomeError, span, {"\xff"})
      .note(DiagnosticCode::NoteDeclaredHere, {span.file, 0, 2}, {"ab"})
      .suggest({span.file, 4, 5}, "z");
  std::ostringstream out;
  print_json(diagnostics, sources, out);
  const auto json = nlohmann::json::parse(out.str());
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["file"], "a.lua");
  EXPECT_EQ(json[0]["line"], 2);
  EXPECT_EQ(json[0]["column"], 2);
  EXPECT_EQ(json[0]["endLine"], 2);
  EXPECT_EQ(json[0]["endColumn"], 7);
  EXPECT_EQ(json[0]["severity"], "error");
  EXPECT_EQ(json[0]["code"], "unknown-attribute");
  EXPECT_EQ(json[0]["notes"][0]["line"], 1);
  EXPECT_EQ(json[0]["notes"][0]["message"], "'ab' is declared here");
  EXPECT_EQ(json[0]["fix"]["replacement"], "z");
  EXPECT_EQ(json[0]["fix"]["column"], 2);
}

TEST_F(DiagnosticsTest, JsonOfNothingIsAnEmptyArray) {
  std::ostringstream out;
  print_diagnostics(diagnostics, sources, out, {.format = DiagnosticFormat::Json});
  EXPECT_EQ(out.str(), "[]\n");
}

TEST(Printable, RejectsOverlongAndSurrogates) {
  EXPECT_EQ(printable("\xC0\x80"), "\\xC0\\x80");
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xF0\x9F\x8C\x99"), "\xF0\x9F\x8C\x99");
  EXPECT_EQ(printable("\xE2\x82"), "\\xE2\\x82");
}

} // namespace
} // namespace moonshade
