// Tokens, as the lexer hands them to the parser.
#pragma once

#include "compiler/base/source.h"

#include <cstdint>
#include <string_view>

namespace moonshade::syntax {

enum class TokenKind : uint8_t {
#define MOONSHADE_TOKEN(name, spelling) name,
#include "compiler/syntax/tokens.def"
};

/// "while", "<=", "<name>".
std::string_view spelling_of(TokenKind kind);

/// The reserved word `text`, or TokenKind::Name.
TokenKind keyword_or_name(std::string_view text);

struct Token {
  TokenKind kind = TokenKind::EndOfFile;
  /// Nothing but blanks and comments stands before it on its line.
  bool is_first_on_line = false;
  Span span;
  /// The name, or the string with its escapes replaced.
  std::string_view text;
  int64_t integer = 0;
  double number = 0;
  /// Of Lexer::comments(): the lines of comment immediately before the token's line.
  uint32_t comments_begin = 0;
  uint32_t comments_end = 0;
};

} // namespace moonshade::syntax
