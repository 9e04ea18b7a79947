// Each pass by a text before and after. That no pass changes a result is tested with shaders (build_test.cpp).
#include "compiler/ir/passes.h"

#include "compiler/ir/test_interpreter.h"
#include "compiler/ir/test_modules.h"
#include "compiler/ir/verify.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace moonshade::ir {
namespace {

using namespace test;
using enum ValueType;
using testing::HasSubstr;
using testing::Not;

Function& f(Module& module) { return module.functions.back(); }

/// The text after the pass; unused values are removed, to keep it short.
std::string after(const std::function<void(Function&)>& pass, std::vector<ValueType> parameters,
                  std::vector<ValueType> results, const std::function<void(Builder&)>& fill) {
  Module module = module_of(std::move(parameters), std::move(results), fill);
  pass(f(module));
  remove_dead_code(f(module));
  return text_of(module);
}

TEST(Fold, FoldsIntegersAndWhatConstantsDecide) {
  EXPECT_EQ(after(fold_constants, {Integer}, {Integer},
                  [](Builder& b) {
                    const ValueId least = b.integer(std::numeric_limits<int64_t>::min());
                    const ValueId wrapped = b.binary(Op::Sub, least, b.integer(1));
                    const ValueId greater = b.compare(Op::Lt, b.integer(1), wrapped);
                    b.if_else(greater, b.block([&] { b.return_values({wrapped}); }),
                              b.block([&] { b.return_values({b.argument(0)}); }));
                  }),
            R"(
function f(a: integer) -> integer {
  %0: integer = const.i 9223372036854775807
  return %0
}
)");
}

TEST(SplitCounters, GivesTheLoopACounterOfItsOwn) {
  EXPECT_EQ(after(split_counters, {Boolean}, {Integer},
                  [](Builder& b) {
                    const VariableId n = b.variable("n", Integer);
                    b.store(n, b.integer(0));
                    const LabelId label = b.label();
                    b.loop(label, b.block([&] {
                      b.if_else(b.argument(0), b.block([&] { b.break_to(label); }));
                      b.store(n, b.binary(Op::Add, b.load(n), b.integer(2)));
                    }));
                    b.return_values({b.load(n)});
                  }),
            R"(
function f(a: boolean) -> integer {
  var $0.n: integer
  var $1.n: integer
  %0: integer = const.i 0
  store $0.n, %0
  store $1.n, %0
  loop #0 {
    %1: boolean = argument 0
    if %1 {
      break #0
    }
    %2: integer = load $1.n
    %3: integer = const.i 2
    %4: integer = add %2, %3
    store $0.n, %4
    store $1.n, %4
  }
  %5: integer = load $0.n
  return %5
}
)");
}

TEST(Fold, FoldsNumbersOnlyWhereFloatAndDoubleAgree) {
  const auto folded = [](Op op, double x, double y) {
    return after(fold_constants, {}, {Number},
                 [&](Builder& b) { b.return_values({b.binary(op, b.number(x), b.number(y))}); });
  };
  EXPECT_THAT(folded(Op::Add, 0.5, 0.25), HasSubstr("const.n 0.75\n  return"));
  EXPECT_THAT(folded(Op::Mul, 3, -0.0), HasSubstr("const.n -0\n  return"));
  // Float does not hold 2^24 + 1: both results differ from those of double, rounded. 0/0 is a NaN.
  EXPECT_THAT(folded(Op::Add, 16777217, 1), HasSubstr("add"));
  EXPECT_THAT(folded(Op::Sub, 16777217, 16777216), HasSubstr("sub"));
  EXPECT_THAT(folded(Op::Div, 0, 0), HasSubstr("div"));
}

TEST(Fold, ComparesConstantsOnlyWhereFloatAndDoubleAgree) {
  const auto folded = [](double x, double y) {
    return after(fold_constants, {}, {Boolean},
                 [&](Builder& b) { b.return_values({b.compare(Op::Eq, b.number(x), b.number(y))}); });
  };
  EXPECT_THAT(folded(1, 2), HasSubstr("const.b false\n  return"));
  EXPECT_THAT(folded(16777217, 16777216), HasSubstr("eq"));
}

TEST(Fold, NegatesComparisonsOfIntegersButNotOfNumbers) {
  const auto negated = [](ValueType type) {
    return after(fold_constants, {type, type}, {Boolean}, [](Builder& b) {
      b.return_values({b.unary(Op::Not, b.compare(Op::Lt, b.argument(0), b.argument(1)))});
    });
  };
  EXPECT_THAT(negated(Integer), HasSubstr("le %1, %0"));
  EXPECT_THAT(negated(Number), HasSubstr("not")) << "NaN is neither less nor not less-or-equal";
}

TEST(Fold, ComparesWithSmallIntegerConstantsAsNumbers) {
  const LibraryFunction* row = nullptr;
  for (const LibraryFunction& candidate : library_overloads("op.lt"))
    if (candidate.parameters[0] == Number) row = &candidate;
  ASSERT_NE(row, nullptr);
  const auto compared = [&](int64_t integer) {
    return after(fold_constants, {Number}, {Boolean}, [&](Builder& b) {
      b.return_values({b.call_library(*row, Boolean, {b.argument(0), b.integer(integer)})});
    });
  };
  EXPECT_THAT(compared(4), HasSubstr("%2: boolean = lt %0, %1"));
  EXPECT_THAT(compared(16777217), HasSubstr("op_lt_number_integer")) << "float does not hold it";
}

TEST(DecideComparisons, AnIndexBuiltWithinItsBoundsNeedsNoCheck) {
  const auto checked_index = [](Builder& b, const LibraryFunction& row, std::vector<ValueId> operands) {
    const ValueId index = b.binary(Op::Add, b.call_library(row, Integer, std::move(operands)), b.integer(1));
    const ValueId below = b.compare(Op::Lt, index, b.integer(1)), above = b.compare(Op::Lt, b.integer(3), index);
    b.fault(b.binary(Op::Or, below, above), FaultCode::Index);
    b.return_values({index});
  };
  const LibraryFunction &fract = library_overloads("fract")[0], &floor = library_overloads("math.floor")[0];
  const LibraryFunction& mod = library_overloads("op.mod")[0];
  ASSERT_EQ(floor.parameters[0], Number);
  ASSERT_EQ(mod.parameters[0], Integer);
  const auto settled = [](Function& function) {
    decide_comparisons(function);
    fold_constants(function);
  };
  const auto of_share = [&](double scale) {
    return after(settled, {Number}, {Integer}, [&](Builder& b) {
      const ValueId share = b.call_library(fract, Number, {b.argument(0)});
      checked_index(b, floor, {b.binary(Op::Mul, share, b.number(scale))});
    });
  };
  EXPECT_EQ(of_share(2.9), R"(
function f(a: number) -> integer {
  %0: number = argument 0
  %1: number = call_library fract(%0)
  %2: number = const.n 2.8999999999999999
  %3: number = mul %1, %2
  %4: integer = call_library math_floor(%3)
  %5: integer = const.i 1
  %6: integer = add %4, %5
  return %6
}
)");
  EXPECT_THAT(of_share(3), Not(HasSubstr("fault"))) << "less than 1 times 3 is not rounded up to 3";
  EXPECT_THAT(of_share(3.0001), HasSubstr("fault"));
  EXPECT_THAT(
      after(settled, {Integer}, {Integer}, [&](Builder& b) { checked_index(b, mod, {b.argument(0), b.integer(3)}); }),
      Not(HasSubstr("fault")));
  EXPECT_THAT(
      after(settled, {Integer}, {Integer}, [&](Builder& b) { checked_index(b, mod, {b.argument(0), b.integer(-3)}); }),
      HasSubstr("fault"));
}

TEST(ForwardVariables, LoadsOfWhatWasStoredBecomeIt) {
  EXPECT_EQ(after(forward_variables, {Number, Boolean}, {Number},
                  [](Builder& b) {
                    const VariableId v = b.variable("v", Number), w = b.variable("w", Number);
                    const ValueId a = b.argument(0);
                    b.store(v, a);
                    b.store(w, a);
                    b.if_else(b.argument(1), b.block([&] { b.store(w, b.binary(Op::Add, b.load(v), b.load(w))); }));
                    b.return_values({b.binary(Op::Mul, b.load(v), b.load(w))});
                  }),
            R"(
function f(a: number, b: boolean) -> number {
  var $0.w: number
  %0: number = argument 0
  store $0.w, %0
  %1: boolean = argument 1
  if %1 {
    %2: number = add %0, %0
    store $0.w, %2
  }
  %3: number = load $0.w
  %4: number = mul %0, %3
  return %4
}
)");
}

TEST(ForwardVariables, ALoopsStoresAreUnknownAtItsBeginning) {
  EXPECT_THAT(after(forward_variables, {Number}, {Number},
                    [](Builder& b) {
                      const VariableId v = b.variable("v", Number);
                      b.store(v, b.number(1));
                      const LabelId label = b.label();
                      b.loop(label, b.block([&] {
                        const ValueId now = b.load(v);
                        b.if_else(b.compare(Op::Lt, b.argument(0), now), b.block([&] { b.break_to(label); }));
                        b.store(v, b.binary(Op::Add, now, now));
                      }));
                      b.return_values({b.load(v)});
                    }),
              HasSubstr("loop #0 {\n    %1: number = load $0.v"));
}

TEST(ForwardVariables, CapturesMayBeOneVariable) {
  Module module = module_of({}, {}, [](Builder&) {});
  Function callee;
  callee.name = "callee";
  callee.variables = {{.name = "x", .type = Number}, {.name = "y", .type = Number}};
  callee.captures = 2;
  callee.results = {Number};
  {
    Builder b(callee);
    b.store(0, b.number(1));
    b.store(1, b.number(2));
    b.return_values({b.load(0)});
  }
  module.functions.push_back(callee);
  forward_variables(f(module));
  EXPECT_THAT(text_of(module), HasSubstr("load $0.x"));
}

TEST(ShareValues, EqualComputationsAreDoneOnce) {
  const LibraryFunction& noise = library_overloads("noise")[0];
  EXPECT_EQ(after(share_values, {Number, Boolean}, {Number, Number, Number},
                  [&](Builder& b) {
                    const ValueId first = b.call_library(noise, Number, {b.argument(0)});
                    const VariableId v = b.variable("v", Number);
                    b.if_else(b.argument(1), b.block([&] { b.store(v, b.unary(Op::Neg, b.argument(0))); }),
                              b.block([&] { b.store(v, b.call_library(noise, Number, {b.argument(0)})); }));
                    const ValueId negated = b.unary(Op::Neg, b.argument(0));
                    b.return_values({first, b.load(v), negated});
                  }),
            R"(
function f(a: number, b: boolean) -> number, number, number {
  var $0.v: number
  %0: number = argument 0
  %1: number = call_library noise_number(%0)
  %2: boolean = argument 1
  if %2 {
    %3: number = neg %0
    store $0.v, %3
  } else {
    store $0.v, %1
  }
  %4: number = neg %0
  %5: number = load $0.v
  return %1, %5, %4
}
)");
}

TEST(ShareValues, AConditionIsCheckedOnceOnEachPath) {
  EXPECT_EQ(after(share_values, {Boolean, Boolean}, {},
                  [](Builder& b) {
                    const ValueId bad = b.argument(0);
                    b.if_else(b.argument(1), b.block([&] { b.fault(bad, FaultCode::Index); }));
                    b.fault(bad, FaultCode::DivideByZero);
                    b.fault(bad, FaultCode::DivideByZero);
                    b.if_else(b.argument(1), b.block([&] { b.fault(bad, FaultCode::Index); }));
                    b.return_values({});
                  }),
            R"(
function f(a: boolean, b: boolean) {
  %0: boolean = argument 0
  %1: boolean = argument 1
  if %1 {
    fault %0, index
  }
  fault %0, division
  return
}
)");
}

TEST(ShareValues, ZerosOfBothSignsAreTwo) {
  EXPECT_THAT(
      after(share_values, {}, {Number, Number}, [](Builder& b) { b.return_values({b.number(0.0), b.number(-0.0)}); }),
      HasSubstr("return %0, %1"));
}

TEST(Select, CheapIfsBecomeSelects) {
  EXPECT_EQ(after(convert_ifs_to_selects, {Number, Boolean}, {Number},
                  [](Builder& b) {
                    const VariableId v = b.variable("v", Number);
                    const ValueId a = b.argument(0);
                    b.store(v, a);
                    b.if_else(b.argument(1), b.block([&] { b.store(v, b.binary(Op::Mul, a, a)); }));
                    b.return_values({b.load(v)});
                  }),
            R"(
function f(a: number, b: boolean) -> number {
  var $0.v: number
  %0: number = argument 0
  store $0.v, %0
  %1: boolean = argument 1
  %2: number = mul %0, %0
  %3: number = load $0.v
  %4: number = select %1, %2, %3
  store $0.v, %4
  %5: number = load $0.v
  return %5
}
)");
}

TEST(Select, IfsWithEffectsOrCostStay) {
  const auto with = [](const std::function<void(Builder&)>& then) {
    return after(convert_ifs_to_selects, {Number, Boolean}, {},
                 [&](Builder& b) { b.if_else(b.argument(1), b.block([&] { then(b); })); });
  };
  EXPECT_THAT(with([](Builder& b) { b.step(); }), HasSubstr("if"));
  EXPECT_THAT(with([](Builder& b) { b.fault(b.boolean(true), FaultCode::Error); }), HasSubstr("if"));
}

TEST(DeadCode, UnusedValuesStoresAndScopesGo) {
  EXPECT_EQ(after([](Function&) {}, {Number}, {Number},
                  [](Builder& b) {
                    const VariableId unread = b.variable("unread", Number);
                    const ValueId a = b.argument(0);
                    b.store(unread, b.binary(Op::Add, a, b.number(1)));
                    b.if_else(b.compare(Op::Lt, a, a), b.block([&] { b.number(2); }));
                    b.scope(b.label(), b.block([&] { b.return_values({a}); }));
                  }),
            R"(
function f(a: number) -> number {
  %0: number = argument 0
  return %0
}
)");
}

TEST(ForwardGlobals, ConstantsOfTheTopLevelReachTheirUses) {
  Module module = module_of({}, {Vec3}, [](Builder& b) {
    b.return_values({b.binary(Op::Add, b.load_global(0, Vec3), b.load_global(1, Vec3))});
  });
  module.globals = {{.name = "COPPER", .type = Vec3}, {.name = "tint", .type = Vec3}};
  {
    Builder b(module.functions[0]);
    b.store_global(0, b.construct(Vec3, {b.number(1), b.number(2), b.number(3)}));
    b.if_else(b.boolean(true), b.block([&] { b.store_global(1, b.zero(Vec3)); }));
  }
  forward_constant_globals(module);
  for (Function& function : module.functions)
    remove_dead_code(function);
  EXPECT_EQ(to_text(module), R"(global @0 tint: vec3
entry f = f

init top_level() {
  %0: boolean = const.b true
  if %0 {
    %1: number = const.n 0
    %2: vec3 = construct %1, %1, %1
    store_global @0 tint, %2
  }
}

function f() -> vec3 {
  %0: number = const.n 1
  %1: number = const.n 2
  %2: number = const.n 3
  %3: vec3 = construct %0, %1, %2
  %4: vec3 = load_global @0 tint
  %5: vec3 = add %3, %4
  return %5
}
)");
}

TEST(Reachability, UncalledFunctionsGo) {
  Module module = module_of({}, {}, [](Builder& b) { b.call(3, {}, {}); });
  Function unused, used;
  unused.name = "unused";
  used.name = "used";
  module.functions.push_back(unused);
  module.functions.push_back(used);
  remove_unreachable(module);
  EXPECT_EQ(to_text(module), R"(entry f = f

init top_level() {
}

function f() {
  call used()
}

function used() {
}
)");
}

/// A loop that stores two variables: what each begins with, whether both are stored before one is read, and the
/// factors.
std::string two_variables(double first, double second, bool apart, double factor, double other_factor) {
  return after(
      [](Function& function) {
        share_variables(function);
        forward_variables(function);
      },
      {Boolean}, {Number, Number},
      [=](Builder& b) {
        const VariableId x = b.variable("x", Number), y = b.variable("y", Number);
        b.store(x, b.number(first));
        b.store(y, b.number(second));
        const LabelId label = b.label();
        b.loop(label, b.block([&] {
          b.if_else(b.argument(0), b.block([&] { b.break_to(label); }));
          const ValueId old_x = b.load(x), old_y = b.load(y);
          b.store(x, b.binary(Op::Mul, old_x, b.number(factor)));
          if (apart) b.store(x, b.binary(Op::Add, b.load(x), b.number(0)));
          b.store(y, b.binary(Op::Mul, old_y, b.number(other_factor)));
        }));
        b.return_values({b.load(x), b.load(y)});
      });
}

TEST(ShareVariables, LeavesOneOfThoseThatAlwaysHoldTheSame) {
  EXPECT_EQ(two_variables(1, 1, false, 2, 2), R"(
function f(a: boolean) -> number, number {
  var $0.x: number
  %0: number = const.n 1
  store $0.x, %0
  loop #0 {
    %1: boolean = argument 0
    if %1 {
      break #0
    }
    %2: number = load $0.x
    %3: number = const.n 2
    %4: number = mul %2, %3
    store $0.x, %4
  }
  %5: number = load $0.x
  return %5, %5
}
)");
}

TEST(ShareVariables, KeepsWhatIsStoredDifferentlyOrAtAnotherTime) {
  EXPECT_THAT(two_variables(1, 2, false, 2, 2), HasSubstr("$1.y"));
  EXPECT_THAT(two_variables(1, 1, false, 2, 3), HasSubstr("$1.y"));
  EXPECT_THAT(two_variables(1, 1, true, 2, 2), HasSubstr("$1.y"));
}

TEST(ShareVariables, KeepsWhatACallMayHaveStoredMeanwhile) {
  // x and y are loaded from one captured variable, but a call lies between.
  Module module;
  module.functions.emplace_back().name = "g";
  module.functions.back().variables = {{.name = "v", .type = Number}};
  module.functions.back().captures = 1;
  Function& f = module.functions.emplace_back();
  f.name = "f";
  f.results = {Number, Number};
  {
    Builder b(f);
    const VariableId v = b.variable("v", Number), x = b.variable("x", Number), y = b.variable("y", Number);
    b.store(v, b.number(1));
    const ValueId before = b.load(v);
    b.call(0, {}, {}, {v});
    const ValueId behind = b.load(v);
    b.store(x, before);
    b.store(y, behind);
    b.return_values({b.load(x), b.load(y)});
  }
  share_variables(f);
  EXPECT_THAT(to_text(module), HasSubstr("load $2.y"));
}

std::string fused(const std::function<ValueId(Builder&, ValueId, ValueId, ValueId)>& make) {
  Module module = module_of({Number, Number, Number}, {Number}, [&](Builder& b) {
    const ValueId x = b.argument(0), y = b.argument(1), z = b.argument(2);
    b.return_values({make(b, x, y, z)});
  });
  fuse(module);
  return text_of(module);
}

TEST(Fuse, ProductsThatAreAddedOnceAreFused) {
  using V = ValueId;
  EXPECT_THAT(fused([](Builder& b, V x, V y, V z) { return b.binary(Op::Add, b.binary(Op::Mul, x, y), z); }),
              HasSubstr("fma %0, %1, %2"));
  EXPECT_THAT(fused([](Builder& b, V x, V y, V z) { return b.binary(Op::Add, z, b.binary(Op::Mul, x, y)); }),
              HasSubstr("fma %0, %1, %2"));
  EXPECT_THAT(fused([](Builder& b, V x, V y, V z) { return b.binary(Op::Sub, b.binary(Op::Mul, x, y), z); }),
              HasSubstr("%3: number = neg %2\n  %4: number = fma %0, %1, %3"));
  EXPECT_THAT(fused([](Builder& b, V x, V y, V z) { return b.binary(Op::Sub, z, b.binary(Op::Mul, x, y)); }),
              HasSubstr("%3: number = neg %0\n  %4: number = fma %3, %1, %2"));
  EXPECT_THAT(fused([](Builder& b, V x, V y, V z) {
                return b.binary(Op::Add, b.binary(Op::Mul, x, y), b.binary(Op::Mul, y, z));
              }),
              HasSubstr("%3: number = mul %1, %2\n  %4: number = fma %0, %1, %3"));
}

TEST(Fuse, ProductsWithAnotherUseStay) {
  EXPECT_THAT(fused([](Builder& b, ValueId x, ValueId y, ValueId z) {
                const ValueId product = b.binary(Op::Mul, x, y);
                return b.binary(Op::Div, b.binary(Op::Add, product, z), product);
              }),
              Not(HasSubstr("fma")));
}

TEST(Fuse, OfTwoProductsThatWhichIsWaitedForLonger) {
  const auto sum = [](Op op, bool exchanged) {
    return fused([=](Builder& b, ValueId x, ValueId y, ValueId z) {
      const ValueId late = b.binary(Op::Mul, b.binary(Op::Add, x, z), z), soon = b.binary(Op::Mul, x, y);
      return exchanged ? b.binary(op, soon, late) : b.binary(op, late, soon);
    });
  };
  const std::string_view factors = "%3: number = add %0, %2\n";
  EXPECT_THAT(sum(Op::Add, false),
              HasSubstr(std::string(factors) + "  %4: number = mul %0, %1\n  %5: number = fma %3, %2, %4"));
  EXPECT_THAT(sum(Op::Add, true),
              HasSubstr(std::string(factors) + "  %4: number = mul %0, %1\n  %5: number = fma %3, %2, %4"));
  EXPECT_THAT(sum(Op::Sub, true), HasSubstr("%5: number = neg %3\n  %6: number = fma %5, %2, %4"));
}

TEST(Fuse, MixOfConstantsMovesFromOneToTheOther) {
  const auto mix = [](double from, double to) {
    return fused([=](Builder& b, ValueId x, ValueId, ValueId) {
      return b.call_library(library_overloads("mix")[0], Number, {b.number(from), b.number(to), x});
    });
  };
  EXPECT_THAT(mix(0.25, 1), HasSubstr("const.n 0.25\n  %2: number = const.n 0.75\n  %3: number = fma %0, %2, %1"));
  // Adding the difference to the one gives the other in float for all but very different numbers.
  EXPECT_THAT(mix(0.42, 0.66), HasSubstr("fma"));
  EXPECT_THAT(mix(1, 1e-9), Not(HasSubstr("fma")));
  EXPECT_THAT(mix(-3e38, 3e38), Not(HasSubstr("fma")));
  EXPECT_THAT(mix(INFINITY, 1), Not(HasSubstr("fma")));
}

TEST(Fuse, MixOfVectorsTakesOneNumberForEachComponent) {
  Module module = module_of({Number}, {Vec3}, [&](Builder& b) {
    const ValueId from = b.construct(Vec3, {b.number(0), b.number(0.5), b.number(1)});
    b.return_values({b.call_library(library_overloads("mix")[0], Vec3, {from, b.number(1), b.argument(0)})});
  });
  fuse(module);
  EXPECT_THAT(text_of(module), HasSubstr("fma"));
  EXPECT_TRUE(verify(module).empty());
}

/// A counted loop as `build` makes it: `for i = start, limit, step do step end`, where break_if(counter) leaves.
Module counted_loop(ValueType type, const std::function<ValueId(Builder&)>& start,
                    const std::function<ValueId(Builder&, ValueId)>& leaves,
                    const std::function<ValueId(Builder&, ValueId)>& next) {
  return module_of({Integer, Number}, {}, [&](Builder& b) {
    const VariableId counter = b.variable("", type);
    b.store(counter, start(b));
    const LabelId label = b.label();
    b.loop(label, b.block([&] {
      b.step();
      const ValueId now = b.load(counter);
      b.if_else(leaves(b, now), b.block([&] { b.break_to(label); }));
      b.store(counter, next(b, now));
    }));
  });
}

bool keeps_steps(Module module, uint64_t limit) {
  module.step_limit = limit;
  remove_bounded_steps(module);
  return text_of(module).find("step\n") != std::string::npos;
}

TEST(Steps, ConstantLoopsWithinTheLimitDoNotCount) {
  const Module module = counted_loop(
      Integer, [](Builder& b) { return b.integer(1); },
      [](Builder& b, ValueId i) { return b.compare(Op::Le, b.integer(10), i); },
      [](Builder& b, ValueId i) { return b.binary(Op::Add, i, b.integer(1)); });
  EXPECT_FALSE(keeps_steps(module, 10));
  EXPECT_TRUE(keeps_steps(module, 9));
}

TEST(Steps, OtherConditionsBesideTheCounterDoNotMatter) {
  const auto loop = [](Op op) {
    return counted_loop(
        Integer, [](Builder& b) { return b.integer(0); },
        [&](Builder& b, ValueId i) {
          return b.binary(op, b.compare(Op::Lt, b.integer(100), i), b.compare(Op::Lt, b.argument(0), i));
        },
        [](Builder& b, ValueId i) { return b.binary(Op::Add, i, b.integer(2)); });
  };
  EXPECT_FALSE(keeps_steps(loop(Op::Or), 1000));
  EXPECT_TRUE(keeps_steps(loop(Op::And), 1000)) << "it stays as long as the argument says";
}

TEST(Steps, FloatLoopsAreRunInBothPrecisions) {
  // 2^24 + 1 is no float: there the counter stands still.
  const Module module = counted_loop(
      Number, [](Builder& b) { return b.number(16777210); },
      [](Builder& b, ValueId x) { return b.compare(Op::Lt, b.number(16777220), x); },
      [](Builder& b, ValueId x) { return b.binary(Op::Add, x, b.number(1)); });
  EXPECT_TRUE(keeps_steps(module, 1000));
}

TEST(Steps, UnknownBoundsAndEndlessLoopsKeepCounting) {
  EXPECT_TRUE(keeps_steps(counted_loop(
                              Integer, [](Builder& b) { return b.integer(1); },
                              [](Builder& b, ValueId i) { return b.compare(Op::Le, b.argument(0), i); },
                              [](Builder& b, ValueId i) { return b.binary(Op::Add, i, b.integer(1)); }),
                          1000));
  EXPECT_TRUE(keeps_steps(counted_loop(
                              Integer, [](Builder& b) { return b.integer(1); },
                              [](Builder& b, ValueId i) { return b.compare(Op::Eq, b.integer(0), i); },
                              [](Builder& b, ValueId i) { return b.binary(Op::Add, i, b.integer(1)); }),
                          1000));
}

TEST(Steps, CallsCountWithTheLoopsAround) {
  Module module = counted_loop(
      Integer, [](Builder& b) { return b.integer(1); },
      [](Builder& b, ValueId i) {
        b.call(2, {}, {});
        return b.compare(Op::Le, b.integer(10), i);
      },
      [](Builder& b, ValueId i) { return b.binary(Op::Add, i, b.integer(1)); });
  Function callee;
  callee.name = "callee";
  {
    Builder b(callee);
    b.step();
    b.step();
  }
  module.functions.push_back(callee);
  EXPECT_FALSE(keeps_steps(module, 30));
  EXPECT_TRUE(keeps_steps(module, 29));
}

} // namespace
} // namespace moonshade::ir
