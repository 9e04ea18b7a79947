// The generators of hostile programs. Sizes are chosen to stay below a megabyte of text.
#include "tests/fuzz/hostile.h"

namespace moonshade::fuzz {
namespace {

using std::to_string;

std::string repeat(std::string_view text, size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (size_t i = 0; i < count; ++i)
    result += text;
  return result;
}

/// `line(0) line(1) ...`
template <class Line> std::string lines(size_t count, const Line& line) {
  std::string text;
  for (size_t i = 0; i < count; ++i)
    text += line(i) + "\n";
  return text;
}

std::string in_height(const std::string& body) { return "function height(p)\n" + body + "\nreturn p.x\nend\n"; }

std::string name(const char* prefix, size_t i) { return prefix + to_string(i); }

// ---- nesting

std::string nested_parentheses(size_t depth) {
  return "function height(p) return " + repeat("(", depth) + "p.x" + repeat(")", depth) + " end";
}
std::string nested_unary(size_t depth) { return "function height(p) return " + repeat("- ", depth) + "p.x end"; }
std::string nested_ifs(size_t depth) {
  return "function height(p)\nlocal h = 0.5\n" +
         lines(depth, [](size_t i) { return "if p.x > " + to_string(i) + ".5 then h = h * 1.5"; }) +
         repeat("end ", depth) + "\nreturn h end";
}
std::string nested_loops(size_t depth) {
  return "function height(p)\nlocal h = 0\n" +
         lines(depth, [](size_t i) { return "for i" + to_string(i) + " = 1, 2 do h = h + p.x"; }) +
         repeat("end ", depth) + "\nreturn h end";
}
/// Each level learns only from the next one that a variable is a number after all.
std::string nested_loops_of_late_numbers(size_t depth) {
  return "function height(p)\n" + lines(depth + 1, [](size_t i) { return "local v" + to_string(i) + " = 1"; }) +
         lines(depth,
               [](size_t i) {
                 return "while p.x > " + to_string(i) + " do v" + to_string(i) + " = v" + to_string(i + 1);
               }) +
         name("v", depth) + " = p.y\n" + repeat("end ", depth) + "\nreturn v0 + 0.0 end";
}
std::string nested_functions(size_t depth) {
  return "function height(p)\nlocal h = 1.0\n" +
         lines(depth, [](size_t i) { return "local function f" + to_string(i) + "(x) h = h + x"; }) + "h = h + p.x\n" +
         lines(depth, [depth](size_t i) { return "end f" + to_string(depth - 1 - i) + "(h)"; }) + "return h end";
}
std::string elseifs(size_t count) {
  return "function height(p)\nlocal h = 0.5\nif p.x < 0 then h = 1.0\n" +
         lines(count, [](size_t i) { return "elseif p.x < " + to_string(i) + " then h = " + to_string(i) + ".25"; }) +
         "end\nreturn h end";
}

/// Flat as text, but each is inside the one before.
std::string short_elseifs(size_t count) {
  return "function height(backface)\nif backface then return 1\n" + repeat("elseif backface then\n", count / 2) +
         "end return 0 end";
}
std::string short_returns(size_t count) {
  return "function height(p)\nlocal b = p.x > 0\n" + repeat("if b then return 1 end\n", count) + "return 0 end";
}
std::string short_breaks(size_t count) {
  return "function height(p)\nlocal b, x = p.x > 0, 0.5\nwhile x > 0 do x = x - 1\n" +
         repeat("if b then break end x=x+1 ", count / 2) + "end\nreturn x end";
}

// ---- expressions

std::string long_sum(size_t terms) { return "function height(p) return p.x" + repeat(" + p.y", terms) + " end"; }
std::string balanced_sum(size_t depth) {
  std::string sum = "p.x";
  for (size_t i = 0; i < depth; ++i)
    sum = (std::string("(").append(sum) + "+").append(sum) + ")";
  return "function height(p) return " + sum + " end";
}
std::string long_conditional(size_t arms) {
  return "function height(p) return " +
         lines(arms, [](size_t i) { return "p.x < " + to_string(i) + " and " + to_string(i) + ".5 or"; }) + "0.5 end";
}
std::string long_concatenation(size_t count) { return "local s = 'a'" + repeat(" .. 'b'", count); }
std::string many_arguments(size_t count) {
  return "function height(p) return max(p.x" + repeat(", p.y", count) + ") end";
}

// ---- statements

std::string statements(size_t count, std::string_view statement) {
  return "function height(p)\nlocal x = p.x\n" + repeat(statement, count) + "return x\nend\n";
}
std::string loop_of_statements(size_t count, std::string_view statement) {
  return "function height(p)\nlocal x = p.x\nfor i = 1, 8 do\n" + repeat(statement, count) + "end\nreturn x\nend\n";
}
std::string locals(size_t count) {
  return in_height(lines(count, [](size_t i) { return "local v" + to_string(i) + " = p.x * " + to_string(i); }));
}
std::string locals_in_blocks(size_t count) {
  return "function height(p)\nlocal h = 0.0\n" +
         lines(count / 100,
               [](size_t) {
                 return "do " + lines(100, [](size_t i) { return "local v" + to_string(i) + " = h + p.x"; }) +
                        " h = v99 end";
               }) +
         "return h end";
}
/// Each constant is made of the one before, twice.
template <class Twice>
std::string doubling(size_t count, std::string_view first, const Twice& twice, std::string_view part) {
  return "local c0 <const> = " + std::string(first) + "\n" +
         lines(count, [&](size_t i) { return "local " + name("c", i + 1) + " <const> = " + twice(name("c", i)); }) +
         "function height(p) return p.x - " + name("c", count) + std::string(part) + " end";
}
std::string doubling_constants(size_t count) {
  return doubling(count, "0", [](const std::string& one) { return one + " + " + one; }, "");
}
std::string doubling_records(size_t count) {
  return doubling(
      count, "{ a = 1 }", [](const std::string& one) { return "{ a = " + one + ", b = " + one + " }"; }, ".a.b.a");
}
/// Every variable is live at once: assigned first, read last.
std::string live_variables(size_t count) {
  std::string text = "function height(p)\nlocal h = 0.0\n";
  for (size_t block = 0; block < count / 150; ++block)
    text += "local function f" + to_string(block) + "(x)\n" +
            lines(150, [](size_t i) { return "local v" + to_string(i) + " = sin(x * " + to_string(i) + ")"; }) +
            "return v0" +
            [] {
              std::string s;
              for (int i = 1; i < 150; ++i)
                s += " + v" + to_string(i);
              return s;
            }() +
            " end\nh = h + f" + to_string(block) + "(h + p.x)\n";
  return text + "return h end";
}
std::string labels(size_t count) {
  return "function height(p)\nlocal x = 0.0\n" +
         lines(count,
               [](size_t i) {
                 return "for i = 1, 2 do if p.x > " + to_string(i) + " then goto l" + to_string(i) +
                        " end x = x + 1 ::l" + to_string(i) + ":: end";
               }) +
         "return x end";
}
std::string breaks(size_t count) {
  return "function height(p)\nlocal x = 0.0\nwhile x < 10 do\n" +
         lines(count, [](size_t i) { return "if p.x > " + to_string(i) + " then break end x = x + 1"; }) +
         "end\nreturn x end";
}
std::string returns(size_t count) {
  return "function height(p)\n" +
         lines(count,
               [](size_t i) { return "if p.x < " + to_string(i) + " then return p.y * " + to_string(i) + " end"; }) +
         "return 0.0 end";
}
/// In a loop each variable becomes a number because the next one did, one a round of inference.
std::string late_numbers(size_t count) {
  return "function height(p)\nlocal function f(x)\n" +
         lines(count, [](size_t i) { return "local v" + to_string(i) + " = 1"; }) + "for i = 1, 3 do\n" +
         lines(count - 1, [](size_t i) { return "v" + to_string(i) + " = v" + to_string(i + 1); }) +
         name("v", count - 1) + " = x\nend\nreturn v0 + 0.0 end\nreturn f(p.x) end";
}

// ---- functions

std::string doubling_calls(size_t depth) {
  return "local function f0(x) return x * 0.5 + 0.1 end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(x) return " + below + "(x) + " + below + "(x + 1) end";
               }) +
         "function height(p) return " + name("f", depth) + "(p.x) end";
}
/// Like doubling_calls, but with too many locals to inline cheaply.
std::string doubling_noise(size_t depth) {
  return "local function f0(x) return noise(vec3(x, x, 1)) end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(x) return " + below + "(x) + perlin(vec3(" + below +
                        "(x + 1))) end";
               }) +
         "function height(p) return " + name("f", depth) + "(p.x) end";
}
std::string chain_of_functions(size_t count) {
  // One local function sees 255 upvalues at most, each only the one before.
  return "local f0 = 0\n" + lines(1, [](size_t) { return std::string("function g0(x) return x * 0.5 end"); }) +
         lines(count,
               [](size_t i) { return "function " + name("g", i + 1) + "(x) return " + name("g", i) + "(x) + 1 end"; }) +
         "function height(p) return " + name("g", count) + "(p.x) end";
}
std::string closures(size_t count) {
  return "function height(p)\nlocal h = p.x\n" +
         lines(count,
               [](size_t i) {
                 return "do local c" + to_string(i) + " = h local function f(x) h = h + x * c" + to_string(i) +
                        " end f(" + to_string(i) + ".5) end";
               }) +
         "return h end";
}
std::string functions_never_called(size_t count) {
  return lines(count, [](size_t i) { return "function g" + to_string(i) + "(a, b) return a + b end"; }) +
         "function height(p) return p.x end";
}
std::string entries(size_t count) {
  return lines(count, [](size_t i) { return "function e" + to_string(i) + "(p) return p * " + to_string(i) + " end"; });
}
std::string entries_of_noise(size_t count) {
  return lines(count,
               [](size_t i) { return "function e" + to_string(i) + "(p) return noise(p * " + to_string(i) + ") end"; });
}
std::string parameters(size_t count) {
  return lines(count,
               [](size_t i) {
                 return "do local v = param('v" + to_string(i) + "', " + to_string(i) +
                        ".5, { min = 0, max = 1e6, doc = 'a value' }) end";
               }) +
         "function height(p) return p.x end";
}
std::string wide_function(size_t count) {
  std::string names, values;
  for (size_t i = 0; i < count; ++i) {
    names += (i ? ", " : "") + name("a", i);
    values += i ? ", p.x" : "p.x";
  }
  return "local function f(" + names + ") return a0 end\nfunction height(p) return f(" + values + ") end";
}

/// A fault at the bottom of doubled calls, which each caller might find again.
std::string doubling_errors(size_t depth) {
  return "local function f0(x) return x and 1 end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(x) return " + below + "(x) + " + below +
                        "(vec3(x)) end";
               }) +
         "function height(p) return " + name("f", depth) + "(p.x) end";
}
/// Each level loops until the type of its variable, given by the level below, is known.
std::string doubling_rounds(size_t depth) {
  return "local function f0(x) return x * 0.5 end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(x) local v = 1 for i = 1, 2 do v = " + below +
                        "(v) + " + below + "(x) end return v end";
               }) +
         "function height(p) return " + name("f", depth) + "(1) end";
}
/// Every call of a chain of a hundred has errors, each with the chain as its notes.
std::string errors_in_chains(size_t depth, size_t errors) {
  return "local function f0(x) return x.nothing end\n" +
         lines(depth,
               [errors](size_t i) {
                 return "local function " + name("f", i + 1) + "(x) " + repeat("x.y = 1 ", errors) + "return " +
                        name("f", i) + "(x) + x.nothing end";
               }) +
         "function height(p) return " + name("f", depth) + "(p) end";
}
std::string multiple_assignments(size_t count, size_t targets) {
  std::string names, calls;
  for (size_t i = 0; i < targets; ++i) {
    names += (i ? "," : "") + name("a", i);
    calls += (i ? ",f(" : "f(") + name("a", i) + ")";
  }
  return "function height(p)\nlocal function f(x) return x * 0.5 end\nlocal " + names + " = p.x" +
         repeat(",p.x", targets - 1) + "\n" + repeat(names + " = " + calls + "\n", count) + "return a0 end";
}
std::string logical_chain(size_t count) {
  return "function height(p)\nlocal b = p.x > 0\n" +
         repeat("b = b" + repeat(" and p.x > 1 or p.y < 2", 400) + "\n", count) + "return b and 1 or 0 end";
}

// ---- specialisations

const char* argument(size_t digit) {
  constexpr const char* kArguments[] = {"1", "p.x", "vec2(p.x)", "p", "vec4(p.x)", "true"};
  return kArguments[digit % 6];
}

/// One function, called for 6^5 lists of argument types and more.
std::string specialisations(size_t count) {
  return "local function f(a, b, c, d, e, g) return 1.5 end\nfunction height(p)\nlocal h = 0.0\n" +
         lines(count,
               [](size_t i) {
                 std::string call = "h = h + f(";
                 for (size_t k = 0, digits = i; k < 6; ++k, digits /= 6)
                   call += (k ? ", " : "") + std::string(argument(digits));
                 return call + ")";
               }) +
         "return h end";
}
/// Each function calls the one below for three types of one more argument: 3^8 lists of types a function.
std::string exponential_specialisations(size_t depth) {
  return "local function f0(a, b, c, d, e, f, g, h) return 1.5 end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(a, b, c, d, e, f, g, h) return " + below +
                        "(b, c, d, e, f, g, h, 1) + " + below + "(b, c, d, e, f, g, h, 1.5) + " + below +
                        "(b, c, d, e, f, g, h, vec2(1.5)) end";
               }) +
         "function height(p) return " + name("f", depth) + "(1, 1, 1, 1, 1, 1, 1, 1) end";
}

// ---- tables and functions as values
std::string table_of(size_t count, const std::string& element, bool inside) {
  std::string table = "local t = {";
  for (size_t i = 0; i < count; ++i)
    table += element + ",";
  table += "}\n";
  const std::string before = inside ? "" : table, within = inside ? table : "";
  return before + "function height(p, id)\n" + within + "return t[id % #t + 1] end";
}
std::string nested_tables(size_t depth) {
  return "local t = " + repeat("{", depth) + "1.5" + repeat("}", depth) + "\nfunction height(p) return t" +
         repeat("[1]", depth) + " end";
}
/// Each makes two tables of the one below: 2^depth calls, each with tables of its own.
std::string exponential_makers(size_t depth) {
  return "local function f0(x) return { v = x } end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(x) local a, b = " + below + "(x), " + below +
                        "(x + 1) return { v = a.v + b.v } end";
               }) +
         "function height(p) return " + name("f", depth) + "(p.x).v end";
}
/// Closures of closures: each captures the one below.
std::string chain_of_closures(size_t depth) {
  return "local function f0(x) return function(y) return x + y end end\n" +
         lines(depth,
               [](size_t i) {
                 return "local function " + name("f", i + 1) + "(x) local g = " + name("f", i) +
                        "(x) return function(y) return g(y) + x end end";
               }) +
         "function height(p) return " + name("f", depth) + "(p.x)(1) end";
}
std::string doubling_closures(size_t depth) {
  return "local function twice(f) return function(x) return f(f(x)) end end\nfunction height(p)\n"
         "local f0 = function(x) return x + 1 end\n" +
         lines(depth, [](size_t i) { return "local " + name("f", i + 1) + " = twice(" + name("f", i) + ")"; }) +
         "return " + name("f", depth) + "(p.x) end";
}
std::string records_of_records(size_t depth) {
  return "function height(p)\nlocal t0 = { x = p.x }\n" +
         lines(depth,
               [](size_t i) {
                 return "local " + name("t", i + 1) + " = { a = " + name("t", i) + ", x = " + name("t", i) + ".x }";
               }) +
         "return " + name("t", depth) + ".x end";
}

// ---- the library

std::string library_calls(size_t count, std::string_view call) {
  return "function height(p)\nlocal x = p.x\n" + repeat("x = x + " + std::string(call) + "\n", count) + "return x end";
}

// ---- derivatives

std::string gradient_of_calls(size_t count, std::string_view call) {
  return "local function f(p)\nlocal x = p.x\n" + repeat("x = x + " + std::string(call) + "\n", count) +
         "return x end\nfunction height(p) return gradient(f, p).x end";
}
std::string gradient_of_doubling(size_t depth) {
  return "local function f0(p) return noise(p) end\n" +
         lines(depth,
               [](size_t i) {
                 const std::string below = name("f", i);
                 return "local function " + name("f", i + 1) + "(p) return " + below + "(p) + " + below + "(p * 2) end";
               }) +
         "function height(p) return gradient(" + name("f", depth) + ", p).x end";
}
/// Each takes the gradient of the one below, were that allowed.
std::string nested_gradients(size_t depth) {
  return "local function f0(p) return noise(p) end\n" +
         lines(depth,
               [](size_t i) {
                 return "local function " + name("f", i + 1) + "(p) return gradient(" + name("f", i) + ", p).x end";
               }) +
         "function height(p) return " + name("f", depth) + "(p) end";
}
std::string many_gradients(size_t count) {
  return "local function f(p) return noise(p) end\nfunction height(p)\nlocal x = p.x\n" +
         repeat("x = x + gradient(f, p * x).y\n", count) + "return x end";
}

// ---- constants, names, errors

std::string constant_table(size_t count) {
  return "local t = { 0" + repeat(", 1.25", count) + " }\nfunction height(p) return t[1] end";
}
std::string named_table(size_t count) {
  return "local t = { " + lines(count, [](size_t i) { return "field" + to_string(i) + " = " + to_string(i) + ","; }) +
         " }\nfunction height(p) return t.field1 end";
}
std::string long_string(size_t size) {
  return "local s = '" + repeat("s", size) + "'\nfunction height(p) return p.x end";
}
std::string long_name(size_t size) { return "function height(p) return " + repeat("n", size) + " end"; }
std::string long_names(size_t count, size_t size) {
  return "function height(p)\n" +
         lines(count,
               [size](size_t i) { return "local x" + to_string(i) + " = " + repeat("n", size) + to_string(i); }) +
         "return p.x end";
}
std::string many_constants(size_t count) {
  return "function height(p)\nlocal x = p.x\n" +
         lines(count, [](size_t i) { return "x = x * 1." + to_string(i) + " + " + to_string(i) + ".5"; }) +
         "return x end";
}
std::string top_level(size_t count) {
  return "local x = param('x', 1.5)\n" + lines(count, [](size_t i) { return "x = x * 1.5 + " + to_string(i); }) +
         "function height(p) return p.x * x end";
}
std::string globals(size_t count) {
  return lines(count, [](size_t i) { return "g" + to_string(i) + " = " + to_string(i) + ".5"; }) +
         "function height(p) return p.x * g1 end";
}
std::string unknown_names(size_t count) {
  return "function height(p)\n" + lines(count, [](size_t i) { return "local a = nosie" + to_string(i) + "(p)"; }) +
         "return p.x end";
}
std::string syntax_errors(size_t count) { return repeat("local = )\n", count); }
std::string recursion(size_t count) {
  return lines(count,
               [count](size_t i) {
                 return "function " + name("f", i) + "(x) return " + name("f", (i + 1) % count) + "(x) end";
               }) +
         "function height(p) return f0(p.x) end";
}

} // namespace

std::vector<HostileProgram> hostile_programs() {
  static constexpr std::string_view bump = "x = x * 1.5 + 0.25\n", branch = "if x > p.y then x = x - p.y end\n";
  return {
      {"Parentheses390", [] { return nested_parentheses(390); }},
      {"Parentheses400000", [] { return nested_parentheses(400'000); }},
      {"Unary390", [] { return nested_unary(390); }},
      {"Unary400000", [] { return nested_unary(400'000); }},
      {"Ifs150", [] { return nested_ifs(150); }},
      {"Ifs20000", [] { return nested_ifs(20'000); }},
      {"Loops100", [] { return nested_loops(100); }},
      {"LoopsOfLateNumbers10", [] { return nested_loops_of_late_numbers(10); }},
      {"LoopsOfLateNumbers15", [] { return nested_loops_of_late_numbers(15); }},
      {"LoopsOfLateNumbers20", [] { return nested_loops_of_late_numbers(20); }},
      {"LoopsOfLateNumbers100", [] { return nested_loops_of_late_numbers(100); }},
      {"NestedFunctions100", [] { return nested_functions(100); }},
      {"Elseifs190", [] { return elseifs(190); }},
      {"Elseifs800", [] { return elseifs(800); }},
      {"Elseifs20000", [] { return elseifs(20'000); }},
      {"ShortElseifs45000", [] { return short_elseifs(90'000); }},
      {"Sum900", [] { return long_sum(900); }},
      {"Sum100000", [] { return long_sum(100'000); }},
      {"BalancedSum15", [] { return balanced_sum(15); }},
      {"BalancedSum17", [] { return balanced_sum(17); }},
      {"Conditional190", [] { return long_conditional(190); }},
      {"Conditional20000", [] { return long_conditional(20'000); }},
      {"Concatenation100000", [] { return long_concatenation(100'000); }},
      {"Arguments200", [] { return many_arguments(200); }},
      {"Arguments100000", [] { return many_arguments(100'000); }},
      {"Statements1000", [] { return statements(1000, bump); }},
      {"Statements5000", [] { return statements(5000, bump); }},
      {"Statements50000", [] { return statements(50'000, bump); }},
      {"Assignments100000", [] { return statements(100'000, "x=x+1\n"); }},
      {"Branches1000", [] { return statements(1000, branch); }},
      {"Branches5000", [] { return statements(5000, branch); }},
      {"Branches20000", [] { return statements(20'000, branch); }},
      {"LoopOfStatements20000", [] { return loop_of_statements(20'000, bump); }},
      {"LoopOfBranches10000", [] { return loop_of_statements(10'000, branch); }},
      {"Loops1000", [] { return statements(1000, "for i = 1, 9 do x = x * 1.5 end\n"); }},
      {"Loops10000", [] { return statements(10'000, "for i = 1, 9 do x = x * 1.5 end\n"); }},
      {"WhileLoops300", [] { return statements(300, "while x > p.y do x = x * 0.5 end\n"); }},
      {"WhileLoops1000", [] { return statements(1000, "while x > p.y do x = x * 0.5 end\n"); }},
      {"WhileLoops10000", [] { return statements(10'000, "while x > p.y do x = x * 0.5 end\n"); }},
      {"TableOfConstants60000", [] { return table_of(60'000, "1.5", false); }},
      {"TableOfConstants200000", [] { return table_of(200'000, "1.5", false); }},
      {"TableOfSines500", [] { return table_of(500, "sin(1)", false); }},
      {"TableOfSines50000", [] { return table_of(50'000, "sin(1)", false); }},
      {"TableOfInputs300", [] { return table_of(300, "p.x", true); }},
      {"TableOfInputs50000", [] { return table_of(50'000, "p.x", true); }},
      {"NestedTables100", [] { return nested_tables(100); }},
      {"NestedTables10000", [] { return nested_tables(10'000); }},
      {"Makers8", [] { return exponential_makers(8); }},
      {"Makers60", [] { return exponential_makers(60); }},
      {"ChainOfClosures30", [] { return chain_of_closures(30); }},
      {"ChainOfClosures190", [] { return chain_of_closures(190); }},
      {"DoublingClosures8", [] { return doubling_closures(8); }},
      {"DoublingClosures60", [] { return doubling_closures(60); }},
      {"RecordsOfRecords180", [] { return records_of_records(180); }},
      {"Locals190", [] { return locals(190); }},
      {"Locals10000", [] { return locals(10'000); }},
      {"LocalsInBlocks10000", [] { return locals_in_blocks(10'000); }},
      {"LiveVariables9000", [] { return live_variables(9000); }},
      {"DoublingConstants60", [] { return doubling_constants(60); }},
      {"DoublingConstants150", [] { return doubling_constants(150); }},
      {"DoublingRecords150", [] { return doubling_records(150); }},
      {"Labels5000", [] { return labels(5000); }},
      {"Breaks5000", [] { return breaks(5000); }},
      {"ShortReturns40000", [] { return short_returns(40'000); }},
      {"ShortBreaks35000", [] { return short_breaks(70'000); }},
      {"Returns1000", [] { return returns(1000); }},
      {"Returns15000", [] { return returns(15'000); }},
      {"LateNumbers150", [] { return late_numbers(150); }},
      {"DoublingCalls20", [] { return doubling_calls(20); }},
      {"DoublingCalls60", [] { return doubling_calls(60); }},
      {"DoublingNoise60", [] { return doubling_noise(60); }},
      {"DoublingErrors60", [] { return doubling_errors(60); }},
      {"DoublingRounds60", [] { return doubling_rounds(60); }},
      {"ErrorsInChains100x100", [] { return errors_in_chains(100, 100); }},
      {"MultipleAssignments300x150", [] { return multiple_assignments(300, 150); }},
      {"LogicalChain100x400", [] { return logical_chain(100); }},
      {"ChainOfFunctions190", [] { return chain_of_functions(190); }},
      {"ChainOfFunctions15000", [] { return chain_of_functions(15'000); }},
      {"Closures1000", [] { return closures(1000); }},
      {"Closures4000", [] { return closures(4000); }},
      {"Closures8000", [] { return closures(8000); }},
      {"FunctionsNeverCalled4000", [] { return functions_never_called(4000); }},
      {"FunctionsNeverCalled20000", [] { return functions_never_called(20'000); }},
      {"Entries100", [] { return entries(100); }},
      {"Entries1000", [] { return entries(1000); }},
      {"Entries4000", [] { return entries(4000); }},
      {"Entries5000", [] { return entries(5000); }},
      {"EntriesOfNoise500", [] { return entries_of_noise(500); }},
      {"EntriesOfNoise4000", [] { return entries_of_noise(4000); }},
      {"Parameters5000", [] { return parameters(5000); }},
      {"WideFunction200", [] { return wide_function(200); }},
      {"WideFunction20000", [] { return wide_function(20'000); }},
      {"Specialisations200", [] { return specialisations(200); }},
      {"Specialisations4000", [] { return specialisations(4000); }},
      {"Specialisations10000", [] { return specialisations(10'000); }},
      {"ExponentialSpecialisations60", [] { return exponential_specialisations(60); }},
      {"Noise100", [] { return library_calls(100, "noise(p * x)"); }},
      {"Noise20000", [] { return library_calls(20'000, "noise(p * x)"); }},
      {"Turbulence5000", [] { return library_calls(5000, "turbulence(p * x, 5)"); }},
      {"Pow20000", [] { return library_calls(20'000, "x ^ p.y"); }},
      {"MathSin20000", [] { return library_calls(20'000, "math.sin(x)"); }},
      {"GradientOfStatements5000", [] { return gradient_of_calls(5000, "x * p.y"); }},
      {"GradientOfNoise2000", [] { return gradient_of_calls(2000, "noise(p * x)"); }},
      {"GradientOfDoubling60", [] { return gradient_of_doubling(60); }},
      {"NestedGradients60", [] { return nested_gradients(60); }},
      {"ManyGradients1000", [] { return many_gradients(1000); }},
      {"ManyGradients20000", [] { return many_gradients(20'000); }},
      {"ConstantTable100000", [] { return constant_table(100'000); }},
      {"NamedTable30000", [] { return named_table(30'000); }},
      {"String1000000", [] { return long_string(1'000'000); }},
      {"Name1000000", [] { return long_name(1'000'000); }},
      {"Names100x9000", [] { return long_names(100, 9000); }},
      {"Constants20000", [] { return many_constants(20'000); }},
      {"TopLevel30000", [] { return top_level(30'000); }},
      {"Globals30000", [] { return globals(30'000); }},
      {"UnknownNames30000", [] { return unknown_names(30'000); }},
      {"SyntaxErrors90000", [] { return syntax_errors(90'000); }},
      {"Recursion15000", [] { return recursion(15'000); }},
  };
}

} // namespace moonshade::fuzz
