#include "compiler/syntax/lexer.h"
#include "compiler/syntax/numeral.h"

#include <clocale>
#include <cmath>
#include <gtest/gtest.h>

namespace moonshade::syntax {
namespace {

struct Lexed {
  explicit Lexed(std::string text) {
    file = sources.add("t.lua", std::move(text));
    Lexer lexer(file, sources.text(file), arena, diagnostics);
    do
      tokens.push_back(lexer.next());
    while (tokens.back().kind != TokenKind::EndOfFile);
    comments = lexer.comments();
  }
  std::string kinds() const {
    std::string result;
    for (const Token& token : tokens)
      result += std::string(spelling_of(token.kind)) + ' ';
    return result;
  }
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  FileId file;
  std::vector<Token> tokens;
  std::vector<Span> comments;
};

/// The content of the one string in `text`, and no errors.
std::string content(std::string text) {
  const Lexed lexed(std::move(text));
  EXPECT_FALSE(lexed.diagnostics.has_errors());
  EXPECT_EQ(lexed.kinds(), "<string> <eof> ");
  return std::string(lexed.tokens[0].text);
}

std::string only_error(std::string text) {
  const Lexed lexed(std::move(text));
  EXPECT_EQ(lexed.diagnostics.error_count(), 1u);
  const auto sorted = lexed.diagnostics.sorted();
  if (sorted.empty()) return "";
  return std::to_string(sorted[0]->span.begin) + "-" + std::to_string(sorted[0]->span.end) + " " +
         std::string(name_of(sorted[0]->code));
}

TEST(Lexer, TakesTheLongestSymbol) {
  EXPECT_EQ(Lexed("+-*///%^#&~|<<>>==~=<=>=<>=(){}[]::;:,.......").kinds(),
            "+ - * // / % ^ # & ~ | << >> == ~= <= >= < >= ( ) { } [ ] :: ; : , ... ... . <eof> ");
}

TEST(Lexer, TellsKeywordsFromNames) {
  EXPECT_EQ(Lexed("and break do else elseif end false for function goto if in local nil not or repeat return then true "
                  "until while And _end end1 goto_")
                .kinds(),
            "and break do else elseif end false for function goto if in local nil not or repeat return then true "
            "until while <name> <name> <name> <name> <eof> ");
}

TEST(Lexer, SpansAreBytes) {
  const Lexed lexed("ab  'cd'\n--x\n  ef");
  ASSERT_EQ(lexed.tokens.size(), 4u);
  EXPECT_EQ(lexed.tokens[1].span, (Span{lexed.file, 4, 8}));
  EXPECT_EQ(lexed.tokens[2].span, (Span{lexed.file, 15, 17}));
  EXPECT_EQ(lexed.tokens[3].span, (Span{lexed.file, 17, 17}));
  EXPECT_TRUE(lexed.tokens[0].is_first_on_line);
  EXPECT_FALSE(lexed.tokens[1].is_first_on_line);
  EXPECT_TRUE(lexed.tokens[2].is_first_on_line);
}

TEST(Lexer, SkipsAFirstLineThatBeginsWithHash) {
  EXPECT_EQ(Lexed("#!/usr/bin/lua\nx").kinds(), "<name> <eof> ");
  EXPECT_EQ(Lexed("\xEF\xBB\xBF# x\nx").kinds(), "<name> <eof> ");
  EXPECT_EQ(Lexed("\xEF\xBB\xBFx").kinds(), "<name> <eof> ");
  EXPECT_EQ(Lexed("#").kinds(), "<eof> ");
  EXPECT_EQ(Lexed("\n#x").kinds(), "# <name> <eof> ");
}

TEST(Lexer, ReadsEscapes) {
  EXPECT_EQ(content(R"("\a\b\f\n\r\t\v\\\"\'")"), "\a\b\f\n\r\t\v\\\"'");
  EXPECT_EQ(content(R"('\x41\x7a\0651\10\0')"), std::string("Az"
                                                            "A1\n\0",
                                                            6));
  EXPECT_EQ(content(R"("\u{41}\u{E4}\u{20AC}\u{1F319}")"), "A\xC3\xA4\xE2\x82\xAC\xF0\x9F\x8C\x99");
  EXPECT_EQ(content(R"("\u{3FFFFFF}\u{7FFFFFFF}")"), "\xFB\xBF\xBF\xBF\xBF\xFD\xBF\xBF\xBF\xBF\xBF");
  EXPECT_EQ(content("\"a\\z \n\t\r\n b\""), "ab");
  EXPECT_EQ(content("'a\\\r\nb\\\n\rc\\\rd'"), "a\nb\nc\nd");
  EXPECT_EQ(content(std::string("'a\0b'", 5)), std::string("a\0b", 3));
  EXPECT_EQ(content("''"), "");
}

TEST(Lexer, ReadsLongStrings) {
  EXPECT_EQ(content("[[a]]"), "a");
  EXPECT_EQ(content("[==[a]]b]=]]==]"), "a]]b]=]");
  EXPECT_EQ(content("[[\r\n\na\rb\n\rc\\n]]"), "\na\nb\nc\\n");
  EXPECT_EQ(content("[=[]]]=]"), "]]");
}

TEST(Lexer, ReportsWhatFormsNoToken) {
  EXPECT_EQ(only_error("x = 'ab\ny"), "4-7 unfinished-string");
  EXPECT_EQ(only_error("'ab\\"), "0-4 unfinished-string");
  EXPECT_EQ(only_error("x [=[ ab ]]"), "2-5 unfinished-long-string");
  EXPECT_EQ(only_error("x --[[ ab"), "2-6 unfinished-long-comment");
  EXPECT_EQ(only_error("[==x"), "0-3 invalid-long-bracket");
  EXPECT_EQ(only_error("1 3x 2"), "2-4 malformed-number");
  EXPECT_EQ(only_error("'a\\qb'"), "2-4 invalid-escape");
  EXPECT_EQ(only_error("'a\\300b'"), "2-6 invalid-escape");
  EXPECT_EQ(only_error("'a\\x4gb'"), "2-5 invalid-escape");
  EXPECT_EQ(only_error("'a\\u{80000000}b'"), "2-13 invalid-escape");
  EXPECT_EQ(only_error("'a\\u{fffffffffffffffff}b'"), "2-22 invalid-escape");
  EXPECT_EQ(only_error("'a\\ub'"), "2-4 invalid-escape");
  EXPECT_EQ(only_error("'a\\u{41'"), "2-7 invalid-escape");
}

TEST(Lexer, GoesOnBehindErrors) {
  EXPECT_EQ(Lexed("x = 'ab\ny @ 3x \x80 z").kinds(),
            "<name> = <invalid> <name> <unknown> <invalid> <unknown> <name> <eof> ");
}

TEST(Lexer, GivesATokenTheCommentLinesDirectlyAboveIt) {
  const Lexed lexed("-- far\n\n-- one\n---@two\n--[[ three\n more ]]\nlocal x -- behind\ny\n-- z\n\nz");
  const Token& local_token = lexed.tokens[0];
  ASSERT_EQ(local_token.comments_end - local_token.comments_begin, 3u);
  EXPECT_EQ(lexed.sources.text(lexed.comments[local_token.comments_begin]), "-- one");
  EXPECT_EQ(lexed.sources.text(lexed.comments[local_token.comments_begin + 1]), "---@two");
  EXPECT_EQ(lexed.sources.text(lexed.comments[local_token.comments_begin + 2]), "--[[ three\n more ]]");
  for (size_t i = 1; i < lexed.tokens.size(); ++i)
    EXPECT_EQ(lexed.tokens[i].comments_begin, lexed.tokens[i].comments_end) << i;
}

TEST(Numeral, IsIntegerOrFloatAsInLua) {
  using Value = std::variant<int64_t, double>;
  EXPECT_EQ(numeral_value("9223372036854775807"), Value(INT64_MAX));
  EXPECT_EQ(numeral_value("9223372036854775808"), Value(9223372036854775808.0));
  EXPECT_EQ(numeral_value("0xffffffffffffffff"), Value(int64_t{-1}));
  EXPECT_EQ(numeral_value("0x10000000000000001"), Value(int64_t{1}));
  EXPECT_EQ(numeral_value("0XA"), Value(int64_t{10}));
  EXPECT_EQ(numeral_value("007"), Value(int64_t{7}));
  EXPECT_EQ(numeral_value("1e2"), Value(100.0));
  EXPECT_EQ(numeral_value(".5"), Value(0.5));
  EXPECT_EQ(numeral_value("3."), Value(3.0));
  EXPECT_EQ(numeral_value("0x.8p1"), Value(1.0));
  EXPECT_EQ(numeral_value("1e999"), Value(HUGE_VAL));
  EXPECT_EQ(numeral_value("1e-999"), Value(0.0));
  for (const char* text : {"", "0x", "1e", "1e+", "0x1p", "1..2", "inf", "nan", "0xg", "1 ", "0x.", ".", "1f"})
    EXPECT_FALSE(numeral_value(text)) << text;
}

TEST(Numeral, DoesNotHearOfTheLocale) {
  // A locale with a decimal comma, where the machine has one.
  const char* const old = std::setlocale(LC_ALL, nullptr);
  const std::string saved = old != nullptr ? old : "C";
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  EXPECT_EQ(numeral_value("1.5"), (std::variant<int64_t, double>(1.5)));
  std::setlocale(LC_ALL, saved.c_str());
}

} // namespace
} // namespace moonshade::syntax
