// For tests: executes a module by the letter of ir.h, in double precision, one point at a time. The library's functions
// are its own bodies over double.
#pragma once

#include "compiler/ir/ir.h"

#include <array>
#include <string>
#include <vector>

namespace moonshade::ir::test {

struct Value {
  ValueType type = ValueType::Number;
  bool boolean = false;
  int64_t integer = 0;
  std::array<double, 16> numbers{};

  static Value of(bool value) { return {.type = ValueType::Boolean, .boolean = value}; }
  static Value of(int64_t value) { return {.type = ValueType::Integer, .integer = value}; }
  static Value of(double value);
  static Value of(ValueType vector, std::initializer_list<double> numbers);
};

/// As `shaderc --run` prints under f64: "%.17g", components separated by ", ".
std::string to_text(const Value& value);

struct Outcome {
  std::vector<Value> results;
  FaultCode fault = FaultCode::None;
  std::string message;
  uint64_t steps = 0;
};

/// Results separated by blanks, or "fault: kind".
std::string to_text(const Outcome& outcome);

class Interpreter {
public:
  /// `parameters` by the shader's parameter. Runs init.
  explicit Interpreter(const Module& module, const std::vector<Value>& parameters = {});
  /// The fault of init, if any.
  const Outcome& init() const { return init_; }
  Outcome run(const std::string& entry, const std::vector<Value>& arguments) const;
  const std::vector<std::vector<Value>>& globals() const { return globals_; }

private:
  Outcome call(FunctionId function, const std::vector<Value>& arguments);

  const Module& module_;
  std::vector<std::vector<Value>> globals_;
  Outcome init_;
};

/// A constant, arithmetic, comparison, conversion or composition on its operands.
Value evaluate(const Instruction& instruction, const std::vector<Value>& operands);

/// One row of the library on its operands.
std::vector<Value> call_native(const LibraryFunction& row, ValueType type, const std::vector<Value>& operands);

} // namespace moonshade::ir::test
