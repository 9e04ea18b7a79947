// Uniformity: what is varying in small functions, argument 0 always varying and argument 1 always uniform.
#include "compiler/ir/uniformity.h"

#include "compiler/ir/test_modules.h"

#include <gtest/gtest.h>

namespace moonshade::ir {
namespace {

using namespace test;
using enum ValueType;

/// A function f(varying: boolean, uniform: boolean, x: number varying) -> number and its analysis.
struct Analysed {
  Module module;
  Uniformity answers;

  bool variable(const std::string& name) const {
    const std::vector<Variable>& variables = module.functions[1].variables;
    for (size_t i = 0; i < variables.size(); ++i)
      if (variables[i].name == name) return answers.variable_varying[i];
    ADD_FAILURE() << "no variable " << name;
    return false;
  }
  /// Of the only instruction with this operation (or the one at `index`).
  bool control(Op op, size_t index = 0) const {
    const std::vector<Instruction>& instructions = module.functions[1].instructions;
    for (size_t i = 0; i < instructions.size(); ++i)
      if (instructions[i].op == op && index-- == 0) return answers.control_varying[i];
    ADD_FAILURE() << "no such instruction";
    return false;
  }
};

struct Inputs {
  ValueId varying, uniform, x;
};

Analysed analyse(const std::function<void(Builder&, const Inputs&)>& fill,
                 const std::function<void(Module&)>& finish = {}) {
  Analysed analysed;
  analysed.module = module_of({Boolean, Boolean, Number}, {Number}, [&](Builder& b) {
    const Inputs inputs{b.argument(0), b.argument(1), b.argument(2)};
    fill(b, inputs);
    if (!b.terminated()) b.return_values({b.number(0)});
  });
  if (finish) finish(analysed.module);
  EXPECT_EQ(verify(analysed.module), std::vector<std::string>()) << to_text(analysed.module);
  UniformityTable table;
  analysed.answers = analyse_uniformity(analysed.module, 1, {{true, false, true}, {}, false}, table);
  return analysed;
}

TEST(Uniformity, FollowsOperands) {
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    b.store(b.variable("from_uniform", Boolean), b.unary(Op::Not, in.uniform));
    b.store(b.variable("from_varying", Boolean), b.binary(Op::And, in.uniform, in.varying));
  });
  EXPECT_FALSE(a.variable("from_uniform"));
  EXPECT_TRUE(a.variable("from_varying"));
  EXPECT_FALSE(a.answers.results_varying[0]);
}

TEST(Uniformity, EverythingIsUniformWhereTheArgumentsAre) {
  Module module = module_of({Boolean}, {Number}, [](Builder& b) {
    const VariableId v = b.variable("v", Number);
    b.store(v, b.number(1));
    b.if_else(b.argument(0), b.block([&] { b.return_values({b.load(v)}); }));
    b.return_values({b.number(2)});
  });
  UniformityTable table;
  const Uniformity& answers = analyse_uniformity(module, 1, entry_signature(module.functions[1], {true}), table);
  for (const std::vector<bool>* flags :
       {&answers.value_varying, &answers.variable_varying, &answers.control_varying, &answers.results_varying})
    for (const bool flag : *flags)
      EXPECT_FALSE(flag);
}

TEST(Uniformity, StoresUnderAVaryingIfMakeAVariableVarying) {
  const auto with = [](bool varying) {
    return analyse([&](Builder& b, const Inputs& in) {
      const VariableId v = b.variable("v", Number);
      b.store(v, b.number(1));
      b.if_else(varying ? in.varying : in.uniform, b.block([&] { b.store(v, b.number(2)); }));
      b.return_values({b.load(v)});
    });
  };
  EXPECT_TRUE(with(true).variable("v"));
  EXPECT_TRUE(with(true).answers.results_varying[0]);
  EXPECT_FALSE(with(false).variable("v"));
  EXPECT_FALSE(with(false).answers.results_varying[0]);
}

TEST(Uniformity, AVariableThatLivesInsideAVaryingIfStaysUniform) {
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId v = b.variable("v", Number);
    b.if_else(in.varying, b.block([&] {
      b.store(v, b.number(1));
      b.if_else(in.uniform, b.block([&] { b.store(v, b.number(2)); }));
      b.fault(b.compare(Op::Lt, b.load(v), b.number(0)), FaultCode::Assert);
    }));
  });
  EXPECT_TRUE(a.control(Op::If, 1));
  EXPECT_FALSE(a.control(Op::If, 0)) << "the inner one";
  EXPECT_FALSE(a.variable("v"));
}

/// loop { step; if `leave` { break }; n = n + 1 } with n set to 0 before.
void counting_loop(Builder& b, ValueId leave, VariableId n) {
  b.store(n, b.integer(0));
  const LabelId label = b.label();
  b.loop(label, b.block([&] {
    const ValueId now = b.load(n);
    b.if_else(leave, b.block([&] { b.break_to(label); }));
    b.store(n, b.binary(Op::Add, now, b.integer(1)));
  }));
}

TEST(Uniformity, ALoopWithAVaryingBreakIsVarying) {
  const Analysed varying =
      analyse([](Builder& b, const Inputs& in) { counting_loop(b, in.varying, b.variable("n", Integer)); });
  EXPECT_TRUE(varying.control(Op::Loop));
  EXPECT_TRUE(varying.control(Op::Break));
  const Analysed uniform =
      analyse([](Builder& b, const Inputs& in) { counting_loop(b, in.uniform, b.variable("n", Integer)); });
  EXPECT_FALSE(uniform.control(Op::Loop));
  EXPECT_FALSE(uniform.control(Op::Break));
}

TEST(Uniformity, TheCounterOfAVaryingLoopIsUniformUnlessReadBehindIt) {
  const auto with = [](bool read) {
    return analyse([&](Builder& b, const Inputs& in) {
      const VariableId n = b.variable("n", Integer);
      counting_loop(b, in.varying, n);
      if (read) b.return_values({b.convert(b.load(n), Number)});
    });
  };
  EXPECT_FALSE(with(false).variable("n"));
  EXPECT_TRUE(with(true).variable("n")) << "lanes leave with counts of their own";
}

TEST(Uniformity, ACounterSetOnceForSeveralVaryingLoopsIsVarying) {
  // The inner loop goes on with the count at which each lane left it last.
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId n = b.variable("n", Integer);
    b.store(n, b.integer(0));
    const LabelId outer = b.label(), inner = b.label();
    b.loop(outer, b.block([&] {
      b.loop(inner, b.block([&] {
        const ValueId now = b.load(n);
        b.if_else(in.varying, b.block([&] { b.break_to(inner); }));
        b.store(n, b.binary(Op::Add, now, b.integer(1)));
      }));
      b.if_else(in.uniform, b.block([&] { b.break_to(outer); }));
    }));
  });
  EXPECT_TRUE(a.variable("n"));
}

TEST(Uniformity, WhatAnEarlierIterationStoredForOtherLanesIsNotUniform) {
  // Each lane reads what it stored when it was here last; other lanes were here in between.
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId v = b.variable("v", Number);
    const LabelId label = b.label();
    b.loop(label, b.block([&] {
      b.if_else(in.varying, b.block([&] {
        b.fault(b.compare(Op::Lt, b.load(v), b.number(0)), FaultCode::Assert);
        b.store(v, b.number(1));
      }));
      b.if_else(in.uniform, b.block([&] { b.break_to(label); }));
    }));
  });
  EXPECT_TRUE(a.variable("v"));
}

TEST(Uniformity, ALoopInsideAVaryingIfIsUniformForItsLanes) {
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId n = b.variable("n", Integer);
    b.if_else(in.varying, b.block([&] { counting_loop(b, in.uniform, n); }));
  });
  EXPECT_FALSE(a.variable("n"));
  EXPECT_FALSE(a.control(Op::Loop));
}

TEST(Uniformity, BehindAVaryingBreakABreakFurtherOutIsVarying) {
  const auto with = [](bool varying) {
    return analyse([&](Builder& b, const Inputs& in) {
      const LabelId outer = b.label(), inner = b.label();
      b.scope(outer, b.block([&] {
        b.scope(inner, b.block([&] {
          b.if_else(varying ? in.varying : in.uniform, b.block([&] { b.break_to(inner); }));
          b.break_to(outer);
        }));
        b.step();
      }));
    });
  };
  EXPECT_TRUE(with(true).control(Op::Break, 1));
  EXPECT_TRUE(with(true).control(Op::Scope, 1)) << "the outer one";
  EXPECT_FALSE(with(false).control(Op::Break, 1));
  EXPECT_FALSE(with(false).control(Op::Scope, 1));
}

TEST(Uniformity, WhatFollowsTheWholeConstructIsNotPartial) {
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId v = b.variable("v", Number);
    const LabelId label = b.label();
    b.scope(label, b.block([&] { b.if_else(in.varying, b.block([&] { b.break_to(label); })); }));
    b.store(v, b.number(1));
    b.return_values({b.load(v)});
  });
  EXPECT_FALSE(a.variable("v"));
  EXPECT_FALSE(a.control(Op::Return));
  EXPECT_FALSE(a.answers.results_varying[0]);
}

TEST(Uniformity, BehindAVaryingReturnTheOthersReturnForThemselves) {
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId v = b.variable("v", Number);
    b.if_else(in.varying, b.block([&] { b.return_values({b.number(1)}); }));
    b.store(v, b.number(1));
    b.return_values({b.load(v)});
  });
  EXPECT_TRUE(a.control(Op::Return, 0));
  EXPECT_FALSE(a.variable("v")) << "lanes that have returned never read it";
  EXPECT_TRUE(a.answers.results_varying[0]);
}

TEST(Uniformity, FaultsMakeNothingVaryingButMayKill) {
  const Analysed a = analyse([](Builder& b, const Inputs& in) {
    const VariableId v = b.variable("v", Number);
    const LabelId label = b.label();
    b.loop(label, b.block([&] {
      b.fault(in.varying, FaultCode::Assert);
      b.store(v, b.number(1));
      b.if_else(in.uniform, b.block([&] { b.break_to(label); }));
    }));
    b.return_values({b.load(v)});
  });
  EXPECT_FALSE(a.variable("v"));
  EXPECT_FALSE(a.control(Op::Loop));
  EXPECT_FALSE(a.answers.results_varying[0]);
  EXPECT_TRUE(a.answers.function_may_kill);
}

/// callee(x) with one capture `outside`, stored 5; gives x.
void add_callee(Module& module) {
  Function callee;
  callee.name = "callee";
  callee.parameters = {Number};
  callee.results = {Number};
  callee.variables = {{.name = "outside", .type = Number}};
  callee.captures = 1;
  {
    Builder b(callee);
    b.store(0, b.number(5));
    b.return_values({b.argument(0)});
  }
  module.functions.push_back(std::move(callee));
}

TEST(Uniformity, CallsAreAnalysedForTheirArguments) {
  const std::vector<ValueType> results{Number};
  const Analysed a = analyse(
      [&](Builder& b, const Inputs& in) {
        const VariableId outside = b.variable("outside", Number);
        b.store(b.variable("of_uniform", Number), b.call(2, results, {b.number(1)}, {outside}));
        b.store(b.variable("of_varying", Number), b.call(2, results, {in.x}, {outside}));
      },
      add_callee);
  EXPECT_FALSE(a.variable("of_uniform"));
  EXPECT_TRUE(a.variable("of_varying"));
  EXPECT_FALSE(a.variable("outside"));
}

TEST(Uniformity, ACalleesStoresUnderAPartialMaskMakeTheCapturedVariableVarying) {
  const std::vector<ValueType> results{Number};
  const Analysed a = analyse(
      [&](Builder& b, const Inputs& in) {
        const VariableId outside = b.variable("outside", Number), inside = b.variable("inside", Number);
        b.store(outside, b.number(1));
        b.if_else(in.varying, b.block([&] {
          b.store(inside, b.number(1));
          b.call(2, results, {b.number(1)}, {outside});
          b.call(2, results, {b.number(1)}, {inside});
        }));
        b.return_values({b.load(outside)});
      },
      add_callee);
  EXPECT_TRUE(a.variable("outside"));
  EXPECT_FALSE(a.variable("inside"));
  EXPECT_TRUE(a.answers.results_varying[0]);
  for (const auto& [call, signature] : a.answers.calls) {
    const VariableId bound = a.module.functions[1].instructions[call].variables[0];
    EXPECT_EQ(signature.captures_varying[0], a.answers.variable_varying[bound]);
  }
}

} // namespace
} // namespace moonshade::ir
