// Messages, places, recovery, and hostile inputs.
#include "compiler/syntax/parser_fixture.h"

#include <ctime>
#include <gtest/gtest.h>

namespace moonshade::syntax {
namespace {

struct Case {
  const char* text;
  const char* errors;
};

TEST(ParserErrors, StandAtTheTokenWhereParsingCannotGoOn) {
  for (const Case& c : std::initializer_list<Case>{
           {"local x =", "1:10 syntax-error"},
           {"local x = = 1", "1:11 syntax-error"},
           {"x = 1 +\n", "2:1 syntax-error"},
           {"f(1, 2\n", "2:1 unclosed-block"},
           {"f(1, 2", "1:7 syntax-error"},
           {"x = {1 2}", "1:8 syntax-error"},
           {"if x then\n  y()\n", "3:1 unclosed-block"},
           {"while x do\nuntil y", "2:1 syntax-error"},
           {"x = 1 end", "1:7 syntax-error"},
           {"return 1 x = 2", "1:10 syntax-error"},
           {"a.b", "1:4 not-a-statement"},
           {"a b = 1", "1:3 not-a-statement"},
           {"f() = 1", "1:5 cannot-assign"},
           {"a, (b) = 1, 2", "1:8 cannot-assign"},
           {"for x do end", "1:7 syntax-error"},
           {"function f( end", "1:13 syntax-error"},
           {"x = 3..2", "1:5 malformed-number"},
           {"x = 'a\\qb' y = = 1", "1:7 invalid-escape 1:16 syntax-error"},
           {"x = \"abc\ny = 1", "1:5 unfinished-string"},
           {"x = [[abc", "1:5 unfinished-long-string"},
           {"function f()\n --[[ end", "2:2 unfinished-long-comment"},
           {"@", "1:1 syntax-error"},
       })
    EXPECT_EQ(Parsed(c.text).errors(), c.errors) << c.text;
}

TEST(ParserErrors, SayWhatWasExpected) {
  EXPECT_EQ(Parsed("if x then\ny()\n").message(), "'end' expected (to close 'if' at line 1) near <eof>");
  EXPECT_EQ(Parsed("x = (1 +\n2 y()").message(), "')' expected (to close '(' at line 1) near 'y'");
  EXPECT_EQ(Parsed("if x y()").message(), "'then' expected near 'y'");
  EXPECT_EQ(Parsed("local 1").message(), "<name> expected near '1'");
  EXPECT_EQ(Parsed("x = \x01").message(), "unexpected symbol near '\\x01'");
  EXPECT_EQ(Parsed("return 1 x()").message(), "'return' must be the last statement of its block near 'x'");
  EXPECT_EQ(Parsed("end").message(), "there is no block to close near 'end'");
  EXPECT_EQ(Parsed("a.b:c = 1").message(), "function arguments expected near '='");
  EXPECT_EQ(Parsed("f() = 1").message(), "only a variable or a field can be assigned to, near '='");
  EXPECT_EQ(Parsed("x = 0xfg").message(), "malformed number '0xfg'");
  EXPECT_EQ(Parsed("for a.b = 1, 2 do end").message(), "'=' or 'in' expected near '.'");
}

TEST(ParserErrors, OperatorsOfOtherLanguagesGetAFix) {
  const auto fixed = [](std::string text) {
    const Parsed parsed(text);
    const auto& fix = parsed.diagnostics.sorted().at(0)->fix;
    return fix ? text.replace(fix->span.begin, fix->span.size(), fix->replacement) : "no fix";
  };
  EXPECT_EQ(fixed("x = a != b"), "x = a ~= b");
  EXPECT_EQ(fixed("x = a && b"), "x = a and b");
  EXPECT_EQ(fixed("x = a || b"), "x = a or b");
}

TEST(ParserErrors, IndependentErrorsAreEachReportedOnce) {
  for (const Case& c : std::initializer_list<Case>{
           {"local x = = 1\nlocal y = 2\nlocal z = )\nw = 3", "1:11 syntax-error 3:11 syntax-error"},
           {"x = 1 +\ny = 2 *\nz = 3", "2:3 syntax-error"}, // taken as 1 + y
           {"if x = 1 then\n  y()\nend\nz()\nw = )", "1:6 syntax-error 5:5 syntax-error"},
           {"while x then\n  y()\nend\nz()", "1:9 syntax-error"},
           {"for i = 1 do\n  y()\nend\nz()", "1:11 syntax-error"},
           {"function f(a, 1)\n  return a\nend\nfunction g()\n  x = )\nend", "1:15 syntax-error 5:7 syntax-error"},
           {"function 1x()\n  return 2\nend\nx = )", "1:10 malformed-number 4:5 syntax-error"},
           {"f(a,\n  b c,\n  d)\nx = )", "2:5 unclosed-block 4:5 syntax-error"},
           {"x = { a = 1,\n  b = = 2,\n  c = 3 }\ny = )", "2:7 syntax-error 4:5 syntax-error"},
           {"f(= function() local a = 1 return a end)\ny = )", "1:3 syntax-error 2:5 syntax-error"},
           {"x = 3..2 y = 0xg z = 1", "1:5 malformed-number 1:14 malformed-number"},
           {"goto l\nx = = 1\nbreak", "2:5 syntax-error"},
           {"if a then\n  while b do\n    x()\nelse\n  y()\nend\nz()", "4:1 unclosed-block"},
           {"end\nend\nx = )", "1:1 syntax-error 3:5 syntax-error"},
       })
    EXPECT_EQ(Parsed(c.text).errors(), c.errors) << c.text;
}

TEST(ParserErrors, TheTreeHasWhatCouldBeParsed) {
  const Parsed parsed("local x = )\nfunction f() y = = 1 return x end");
  EXPECT_EQ(parsed.tree(), R"(  LocalStat x #0
    ErrorExpr
  FunctionStat
    NameExpr f global
    Function f ()
      AssignStat
        targets
          NameExpr y global
        values
          ErrorExpr
      ReturnStat
        NameExpr x upvalue #0
)");
}

// ---- limits and hostile inputs -------------------------------------------------------------------------------------

std::string repeated(std::string_view part, size_t bytes) {
  std::string text;
  text.reserve(bytes + part.size());
  while (text.size() < bytes)
    text += part;
  return text;
}

TEST(ParserLimits, DepthIsRefusedAtItsToken) {
  const std::string parens(1000, '(');
  EXPECT_EQ(Parsed("x = " + parens).errors(), "1:404 too-large"); // the statement is one level
  EXPECT_EQ(Parsed("x = " + parens).message(), "nested too deeply (limit 400)");
  EXPECT_EQ(Parsed("x = 1" + repeated("+1", 990 * 2)).errors(), "");
  EXPECT_NE(Parsed("x = 1" + repeated("+1", 1100 * 2)).errors().find("too-large"), std::string::npos);
  EXPECT_NE(Parsed("x = a" + repeated(".b", 1100 * 2)).errors().find("too-large"), std::string::npos);
}

TEST(ParserLimits, SourceSizeIsBounded) {
  EXPECT_EQ(Parsed(std::string(kMaxSourceBytes + 1, ' ')).errors(), "1:1 too-large");
  EXPECT_EQ(Parsed(std::string(kMaxSourceBytes, ' ')).errors(), "");
}

TEST(ParserLimits, HostileInputsAreRefusedQuickly) {
  constexpr size_t kSize = 1 << 20;
  const std::vector<std::string> inputs = {
      "x = " + repeated("(", kSize),
      "x = " + repeated("{", kSize),
      "x = " + repeated("f{", kSize),
      "x = " + repeated("f(", kSize),
      "x = " + repeated("a[", kSize),
      "x = " + repeated("not ", kSize),
      "x = " + repeated("- ", kSize),
      "x = " + repeated("a^", kSize),
      "x = " + repeated("a..", kSize),
      "x = " + repeated("a+", kSize),
      "x = a" + repeated(".a", kSize),
      "x = a" + repeated("()", kSize) + ")",
      "x = a" + repeated("{}", kSize) + ")",
      repeated("f(function() ", kSize),
      repeated("function f() ", kSize),
      repeated("do ", kSize),
      repeated("repeat ", kSize),
      repeated("if a then ", kSize),
      repeated("if a then else", kSize),
      repeated("while a do ", kSize),
      repeated("for i = 1, 2 do ", kSize),
      repeated("end ", kSize),
      repeated("else ", kSize),
      repeated("until ", kSize),
      repeated("x = ) ", kSize),
      repeated("x = )\n", kSize),
      repeated("@", kSize),
      repeated("(x ;", kSize),
      repeated("f(\n; ", kSize),
      repeated("x = {; ", kSize),
      repeated("break ", kSize),
      repeated("function ( ", kSize),
      repeated("= function(", kSize),
      repeated("= function() end", kSize),
      repeated("local ", kSize),
      repeated("goto a ", kSize),
      repeated("::a:: ", kSize),
      repeated("do goto a end ", kSize),
      repeated("local a <foo> ", kSize),
      repeated("3x ", kSize),
      repeated("'", kSize),
      repeated("\"\\q", kSize),
      repeated("'\n", kSize),
      repeated("[=[", kSize),
      repeated("[==", kSize),
      repeated("--[[\n", kSize),
      "x = [[" + repeated("]=]", kSize),
      "x = [" + std::string(kSize, '=') + "[" + repeated("]=", kSize),
      repeated("[" + std::string(1000, '='), kSize),
      std::string(kSize, '\0'),
      "x = '" + std::string(kSize, '\0'),
      repeated("\xff\xfe\x80", kSize),
      std::string(kSize, '1') + "x",
      "x = 1e" + std::string(kSize, '9') + "z",
      "x = 0x" + std::string(kSize, 'f') + ".",
      "x = '" + repeated("\\u{7FFFFFFF}", kSize),
      "x = '" + repeated("\\z ", kSize),
      "return " + repeated("a,", kSize),
      "local " + repeated("a,", kSize),
      repeated("a,", kSize) + " = 1",
  };
  for (const std::string& input : inputs) {
    const std::clock_t begin = std::clock(); // of the processor, however busy the machine is
    const Parsed parsed(input);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    const std::string shown = input.substr(0, 20);
    if (!input.starts_with("x = 0xf")) EXPECT_TRUE(parsed.diagnostics.has_errors()) << shown;
    EXPECT_LT(seconds, 5.0) << shown; // with sanitizers; a fraction of a second without
    EXPECT_LT(parsed.arena.bytes_used(), 400 * kSize) << shown;
    std::ostringstream out;
    print_text(parsed.diagnostics, parsed.sources, out);
    EXPECT_LT(out.str().size(), size_t{1} << 18) << shown;
  }
}

TEST(ParserLimits, LargeValidInputsAreTaken) {
  constexpr size_t kSize = 1 << 20;
  for (const std::string& input : {
           repeated("local a = 1 ", kSize),
           repeated("function f() end ", kSize),
           repeated("do local a goto b ::b:: end ", kSize),
           "x = '" + repeated("\\n", kSize) + "'",
           "x = [[" + repeated("\r\n", kSize) + "]]",
           "if a then " + repeated("elseif b then ", kSize) + "end",
           "f(a" + repeated(",a", kSize) + ")",
           "x = {" + repeated("a=1,", kSize) + "}",
           repeated("\n", kSize),
           repeated("-- comment\n", kSize),
           repeated(";", kSize),
       })
    EXPECT_EQ(Parsed(input).errors(), "") << input.substr(0, 20);
}

} // namespace
} // namespace moonshade::syntax
