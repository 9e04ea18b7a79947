// For tests: compiles a module of the IR for a domain and runs its kernels over columns of inputs.
#pragma once

#include "compiler/codegen/codegen.h"
#include "runtime/jit.h"

#include <cstdint>
#include <string>
#include <vector>

namespace moonshade::testing {

/// One component of an input: values for all points (or one, for a uniform input).
struct Column {
  ValueType type = ValueType::Number;
  std::vector<double> numbers;   ///< of numbers and vectors
  std::vector<int64_t> integers; ///< of integers and booleans
};
Column numbers(std::vector<double> values);
Column integers(std::vector<int64_t> values);

struct Outcome {
  /// By component of the results and point: the bits, all NaNs made one.
  std::vector<std::vector<uint64_t>> bits;
  std::vector<uint8_t> fault_codes;
  uint64_t fault_count = 0, first_point = 0;
  uint32_t first_site = 0;
  bool operator==(const Outcome&) const = default;

  double number(size_t component, size_t point, Precision precision) const;
  int64_t integer(size_t component, size_t point) const { return static_cast<int64_t>(bits[component][point]); }
};

class CompiledModule {
public:
  CompiledModule(const ir::Module& module, codegen::Options options);
  /// Runs entry 0 for `count` points.
  Outcome run(const std::vector<Column>& inputs, uint64_t count, size_t entry = 0) const;
  /// Runs the init function on the instance's constants; the number of the fault's place plus 1, or 0.
  uint32_t initialise();
  const codegen::CodeInfo& info() const { return generated.info; }

  codegen::Generated generated;
  std::vector<std::byte> constants;

private:
  JitCode code_;
  std::vector<std::vector<bool>> number_outputs_; ///< by entry and component
};

} // namespace moonshade::testing
