// Derivatives by a text before and after, and by central differences in double over many shaders.
#include "compiler/ir/derivative.h"

#include "compiler/ir/passes.h"
#include "compiler/ir/test_modules.h"
#include "compiler/ir/test_shaders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

namespace moonshade::ir {
namespace {

using namespace test;
using enum ValueType;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Texts ---------------------------------------------------------------------------------------------------------------

/// The gradient of `f` by all its parameters, without unused values.
std::string gradient_of(std::vector<ValueType> parameters, std::vector<ValueType> results,
                        const std::function<void(Builder&)>& fill) {
  Module module = module_of(parameters, std::move(results), fill);
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < parameters.size(); ++i)
    if (parameters[i] != Boolean && parameters[i] != Integer) all.push_back(i);
  add_gradient(module, 1, all);
  remove_dead_code(module.functions.back());
  return text_of(module);
}

const LibraryFunction& row(std::string_view name) { return library_overloads(name)[0]; }

TEST(Derivative, KeepsProductsByZeroOut) {
  EXPECT_EQ(gradient_of({Vec3}, {Number},
                        [](Builder& b) {
                          const ValueId p = b.argument(0);
                          const ValueId twice = b.binary(Op::Mul, p, b.convert(b.number(2), Vec3));
                          b.return_values({b.binary(Op::Mul, b.component(twice, 0), b.component(p, 1))});
                        }),
            R"(
function f'(a: vec3) -> number, vec3 {
  %0: vec3 = argument 0
  %1: number = const.n 2
  %2: vec3 = construct %1
  %3: vec3 = mul %0, %2
  %4: number = component 0, %2
  %5: number = component 0, %3
  %6: number = component 1, %0
  %7: number = mul %5, %6
  %8: number = mul %6, %4
  %9: number = const.n 0
  %10: vec3 = construct %8, %5, %9
  return %7, %10
}
)");
}

TEST(Derivative, OfALibraryFunctionIsTheChainRule) {
  EXPECT_EQ(gradient_of({Number, Number}, {Number},
                        [](Builder& b) {
                          const ValueId x = b.argument(0);
                          b.return_values({b.call_library(row("sin"), Number, {b.binary(Op::Mul, x, b.argument(1))})});
                        }),
            R"(
function f'(a: number, b: number) -> number, number, number {
  %0: number = argument 0
  %1: number = argument 1
  %2: number = mul %0, %1
  %3: number = call_library sin__d(%2)
  %4: number = result 1, %3
  %5: number = mul %4, %1
  %6: number = const.n 0
  %7: boolean = eq %4, %6
  %8: boolean = eq %5, %5
  %9: number = const.n 0
  %10: number = select %7, %9, %5
  %11: number = select %8, %5, %10
  %12: number = mul %4, %0
  %13: boolean = eq %12, %12
  %14: number = const.n 0
  %15: number = select %7, %14, %12
  %16: number = select %13, %12, %15
  return %3, %11, %16
}
)");
}

TEST(Derivative, MultipliesFirstWhatIsThereFirst) {
  // weight * noise(p * scale): the slope comes last.
  const std::string text = gradient_of({Number}, {Number}, [](Builder& b) {
    const VariableId weight = b.variable("weight", Number), scale = b.variable("scale", Number);
    b.store(weight, b.number(0.5));
    b.store(scale, b.number(3));
    const ValueId noise = b.call_library(row("noise"), Number, {b.binary(Op::Mul, b.argument(0), b.load(scale))});
    b.return_values({b.binary(Op::Mul, noise, b.load(weight))});
  });
  EXPECT_THAT(text, HasSubstr(R"(%6: number = result 1, %5
  %7: number = load $0.weight
  %8: number = mul %5, %7
  %9: number = mul %7, %3
  %10: number = mul %6, %9
  return %8, %10)"));
}

TEST(Derivative, GivesVariablesOnlyTheDirectionsThatTheyHave) {
  const std::string text = gradient_of({Number, Number}, {Number}, [](Builder& b) {
    const VariableId v = b.variable("v", Number), w = b.variable("w", Number);
    b.store(v, b.argument(0));
    b.store(w, b.number(1));
    b.if_else(b.compare(Op::Lt, b.argument(1), b.number(0)), b.block([&] { b.store(v, b.number(3)); }));
    b.return_values({b.binary(Op::Mul, b.load(v), b.load(w))});
  });
  EXPECT_THAT(text, HasSubstr("v'00"));
  EXPECT_THAT(text, Not(HasSubstr("v'01")));
  EXPECT_THAT(text, Not(HasSubstr("w'")));
}

TEST(Derivative, OfWhatIsConstantIsTheFunctionItself) {
  const std::string text = gradient_of({Number}, {Number, Integer}, [](Builder& b) {
    const ValueId floor = b.call_library(row("math.floor"), Integer, {b.argument(0)});
    b.return_values({b.convert(floor, Number), floor});
  });
  EXPECT_THAT(text, HasSubstr("call_library math_floor("));
  EXPECT_THAT(text, HasSubstr("-> number, integer, number {"));
}

TEST(Derivative, OfAFunctionThatCapturesTakesTheCaptureAsConstant) {
  Module module;
  module.functions.resize(2);
  module.functions[0].name = "inner";
  module.functions[0].captures = 1;
  module.functions[0].variables = {{"seen", Number, 1}};
  module.functions[0].parameters = {Number};
  module.functions[0].parameter_names = {"x"};
  module.functions[0].results = {Number};
  {
    // seen = seen * x; return seen
    Builder b(module.functions[0]);
    b.store(0, b.binary(Op::Mul, b.load(0), b.argument(0)));
    b.return_values({b.load(0)});
  }
  const FunctionId gradient = add_gradient(module, 0, std::vector<uint32_t>{0});
  module.functions[1].name = "f";
  module.functions[1].results = {Number, Number, Number};
  {
    Builder b(module.functions[1]);
    const VariableId seen = b.variable("mine", Number);
    b.store(seen, b.number(5));
    const ValueId call = b.call(gradient, module.functions[gradient].results, {b.number(3)}, {seen});
    const ValueId slope = b.result(call, 1, Number);
    b.return_values({call, slope, b.load(seen)});
  }
  module.functions.emplace_back().name = "init";
  module.init = 3;
  module.entries.push_back({"f", 1});
  ASSERT_THAT(verify(module), IsEmpty()) << to_text(module);
  EXPECT_EQ(to_text(Interpreter(module).run("f", {})), "15 5 15");
}

// Numbers -------------------------------------------------------------------------------------------------------------

bool is_number(ValueType type) { return type != Boolean && type != Integer; }

/// All numbers of the results, one after the other.
std::vector<double> numbers_of(const Outcome& outcome, size_t first, size_t last) {
  std::vector<double> numbers;
  for (size_t i = first; i < std::min(last, outcome.results.size()); ++i)
    for (unsigned c = 0; is_number(outcome.results[i].type) && c < component_count(outcome.results[i].type); ++c)
      numbers.push_back(outcome.results[i].numbers[c]);
  return numbers;
}

struct Comparison {
  unsigned compared = 0, points = 0;
  double worst = 0;
};

/// The gradient of an entry at one point against differences, by every component of every input of numbers.
void compare_at(const Interpreter& interpreter, const EntryInfo& entry, const std::vector<Value>& inputs,
                Comparison& comparison) {
  const Outcome plain = interpreter.run(entry.name, inputs), exact = interpreter.run(entry.name + "'", inputs);
  EXPECT_EQ(plain.fault, exact.fault);
  if (plain.fault != FaultCode::None) return;
  const size_t results = plain.results.size();
  for (size_t i = 0; i < results; ++i)
    EXPECT_EQ(to_text(plain.results[i]), to_text(exact.results[i]));
  EXPECT_EQ(plain.steps, exact.steps);
  // Gradients by result component, input, input component.
  const std::vector<double> gradient = numbers_of(exact, results, exact.results.size());
  const size_t rows = numbers_of(plain, 0, results).size(), columns = rows == 0 ? 0 : gradient.size() / rows;
  size_t column = 0;
  for (size_t i = 0; i < inputs.size(); ++i)
    for (unsigned c = 0; is_number(inputs[i].type) && c < component_count(inputs[i].type); ++c, ++column) {
      const double h = 1e-5;
      const auto at = [&](double offset) {
        std::vector<Value> moved = inputs;
        moved[i].numbers[c] += offset;
        return numbers_of(interpreter.run(entry.name, moved), 0, results);
      };
      const auto far_below = at(-2 * h), below = at(-h), above = at(h), far_above = at(2 * h);
      for (size_t r = 0; r < rows; ++r) {
        ++comparison.points;
        if (std::min({far_below.size(), below.size(), above.size(), far_above.size()}) != rows) continue;
        const double narrow = (above[r] - below[r]) / (2 * h), wide = (far_above[r] - far_below[r]) / (4 * h);
        const double difference = (4 * narrow - wide) / 3;
        if (!(std::abs(narrow - wide) < 1e-4 * (1 + std::abs(narrow)))) continue;
        ++comparison.compared;
        comparison.worst = std::max(comparison.worst,
                                    std::abs(gradient[r * columns + column] - difference) / (1 + std::abs(difference)));
      }
    }
}

/// Every entry of the shader whose inputs have few enough components, plain and optimised.
void expect_gradients(const std::string& text, double least_compared = 0.8) {
  const Checked checked = check(text);
  ASSERT_THAT(checked.errors, IsEmpty()) << text;
  Module module = build(checked.program);
  std::vector<EntryInfo> entries;
  for (const EntryInfo& entry : checked.program.info.entries) {
    std::vector<uint32_t> parameters;
    unsigned components = 0;
    for (uint32_t i = 0; i < entry.inputs.size(); ++i)
      if (is_number(entry.inputs[i].type)) {
        parameters.push_back(i);
        components += component_count(entry.inputs[i].type);
      }
    if (parameters.empty() || components > kMaxDirections) continue;
    const auto found = std::ranges::find(module.entries, entry.name, &Entry::name);
    module.entries.push_back({entry.name + "'", add_gradient(module, found->function, parameters)});
    entries.push_back(entry);
  }
  Module optimized = module, fused = module;
  optimize(optimized, Precision::F64);
  optimize(fused, Precision::F32);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-3, 3);
  const std::vector<Value> parameters = parameters_of(checked.program.info);
  for (const Module* tested : std::initializer_list<const Module*>{&module, &optimized, &fused}) {
    ASSERT_THAT(verify(*tested), IsEmpty()) << to_text(*tested);
    if (tested == &fused) continue;
    const Interpreter interpreter(*tested, parameters);
    for (const EntryInfo& entry : entries) {
      Comparison comparison;
      for (unsigned point = 0; point < 24; ++point) {
        std::vector<Value> inputs = inputs_at(entry, point);
        for (Value& input : inputs)
          for (double& number : input.numbers)
            number = uniform(random);
        compare_at(interpreter, entry, inputs, comparison);
      }
      EXPECT_LT(comparison.worst, 1e-5) << text << entry.name << '\n' << to_text(*tested);
      EXPECT_GE(comparison.compared, least_compared * comparison.points) << text << entry.name;
    }
  }
}

TEST(Derivative, OfExpressions) {
  expect_gradients("function f(p) return p.x * p.y / (2 + p.z * p.z) - -p.x end");
  expect_gradients("function f(p) return p * p.yzx - 2 / (p * p + 1) end");
  expect_gradients("function f(p, uv) return dot(p, vec3(uv.x, uv.y, uv.x * uv.y)), cross(p, p.zxy * uv.x) end");
  expect_gradients("function f(p) return p ^ 2, (p.x * p.x + 1) ^ p.y, p.x ^ 3 end");
  expect_gradients("function f(p) return p % 1.5, p.x // 0.3, math.floor(p.y) + p.y * math.floor(p.z) end");
  expect_gradients("function f(p, time) return math.sin(p.x * time) + math.exp(p.y) * math.atan(p.x, time) end");
  expect_gradients("function f(p) return length(p), normalize(p), reflect(p, normalize(p.yzx)) end");
}

TEST(Derivative, OfComponentwiseFunctions) {
  expect_gradients("function f(p) return sin(p), max(p, p.zxy), mix(p, p.yzx, 0.3), clamp(p, p.x, 1) end");
  expect_gradients("function f(p) return smoothstep(-2, p.x + 4, p), abs(p) * floor(p) end");
}

TEST(Derivative, OfNoise) {
  expect_gradients("function f(p) return noise(p * 3), perlin(p.xy * 2), noise(p.x) end");
  expect_gradients("function f(p) return fbm(p, 4), turbulence(p * 2, 3, 2.1, 0.4), fbm(p.xy, 3, 2 + p.z, 0.5) end");
}

TEST(Derivative, OfBranches) {
  expect_gradients(R"(
function f(p)
  local h = 1.0
  if p.x < 0 then h = p.x * p.y elseif p.y < 0 then h = p.z end
  local k = p.z > 0 and p.x or p.y * 2
  if p.x * p.y > 1 then return h * k end
  return h + k
end)");
}

TEST(Derivative, OfLoops) {
  expect_gradients(R"(
function f(p)
  local x, y, n = 0.0, 0.0, 0
  while n < 6 and x * x + y * y < 4 do
    x, y, n = x * x - y * y + p.x * 0.3, 2 * x * y + p.y * 0.3, n + 1
  end
  local sum = vec3(0)
  for i = 1, 5 do
    if i == 3 then goto continue end
    sum = sum + sin(p * i) / i
    if sum.x > 2 then break end
    ::continue::
  end
  repeat sum = sum * 0.7 until length(sum) < 1
  return x, y, sum
end)");
}

TEST(Derivative, OfCallsAndCaptures) {
  expect_gradients(R"(
local function square(x) return x * x end
local function both(x, y) return square(x) + y, x * square(y) end
function f(p)
  local sum, count = 0.0, 0
  local function add(x) sum = sum + square(x); count = count + 1 end
  local function twice(x) add(x); add(x * p.z) end
  add(p.x)
  twice(p.y)
  local a, b = both(p.x, 3.0)
  local c, d = both(2.0, p.y)
  return sum, count, a * b, c - d, square(2.0)
end)");
}

TEST(Derivative, FaultsWhereTheFunctionDoes) {
  expect_gradients("function f(p) assert(p.x < 1, 'far'); return p.x * math.tointeger(4.0) end", 0.3);
}

/// Random expressions over everything that is smooth.
class Expressions {
public:
  explicit Expressions(unsigned seed) : random_(seed) {}
  std::string number(int depth) {
    static const char* const kLeaves[] = {"p.x", "p.y", "p.z", "time", "0.7", "1.3", "-2.1"};
    if (depth == 0) return kLeaves[random_() % std::size(kLeaves)];
    const auto n = [&] { return number(depth - 1); };
    const auto v = [&] { return vector(depth - 1); };
    switch (random_() % 12) {
    case 0:
      return "(" + n() + " + " + n() + ")";
    case 1:
      return "(" + n() + " - " + n() + ")";
    case 2:
      return "(" + n() + " * " + n() + ")";
    case 3:
      return "(" + n() + " / (1.5 + abs(" + n() + ")))";
    case 4:
      return "sin(" + n() + ")";
    case 5:
      return "mix(" + n() + ", " + n() + ", saturate(" + n() + "))";
    case 6:
      return "(" + n() + " < " + n() + " and " + n() + " or " + n() + ")";
    case 7:
      return "dot(" + v() + ", " + v() + ")";
    case 8:
      return "length(" + v() + ")";
    case 9:
      return "noise(" + v() + ")";
    case 10:
      return "smoothstep(-1, 2, " + n() + ")";
    default:
      return v() + ".y";
    }
  }
  std::string vector(int depth) {
    if (depth <= 0) return "p";
    const auto n = [&] { return number(depth - 1); };
    const auto v = [&] { return vector(depth - 1); };
    switch (random_() % 6) {
    case 0:
      return "vec3(" + n() + ", " + n() + ", " + n() + ")";
    case 1:
      return "(" + v() + " * " + n() + ")";
    case 2:
      return "cross(" + v() + ", " + v() + ")";
    case 3:
      return "cos(" + v() + ")";
    case 4:
      return "(" + v() + " + " + v() + ").zxy";
    default:
      return "max(" + v() + ", " + v() + ")";
    }
  }

private:
  std::mt19937 random_;
};

TEST(Derivative, OfRandomExpressions) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Expressions expressions(seed);
    expect_gradients("function f(p, time) return " + expressions.number(4) + ", " + expressions.vector(3) + " end", 0);
  }
}

TEST(Derivative, OfTheGallery) {
  for (const char* name : {"copper", "planet", "marble"}) {
    std::ifstream file(std::string(MOONSHADE_SHADERS) + "/" + name + ".lua");
    std::ostringstream text;
    text << file.rdbuf();
    ASSERT_THAT(text.str(), Not(IsEmpty())) << name;
    expect_gradients(text.str(), 0.3);
  }
}

} // namespace
} // namespace moonshade::ir
