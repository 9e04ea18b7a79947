#include "generator.h"

#include <array>

namespace moonshade::test {
namespace {

using Pool = std::string_view;

constexpr auto kNames = std::to_array<Pool>({"a", "b", "c", "x", "_ENV", "self", "long_name_1"});
constexpr auto kLabels = std::to_array<Pool>({"l", "m", "break_", "a"});
constexpr auto kBinary = std::to_array<Pool>({"+",  "-",  "*",  "/",  "//", "%",  "^", "&",  "|",   "~", "<<",
                                              ">>", "..", "==", "~=", "<",  "<=", ">", ">=", "and", "or"});
constexpr auto kUnary = std::to_array<Pool>({"-", "not", "#", "~"});
constexpr auto kAttribs = std::to_array<Pool>({"<const>", "<close>", "< const >", "<foo>"});
constexpr auto kTokens = std::to_array<Pool>({"and",      "break",
                                              "do",       "else",
                                              "elseif",   "end",
                                              "false",    "for",
                                              "function", "goto",
                                              "if",       "in",
                                              "local",    "nil",
                                              "not",      "or",
                                              "repeat",   "return",
                                              "then",     "true",
                                              "until",    "while",
                                              "+",        "-",
                                              "*",        "/",
                                              "//",       "%",
                                              "^",        "#",
                                              "&",        "~",
                                              "|",        "<<",
                                              ">>",       "==",
                                              "~=",       "<=",
                                              ">=",       "<",
                                              ">",        "=",
                                              "(",        ")",
                                              "{",        "}",
                                              "[",        "]",
                                              "::",       ";",
                                              ":",        ",",
                                              ".",        "..",
                                              "...",      "<const>",
                                              "<close>",  "a",
                                              "b",        "x",
                                              "_ENV",     "1",
                                              "0x1p4",    "1e9",
                                              "'s'",      "\"t\"",
                                              "[[l]]",    "[==[",
                                              "]==]",     "--",
                                              "--[[",     "]]",
                                              "[=",       "!",
                                              "@",        "?",
                                              "\\",       "'",
                                              "\"",       "3..2",
                                              "0x",       "1e",
                                              "\n",       "\r\n",
                                              "::l::",    "goto l",
                                              "break;",   "local a <const> = 1",
                                              "a = 2",    "function a()",
                                              "end",      "end",
                                              "do",       "then",
                                              "until"});
constexpr auto kBytes = std::to_array<char>(
    {'\0', '\n', '\r', ' ', '\t', '\v', '\f', '"', '\'',   '\\',   '[', ']', '=', '-', '(', ')', '{', '}', '.',
     '~',  '0',  '9',  'x', 'e',  'p',  'u',  'z', '\x80', '\xff', '#', '<', '>', ':', ';', '@', '$', '!'});

/// Cuts a program into rough tokens: words, runs of blanks, single symbols.
std::vector<std::string> pieces_of(std::string_view program) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  std::vector<std::string> pieces;
  for (size_t i = 0; i < program.size();) {
    size_t end = i + 1;
    while (is_word(program[i]) && end < program.size() && is_word(program[end]))
      ++end;
    pieces.emplace_back(program.substr(i, end - i));
    i = end;
  }
  return pieces;
}

} // namespace

void Generator::put(std::string_view token) {
  gap();
  out_ += token;
}

void Generator::gap() {
  if (!has_line_breaks_) {
    out_ += chance(98) ? " " : " --[[ comment ]] ";
    return;
  }
  switch (below(40)) {
  case 0:
    out_ += "\n";
    break;
  case 1:
    out_ += "\r\n";
    break;
  case 2:
    out_ += " -- comment\n";
    break;
  case 3:
    out_ += " --[[ long\n comment ]] ";
    break;
  case 4:
    out_ += " --[==[ ]] ]==] ";
    break;
  case 5:
    out_ += "\t\v\f";
    break;
  default:
    out_ += ' ';
    break;
  }
}

std::string Generator::program() {
  out_.clear();
  loops_ = 0;
  is_vararg_ = true;
  if (chance(2)) out_ = "#!/usr/bin/lua x\n";
  block(4);
  return out_;
}

std::string Generator::program_on_one_line() {
  out_.clear();
  loops_ = 0;
  is_vararg_ = true;
  has_line_breaks_ = false;
  block(4);
  has_line_breaks_ = true;
  return out_;
}

std::string Generator::program_of_jumps() {
  out_.clear();
  has_line_breaks_ = false;
  jumps(4);
  has_line_breaks_ = true;
  return out_;
}

void Generator::jumps(int depth) {
  for (unsigned i = below(5); i > 0; --i)
    jump_stat(depth);
}

void Generator::jump_stat(int depth) {
  switch (below(depth > 0 ? 13 : 9)) {
  case 0:
  case 1:
  case 2:
    return put("goto"), put(pick(kLabels));
  case 3:
  case 4:
  case 5:
    return put("::"), put(pick(kLabels)), put("::");
  case 6:
    return put("local"), put(pick(kNames));
  case 7:
    return put(";");
  case 8:
    return put("f()");
  case 9:
    put("repeat");
    if (chance(40)) put("if a then goto l end"), jumps(depth - 1), put(chance(50) ? "local x" : ""), put("::l::");
    return jumps(depth - 1), put("until"), put(pick(kNames));
  case 10:
    return put("if a then"), jumps(depth - 1), put(chance(50) ? "else" : "elseif b then"), jumps(depth - 1), put("end");
  case 11:
    return put(chance(80) ? "do" : "local function f()"), jumps(depth - 1), put("end");
  default:
    return put(chance(50) ? "while a do" : "for b = 1, 2 do"), jumps(depth - 1), put("end");
  }
}

void Generator::block(int depth) {
  const unsigned count = below(depth > 2 ? 8 : 5);
  for (unsigned i = 0; i < count; ++i) {
    stat(depth);
    if (chance(15)) put(";");
  }
  if (chance(12)) {
    put("return");
    if (chance(70)) exprs(depth);
    if (chance(20)) put(";");
  } else if (chance(10)) {
    put("::");
    put(pick(kLabels));
    put("::");
  }
}

void Generator::stat(int depth) {
  const unsigned kind = below(depth > 0 ? 20 : 9);
  switch (kind) {
  case 0:
  case 1:
    var(depth);
    while (chance(20))
      put(","), var(depth);
    put("=");
    return exprs(depth);
  case 2:
  case 3:
    return suffixed(depth, true);
  case 4:
  case 5:
  case 6:
    return local(depth);
  case 7:
    if (chance(50)) return put("::"), put(pick(kLabels)), put("::");
    return put("goto"), put(pick(kLabels));
  case 8:
    if (loops_ > 0 || chance(3)) return put("break");
    return put(";");
  case 9:
    return put("do"), block(depth - 1), put("end");
  case 10:
  case 11:
    put("if"), expr(depth), put("then"), block(depth - 1);
    while (chance(25))
      put("elseif"), expr(depth), put("then"), block(depth - 1);
    if (chance(40)) put("else"), block(depth - 1);
    return put("end");
  case 12:
  case 13:
  case 14:
    put("function"), put(pick(kNames));
    while (chance(20))
      put("."), put(pick(kNames));
    if (chance(20)) put(":"), put(pick(kNames));
    return function_rest(depth);
  case 15:
    return put("local"), put("function"), put(pick(kNames)), function_rest(depth);
  default:
    return loop(depth);
  }
}

void Generator::loop(int depth) {
  const unsigned kind = below(4);
  if (kind == 0) {
    put("repeat");
    ++loops_, block(depth - 1), --loops_;
    put("until");
    return expr(depth);
  }
  if (kind == 1) {
    put("while"), expr(depth);
  } else if (kind == 2) {
    put("for"), put(pick(kNames)), put("="), expr(depth), put(","), expr(depth);
    if (chance(30)) put(","), expr(depth);
  } else {
    put("for"), put(pick(kNames));
    while (chance(30))
      put(","), put(pick(kNames));
    put("in"), exprs(depth);
  }
  put("do");
  ++loops_, block(depth - 1), --loops_;
  put("end");
}

void Generator::local(int depth) {
  put("local");
  do {
    put(pick(kNames));
    if (chance(12)) put(chance(80) ? "<const>" : pick(kAttribs));
  } while (chance(30) && (put(","), true));
  if (chance(80)) put("="), exprs(depth);
}

void Generator::function_rest(int depth) {
  put("(");
  bool is_vararg = chance(30);
  const unsigned count = below(4);
  for (unsigned i = 0; i < count; ++i) {
    if (i > 0) put(",");
    put(pick(kNames));
  }
  if (is_vararg) put(count > 0 ? ", ..." : "...");
  put(")");
  std::swap(is_vararg, is_vararg_);
  const int loops = loops_;
  loops_ = 0;
  block(depth - 1);
  loops_ = loops;
  std::swap(is_vararg, is_vararg_);
  put("end");
}

void Generator::exprs(int depth) {
  expr(depth);
  while (chance(25))
    put(","), expr(depth);
}

void Generator::expr(int depth) {
  switch (below(depth > 0 ? 17 : 7)) {
  case 0:
    return put(numeral());
  case 1:
    return put(string_literal());
  case 2:
    return put(chance(40) ? "nil" : chance(50) ? "true" : "false");
  case 3:
    return put(is_vararg_ || chance(2) ? "..." : "nil");
  case 4:
  case 5:
  case 6:
    return put(pick(kNames));
  case 7:
  case 8:
  case 9:
    return expr(depth - 1), put(pick(kBinary)), expr(depth - 1);
  case 10:
    put(pick(kUnary));
    return expr(depth - 1);
  case 11:
    return put("("), expr(depth - 1), put(")");
  case 12:
    return table(depth - 1);
  case 13:
    return put("function"), function_rest(depth - 2);
  default:
    return suffixed(depth - 1, false);
  }
}

void Generator::var(int depth) {
  if (depth <= 0 || chance(60)) return put(pick(kNames));
  suffixed(depth - 1, false);
  if (chance(60)) return put("."), put(pick(kNames));
  if (chance(80)) put("["), expr(depth - 1), put("]");
}

void Generator::suffixed(int depth, bool must_be_call) {
  if (depth > 0 && chance(10))
    put("("), expr(depth - 1), put(")");
  else
    put(pick(kNames));
  bool is_call = false;
  for (unsigned i = below(3) + (must_be_call ? 1 : 0); i > 0 || (must_be_call && !is_call && chance(99)); i -= i > 0) {
    const unsigned kind = below(7);
    is_call = kind >= 2;
    switch (kind) {
    case 0:
      put("."), put(pick(kNames));
      break;
    case 1:
      put("["), expr(depth - 1), put("]");
      break;
    case 2:
      put(":"), put(pick(kNames)), put("("), put(")");
      break;
    case 3:
      put(string_literal());
      break;
    case 4:
      table(depth - 1);
      break;
    default:
      put("(");
      if (chance(70)) exprs(depth - 1);
      put(")");
    }
  }
}

void Generator::table(int depth) {
  put("{");
  while (chance(60)) {
    const unsigned kind = below(3);
    if (kind == 0) put(pick(kNames)), put("=");
    if (kind == 1) put("["), expr(depth - 1), put("]"), put("=");
    expr(depth - 1);
    if (chance(10)) break;
    put(chance(80) ? "," : ";");
  }
  put("}");
}

std::string Generator::numeral() {
  const auto digits = [&](std::string_view pool, unsigned most) {
    std::string result;
    for (unsigned i = below(most + 1); i > 0; --i)
      result += pool[below(static_cast<unsigned>(pool.size()))];
    return result;
  };
  constexpr std::string_view kDecimal = "0123456789", kHex = "0123456789abcdefABCDEF";
  const bool is_hex = chance(40);
  const std::string_view pool = is_hex ? kHex : kDecimal;
  const unsigned most = chance(20) ? 40 : 20;
  std::string result = is_hex ? (chance(50) ? "0x" : "0X") : "";
  result += std::string(1, pool[below(10)]) + digits(pool, most);
  if (chance(40)) result += "." + digits(pool, most);
  if (chance(30)) {
    result += is_hex ? (chance(50) ? "p" : "P") : (chance(50) ? "e" : "E");
    if (chance(50)) result += chance(50) ? "-" : "+";
    result += std::to_string(below(chance(50) ? 10 : 1200));
  }
  return result;
}

std::string Generator::string_literal() {
  if (has_line_breaks_ && chance(15)) {
    const std::string level(below(3), '=');
    const std::string_view content = pick(std::to_array<Pool>({"", "x]y", "\nabc", "a\r\nb\rc\n\rd", "\\n", "\r\r"}));
    return "[" + level + "[" + std::string(content) + "]" + level + "]";
  }
  constexpr auto kParts = std::to_array<Pool>({"a",
                                               "b c",
                                               "\\n",
                                               "\\z  \n\t ",
                                               "\\x41",
                                               "\\065",
                                               "\\7",
                                               "\\u{48}",
                                               "\\u{7FF}",
                                               "\\u{FFFF}",
                                               "\\u{1FFFFF}",
                                               "\\u{3FFFFFF}",
                                               "\\u{7FFFFFFF}",
                                               "\\\n",
                                               "\\\r\n",
                                               "\\\\",
                                               "\\'",
                                               "\\\"",
                                               "\\a\\b\\f\\v\\r\\t",
                                               "\xC3\xA4",
                                               "\xff",
                                               "\\255",
                                               "\\0001",
                                               "--"});
  constexpr auto kBadParts = std::to_array<Pool>(
      {"\\q", "\\256", "\\xg1", "\\x1", "\\u{}", "\\u{80000000}", "\\u{1", "\n", "\\u1", "\\u{FFFFFFFFFF}", "\\"});
  const char quote = chance(50) ? '"' : '\'';
  std::string result(1, quote);
  for (unsigned i = below(5); i > 0; --i)
    result += pick(kParts);
  if (chance(1)) result += pick(kBadParts);
  return result + quote;
}

std::string Generator::any_token() {
  if (chance(4)) return numeral();
  if (chance(4)) return string_literal();
  return std::string(pick(kTokens));
}

std::string Generator::token_stream() {
  std::string result;
  for (unsigned i = below(20) + 1; i > 0; --i) {
    result += any_token();
    if (chance(95)) result += ' ';
  }
  return result;
}

std::string Generator::mutated(std::string_view program) {
  return chance(70) ? mutate_tokens(program) : mutate_bytes(program);
}

std::string Generator::mutate_tokens(std::string_view program) {
  std::vector<std::string> pieces = pieces_of(program);
  for (unsigned i = below(3) + 1; i > 0 && !pieces.empty(); --i) {
    const auto size = static_cast<unsigned>(pieces.size());
    const unsigned at = below(size), other = below(size);
    switch (below(5)) {
    case 0:
      pieces.erase(pieces.begin() + at);
      break;
    case 1:
      pieces.insert(pieces.begin() + at, pieces[other]);
      break;
    case 2:
      std::swap(pieces[at], pieces[other]);
      break;
    case 3:
      pieces[at] = any_token();
      break;
    default:
      pieces.insert(pieces.begin() + at, " " + any_token() + " ");
      break;
    }
  }
  std::string result;
  for (const std::string& piece : pieces)
    result += piece;
  return result;
}

std::string Generator::mutate_bytes(std::string_view program) {
  std::string result(program);
  for (unsigned i = below(4) + 1; i > 0 && !result.empty(); --i) {
    const unsigned at = below(static_cast<unsigned>(result.size()));
    const char byte = kBytes[below(kBytes.size())];
    switch (below(4)) {
    case 0:
      result.erase(at, 1);
      break;
    case 1:
      result.insert(at, 1, byte);
      break;
    case 2:
      result[at] = byte;
      break;
    default:
      result.resize(at);
      break;
    }
  }
  return result;
}

} // namespace moonshade::test
