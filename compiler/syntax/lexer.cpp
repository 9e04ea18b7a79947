// Blanks, comments, names, symbols and numerals; strings are in lexer_strings.cpp.
#include "compiler/syntax/lexer.h"

#include "compiler/syntax/characters.h"
#include "compiler/syntax/numeral.h"

namespace moonshade::syntax {

Lexer::Lexer(FileId file, std::string_view text, Arena& arena, Diagnostics& diagnostics)
    : file_(file), text_(text), arena_(arena), diagnostics_(diagnostics) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  if (peek() == '#') skip_first_line();
}

Token Lexer::next() {
  skip_blanks_and_comments();
  Token token = scan(at_);
  token.is_first_on_line = is_line_start_;
  if (run_line_ + 1 == line_ && token.is_first_on_line && run_line_ != 0) {
    token.comments_begin = static_cast<uint32_t>(run_begin_);
    token.comments_end = static_cast<uint32_t>(comments_.size());
  }
  is_line_start_ = false;
  run_line_ = 0;
  return token;
}

bool Lexer::accept(char c) {
  if (at_end() || text_[at_] != c) return false;
  ++at_;
  return true;
}

Span Lexer::span_from(size_t begin) const { return {file_, static_cast<uint32_t>(begin), static_cast<uint32_t>(at_)}; }

void Lexer::report(DiagnosticCode code, size_t begin, std::initializer_list<std::string> args) {
  had_errors_ = true;
  diagnostics_.report(code, span_from(begin), args);
}

void Lexer::skip_first_line() {
  while (!at_end() && text_[at_] != '\n')
    ++at_; // as luaL_loadfilex: up to a line feed only
}

/// One line break, which may be two bytes: CR LF or LF CR.
void Lexer::skip_line_break() {
  const char first = text_[at_++];
  if (!at_end() && is_line_break(text_[at_]) && text_[at_] != first) ++at_;
  ++line_;
}

void Lexer::skip_blanks_and_comments() {
  while (!at_end()) {
    if (is_line_break(text_[at_])) {
      skip_line_break();
      is_line_start_ = true;
    } else if (is_blank(text_[at_])) {
      ++at_;
    } else if (peek() == '-' && peek(1) == '-') {
      skip_comment();
    } else {
      return;
    }
  }
}

/// A comment of either form. Comments that stand alone on adjacent lines form a run, which the token on the line below
/// gets.
void Lexer::skip_comment() {
  const size_t begin = at_;
  const uint32_t first_line = line_;
  at_ += 2;
  if (const size_t size = long_bracket_size(); size != 0) {
    long_bracket(size, DiagnosticCode::UnfinishedLongComment, begin);
  } else {
    while (!at_end() && !is_line_break(text_[at_]))
      ++at_;
  }
  const bool continues_run = run_line_ != 0 && run_line_ + 1 == first_line;
  if (is_line_start_ && !continues_run) run_begin_ = comments_.size();
  if (is_line_start_) run_line_ = line_;
  comments_.push_back(span_from(begin));
}

Token Lexer::scan(size_t begin) {
  Token token;
  if (at_end()) {
    token.kind = TokenKind::EndOfFile;
  } else if (const char c = text_[at_]; is_name_start(c)) {
    while (!at_end() && is_name_part(text_[at_]))
      ++at_;
    token.text = text_.substr(begin, at_ - begin);
    token.kind = keyword_or_name(token.text);
  } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
    scan_numeral(token, begin);
  } else if (c == '"' || c == '\'') {
    scan_string(token, begin);
  } else if (c == '[') {
    scan_left_bracket(token, begin);
  } else {
    token.kind = scan_symbol();
  }
  token.span = span_from(begin);
  return token;
}

TokenKind Lexer::scan_symbol() {
  switch (text_[at_++]) {
  case '+':
    return TokenKind::Plus;
  case '-':
    return TokenKind::Minus;
  case '*':
    return TokenKind::Star;
  case '%':
    return TokenKind::Percent;
  case '^':
    return TokenKind::Caret;
  case '#':
    return TokenKind::Hash;
  case '&':
    return TokenKind::Ampersand;
  case '|':
    return TokenKind::Pipe;
  case '(':
    return TokenKind::LeftParen;
  case ')':
    return TokenKind::RightParen;
  case '{':
    return TokenKind::LeftBrace;
  case '}':
    return TokenKind::RightBrace;
  case ']':
    return TokenKind::RightBracket;
  case ';':
    return TokenKind::Semicolon;
  case ',':
    return TokenKind::Comma;
  case '/':
    return accept('/') ? TokenKind::FloorDivide : TokenKind::Slash;
  case '~':
    return accept('=') ? TokenKind::NotEqual : TokenKind::Tilde;
  case '=':
    return accept('=') ? TokenKind::EqualEqual : TokenKind::Equal;
  case ':':
    return accept(':') ? TokenKind::DoubleColon : TokenKind::Colon;
  case '<':
    return accept('<') ? TokenKind::ShiftLeft : accept('=') ? TokenKind::LessEqual : TokenKind::Less;
  case '>':
    return accept('>') ? TokenKind::ShiftRight : accept('=') ? TokenKind::GreaterEqual : TokenKind::Greater;
  case '.':
    return !accept('.') ? TokenKind::Dot : accept('.') ? TokenKind::Dots : TokenKind::Concat;
  default:
    return TokenKind::Unknown;
  }
}

/// Takes everything that looks like part of a numeral (llex.c: read_numeral) and then asks for its value.
void Lexer::scan_numeral(Token& token, size_t begin) {
  const bool is_hex = accept('0') && (accept('x') || accept('X'));
  while (!at_end()) {
    const char lower = static_cast<char>(text_[at_] | 0x20);
    if (lower == (is_hex ? 'p' : 'e')) {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
    } else if (is_hex_digit(text_[at_]) || text_[at_] == '.') {
      ++at_;
    } else {
      break;
    }
  }
  while (!at_end() && is_name_part(text_[at_]))
    ++at_; // touching a name is an error
  const std::string_view text = text_.substr(begin, at_ - begin);
  const auto value = numeral_value(text);
  if (!value) {
    report(DiagnosticCode::MalformedNumber, begin, {std::string(text.substr(0, 40))});
    token.kind = TokenKind::Invalid;
  } else if (const auto* integer = std::get_if<int64_t>(&*value)) {
    token.kind = TokenKind::Integer;
    token.integer = *integer;
  } else {
    token.kind = TokenKind::Number;
    token.number = std::get<double>(*value);
  }
}

} // namespace moonshade::syntax
