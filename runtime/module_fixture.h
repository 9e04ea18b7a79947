// For tests: modules of one entry built by hand, and the check that every width agrees with one lane.
#pragma once

#include "compiler/ir/builder.h"
#include "compiler/ir/print.h"
#include "compiler/ir/verify.h"
#include "runtime/kernel_harness.h"
#include "stdlib/print_precision_for_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace moonshade::testing {

/// The library's function with this symbol.
inline const LibraryFunction& row(std::string_view symbol) {
  for (const LibraryFunction& function : library())
    if (function.symbol == symbol) return function;
  ADD_FAILURE() << "no library function " << symbol;
  std::abort();
}

/// A module with one entry, function 0, whose body `body` builds; function 1 is an empty init.
template <class Body>
ir::Module one_entry(std::vector<ValueType> parameters, std::vector<ValueType> results, Body&& body) {
  ir::Module module;
  ir::Function& function = module.functions.emplace_back();
  function.name = "main";
  function.parameters = std::move(parameters);
  for (size_t i = 0; i < function.parameters.size(); ++i)
    function.parameter_names.push_back("x" + std::to_string(i));
  function.results = std::move(results);
  module.entries.push_back({"main", 0});
  {
    ir::Builder builder(function);
    body(builder);
  }
  module.functions.emplace_back().name = "init";
  module.init = 1;
  return module;
}

inline ir::ValueId load_element(ir::Builder& b, ir::VariableId variable, ir::ValueId index, ValueType type) {
  ir::Instruction instruction;
  instruction.op = ir::Op::LoadElement;
  instruction.type = type;
  instruction.index = variable;
  instruction.operands = {index};
  return b.append(std::move(instruction));
}

inline void store_element(ir::Builder& b, ir::VariableId variable, ir::ValueId index, ir::ValueId value) {
  ir::Instruction instruction;
  instruction.op = ir::Op::StoreElement;
  instruction.index = variable;
  instruction.operands = {index, value};
  b.append(std::move(instruction));
}

/// Random numbers that a float holds too.
inline std::vector<double> some_numbers(size_t count, double scale = 4) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_real_distribution<double> distribution(-scale, scale);
  std::vector<double> values;
  while (values.size() < count)
    values.push_back(static_cast<float>(distribution(random)));
  return values;
}

/// The outcome of one lane, after checking that every width agrees with it, unoptimised and optimised.
inline Outcome same_everywhere(const ir::Module& module, Precision precision, const std::vector<Column>& inputs,
                               uint64_t count, const codegen::Options& base = {}) {
  EXPECT_THAT(ir::verify(module), ::testing::IsEmpty()) << ir::to_text(module);
  codegen::Options options = base;
  options.precision = precision;
  options.width = 1;
  const Outcome expected = CompiledModule(module, options).run(inputs, count);
  for (const unsigned width : kWidths) {
    for (const int level : {0, 2}) {
      options.width = width;
      options.optimization = level;
      const Outcome outcome = CompiledModule(module, options).run(inputs, count);
      EXPECT_EQ(outcome.bits, expected.bits) << "width " << width << " -O" << level << "\n" << ir::to_text(module);
      EXPECT_EQ(outcome.fault_codes, expected.fault_codes) << "width " << width << " -O" << level;
      EXPECT_EQ(outcome.fault_count, expected.fault_count);
      EXPECT_EQ(outcome.first_point, expected.first_point);
      EXPECT_EQ(outcome.first_site, expected.first_site);
      if (::testing::Test::HasFailure()) return expected;
    }
  }
  return expected;
}

class DomainTest : public ::testing::TestWithParam<Precision> {
protected:
  Precision precision() const { return GetParam(); }
};
inline auto both_precisions() { return ::testing::Values(Precision::F32, Precision::F64); }
inline std::string precision_name(const ::testing::TestParamInfo<Precision>& info) {
  return ::testing::PrintToString(info.param);
}

} // namespace moonshade::testing
