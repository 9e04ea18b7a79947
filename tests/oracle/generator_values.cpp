// Expressions of booleans, integers, numbers, vectors and matrices, with the edges of each.
#include "tests/oracle/generator_impl.h"

#include <cstdio>

namespace moonshade::oracle {

// ---- literals ------------------------------------------------------------------------------------------------------

std::string Generator::integer_literal() {
  static const std::vector<std::string> edges = {"0",
                                                 "1",
                                                 "2",
                                                 "3",
                                                 "5",
                                                 "7",
                                                 "(-1)",
                                                 "(-2)",
                                                 "(-3)",
                                                 "10",
                                                 "63",
                                                 "64",
                                                 "(-63)",
                                                 "(-64)",
                                                 "0xff",
                                                 "math.maxinteger",
                                                 "math.mininteger",
                                                 "0x7fffffffffffffff",
                                                 "0xffffffffffffffff",
                                                 "(1 << 53)",
                                                 "((1 << 53) + 1)",
                                                 "((1 << 53) - 1)",
                                                 "(-(1 << 53) - 1)",
                                                 "(1 << 62)",
                                                 "(1 << 24)",
                                                 "1000003",
                                                 "4294967296",
                                                 "2147483648"};
  return random_.chance(0.5) ? random_.pick(edges) : std::to_string(random_.between(0, 20));
}

std::string Generator::number_literal() {
  static const std::vector<std::string> edges = {"0.0",
                                                 "1.0",
                                                 "0.5",
                                                 ".25",
                                                 "3.",
                                                 "(-0.0)",
                                                 "(-1.5)",
                                                 "1e10",
                                                 "1e-10",
                                                 "2.0",
                                                 "0x1p-3",
                                                 "0x.8p1",
                                                 "1e300",
                                                 "math.pi",
                                                 "math.huge",
                                                 "(-math.huge)",
                                                 "1e-320",
                                                 "9007199254740992.0",
                                                 "9007199254740993.0",
                                                 "16777217.0",
                                                 "9223372036854775808.0",
                                                 "(-9223372036854775808.0)",
                                                 "9223372036854774784.0",
                                                 "100.75",
                                                 "(0/0)"};
  if (random_.chance(0.3)) return random_.pick(edges);
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.3f", random_.unit() * 8 - 4);
  return buffer[0] == '-' ? "(" + std::string(buffer) + ")" : buffer;
}

std::string Generator::literal(T type) {
  if (type == T::B) return random_.chance(0.5) ? "true" : "false";
  if (type == T::I) return integer_literal();
  if (type == T::N) return number_literal();
  return construct(type, 0);
}

std::string Generator::construct(T type, int depth) {
  const unsigned size = size_of(type);
  if (is_matrix(type)) {
    const std::string name = type == T::M3 ? "mat3" : "mat4";
    const T column = type == T::M3 ? T::V3 : T::V4;
    if (depth <= 0 || random_.chance(0.2)) return name + "(" + leaf(T::N, 0) + ")";
    if (random_.chance(0.15)) return name + "(" + leaf(type == T::M3 ? T::M4 : T::M3, 0) + ")";
    std::string text = name + "(";
    for (unsigned i = 0; i < size; ++i)
      text += (i ? ", " : "") + expression(column, depth - 2);
    return text + ")";
  }
  const std::string name = size == 3 && random_.chance(0.3) ? "rgb" : "vec" + std::to_string(size);
  if (random_.chance(0.15) && name != "rgb") return name + "(" + expression(T::N, depth - 1) + ")";
  if (size > 2 && name != "rgb" && random_.chance(0.15)) {
    const std::string text = name + "(" + expression(size == 3 ? T::V2 : T::V3, depth - 1);
    return text + ", " + expression(T::N, depth - 1) + ")";
  }
  std::string text = name + "(";
  for (unsigned i = 0; i < size; ++i)
    text += (i ? ", " : "") + expression(random_.chance(0.1) ? T::I : T::N, depth - 1);
  return text + ")";
}

// ---- expressions ---------------------------------------------------------------------------------------------------

std::string Generator::leaf(T type, int depth) {
  if (random_.chance(0.35))
    if (std::string text = element(type, false, depth); !text.empty()) return text;
  const auto variables = in_scope(type, false);
  if (!variables.empty() && random_.chance(0.75)) return random_.pick(variables)->name;
  return literal(type);
}

std::string Generator::expression(T type, int depth) {
  if (depth <= 0 || random_.chance(0.12)) return leaf(type, depth);
  if (random_.chance(0.12)) return conditional(type, depth);
  if (random_.chance(0.14))
    if (std::string text = call(type, depth); !text.empty()) return text;
  if (random_.chance(0.1))
    if (std::string text = call_at_once(type, depth); !text.empty()) return text;
  if (random_.chance(0.1))
    if (std::string text = element(type, false, depth); !text.empty()) return text;
  switch (type) {
  case T::B:
    return boolean(depth);
  case T::I:
    return integer(depth);
  case T::N:
    return number(depth);
  case T::M3:
  case T::M4:
    return matrix(type, depth);
  default:
    return vector(type, depth);
  }
}

std::string Generator::conditional(T type, int depth) {
  if (type == T::B) return "(" + expression(T::B, depth - 1) + " and " + expression(T::B, depth - 1) + ")";
  std::string text = "(" + expression(T::B, depth - 1) + " and " + expression(type, depth - 1);
  if (random_.chance(0.25)) text += " or " + expression(T::B, depth - 1) + " and " + expression(type, depth - 1);
  return text + " or " + expression(type, depth - 1) + ")";
}

std::string Generator::binary(const char* op, T left, T right, int depth) {
  const std::string first = expression(left, depth - 1);
  return "(" + first + " " + op + " " + expression(right, depth - 1) + ")";
}

std::string Generator::boolean(int depth) {
  static const std::vector<const char*> comparisons = {"<", "<=", ">", ">=", "==", "~="};
  const char* op = random_.pick(comparisons);
  switch (random_.below(12)) {
  case 0:
    return "not " + expression(T::B, depth - 1);
  case 1:
    return "(" + expression(T::B, depth - 1) + " or " + expression(T::B, depth - 1) + ")";
  case 2:
    return binary(op, T::I, T::I, depth);
  case 3:
    return binary(op, T::I, T::N, depth);
  case 4:
    return binary(op, T::N, T::I, depth);
  case 5:
    return "(" + expression(T::B, depth - 1) + " == " + expression(T::B, depth - 1) + ")";
  case 6: { // around the integers that floats cannot tell apart
    static const std::vector<std::string> pivots = {"(1 << 53)", "(1 << 62)", "(1 << 24)", "math.maxinteger"};
    const std::string near = "(" + random_.pick(pivots) + " - " + expression(T::I, depth - 1) + " % 4)";
    const std::string other = random_.chance(0.5) ? number_literal() : "(" + near + " * 1.0)";
    return random_.chance(0.5) ? "(" + near + " " + op + " " + other + ")" : "(" + other + " " + op + " " + near + ")";
  }
  case 7: { // of values made here: Lua finds one and the same vector equal to itself, whatever is in it
    const T type = random_.chance(0.2) ? T::M3 : random_.pick(std::vector<T>{T::V2, T::V3, T::V4});
    const std::string left = "(" + expression(type, depth - 1) + " * 1.0)";
    return "(" + left + (random_.chance(0.5) ? " == " : " ~= ") + "(" + leaf(type, 0) + " + " + leaf(type, 0) + "))";
  }
  case 8:
    return library(T::B, depth);
  case 9: // known while compiling, but for the faults inside
    return "(math.type(" + expression(random_.chance(0.5) ? T::I : T::N, depth - 1) + ") == \"integer\")";
  default:
    return binary(op, T::N, T::N, depth);
  }
}

std::string Generator::integer(int depth) {
  static const std::vector<const char*> plain = {"+", "-", "*", "&", "|", "~", "<<", ">>"};
  switch (random_.below(11)) {
  case 0:
    return "(-" + expression(T::I, depth - 1) + ")";
  case 1:
    return "(~" + expression(T::I, depth - 1) + ")";
  case 2: {
    const char* op = random_.chance(0.5) ? "//" : "%";
    if (random_.chance(0.4)) return binary(op, T::I, T::I, depth);
    return "(" + expression(T::I, depth - 1) + " " + op + " (" + expression(T::I, depth - 1) + " | 1))";
  }
  case 3:
    return "math." + std::string(random_.chance(0.5) ? "floor" : "ceil") + "(clamp(" + expression(T::N, depth - 1) +
           ", -1000.0, 1000.0) == 0 and 0.0 or 2.5)";
  case 4:
  case 5:
    return library(T::I, depth);
  case 6:
    if (!tables_.empty())
      if (const TableVariable& table = random_.pick(tables_); table.shape->is_array()) return "#" + table.name;
    return leaf(T::I, depth);
  default:
    return binary(random_.pick(plain), T::I, T::I, depth);
  }
}

std::string Generator::number(int depth) {
  static const std::vector<const char*> plain = {"+", "-", "*", "/", "+", "-", "*", "/", "//", "%", "^"};
  switch (random_.below(11)) {
  case 0:
    return "(-" + expression(T::N, depth - 1) + ")";
  case 1: {
    const std::string first = expression(T::I, depth - 1);
    return "(" + first + " / " + expression(random_.chance(0.5) ? T::I : T::N, depth - 1) + ")";
  }
  case 2:
    return binary(random_.pick(std::vector<const char*>{"+", "-", "*", "//", "%"}), T::I, T::N, depth);
  case 3: {
    static const std::vector<const char*> components = {".x", ".y", ".r", "[1]", "[2]", ".g"};
    const T from = random_.pick(std::vector<T>{T::V2, T::V3, T::V4});
    return "(" + expression(from, depth - 1) + ")" + random_.pick(components);
  }
  case 4:
  case 5:
  case 6:
    return library(T::N, depth);
  case 7:
    return "(" + expression(T::N, depth - 1) + " ^ " + random_.pick(std::vector<std::string>{"2", "2", "0.5", "3"}) +
           ")";
  case 8:
    return binary(random_.pick(std::vector<const char*>{"+", "-", "*", "/", "^"}), T::N, T::I, depth);
  default:
    return binary(random_.pick(plain), T::N, T::N, depth);
  }
}

std::string Generator::vector(T type, int depth) {
  static const std::vector<const char*> plain = {"+", "-", "*", "/", "//", "%", "*", "+"};
  switch (random_.below(10)) {
  case 0:
    return "(-" + expression(type, depth - 1) + ")";
  case 1:
    return binary(random_.pick(plain), type, T::N, depth);
  case 2:
    return binary(random_.pick(plain), random_.chance(0.5) ? T::N : T::I, type, depth);
  case 3:
    return construct(type, depth);
  case 4:
  case 5:
    return library(type, depth);
  case 6: {
    static const std::vector<const char*> swizzles2 = {".xy", ".yx", ".xx"}, swizzles3 = {".xyx", ".yxy", ".xyy"},
                                          swizzles4 = {".xyxy", ".yyxx"};
    const T from = random_.pick(std::vector<T>{T::V2, T::V3, T::V4});
    const auto& swizzles = type == T::V2 ? swizzles2 : type == T::V3 ? swizzles3 : swizzles4;
    return "(" + expression(from, depth - 1) + ")" + random_.pick(swizzles);
  }
  case 7:
    if (type != T::V2 && random_.chance(0.4)) {
      const T from = type == T::V3 ? T::M3 : T::M4;
      if (random_.chance(0.5)) return binary("*", from, type, depth);
      return "(" + expression(from, depth - 1) + ")[" + std::to_string(random_.between(1, int(size_of(type)))) + "]";
    }
    return binary("^", type, random_.chance(0.5) ? T::N : type, depth);
  default:
    return binary(random_.pick(plain), type, type, depth);
  }
}

std::string Generator::matrix(T type, int depth) {
  switch (random_.below(8)) {
  case 0:
    return "(-" + expression(type, depth - 1) + ")";
  case 1:
    return binary(random_.chance(0.5) ? "*" : "/", type, T::N, depth);
  case 2:
    return binary("*", T::N, type, depth);
  case 3:
    return binary(random_.chance(0.5) ? "+" : "-", type, type, depth);
  case 4:
    return binary("*", type, type, depth - 1);
  case 5:
    return library(type, depth - 1);
  default:
    return construct(type, depth);
  }
}

} // namespace moonshade::oracle
