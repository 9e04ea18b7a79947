// The lexer: bytes to tokens as llex.c does it, one at a time. Any bytes may occur; what forms no token is reported
// (or handed on as TokenKind::Unknown) and lexing goes on behind it.
#pragma once

#include "compiler/base/arena.h"
#include "compiler/base/diagnostics.h"
#include "compiler/syntax/token.h"

#include <optional>
#include <string>
#include <vector>

namespace moonshade::syntax {

class Lexer {
public:
  /// `text` is the whole file; a byte order mark and a first line that begins with '#' are skipped. Names and plain
  /// strings are views into it, strings with escapes live in the arena.
  Lexer(FileId file, std::string_view text, Arena& arena, Diagnostics& diagnostics);

  /// The next token; at the end of the text EndOfFile, again and again.
  Token next();

  /// All comments so far, in order, each from its `--` to its end (without the line break).
  const std::vector<Span>& comments() const { return comments_; }
  bool had_errors() const { return had_errors_; }

private:
  // lexer.cpp
  bool at_end() const { return at_ >= text_.size(); }
  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool accept(char c);
  Span span_from(size_t begin) const;
  void report(DiagnosticCode code, size_t begin, std::initializer_list<std::string> args);
  void skip_first_line();
  void skip_line_break();
  void skip_blanks_and_comments();
  void skip_comment();
  Token scan(size_t begin);
  TokenKind scan_symbol();
  void scan_numeral(Token& token, size_t begin);

  // lexer_strings.cpp
  /// Bytes of a long bracket's opening ("[==[") at the current place; 0 where there is none.
  size_t long_bracket_size() const;
  /// Reads a long bracket to its end; its content. Where it has no end, `code` is reported.
  std::optional<std::string_view> long_bracket(size_t size, DiagnosticCode code, size_t token_begin);
  std::string_view normalise_line_breaks(std::string_view content);
  void scan_left_bracket(Token& token, size_t begin);
  void scan_string(Token& token, size_t begin);
  void scan_escape();
  void scan_decimal_escape(size_t begin);
  void scan_hex_escape(size_t begin);
  void scan_utf8_escape(size_t begin);

  FileId file_;
  std::string_view text_;
  Arena& arena_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  uint32_t line_ = 1;
  bool is_line_start_ = true; // nothing but blanks and comments yet on this line
  bool had_errors_ = false;
  std::string buffer_; // the string being read
  std::vector<Span> comments_;
  size_t run_begin_ = 0;  // first of the comments that stand on lines of their own, one right below the other
  uint32_t run_line_ = 0; // the last line of that run; 0: there is none
};

} // namespace moonshade::syntax
