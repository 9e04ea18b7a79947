// The builder and the printer: what is built is what is printed, and the verifier has nothing against it.
#include "compiler/ir/test_modules.h"

#include <gtest/gtest.h>

namespace moonshade::ir {
namespace {

using namespace test;
using enum ValueType;

TEST(Builder, BuildsAndPrintsNestedBlocks) {
  const Module module = module_of({Number, Integer}, {Number}, [](Builder& b) {
    const VariableId sum = b.variable("sum", Number);
    b.store(sum, b.number(0.1));
    const LabelId label = b.label();
    b.loop(label, b.block([&] {
      b.step();
      const ValueId now = b.load(sum);
      const ValueId large = b.compare(Op::Lt, b.argument(0), now);
      b.if_else(large, b.block([&] { b.break_to(label); }),
                b.block([&] { b.fault(b.boolean(false), FaultCode::Assert, "a \"b\"\n"); }));
      b.store(sum, b.binary(Op::Add, now, b.convert(b.argument(1), Number)));
    }));
    b.return_values({b.load(sum)});
  });
  EXPECT_EQ(text_of(module), R"(
function f(a: number, b: integer) -> number {
  var $0.sum: number
  %0: number = const.n 0.10000000000000001
  store $0.sum, %0
  loop #0 {
    step
    %1: number = load $0.sum
    %2: number = argument 0
    %3: boolean = lt %2, %1
    if %3 {
      break #0
    } else {
      %4: boolean = const.b false
      fault %4, assert "a \"b\"\x0a"
    }
    %5: integer = argument 1
    %6: number = integer_to_number %5
    %7: number = add %1, %6
    store $0.sum, %7
  }
  %8: number = load $0.sum
  return %8
}
)");
}

TEST(Builder, ConvertsNumbersToVectorsAndExactIntegersAtOnce) {
  const Module module = module_of({}, {Vec3}, [](Builder& b) { b.return_values({b.convert(b.integer(3), Vec3)}); });
  EXPECT_EQ(text_of(module), R"(
function f() -> vec3 {
  %0: integer = const.i 3
  %1: number = const.n 3
  %2: vec3 = construct %1
  return %2
}
)");
}

TEST(Builder, LeavesIntegersThatDoubleCannotHoldToTheDomain) {
  const Module module = module_of(
      {}, {Number}, [](Builder& b) { b.return_values({b.convert(b.integer((int64_t{1} << 53) + 1), Number)}); });
  EXPECT_NE(text_of(module).find("integer_to_number"), std::string::npos);
}

TEST(Builder, KnowsWhereExecutionEnds) {
  module_of({Boolean}, {}, [](Builder& b) {
    EXPECT_FALSE(b.terminated());
    const LabelId label = b.label();
    b.loop(label, b.block([&] { b.step(); }));
    EXPECT_TRUE(b.terminated()) << "a loop without a break";
    b.current().instructions.clear();
    b.loop(label, b.block([&] { b.if_else(b.argument(0), b.block([&] { b.break_to(label); })); }));
    EXPECT_FALSE(b.terminated());
    b.if_else(b.argument(0), b.block([&] { b.return_values({}); }), b.block([&] { b.return_values({}); }));
    EXPECT_TRUE(b.terminated());
  });
}

TEST(Printer, PrintsGlobalsEntriesAndInit) {
  Module module = module_of({}, {}, [](Builder&) {});
  module.globals.push_back({.name = "scale", .type = Number, .parameter = 2});
  module.globals.push_back({.name = "TABLE", .type = Vec2, .count = 4});
  EXPECT_EQ(to_text(module), R"(global @0 scale: number, parameter 2
global @1 TABLE: vec2[4]
entry f = f

init top_level() {
}

function f() {
}
)");
}

} // namespace
} // namespace moonshade::ir
