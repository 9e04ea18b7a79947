// Faults, steps, calls and captures in compiled code, from modules built by hand: the same points fault at every width.
#include "runtime/frontend.h"
#include "runtime/module_fixture.h"

namespace moonshade {
namespace {

using enum ValueType;
using ir::Op;
using namespace testing;

/// A loop of `count` iterations (an integer value), each counted as a step.
template <class Body> void counted_loop(ir::Builder& b, ir::ValueId count, Body&& body) {
  const auto i = b.variable("i", Integer);
  const auto label = b.label();
  b.store(i, b.integer(0));
  b.loop(label, b.block([&] {
    b.step();
    b.if_else(b.compare(Op::Le, count, b.load(i)), b.block([&] { b.break_to(label); }));
    body(b.load(i));
    b.store(i, b.binary(Op::Add, b.load(i), b.integer(1)));
  }));
}

using Faults = DomainTest;
INSTANTIATE_TEST_SUITE_P(, Faults, both_precisions(), precision_name);

TEST_P(Faults, EndOnlyTheirPoint) {
  const ir::Module module = one_entry({Integer}, {Number, Integer}, [](ir::Builder& b) {
    const auto k = b.argument(0);
    const auto table = b.variable("table", Number, 4);
    for (int i = 0; i < 4; ++i)
      store_element(b, table, b.integer(i), b.number(i + 0.5));
    b.fault(b.compare(Op::Eq, b.binary(Op::And, k, b.integer(7)), b.integer(5)), FaultCode::Assert, "five");
    b.fault(b.binary(Op::Or, b.compare(Op::Lt, k, b.integer(0)), b.compare(Op::Le, b.integer(4), k)), FaultCode::Index);
    b.return_values({load_element(b, table, k, Number), k});
  });
  const std::vector<int64_t> keys = {0, 1, 2, 3, 4, 5, -1, 3, 2, 13, 0, INT64_MAX, INT64_MIN, 1, 1, 1, 1, 1, 21};
  const Outcome outcome = same_everywhere(module, precision(), {integers(keys)}, keys.size());
  EXPECT_EQ(outcome.fault_count, 7u);
  EXPECT_EQ(outcome.first_point, 4u);
  for (size_t i = 0; i < keys.size(); ++i) {
    const bool inside = keys[i] >= 0 && keys[i] < 4;
    EXPECT_EQ(outcome.number(0, i, precision()), inside ? static_cast<double>(keys[i]) + 0.5 : 0);
    EXPECT_EQ(outcome.integer(1, i), inside ? keys[i] : 0);
    const FaultCode code = inside ? FaultCode::None : (keys[i] & 7) == 5 ? FaultCode::Assert : FaultCode::Index;
    EXPECT_EQ(outcome.fault_codes[i], static_cast<uint8_t>(code)) << i;
  }
}

TEST_P(Faults, NameTheFirstPlaceThatWasReached) {
  const ir::Module module = one_entry({Integer}, {Integer}, [](ir::Builder& b) {
    const auto k = b.argument(0);
    b.if_else(b.compare(Op::Lt, k, b.integer(10)),
              b.block([&] { b.fault(b.compare(Op::Lt, k, b.integer(3)), FaultCode::Error, "small"); }),
              b.block([&] { b.fault(b.compare(Op::Lt, b.integer(20), k), FaultCode::DivideByZero); }));
    b.fault(b.compare(Op::Eq, b.binary(Op::And, k, b.integer(1)), b.integer(1)), FaultCode::Assert, "odd");
    b.return_values({k});
  });
  std::vector<int64_t> keys;
  for (int64_t i = 0; i < 60; ++i)
    keys.push_back((i * 7) % 30);
  const Outcome outcome = same_everywhere(module, precision(), {integers(keys)}, keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    const int64_t k = keys[i];
    const FaultCode code = k < 3    ? FaultCode::Error
                           : k > 20 ? FaultCode::DivideByZero
                           : k % 2  ? FaultCode::Assert
                                    : FaultCode::None;
    EXPECT_EQ(outcome.fault_codes[i], static_cast<uint8_t>(code)) << k;
  }
}

TEST_P(Faults, CountStepsByPoint) {
  // 3 * (k + 1) + 1 steps... exactly: k + 1 of the outer loop's, k times 3 of the inner one's
  const auto build = [](uint64_t limit) {
    ir::Module module = one_entry({Integer}, {Integer}, [](ir::Builder& b) {
      const auto sum = b.variable("sum", Integer);
      b.store(sum, b.integer(0));
      counted_loop(b, b.argument(0), [&](ir::ValueId) {
        counted_loop(b, b.integer(2), [&](ir::ValueId j) {
          b.store(sum, b.binary(Op::Add, b.load(sum), b.binary(Op::Add, j, b.integer(1))));
        });
      });
      b.return_values({b.load(sum)});
    });
    module.step_limit = limit;
    return module;
  };
  std::vector<int64_t> keys;
  for (int64_t i = 0; i < 67; ++i)
    keys.push_back((i * 13) % 41);
  const Outcome outcome = same_everywhere(build(100), precision(), {integers(keys)}, keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    const int64_t steps = keys[i] + 1 + 3 * keys[i];
    EXPECT_EQ(outcome.fault_codes[i], static_cast<uint8_t>(steps > 100 ? FaultCode::StepLimit : FaultCode::None))
        << keys[i];
    EXPECT_EQ(outcome.integer(0, i), steps > 100 ? 0 : 3 * keys[i]);
  }
}

TEST_P(Faults, EndLoopsThatWouldNotEnd) {
  // a point with a negative key faults before a loop that only ends for others
  const ir::Module module = one_entry({Integer}, {Integer}, [](ir::Builder& b) {
    const auto k = b.argument(0);
    const auto n = b.variable("n", Integer);
    b.store(n, k);
    b.fault(b.compare(Op::Lt, k, b.integer(0)), FaultCode::ForStepZero);
    const auto label = b.label();
    b.loop(label, b.block([&] {
      b.step();
      b.if_else(b.compare(Op::Eq, b.load(n), b.integer(0)), b.block([&] { b.break_to(label); }));
      b.store(n, b.binary(Op::Sub, b.load(n), b.integer(1)));
    }));
    const auto endless = b.label();
    b.if_else(b.compare(Op::Eq, k, b.integer(9)), b.block([&] {
      b.fault(b.boolean(true), FaultCode::Error, "nine");
      b.loop(endless, b.block([&] { b.step(); }));
    }));
    b.return_values({b.binary(Op::Add, k, b.integer(100))});
  });
  const std::vector<int64_t> keys = {5, -1, 7, 8, 9, 0, -5, 9, 1, 1, 1, 1, 1, 1, 1, 1, 1, -1};
  const Outcome outcome = same_everywhere(module, precision(), {integers(keys)}, keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    const FaultCode code = keys[i] < 0 ? FaultCode::ForStepZero : keys[i] == 9 ? FaultCode::Error : FaultCode::None;
    EXPECT_EQ(outcome.fault_codes[i], static_cast<uint8_t>(code)) << keys[i];
    EXPECT_EQ(outcome.integer(0, i), code == FaultCode::None ? keys[i] + 100 : 0);
  }
}

TEST_P(Faults, ReachOutOfFunctionsAndCaptures) {
  // callee: adds its argument to the captured sum, returns early for some, faults for some, counts a step
  for (const int calls : {1, 40}) { // in place, and as a function of its own
    ir::Module module = one_entry({Integer, Number}, {Number, Number}, [&](ir::Builder& b) {
      const auto sum = b.variable("sum", Number);
      b.store(sum, b.argument(1));
      const auto total = b.variable("total", Number);
      b.store(total, b.number(0));
      const std::vector<ValueType> results = {Number, Integer};
      for (int i = 0; i < calls; ++i) {
        b.if_else(b.compare(Op::Lt, b.binary(Op::And, b.argument(0), b.integer(3)), b.integer(1 + i % 3)), b.block([&] {
          const auto got = b.call(2, results, {b.argument(0), b.load(sum)}, {sum});
          const auto second = b.result(got, 1, Integer);
          b.store(total, b.binary(Op::Add, b.load(total), b.binary(Op::Add, got, b.convert(second, Number))));
        }));
      }
      b.return_values({b.load(total), b.load(sum)});
    });
    ir::Function& callee = module.functions.emplace_back();
    callee.name = "callee";
    callee.parameters = {Integer, Number};
    callee.parameter_names = {"k", "x"};
    callee.results = {Number, Integer};
    callee.variables = {{"sum", Number, 1}};
    callee.captures = 1;
    {
      ir::Builder b(callee);
      b.step();
      const auto k = b.argument(0), x = b.argument(1);
      b.store(0, b.binary(Op::Add, b.load(0), b.number(0.5)));
      b.fault(b.compare(Op::Eq, k, b.integer(12)), FaultCode::IntegerRange);
      b.if_else(b.compare(Op::Lt, x, b.number(0)),
                b.block([&] { b.return_values({b.unary(Op::Neg, x), b.integer(1)}); }));
      b.store(0, b.binary(Op::Add, b.load(0), b.number(0.25)));
      for (int i = 0; i < 30; ++i)
        b.store(0, b.binary(Op::Mul, b.load(0), b.number(1 + i / 64.0)));
      b.return_values({b.binary(Op::Mul, x, b.number(2)), k});
    }
    module.step_limit = 30;
    std::vector<int64_t> keys;
    for (int64_t i = 0; i < 70; ++i)
      keys.push_back((i * 5) % 17);
    const Outcome outcome = same_everywhere(module, precision(), {integers(keys), numbers(some_numbers(70, 2))}, 70);
    for (size_t i = 0; i < keys.size(); ++i) {
      const FaultCode expected = keys[i] == 12                     ? FaultCode::IntegerRange
                                 : calls == 40 && keys[i] % 4 == 0 ? FaultCode::StepLimit
                                                                   : FaultCode::None;
      EXPECT_EQ(outcome.fault_codes[i], static_cast<uint8_t>(expected)) << keys[i];
    }
  }
}

TEST_P(Faults, OfTheTopLevelAreReported) {
  ir::Module module = one_entry({Number}, {Number}, [](ir::Builder& b) { b.return_values({b.argument(0)}); });
  module.globals = {{"n", Integer, 1, 0}};
  {
    ir::Builder b(module.functions[module.init]);
    b.fault(b.compare(Op::Eq, b.load_global(0, Integer), b.integer(0)), FaultCode::DivideByZero);
  }
  codegen::Options options;
  options.precision = precision();
  CompiledModule compiled(module, options);
  const uint32_t fault = compiled.initialise();
  ASSERT_NE(fault, 0u);
  EXPECT_EQ(compiled.info().places[fault - 1].code, FaultCode::DivideByZero);
  compiled.constants[compiled.info().global_offsets[0]] = std::byte{1};
  EXPECT_EQ(compiled.initialise(), 0u);
}

TEST_P(Faults, LeaveProgramsAloneThatCannotFault) {
  const ir::Module module = one_entry(
      {Number}, {Number}, [](ir::Builder& b) { b.return_values({b.binary(Op::Add, b.argument(0), b.number(1))}); });
  codegen::Options options;
  options.precision = precision();
  EXPECT_EQ(codegen::generate(module, options).llvm_text().find("moonshade_block_faulted"), std::string::npos);
}

/// Nothing is kept for a shader that cannot fault, at any width.
TEST(FaultBookkeeping, IsNotThereWhereNoFaultIsPossible) {
  const auto reports_faults = [](const std::string& text, unsigned width) {
    const CheckedShader checked("test.lua", text);
    EXPECT_TRUE(checked.ok());
    CompileOptions options;
    options.width = width;
    const Emission emission = emit(checked, Stage::Llvm, options);
    EXPECT_NE(emission.bytes.find("moonshade_entry_height"), std::string::npos) << emission.error;
    return emission.bytes.find("moonshade_block_faulted") != std::string::npos;
  };
  for (const unsigned width : {1u, 8u}) {
    EXPECT_FALSE(reports_faults("local function f(x) return x * 2 end\n"
                                "function height(p, id)\n"
                                "  local s = 0.0\n"
                                "  for i = 1, 20 do s = s + f(noise(p * i)) + (id // 3) % 5 end\n"
                                "  return s\n"
                                "end",
                                width));
    EXPECT_TRUE(reports_faults("function height(p, id) return p.x // 1 + 7 // id end", width));
    EXPECT_TRUE(
        reports_faults("function height(p, id) local s = 0.0 for i = 1, id do s = s + i end return s end", width));
    EXPECT_TRUE(reports_faults("function height(p, id) return p[id] end", width));
  }
}

} // namespace
} // namespace moonshade
