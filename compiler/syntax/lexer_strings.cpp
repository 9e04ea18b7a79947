// Quoted strings with their escapes, and long brackets (llex.c: read_string, read_long_string).
#include "compiler/syntax/characters.h"
#include "compiler/syntax/lexer.h"

#include <array>

namespace moonshade::syntax {
namespace {

/// UTF-8 as Lua writes it: of any value below 2^31, in up to six bytes (lobject.c: luaO_utf8esc).
void append_utf8(std::string& out, uint32_t value) {
  if (value < 0x80) {
    out += static_cast<char>(value);
    return;
  }
  std::array<char, 6> reversed{};
  size_t size = 0;
  uint32_t first_limit = 0x3F; // the greatest value that fits the first byte
  do {
    reversed[size++] = static_cast<char>(0x80 | (value & 0x3F));
    value >>= 6;
    first_limit >>= 1;
  } while (value > first_limit);
  reversed[size++] = static_cast<char>((~first_limit << 1) | value);
  while (size > 0)
    out += reversed[--size];
}

/// The byte that a one-letter escape stands for; 0 where there is none.
char simple_escape(char letter) {
  switch (letter) {
  case 'a':
    return '\a';
  case 'b':
    return '\b';
  case 'f':
    return '\f';
  case 'n':
    return '\n';
  case 'r':
    return '\r';
  case 't':
    return '\t';
  case 'v':
    return '\v';
  case '\\':
  case '"':
  case '\'':
    return letter;
  default:
    return 0;
  }
}

} // namespace

size_t Lexer::long_bracket_size() const {
  if (peek() != '[') return 0;
  size_t size = 1;
  while (peek(size) == '=')
    ++size;
  return peek(size) == '[' ? size + 1 : 0;
}

std::optional<std::string_view> Lexer::long_bracket(size_t size, DiagnosticCode code, size_t token_begin) {
  std::string closing(size, '=');
  closing.front() = closing.back() = ']';
  at_ += size;
  if (!at_end() && is_line_break(text_[at_])) skip_line_break(); // a first line break is no content
  const size_t begin = at_;
  while (!at_end()) {
    if (is_line_break(text_[at_])) {
      skip_line_break();
    } else if (text_[at_] == ']' && text_.substr(at_, size) == closing) {
      const std::string_view content = text_.substr(begin, at_ - begin);
      at_ += size;
      return content;
    } else {
      ++at_;
    }
  }
  had_errors_ = true;
  const Span opening = {file_, static_cast<uint32_t>(token_begin), static_cast<uint32_t>(begin)};
  constexpr size_t kMaxShown = 20;
  if (closing.size() > kMaxShown) closing = closing.substr(0, kMaxShown) + "...";
  diagnostics_.report(code, opening, {closing});
  return {};
}

/// Each line break of a long string, of whichever form, is one line feed.
std::string_view Lexer::normalise_line_breaks(std::string_view content) {
  if (content.find('\r') == std::string_view::npos) return content;
  buffer_.clear();
  for (size_t i = 0; i < content.size(); ++i) {
    if (!is_line_break(content[i])) {
      buffer_ += content[i];
      continue;
    }
    buffer_ += '\n';
    if (i + 1 < content.size() && is_line_break(content[i + 1]) && content[i + 1] != content[i]) ++i;
  }
  return arena_.copy(std::string_view(buffer_));
}

void Lexer::scan_left_bracket(Token& token, size_t begin) {
  if (const size_t size = long_bracket_size(); size != 0) {
    const auto content = long_bracket(size, DiagnosticCode::UnfinishedLongString, begin);
    token.kind = content ? TokenKind::String : TokenKind::Invalid;
    token.text = normalise_line_breaks(content.value_or(""));
    return;
  }
  ++at_;
  token.kind = TokenKind::LeftBracket;
  if (peek() != '=') return;
  while (peek() == '=')
    ++at_;
  token.kind = TokenKind::Invalid;
  report(DiagnosticCode::InvalidLongBracket, begin, {});
}

void Lexer::scan_string(Token& token, size_t begin) {
  const char quote = text_[at_++];
  token.kind = TokenKind::String;
  buffer_.clear();
  bool has_escapes = false;
  while (!at_end() && text_[at_] != quote && !is_line_break(text_[at_])) {
    if (text_[at_] == '\\') {
      has_escapes = true;
      scan_escape();
    } else {
      buffer_ += text_[at_++];
    }
  }
  const std::string_view plain = text_.substr(begin + 1, at_ - begin - 1);
  token.text = has_escapes ? arena_.copy(std::string_view(buffer_)) : plain;
  if (accept(quote)) return;
  token.kind = TokenKind::Invalid;
  report(DiagnosticCode::UnfinishedString, begin, {std::string(1, quote)});
}

void Lexer::scan_escape() {
  const size_t begin = at_++;
  if (at_end()) return; // the string is unfinished, which is reported
  const char c = text_[at_];
  if (const char byte = simple_escape(c)) {
    ++at_;
    buffer_ += byte;
  } else if (is_line_break(c)) {
    skip_line_break();
    buffer_ += '\n';
  } else if (c == 'z') {
    ++at_;
    while (!at_end() && is_space(text_[at_]))
      is_line_break(text_[at_]) ? skip_line_break() : void(++at_);
  } else if (is_digit(c)) {
    scan_decimal_escape(begin);
  } else if (c == 'x') {
    scan_hex_escape(begin);
  } else if (c == 'u') {
    scan_utf8_escape(begin);
  } else {
    ++at_;
    report(DiagnosticCode::InvalidEscape, begin, {"no such letter behind '\\'"});
  }
}

void Lexer::scan_decimal_escape(size_t begin) {
  unsigned value = 0;
  for (int i = 0; i < 3 && is_digit(peek()); ++i)
    value = value * 10 + static_cast<unsigned>(text_[at_++] - '0');
  if (value > 255) report(DiagnosticCode::InvalidEscape, begin, {"a byte is at most \\255"});
  buffer_ += static_cast<char>(value);
}

void Lexer::scan_hex_escape(size_t begin) {
  ++at_; // x
  uint32_t value = 0;
  for (int i = 0; i < 2; ++i) {
    if (!is_hex_digit(peek())) {
      report(DiagnosticCode::InvalidEscape, begin, {"two hexadecimal digits expected behind '\\x'"});
      return;
    }
    value = value * 16 + hex_digit_value(text_[at_++]);
  }
  buffer_ += static_cast<char>(value);
}

void Lexer::scan_utf8_escape(size_t begin) {
  ++at_; // u
  if (!accept('{')) return report(DiagnosticCode::InvalidEscape, begin, {"'{' expected behind '\\u'"});
  if (!is_hex_digit(peek())) return report(DiagnosticCode::InvalidEscape, begin, {"hexadecimal digit expected"});
  uint32_t value = 0;
  bool is_too_large = false;
  while (is_hex_digit(peek())) {
    is_too_large = is_too_large || value > (0x7FFFFFFFu >> 4);
    value = value * 16 + hex_digit_value(text_[at_++]);
  }
  if (is_too_large) return report(DiagnosticCode::InvalidEscape, begin, {"a character is below \\u{80000000}"});
  if (!accept('}')) return report(DiagnosticCode::InvalidEscape, begin, {"'}' expected behind '\\u{'"});
  append_utf8(buffer_, value);
}

} // namespace moonshade::syntax
