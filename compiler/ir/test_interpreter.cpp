// For tests: the interpreter. See test_interpreter.h.
#include "compiler/ir/test_interpreter.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace moonshade::ir::test {
namespace {

enum class Flow : uint8_t { Next, Break, Return, Fault };

uint64_t bits(int64_t value) { return static_cast<uint64_t>(value); }

/// One call of a function.
class Activation {
public:
  Activation(const Module& module, const Function& function, std::vector<std::vector<Value>>& globals, Outcome& outcome,
             const std::vector<Value>& arguments, const std::vector<std::vector<Value>*>& captures)
      : module_(module), function_(function), globals_(globals), outcome_(outcome), arguments_(arguments),
        values_(function.instructions.size()), own_(function.variables.size()) {
    for (VariableId i = 0; i < function.variables.size(); ++i) {
      own_[i].resize(function.variables[i].count);
      variables_.push_back(i < function.captures ? captures[i] : &own_[i]);
    }
  }

  Flow run() { return block(function_.body); }
  const std::vector<Value>& results() const { return results_; }

private:
  Flow block(const Block& block) {
    for (const ValueId id : block.instructions)
      if (const Flow flow = execute(id); flow != Flow::Next) return flow;
    return Flow::Next;
  }

  const Value& operand(const Instruction& instruction, size_t i) const { return values_[instruction.operands[i]][0]; }

  Flow fault(FaultCode code, const std::string& message) {
    outcome_.fault = code;
    outcome_.message = message;
    return Flow::Fault;
  }

  Flow execute(ValueId id) {
    const Instruction& instruction = function_.instructions[id];
    switch (instruction.op) {
    case Op::StoreGlobal:
      globals_[instruction.index] = {operand(instruction, 0)};
      return Flow::Next;
    case Op::StoreGlobalElement:
      globals_[instruction.index].at(bits(operand(instruction, 0).integer)) = operand(instruction, 1);
      return Flow::Next;
    case Op::Store:
      *variables_[instruction.index] = {operand(instruction, 0)};
      return Flow::Next;
    case Op::StoreElement:
      variables_[instruction.index]->at(bits(operand(instruction, 0).integer)) = operand(instruction, 1);
      return Flow::Next;
    case Op::Call:
      return call(id, instruction);
    case Op::If:
      return block(instruction.blocks[operand(instruction, 0).boolean ? 0 : 1]);
    case Op::Loop:
      while (true) {
        const Flow flow = block(instruction.blocks[0]);
        if (flow == Flow::Break && target_ == instruction.index) return Flow::Next;
        if (flow != Flow::Next) return flow;
      }
    case Op::Scope: {
      const Flow flow = block(instruction.blocks[0]);
      return flow == Flow::Break && target_ == instruction.index ? Flow::Next : flow;
    }
    case Op::Break:
      target_ = instruction.index;
      return Flow::Break;
    case Op::Return:
      for (size_t i = 0; i < instruction.operands.size(); ++i)
        results_.push_back(operand(instruction, i));
      return Flow::Return;
    case Op::Fault:
      return operand(instruction, 0).boolean ? fault(instruction.fault, instruction.text) : Flow::Next;
    case Op::Step:
      return ++outcome_.steps > module_.step_limit ? fault(FaultCode::StepLimit, "") : Flow::Next;
    case Op::Print:
      return Flow::Next;
    case Op::CallLibrary: {
      std::vector<Value> operands;
      operands.reserve(instruction.operands.size());
      for (size_t i = 0; i < instruction.operands.size(); ++i)
        operands.push_back(operand(instruction, i));
      values_[id] = call_native(*instruction.library, instruction.type, operands);
      return Flow::Next;
    }
    default:
      values_[id] = {value(instruction)};
      return Flow::Next;
    }
  }

  Flow call(ValueId id, const Instruction& instruction) {
    std::vector<Value> arguments;
    arguments.reserve(instruction.operands.size());
    for (size_t i = 0; i < instruction.operands.size(); ++i)
      arguments.push_back(operand(instruction, i));
    std::vector<std::vector<Value>*> captures;
    captures.reserve(instruction.variables.size());
    for (const VariableId variable : instruction.variables)
      captures.push_back(variables_[variable]);
    Activation callee(module_, module_.functions[instruction.index], globals_, outcome_, arguments, captures);
    const Flow flow = callee.run();
    values_[id] = callee.results();
    return flow == Flow::Fault ? flow : Flow::Next;
  }

  Value value(const Instruction& instruction) const {
    switch (instruction.op) {
    case Op::Argument:
      return arguments_[instruction.index];
    case Op::LoadGlobal:
      return globals_[instruction.index][0];
    case Op::LoadGlobalElement:
      return globals_[instruction.index].at(bits(operand(instruction, 0).integer));
    case Op::Load:
      return (*variables_[instruction.index])[0];
    case Op::LoadElement:
      return variables_[instruction.index]->at(bits(operand(instruction, 0).integer));
    case Op::Result:
      return values_[instruction.operands[0]][instruction.index];
    default:
      break;
    }
    std::vector<Value> operands;
    operands.reserve(instruction.operands.size());
    for (size_t i = 0; i < instruction.operands.size(); ++i)
      operands.push_back(operand(instruction, i));
    return evaluate(instruction, operands);
  }

  const Module& module_;
  const Function& function_;
  std::vector<std::vector<Value>>& globals_;
  Outcome& outcome_;
  const std::vector<Value>& arguments_;
  std::vector<std::vector<Value>> values_; ///< of calls: all results
  std::vector<std::vector<Value>> own_;
  std::vector<std::vector<Value>*> variables_;
  std::vector<Value> results_;
  LabelId target_ = kNone;
};

std::string to_text(double value) {
  if (std::isnan(value)) return "nan";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

} // namespace

Value Value::of(double value) {
  Value result;
  result.numbers[0] = value;
  return result;
}

Value Value::of(ValueType vector, std::initializer_list<double> numbers) {
  Value result;
  result.type = vector;
  std::copy(numbers.begin(), numbers.end(), result.numbers.begin());
  return result;
}

std::string to_text(const Value& value) {
  if (value.type == ValueType::Boolean) return value.boolean ? "true" : "false";
  if (value.type == ValueType::Integer) return std::to_string(value.integer);
  std::string text;
  for (unsigned i = 0; i < component_count(value.type); ++i)
    text += (i == 0 ? "" : ", ") + to_text(value.numbers[i]);
  return text;
}

std::string to_text(const Outcome& outcome) {
  if (outcome.fault != FaultCode::None) return std::string("fault: ") + fault_name(outcome.fault);
  std::string text;
  for (const Value& value : outcome.results)
    text += (text.empty() ? "" : " ") + to_text(value);
  return text;
}

Interpreter::Interpreter(const Module& module, const std::vector<Value>& parameters) : module_(module) {
  for (const Global& global : module.globals) {
    globals_.emplace_back(global.count);
    if (global.parameter != kNone && global.parameter < parameters.size())
      globals_.back() = {parameters[global.parameter]};
    const size_t components = component_count(global.type);
    for (size_t i = 0; i < global.integers.size(); ++i)
      globals_.back()[i].integer = global.integers[i];
    for (size_t i = 0; i < global.numbers.size(); ++i)
      globals_.back()[i / components].numbers[i % components] = global.numbers[i];
  }
  init_ = call(module.init, {});
}

Outcome Interpreter::run(const std::string& entry, const std::vector<Value>& arguments) const {
  for (const Entry& candidate : module_.entries)
    if (candidate.name == entry) return Interpreter(*this).call(candidate.function, arguments);
  return {.results = {}, .fault = FaultCode::Error, .message = "no entry " + entry};
}

Outcome Interpreter::call(FunctionId function, const std::vector<Value>& arguments) {
  Outcome outcome;
  Activation activation(module_, module_.functions[function], globals_, outcome, arguments, {});
  activation.run();
  outcome.results = activation.results();
  return outcome;
}

} // namespace moonshade::ir::test
