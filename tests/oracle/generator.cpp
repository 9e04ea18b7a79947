// The generator: expressions by wanted type over what is in scope, statements by weight, functions before their use.
// What it avoids, because the dialect leaves it open or states it as different from stock Lua: variables that mix
// integers and numbers, conversions out of the integer range, equality of vectors with NaN, calls that assign what the
// same expression reads.
#include "tests/oracle/generator.h"

#include "tests/oracle/random.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace moonshade::oracle {
namespace {

enum class T : uint8_t { B, I, N, V2, V3, V4 };

struct Variable {
  std::string name;
  T type;
  bool assignable;
};

struct FunctionInfo {
  std::string name;
  std::vector<T> parameters;
  std::vector<T> results;
  /// Assigns variables of an enclosing function: called only as a statement of its own.
  bool assigns;
};

/// A library function by the types it is tried with here.
struct LibraryCall {
  const char* name;
  std::vector<T> parameters;
  T result;
};

const std::vector<LibraryCall>& library_calls() {
  using enum T;
  static const std::vector<LibraryCall> calls = {
      {"abs", {N}, N},
      {"sign", {N}, N},
      {"floor", {N}, N},
      {"ceil", {N}, N},
      {"fract", {N}, N},
      {"round", {N}, N},
      {"trunc", {N}, N},
      {"mod", {N, N}, N},
      {"min", {N, N}, N},
      {"max", {N, N}, N},
      {"clamp", {N, N, N}, N},
      {"saturate", {N}, N},
      {"mix", {N, N, N}, N},
      {"step", {N, N}, N},
      {"smoothstep", {N, N, N}, N},
      {"sqrt", {N}, N},
      {"sin", {N}, N},
      {"cos", {N}, N},
      {"exp", {N}, N},
      {"log", {N}, N},
      {"pow", {N, N}, N},
      {"radians", {N}, N},
      {"atan", {N, N}, N},
      {"inversesqrt", {N}, N},
      {"linearstep", {N, N, N}, N},
      {"pulse", {N, N, N}, N},
      {"bias", {N, N}, N},
      {"gain", {N, N}, N},
      {"smootherstep", {N, N, N}, N},
      {"tan", {N}, N},
      {"asin", {N}, N},
      {"acos", {N}, N},
      {"math.sin", {N}, N},
      {"math.cos", {N}, N},
      {"math.sqrt", {N}, N},
      {"math.abs", {N}, N},
      {"math.abs", {I}, I},
      {"math.fmod", {N, N}, N},
      {"math.max", {I, I}, I},
      {"math.min", {N, N}, N},
      {"math.exp", {N}, N},
      {"math.ult", {I, I}, B},
      {"abs", {V3}, V3},
      {"floor", {V3}, V3},
      {"fract", {V2}, V2},
      {"min", {V3, V3}, V3},
      {"max", {V4, N}, V4},
      {"clamp", {V3, N, N}, V3},
      {"mix", {V3, V3, N}, V3},
      {"mix", {V4, V4, V4}, V4},
      {"smoothstep", {N, N, V2}, V2},
      {"sin", {V3}, V3},
      {"pow", {V2, N}, V2},
      {"step", {V3, V3}, V3},
      {"dot", {V2, V2}, N},
      {"dot", {V3, V3}, N},
      {"dot", {V4, V4}, N},
      {"cross", {V3, V3}, V3},
      {"length", {V2}, N},
      {"length", {V3}, N},
      {"length", {V4}, N},
      {"distance", {V3, V3}, N},
      {"normalize", {V3}, V3},
      {"normalize", {V2}, V2},
      {"reflect", {V3, V3}, V3},
      {"refract", {V3, V3, N}, V3},
      {"faceforward", {V3, V3, V3}, V3},
      {"noise", {V2}, N},
      {"noise", {V3}, N},
      {"perlin", {V2}, N},
      {"perlin", {V3}, N},
      {"turbulence", {V3}, N},
      {"fbm", {V3}, N},
      {"hash", {N}, N},
      {"hash", {I}, N},
      {"hash", {V2}, N},
      {"hash", {V3}, N},
  };
  return calls;
}

class Generator {
public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  std::string program() {
    parameters();
    const int constants = random_.between(0, 4);
    for (int i = 0; i < constants; ++i)
      top_level_constant();
    if (random_.chance(0.3)) top_level_loop();
    const int functions = random_.between(0, 4);
    for (int i = 0; i < functions; ++i)
      function(true);
    entry();
    return std::move(text_);
  }

private:
  // ---- output and names ----
  void line(const std::string& text) {
    text_.append(static_cast<size_t>(2 * indent_), ' ');
    text_ += text;
    text_ += '\n';
  }
  void open(const std::string& text) {
    line(text);
    ++indent_;
  }
  void close(const std::string& text = "end") {
    --indent_;
    line(text);
  }
  std::string fresh(const char* prefix) { return prefix + std::to_string(next_name_++); }
  T any_type() {
    static const std::vector<T> weighted = {T::N, T::N, T::N, T::I, T::I, T::B, T::V3, T::V3, T::V2, T::V4};
    return random_.pick(weighted);
  }

  std::vector<const Variable*> in_scope(T type, bool assignable) const {
    std::vector<const Variable*> result;
    for (const Variable& variable : scope_)
      if (variable.type == type && (variable.assignable || !assignable)) result.push_back(&variable);
    return result;
  }

  // ---- literals ----
  std::string integer_literal() {
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
                                                   "0xff",
                                                   "math.maxinteger",
                                                   "math.mininteger",
                                                   "0x7fffffffffffffff",
                                                   "0xffffffffffffffff",
                                                   "(1 << 53)",
                                                   "((1 << 53) + 1)",
                                                   "(1 << 62)",
                                                   "1000003",
                                                   "2147483648"};
    return random_.chance(0.5) ? random_.pick(edges) : std::to_string(random_.between(0, 20));
  }
  std::string number_literal() {
    static const std::vector<std::string> edges = {
        "0.0",    "1.0",    "0.5",    ".25",   "3.",      "(-0.0)",    "(-1.5)",       "1e10",   "1e-10",
        "2.0",    "0x1p-3", "0x.8p1", "1e300", "math.pi", "math.huge", "(-math.huge)", "1e-320", "9007199254740993.0",
        "100.75", "(0/0)"};
    if (random_.chance(0.3)) return random_.pick(edges);
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.3f", random_.unit() * 8 - 4);
    return buffer[0] == '-' ? "(" + std::string(buffer) + ")" : buffer;
  }
  std::string literal(T type) {
    switch (type) {
    case T::B:
      return random_.chance(0.5) ? "true" : "false";
    case T::I:
      return integer_literal();
    case T::N:
      return number_literal();
    default:
      return construct(type, 0);
    }
  }

  // ---- expressions ----
  static unsigned size_of(T type) { return type == T::V2 ? 2 : type == T::V3 ? 3 : 4; }
  static bool is_vector(T type) { return type >= T::V2; }

  std::string construct(T type, int depth) {
    const unsigned size = size_of(type);
    const std::string name = size == 3 && random_.chance(0.3) ? "rgb" : "vec" + std::to_string(size);
    if (random_.chance(0.15) && name != "rgb") return name + "(" + expression(T::N, depth - 1) + ")";
    if (size > 2 && name != "rgb" && random_.chance(0.15)) {
      std::string text = name + "(" + expression(size == 3 ? T::V2 : T::V3, depth - 1);
      return text + ", " + expression(T::N, depth - 1) + ")";
    }
    std::string text = name + "(";
    for (unsigned i = 0; i < size; ++i)
      text += (i ? ", " : "") + expression(random_.chance(0.1) ? T::I : T::N, depth - 1);
    return text + ")";
  }

  std::string leaf(T type) {
    const auto variables = in_scope(type, false);
    if (!variables.empty() && random_.chance(0.75)) return random_.pick(variables)->name;
    return literal(type);
  }

  std::string expression(T type, int depth) {
    if (depth <= 0 || random_.chance(0.12)) return leaf(type);
    if (random_.chance(0.12)) return conditional(type, depth);
    if (random_.chance(0.12)) {
      if (auto text = call(type, depth); !text.empty()) return text;
    }
    switch (type) {
    case T::B:
      return boolean(depth);
    case T::I:
      return integer(depth);
    case T::N:
      return number(depth);
    default:
      return vector(type, depth);
    }
  }

  std::string conditional(T type, int depth) {
    if (type == T::B) return "(" + expression(T::B, depth - 1) + " and " + expression(T::B, depth - 1) + ")";
    std::string text = "(" + expression(T::B, depth - 1) + " and " + expression(type, depth - 1);
    if (random_.chance(0.25)) text += " or " + expression(T::B, depth - 1) + " and " + expression(type, depth - 1);
    return text + " or " + expression(type, depth - 1) + ")";
  }

  /// A call of a function of the program that has `type` as its first result; empty where there is none.
  std::string call(T type, int depth) {
    std::vector<const FunctionInfo*> fits;
    for (const FunctionInfo& candidate : functions_)
      if (candidate.results[0] == type && !candidate.assigns) fits.push_back(&candidate);
    if (fits.empty() || calls_ >= kMaxCalls) return {};
    ++calls_;
    const FunctionInfo& callee = *random_.pick(fits);
    const std::string text = call_text(callee, depth);
    return callee.results.size() > 1 ? "(" + text + ")" : text;
  }
  std::string call_text(const FunctionInfo& callee, int depth) {
    std::string text = callee.name + "(";
    for (size_t i = 0; i < callee.parameters.size(); ++i)
      text += (i ? ", " : "") + expression(callee.parameters[i], depth - 1);
    return text + ")";
  }

  std::string library(T type, int depth) {
    std::vector<const LibraryCall*> fits;
    for (const LibraryCall& candidate : library_calls())
      if (candidate.result == type) fits.push_back(&candidate);
    if (fits.empty()) return leaf(type);
    const LibraryCall& callee = *random_.pick(fits);
    std::string text = callee.name;
    size_t first = 0;
    if (is_vector(callee.parameters[0]) && random_.chance(0.2)) { // as a method
      text = "(" + expression(callee.parameters[0], depth - 1) + "):" + callee.name;
      first = 1;
    }
    text += "(";
    for (size_t i = first; i < callee.parameters.size(); ++i)
      text += (i > first ? ", " : "") + expression(callee.parameters[i], depth - 1);
    return text + ")";
  }

  std::string binary(T type, const char* op, T left, T right, int depth) {
    (void)type;
    return "(" + expression(left, depth - 1) + " " + op + " " + expression(right, depth - 1) + ")";
  }

  std::string boolean(int depth) {
    static const std::vector<const char*> comparisons = {"<", "<=", ">", ">=", "==", "~="};
    switch (random_.below(8)) {
    case 0:
      return "not " + expression(T::B, depth - 1);
    case 1:
      return "(" + expression(T::B, depth - 1) + " or " + expression(T::B, depth - 1) + ")";
    case 2:
      return binary(T::B, random_.pick(comparisons), T::I, T::I, depth);
    case 3:
      return binary(T::B, random_.pick(comparisons), T::I, T::N, depth);
    case 4:
      return binary(T::B, random_.pick(comparisons), T::N, T::I, depth);
    case 5:
      return "(" + expression(T::B, depth - 1) + " == " + expression(T::B, depth - 1) + ")";
    default:
      return binary(T::B, random_.pick(comparisons), T::N, T::N, depth);
    }
  }

  std::string integer(int depth) {
    static const std::vector<const char*> plain = {"+", "-", "*", "&", "|", "~", "<<", ">>"};
    switch (random_.below(10)) {
    case 0:
      return "(-" + expression(T::I, depth - 1) + ")";
    case 1:
      return "(~" + expression(T::I, depth - 1) + ")";
    case 2:
      return binary(T::I, random_.chance(0.5) ? "//" : "%", T::I, T::I, depth);
    case 3:
      return "math.floor(clamp(" + expression(T::N, depth - 1) + ", -1000.0, 1000.0) == 0 and 0.0 or 2.5)";
    case 4:
      return library(T::I, depth);
    default:
      return binary(T::I, random_.pick(plain), T::I, T::I, depth);
    }
  }

  std::string number(int depth) {
    static const std::vector<const char*> plain = {"+", "-", "*", "/", "+", "-", "*", "/", "//", "%", "^"};
    switch (random_.below(10)) {
    case 0:
      return "(-" + expression(T::N, depth - 1) + ")";
    case 1:
      return "(" + expression(T::I, depth - 1) + " / " + expression(random_.chance(0.5) ? T::I : T::N, depth - 1) + ")";
    case 2:
      return binary(T::N, "+", T::I, T::N, depth);
    case 3: {
      static const std::vector<const char*> components = {".x", ".y", ".r", "[1]", "[2]", ".g"};
      const T vector_type = random_.pick(std::vector<T>{T::V2, T::V3, T::V4});
      return "(" + expression(vector_type, depth - 1) + ")" + random_.pick(components);
    }
    case 4:
    case 5:
    case 6:
      return library(T::N, depth);
    case 7:
      return "(" + expression(T::N, depth - 1) + " ^ 2)";
    default:
      return binary(T::N, random_.pick(plain), T::N, T::N, depth);
    }
  }

  std::string vector(T type, int depth) {
    static const std::vector<const char*> plain = {"+", "-", "*", "/", "//", "%"};
    switch (random_.below(8)) {
    case 0:
      return "(-" + expression(type, depth - 1) + ")";
    case 1:
      return binary(type, random_.pick(plain), type, T::N, depth);
    case 2:
      return binary(type, random_.pick(plain), random_.chance(0.5) ? T::N : T::I, type, depth);
    case 3:
      return construct(type, depth);
    case 4:
      return library(type, depth);
    case 5: {
      static const std::vector<const char*> swizzles2 = {".xy", ".yx", ".xx"}, swizzles3 = {".xyx", ".yxy", ".xyy"},
                                            swizzles4 = {".xyxy", ".yyxx"};
      const T from = random_.pick(std::vector<T>{T::V2, T::V3, T::V4});
      const auto& swizzles = type == T::V2 ? swizzles2 : type == T::V3 ? swizzles3 : swizzles4;
      return "(" + expression(from, depth - 1) + ")" + random_.pick(swizzles);
    }
    default:
      return binary(type, random_.pick(plain), type, type, depth);
    }
  }

  // ---- statements ----
  void declare(T type, int depth) {
    const std::string value = expression(type, depth);
    const bool constant = random_.chance(0.15);
    const std::string name = fresh("v");
    line("local " + name + (constant ? " <const> = " : " = ") + value);
    scope_.push_back({name, type, !constant});
  }

  void assign() {
    const T type = any_type();
    const auto targets = in_scope(type, true);
    if (targets.empty()) return declare(type, 2);
    const std::string target = random_.pick(targets)->name;
    const T other = any_type();
    const auto others = in_scope(other, true);
    if (!others.empty() && random_.chance(0.2)) {
      const std::string second = random_.pick(others)->name;
      if (second != target)
        return line(target + ", " + second + " = " + expression(type, 2) + ", " + expression(other, 2));
    }
    line(target + " = " + expression(type, 3));
  }

  void multiple_results() {
    std::vector<const FunctionInfo*> fits;
    for (const FunctionInfo& candidate : functions_)
      if (candidate.results.size() > 1 || candidate.assigns) fits.push_back(&candidate);
    if (fits.empty() || calls_ >= kMaxCalls) return assign();
    ++calls_;
    const FunctionInfo callee = *random_.pick(fits);
    const std::string text = call_text(callee, 2);
    if (callee.assigns && random_.chance(0.5)) return line(text);
    const size_t wanted = 1 + random_.below(callee.results.size());
    std::string names;
    std::vector<Variable> made;
    for (size_t i = 0; i < wanted; ++i) {
      made.push_back({fresh("v"), callee.results[i], true});
      names += (i ? ", " : "") + made.back().name;
    }
    line("local " + names + " = " + text);
    scope_.insert(scope_.end(), made.begin(), made.end());
  }

  void block(int statements, int depth) {
    const size_t mark = scope_.size();
    const size_t function_mark = functions_.size();
    for (int i = 0; i < statements; ++i)
      statement(depth);
    leave(mark, function_mark);
  }
  void leave(size_t mark, size_t function_mark) {
    scope_.resize(mark);
    functions_.erase(functions_.begin() + static_cast<std::ptrdiff_t>(function_mark), functions_.end());
  }

  void if_statement(int depth) {
    open("if " + expression(T::B, 2) + " then");
    block(random_.between(1, 3), depth - 1);
    if (random_.chance(0.3)) {
      close("elseif " + expression(T::B, 2) + " then");
      ++indent_;
      block(random_.between(1, 2), depth - 1);
    }
    if (random_.chance(0.5)) {
      close("else");
      ++indent_;
      block(random_.between(1, 2), depth - 1);
    }
    close();
  }

  /// Statements of a loop body, with breaks and continues among them.
  void loop_body(int depth) {
    const size_t mark = scope_.size();
    const size_t function_mark = functions_.size();
    const std::string label = random_.chance(0.35) ? fresh("continue") : "";
    if (!label.empty()) open("do");
    const int statements = random_.between(1, 4);
    for (int i = 0; i < statements; ++i) {
      if (random_.chance(0.15))
        line("if " + expression(T::B, 2) + " then break end");
      else if (!label.empty() && random_.chance(0.4))
        line("if " + expression(T::B, 2) + " then goto " + label + " end");
      else
        statement(depth);
    }
    leave(mark, function_mark);
    if (!label.empty()) {
      close();
      line("::" + label + "::");
    }
  }

  void numeric_for(int depth) {
    const std::string name = fresh("i");
    T type = T::I;
    switch (random_.below(6)) {
    case 0:
      open("for " + name + " = 0.0, " + expression(T::N, 1) + " % 3.0, 0.5 do");
      type = T::N;
      break;
    case 1:
      open("for " + name + " = 5, 1, -2 do");
      break;
    case 2:
      open("for " + name + " = 1, " + expression(T::I, 1) + " % 5 do");
      break;
    case 3:
      open("for " + name + " = math.maxinteger - 2, math.maxinteger do");
      break;
    case 4:
      open("for " + name + " = math.mininteger, math.mininteger + " + std::to_string(random_.between(0, 3)) + " do");
      break;
    default:
      open("for " + name + " = 1, " + std::to_string(random_.between(0, 6)) + " do");
      break;
    }
    const size_t mark = scope_.size();
    scope_.push_back({name, type, false});
    loop_body(depth - 1);
    scope_.resize(mark);
    close();
  }

  void while_loop(int depth) {
    const std::string counter = fresh("w");
    line("local " + counter + " = 0");
    open("while " + counter + " < " + std::to_string(random_.between(1, 6)) + " and " + expression(T::B, 2) + " do");
    line(counter + " = " + counter + " + 1");
    loop_body(depth - 1);
    close();
  }

  void repeat_loop(int depth) {
    const std::string counter = fresh("w");
    line("local " + counter + " = 0");
    open("repeat");
    line(counter + " = " + counter + " + 1");
    const size_t mark = scope_.size();
    declare(T::N, 2);
    const std::string local = scope_.back().name;
    block(random_.between(1, 2), depth - 1);
    scope_.resize(mark);
    close("until " + counter + " > " + std::to_string(random_.between(1, 5)) + " or " + local + " > " +
          expression(T::N, 1));
  }

  void nested_function(int depth) {
    // a local function that assigns a variable of its encloser
    const auto type = any_type();
    const auto targets = in_scope(type, true);
    if (targets.empty() || depth < 1) return assign();
    const std::string target = random_.pick(targets)->name;
    const std::string name = fresh("g");
    const std::string parameter = fresh("a");
    open("local function " + name + "(" + parameter + ")");
    const size_t mark = scope_.size();
    scope_.push_back({parameter, T::N, true});
    if (random_.chance(0.3)) line("if " + expression(T::B, 2) + " then return " + parameter + " end");
    line(target + " = " + expression(type, 2));
    line("return " + expression(T::N, 2));
    scope_.resize(mark);
    close();
    functions_.push_back({name, {T::N}, {T::N}, true});
  }

  void statement(int depth) {
    if (depth <= 0) {
      if (random_.chance(0.5))
        assign();
      else
        declare(any_type(), 3);
      return;
    }
    switch (random_.below(16)) {
    case 0:
    case 1:
      return if_statement(depth);
    case 2:
    case 3:
      return numeric_for(depth);
    case 4:
      return while_loop(depth);
    case 5:
      return repeat_loop(depth);
    case 6:
      return multiple_results();
    case 7:
      open("do");
      block(random_.between(1, 3), depth - 1);
      return close();
    case 8:
      if (!results_.empty() && random_.chance(0.5))
        return line("if " + expression(T::B, 2) + " then return " + result_list() + " end");
      return assign();
    case 9:
      return nested_function(depth);
    case 10:
      if (random_.chance(0.2)) return line("assert(" + expression(T::B, 1) + " or true, \"never\")");
      if (random_.chance(0.1)) return line("if " + expression(T::B, 2) + " then error(\"here\") end");
      return assign();
    case 11:
    case 12:
    case 13:
      return declare(any_type(), 4);
    default:
      return assign();
    }
  }

  std::string result_list() {
    std::string text;
    for (size_t i = 0; i < results_.size(); ++i)
      text += (i ? ", " : "") + expression(results_[i], 2);
    return text;
  }

  // ---- the program's parts ----
  void parameters() {
    const int count = random_.between(0, 2);
    for (int i = 0; i < count; ++i) {
      const T type = random_.pick(std::vector<T>{T::N, T::I, T::V3, T::B});
      const std::string name = fresh("q");
      const std::string value = type == T::N   ? std::string("0.75")
                                : type == T::I ? std::string("3")
                                : type == T::B ? std::string("true")
                                               : std::string("vec3(0.5, 0.25, 1.5)");
      line("local " + name + " = param(\"" + name + "\", " + value + ")");
      scope_.push_back({name, type, false});
    }
  }

  void top_level_constant() {
    const T type = any_type();
    const std::string value = expression(type, 2);
    const std::string name = fresh("K");
    line("local " + name + (random_.chance(0.5) ? " <const> = " : " = ") + value);
    scope_.push_back({name, type, false});
  }

  void top_level_loop() {
    const std::string name = fresh("K");
    line("local " + name + " = 0.0");
    open("for i = 1, " + std::to_string(random_.between(1, 5)) + " do");
    line(name + " = " + name + " + i * " + expression(T::N, 1));
    close();
    scope_.push_back({name, T::N, false});
  }

  void function(bool top) {
    FunctionInfo made{fresh("f"), {}, {}, false};
    const size_t mark = scope_.size();
    const size_t function_mark = functions_.size();
    std::string list;
    const int parameters = random_.between(0, 3);
    for (int i = 0; i < parameters; ++i) {
      const T type = any_type();
      made.parameters.push_back(type);
      const std::string name = fresh("a");
      list += (i ? ", " : "") + name;
      scope_.push_back({name, type, true});
    }
    const int results = random_.chance(0.3) ? 2 : 1;
    for (int i = 0; i < results; ++i)
      made.results.push_back(any_type());
    results_ = made.results;
    open("local function " + made.name + "(" + list + ")");
    body(random_.between(1, 4), top ? 2 : 1);
    close();
    leave(mark, function_mark);
    results_.clear();
    functions_.push_back(made);
  }

  void body(int statements, int depth) {
    for (int i = 0; i < statements; ++i)
      statement(depth);
    line("return " + result_list());
  }

  void entry() {
    open("function probe(p, uv, time, id, backface)");
    scope_.push_back({"p", T::V3, true});
    scope_.push_back({"uv", T::V2, true});
    scope_.push_back({"time", T::N, true});
    scope_.push_back({"id", T::I, true});
    scope_.push_back({"backface", T::B, true});
    const int results = random_.between(1, 3);
    for (int i = 0; i < results; ++i)
      results_.push_back(any_type());
    body(random_.between(2, 9), 3);
    close();
  }

  static constexpr int kMaxCalls = 12; // in the whole program: calls nest, and time multiplies

  Random random_;
  std::string text_;
  int indent_ = 0;
  int next_name_ = 0;
  int calls_ = 0;
  std::vector<Variable> scope_;
  std::vector<FunctionInfo> functions_;
  std::vector<T> results_;
};

} // namespace

std::string generate_program(uint64_t seed) { return Generator(seed * 0x2545f4914f6cdd1du + 1).program(); }

} // namespace moonshade::oracle
