// narrow_variables: functions as text, and which of their variables 32 bits hold.
#include "compiler/ir/narrow.h"

#include "compiler/ir/test_modules.h"

#include <gtest/gtest.h>

namespace moonshade::ir {
namespace {

using namespace test;
using enum ValueType;

/// The text of a function, and behind it the names of its narrow variables.
std::string narrow_in(const std::function<void(Builder&)>& fill, uint64_t step_limit = 1'000'000) {
  const Module module = module_of({Integer, Boolean}, {Integer}, fill);
  const Function& function = module.functions.back();
  const std::vector<bool> narrow = narrow_variables(function, step_limit);
  std::string text = text_of(module) + "narrow:";
  for (VariableId i = 0; i < narrow.size(); ++i)
    if (narrow[i]) text += " " + function.variables[i].name;
  return text;
}

/// Of a loop that counts in steps of `step` from 0, with `also` at its end.
std::string counting(
    int64_t step, uint64_t step_limit,
    const std::function<void(Builder&, VariableId)>& also = [](Builder&, VariableId) {}) {
  const std::string text = narrow_in(
      [&](Builder& b) {
        const VariableId n = b.variable("n", Integer);
        b.store(n, b.integer(0));
        const LabelId label = b.label();
        b.loop(label, b.block([&] {
          b.if_else(b.argument(1), b.block([&] { b.break_to(label); }));
          b.store(n, b.binary(Op::Add, b.load(n), b.integer(step)));
          also(b, n);
        }));
        b.return_values({b.load(n)});
      },
      step_limit);
  return text.substr(text.find("narrow:"));
}

TEST(Narrow, WhatOnlyCountsIsNarrowAndSoIsItsCopy) {
  EXPECT_EQ(narrow_in([](Builder& b) {
              const VariableId n = b.variable("n", Integer), last = b.variable("last", Integer);
              const VariableId any = b.variable("any", Integer);
              b.store(n, b.integer(7));
              b.store(last, b.integer(0));
              b.store(any, b.argument(0));
              const LabelId label = b.label();
              b.loop(label, b.block([&] {
                b.if_else(b.argument(1), b.block([&] { b.break_to(label); }));
                const ValueId next = b.binary(Op::Sub, b.load(n), b.integer(2));
                b.store(n, b.select(b.argument(1), next, b.integer(5)));
                b.store(last, next);
                b.store(any, b.binary(Op::Add, b.load(any), b.integer(1)));
              }));
              b.return_values({b.load(last)});
            }),
            R"(
function f(a: integer, b: boolean) -> integer {
  var $0.n: integer
  var $1.last: integer
  var $2.any: integer
  %0: integer = const.i 7
  store $0.n, %0
  %1: integer = const.i 0
  store $1.last, %1
  %2: integer = argument 0
  store $2.any, %2
  loop #0 {
    %3: boolean = argument 1
    if %3 {
      break #0
    }
    %4: integer = load $0.n
    %5: integer = const.i 2
    %6: integer = sub %4, %5
    %7: boolean = argument 1
    %8: integer = const.i 5
    %9: integer = select %7, %6, %8
    store $0.n, %9
    store $1.last, %6
    %10: integer = load $2.any
    %11: integer = const.i 1
    %12: integer = add %10, %11
    store $2.any, %12
  }
  %13: integer = load $1.last
  return %13
}
narrow: n last)");
}

TEST(Narrow, TheStepLimitBoundsCounters) {
  EXPECT_EQ(counting(2000, 1'000'000), "narrow: n");
  EXPECT_EQ(counting(3000, 1'000'000), "narrow:") << "3,000,003,000 are beyond 32 bits";
  EXPECT_EQ(counting(1, uint64_t{1} << 40), "narrow:");
}

TEST(Narrow, ProductsAndVariablesInTermsOfEachOtherAreNot) {
  EXPECT_EQ(counting(1, 1000, [](Builder& b, VariableId n) { b.store(n, b.binary(Op::Mul, b.load(n), b.integer(2))); }),
            "narrow:");
  EXPECT_EQ(counting(1, 1000,
                     [](Builder& b, VariableId n) {
                       const VariableId m = b.variable("m", Integer);
                       b.store(m, b.binary(Op::Add, b.load(n), b.integer(1)));
                       b.store(n, b.binary(Op::Add, b.load(m), b.integer(1)));
                     }),
            "narrow:")
      << "n grows by what m was, which is what n was";
}

} // namespace
} // namespace moonshade::ir
