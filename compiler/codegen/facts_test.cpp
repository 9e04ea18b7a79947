// FunctionFacts: functions as text, and what is found out of their variables.
#include "compiler/codegen/facts.h"

#include "compiler/ir/test_modules.h"

#include <gtest/gtest.h>

namespace moonshade::codegen {
namespace {

using namespace ir;
using namespace ir::test;
using enum ValueType;

/// The text of a function of one number, and behind it for each variable the loop that lanes leave for good.
std::string last_loops_of(const std::function<void(ir::Builder&)>& fill) {
  const Module module = module_of({Number}, {Number}, fill);
  const Function& function = module.functions.back();
  UniformityTable table;
  const Uniformity& uniformity = analyse_uniformity(module, 1, entry_signature(function, {false}), table);
  const FunctionFacts facts = function_facts(function, uniformity, module.step_limit);
  std::string text = text_of(module);
  for (VariableId i = 0; i < function.variables.size(); ++i) {
    const LabelId loop = facts.last_loops[i];
    text += function.variables[i].name + ": " + (loop == kNone ? "none" : "#" + std::to_string(loop)) + "\n";
  }
  return text;
}

/// A loop that each lane leaves when it likes, around `body`.
void varying_loop(ir::Builder& b, const std::function<void()>& body) {
  const LabelId label = b.label();
  b.loop(label, b.block([&] {
    b.if_else(b.compare(Op::Lt, b.argument(0), b.number(1)), b.block([&] { b.break_to(label); }));
    body();
  }));
}

void count(ir::Builder& b, VariableId variable) { b.store(variable, b.binary(Op::Add, b.load(variable), b.number(1))); }

TEST(LastLoops, WhatIsReadInALoopAloneIsLostToLanesThatHaveLeft) {
  EXPECT_EQ(last_loops_of([](ir::Builder& b) {
              const VariableId inside = b.variable("inside", Number), behind = b.variable("behind", Number);
              b.store(inside, b.number(0));
              b.store(behind, b.number(0));
              varying_loop(b, [&] {
                count(b, inside);
                count(b, behind);
              });
              b.return_values({b.load(behind)});
            }),
            R"(
function f(a: number) -> number {
  var $0.inside: number
  var $1.behind: number
  %0: number = const.n 0
  store $0.inside, %0
  %1: number = const.n 0
  store $1.behind, %1
  loop #0 {
    %2: number = argument 0
    %3: number = const.n 1
    %4: boolean = lt %2, %3
    if %4 {
      break #0
    }
    %5: number = load $0.inside
    %6: number = const.n 1
    %7: number = add %5, %6
    store $0.inside, %7
    %8: number = load $1.behind
    %9: number = const.n 1
    %10: number = add %8, %9
    store $1.behind, %10
  }
  %11: number = load $1.behind
  return %11
}
inside: #0
behind: none
)");
}

/// Only the lines behind the text.
std::string facts_alone(const std::function<void(ir::Builder&)>& fill) {
  const std::string text = last_loops_of(fill);
  return text.substr(text.rfind("}\n") + 2);
}

TEST(LastLoops, TheOutermostLoopWithinTheHomeCounts) {
  const auto nested = [](bool home_outside) {
    return facts_alone([&](ir::Builder& b) {
      const VariableId n = b.variable("n", Number);
      if (home_outside) b.store(n, b.number(0));
      varying_loop(b, [&] {
        if (!home_outside) b.store(n, b.number(0));
        varying_loop(b, [&] { count(b, n); });
      });
      b.return_values({b.number(0)});
    });
  };
  EXPECT_EQ(nested(true), "n: #0\n");
  EXPECT_EQ(nested(false), "n: #1\n") << "the outer loop stands around the home";
}

TEST(LastLoops, ReadsInTwoLoopsHaveNone) {
  EXPECT_EQ(facts_alone([](ir::Builder& b) {
              const VariableId n = b.variable("n", Number);
              b.store(n, b.number(0));
              varying_loop(b, [&] { count(b, n); });
              varying_loop(b, [&] { count(b, n); });
              b.return_values({b.number(0)});
            }),
            "n: none\n");
}

} // namespace
} // namespace moonshade::codegen
