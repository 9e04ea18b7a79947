// The verifier: each rule broken once. A sound module has no violations (builder_test.cpp, and all tests of passes).
#include "compiler/ir/test_modules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::ir {
namespace {

using namespace test;
using enum ValueType;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> violations(std::vector<ValueType> parameters, std::vector<ValueType> results,
                                    const std::function<void(Builder&)>& fill) {
  return verify(module_of(std::move(parameters), std::move(results), fill));
}

Instruction raw(Op op, ValueType type, std::vector<ValueId> operands, uint32_t index = 0) {
  Instruction instruction{};
  instruction.op = op;
  instruction.type = type;
  instruction.operands = std::move(operands);
  instruction.index = index;
  return instruction;
}

TEST(Verify, ValueOfAnInnerBlockIsNotVisibleOutside) {
  EXPECT_THAT(violations({Boolean}, {},
                         [](Builder& b) {
                           ValueId inner = kNone;
                           b.if_else(b.argument(0), b.block([&] { inner = b.integer(1); }));
                           b.unary(Op::Neg, inner);
                         }),
              ElementsAre(HasSubstr("is not visible here")));
}

TEST(Verify, ValueIsNotUsedBeforeItIsComputed) {
  EXPECT_THAT(violations({}, {},
                         [](Builder& b) {
                           const ValueId one = b.integer(1);
                           b.unary(Op::Neg, one);
                           std::swap(b.current().instructions[0], b.current().instructions[1]);
                         }),
              ElementsAre(HasSubstr("is not visible here")));
}

TEST(Verify, NoInstructionStandsInTwoBlocks) {
  EXPECT_THAT(violations({Boolean}, {},
                         [](Builder& b) {
                           const ValueId one = b.integer(1);
                           b.current().instructions.push_back(one);
                         }),
              ElementsAre(HasSubstr("stands in blocks twice")));
}

TEST(Verify, OperandsAgreeWithTheType) {
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.append(raw(Op::Add, Number, {b.number(1), b.integer(1)})); }),
              ElementsAre(HasSubstr("operand 1 is integer instead of number")));
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.unary(Op::Neg, b.boolean(true)); }),
              ElementsAre(HasSubstr("cannot work on boolean")));
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.binary(Op::Div, b.integer(1), b.integer(1)); }),
              ElementsAre(HasSubstr("cannot work on integer")));
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.compare(Op::Lt, b.zero(Vec3), b.zero(Vec3)); }),
              ElementsAre(HasSubstr("cannot work on vec3")));
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.if_else(b.integer(1), {}); }),
              ElementsAre(HasSubstr("instead of boolean")));
}

TEST(Verify, NumberOfOperands) {
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.append(raw(Op::Fma, Number, {b.number(1)})); }),
              ElementsAre(HasSubstr("has 1 operands")));
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.construct(Vec3, {b.number(1), b.number(2)}); }),
              ElementsAre(HasSubstr("has 2 numbers")));
}

TEST(Verify, ComponentIsInRange) {
  EXPECT_THAT(violations({Vec2}, {}, [](Builder& b) { b.component(b.argument(0), 2); }),
              ElementsAre(HasSubstr("index out of range")));
}

TEST(Verify, BreakNamesAnEnclosingConstruct) {
  EXPECT_THAT(violations({}, {},
                         [](Builder& b) {
                           const LabelId label = b.label();
                           b.scope(label, b.block([&] { b.break_to(label); }));
                           b.break_to(label);
                         }),
              ElementsAre(HasSubstr("names no enclosing loop or scope")));
}

TEST(Verify, NothingFollowsBreakOrReturn) {
  EXPECT_THAT(violations({}, {},
                         [](Builder& b) {
                           b.return_values({});
                           b.step();
                         }),
              ElementsAre(HasSubstr("is followed by another instruction")));
}

TEST(Verify, ReturnsOnEveryPath) {
  EXPECT_THAT(
      violations({Boolean}, {Number},
                 [](Builder& b) { b.if_else(b.argument(0), b.block([&] { b.return_values({b.number(1)}); })); }),
      ElementsAre(HasSubstr("the end can be reached without a return")));
  EXPECT_THAT(violations({}, {Number}, [](Builder& b) { b.return_values({b.integer(1)}); }),
              ElementsAre(HasSubstr("type of result 0")));
  EXPECT_THAT(violations({}, {Number}, [](Builder& b) { b.return_values({}); }),
              ElementsAre(HasSubstr("number of results is wrong")));
}

TEST(Verify, CallsAgreeWithTheCallee) {
  const auto with_callee = [](const std::function<void(Builder&)>& fill) {
    Module module = module_of({}, {}, fill);
    Function callee;
    callee.name = "callee";
    callee.parameters = {Number};
    callee.variables = {{.name = "outside", .type = Number}};
    callee.captures = 1;
    module.functions.push_back(callee);
    return verify(module);
  };
  EXPECT_THAT(with_callee([](Builder& b) {
                const VariableId variable = b.variable("v", Number);
                b.call(2, {}, {b.number(1)}, {variable});
              }),
              ElementsAre());
  EXPECT_THAT(with_callee([](Builder& b) { b.call(2, {}, {b.number(1)}, {}); }),
              ElementsAre(HasSubstr("captures of callee are missing")));
  EXPECT_THAT(with_callee([](Builder& b) {
                const VariableId variable = b.variable("v", Integer);
                b.call(2, {}, {b.number(1)}, {variable});
              }),
              ElementsAre(HasSubstr("binds a variable of another type")));
  EXPECT_THAT(with_callee([](Builder& b) {
                const VariableId variable = b.variable("v", Number);
                b.call(2, {}, {b.integer(1)}, {variable});
              }),
              ElementsAre(HasSubstr("argument 0 of callee is integer")));
  EXPECT_THAT(with_callee([](Builder& b) { b.call(9, {}, {}); }), ElementsAre(HasSubstr("names no function")));
}

TEST(Verify, RefusesRecursion) {
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.call(1, {}, {}); }), ElementsAre(HasSubstr("is recursive")));
}

TEST(Verify, LibraryRowsFixTheTypes) {
  const LibraryFunction& mix = library_overloads("mix")[0];
  const LibraryFunction& cross = library_overloads("cross")[0];
  EXPECT_THAT(violations({Vec3}, {},
                         [&](Builder& b) {
                           const ValueId v = b.argument(0), half = b.number(0.5);
                           b.call_library(mix, Vec3, {v, v, half});
                           b.call_library(mix, Number, {half, half, half});
                           b.call_library(cross, Vec3, {v, v});
                         }),
              ElementsAre());
  EXPECT_THAT(violations({Vec3}, {},
                         [&](Builder& b) { b.call_library(mix, Number, {b.argument(0), b.number(1), b.number(1)}); }),
              ElementsAre(HasSubstr("operand 0 of mix is vec3 instead of number")));
  EXPECT_THAT(
      violations({Vec3}, {}, [&](Builder& b) { b.call_library(mix, Vec2, {b.argument(0), b.number(1), b.number(1)}); }),
      ElementsAre(HasSubstr("operand 0 of mix is vec3")));
  EXPECT_THAT(violations({Vec3}, {}, [&](Builder& b) { b.call_library(cross, Vec3, {b.argument(0)}); }),
              ElementsAre(HasSubstr("has 1 operands for cross")));
}

TEST(Verify, ResultsAreThoseOfTheCall) {
  const LibraryFunction& floor = library_overloads("math.floor")[0];
  EXPECT_THAT(violations({Number}, {},
                         [&](Builder& b) { b.result(b.call_library(floor, Integer, {b.argument(0)}), 1, Boolean); }),
              ElementsAre());
  EXPECT_THAT(violations({Number}, {},
                         [&](Builder& b) { b.result(b.call_library(floor, Integer, {b.argument(0)}), 2, Boolean); }),
              ElementsAre(HasSubstr("index out of range")));
  EXPECT_THAT(violations({Number}, {}, [&](Builder& b) { b.result(b.argument(0), 1, Boolean); }),
              ElementsAre(HasSubstr("is not of a call")));
}

TEST(Verify, GlobalsAreStoredByInitAlone) {
  Module module = module_of({}, {}, [](Builder& b) { b.store_global(0, b.number(1)); });
  module.globals.push_back({.name = "g", .type = Number});
  EXPECT_THAT(verify(module), ElementsAre(HasSubstr("stands outside init")));
}

TEST(Verify, VariablesHaveTheTypeOfWhatIsStored) {
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.store(b.variable("v", Number), b.integer(1)); }),
              ElementsAre(HasSubstr("operand 0 is integer instead of number")));
  EXPECT_THAT(violations({}, {}, [](Builder& b) { b.load(b.variable("v", Number, 3)); }),
              ElementsAre(HasSubstr("works on an array")));
}

TEST(Verify, EntriesAndInitHaveNoCaptures) {
  Module module = module_of({}, {}, [](Builder& b) { b.variable("v", Number); });
  module.functions[1].captures = 1;
  EXPECT_THAT(verify(module), ElementsAre(HasSubstr("entry 'f' has captures")));
}

} // namespace
} // namespace moonshade::ir
