// The builder. See builder.h.
#include "compiler/ir/builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace moonshade::ir {
namespace {

Instruction make(Op op, ValueType type = ValueType::Boolean, std::vector<ValueId> operands = {}) {
  Instruction instruction{};
  instruction.op = op;
  instruction.type = type;
  instruction.operands = std::move(operands);
  return instruction;
}

Instruction make_indexed(Op op, ValueType type, uint32_t index, std::vector<ValueId> operands = {}) {
  Instruction instruction = make(op, type, std::move(operands));
  instruction.index = index;
  return instruction;
}

} // namespace

bool has_break_to(const Function& function, const Block& block, LabelId label) {
  return std::ranges::any_of(block.instructions, [&](ValueId id) {
    const Instruction& instruction = function.instructions[id];
    if (instruction.op == Op::Break) return instruction.index == label;
    return std::ranges::any_of(instruction.blocks,
                               [&](const Block& inner) { return has_break_to(function, inner, label); });
  });
}

bool falls_through(const Function& function, const Block& block) {
  return block.instructions.empty() || falls_through(function, function.instructions[block.instructions.back()]);
}

bool falls_through(const Function& function, const Instruction& last) {
  switch (last.op) {
  case Op::Return:
  case Op::Break:
    return false;
  case Op::If:
    return falls_through(function, last.blocks[0]) || falls_through(function, last.blocks[1]);
  case Op::Loop:
    return has_break_to(function, last.blocks[0], last.index);
  case Op::Scope:
    return falls_through(function, last.blocks[0]) || has_break_to(function, last.blocks[0], last.index);
  default:
    return true;
  }
}

Builder::Builder(Function& function) : function_(function) { open_.push_back(std::move(function.body)); }

Builder::~Builder() {
  assert(open_.size() == 1);
  function_.body = std::move(open_.front());
}

VariableId Builder::variable(std::string name, ValueType type, uint32_t count) {
  function_.variables.push_back({std::move(name), type, count});
  return static_cast<VariableId>(function_.variables.size() - 1);
}

ValueId Builder::append(Instruction instruction) {
  if (!instruction.span.has_place()) instruction.span = span_;
  function_.instructions.push_back(std::move(instruction));
  const auto id = static_cast<ValueId>(function_.instructions.size() - 1);
  current().instructions.push_back(id);
  return id;
}

bool Builder::terminated() const { return !falls_through(function_, open_.back()); }

ValueId Builder::boolean(bool value) {
  Instruction instruction = make(Op::ConstBoolean);
  instruction.integer = value;
  return append(std::move(instruction));
}

ValueId Builder::integer(int64_t value) {
  Instruction instruction = make(Op::ConstInteger, ValueType::Integer);
  instruction.integer = value;
  return append(std::move(instruction));
}

ValueId Builder::number(double value) {
  Instruction instruction = make(Op::ConstNumber, ValueType::Number);
  instruction.number = value;
  return append(std::move(instruction));
}

ValueId Builder::zero(ValueType type) {
  switch (type) {
  case ValueType::Boolean:
    return boolean(false);
  case ValueType::Integer:
    return integer(0);
  case ValueType::Number:
    return number(0);
  default:
    return construct(type, std::vector<ValueId>(component_count(type), number(0)));
  }
}

ValueId Builder::argument(uint32_t index) {
  return append(make_indexed(Op::Argument, function_.parameters[index], index));
}

ValueId Builder::load(VariableId variable) {
  return append(make_indexed(Op::Load, function_.variables[variable].type, variable));
}

void Builder::store(VariableId variable, ValueId value) {
  append(make_indexed(Op::Store, ValueType::Boolean, variable, {value}));
}

ValueId Builder::load_element(VariableId variable, ValueId index) {
  return append(make_indexed(Op::LoadElement, function_.variables[variable].type, variable, {index}));
}

void Builder::store_element(VariableId variable, ValueId index, ValueId value) {
  append(make_indexed(Op::StoreElement, ValueType::Boolean, variable, {index, value}));
}

ValueId Builder::load_global_element(GlobalId global, ValueType type, ValueId index) {
  return append(make_indexed(Op::LoadGlobalElement, type, global, {index}));
}

void Builder::store_global_element(GlobalId global, ValueId index, ValueId value) {
  append(make_indexed(Op::StoreGlobalElement, ValueType::Boolean, global, {index, value}));
}

ValueId Builder::load_global(GlobalId global, ValueType type) {
  return append(make_indexed(Op::LoadGlobal, type, global));
}

void Builder::store_global(GlobalId global, ValueId value) {
  append(make_indexed(Op::StoreGlobal, ValueType::Boolean, global, {value}));
}

ValueId Builder::unary(Op op, ValueId a) { return append(make(op, type_of(a), {a})); }
ValueId Builder::binary(Op op, ValueId a, ValueId b) { return append(make(op, type_of(a), {a, b})); }
ValueId Builder::fma(ValueId a, ValueId b, ValueId c) { return append(make(Op::Fma, type_of(a), {a, b, c})); }
ValueId Builder::compare(Op op, ValueId a, ValueId b) { return append(make(op, ValueType::Boolean, {a, b})); }

ValueId Builder::select(ValueId condition, ValueId a, ValueId b) {
  return append(make(Op::Select, type_of(a), {condition, a, b}));
}

ValueId Builder::construct(ValueType type, std::vector<ValueId> numbers) {
  return append(make(Op::Construct, type, std::move(numbers)));
}

ValueId Builder::component(ValueId vector, uint32_t index) {
  return append(make_indexed(Op::Component, ValueType::Number, index, {vector}));
}

ValueId Builder::convert(ValueId value, ValueType type) {
  const ValueType from = type_of(value);
  if (from == type) return value;
  if (from == ValueType::Integer) {
    // A constant that double holds exactly is rounded once either way.
    const Instruction& instruction = at(value);
    constexpr int64_t kExact = int64_t{1} << 53;
    if (instruction.op == Op::ConstInteger && instruction.integer >= -kExact && instruction.integer <= kExact)
      value = number(static_cast<double>(instruction.integer));
    else
      value = append(make(Op::IntegerToNumber, ValueType::Number, {value}));
  }
  return type == ValueType::Number ? value : construct(type, {value});
}

ValueId Builder::call_library(const LibraryFunction& row, ValueType type, std::vector<ValueId> operands) {
  Instruction instruction = make(Op::CallLibrary, type, std::move(operands));
  instruction.library = &row;
  return append(std::move(instruction));
}

ValueId Builder::call(FunctionId callee, std::span<const ValueType> results, std::vector<ValueId> arguments,
                      std::vector<VariableId> captures) {
  Instruction instruction =
      make_indexed(Op::Call, results.empty() ? ValueType::Boolean : results[0], callee, std::move(arguments));
  instruction.variables = std::move(captures);
  return append(std::move(instruction));
}

ValueId Builder::result(ValueId call, uint32_t index, ValueType type) {
  return index == 0 ? call : append(make_indexed(Op::Result, type, index, {call}));
}

void Builder::fault(ValueId condition, FaultCode code, std::string message) {
  Instruction instruction = make(Op::Fault, ValueType::Boolean, {condition});
  instruction.fault = code;
  instruction.text = std::move(message);
  append(std::move(instruction));
}

void Builder::step() { append(make(Op::Step)); }
void Builder::return_values(std::vector<ValueId> values) {
  append(make(Op::Return, ValueType::Boolean, std::move(values)));
}
void Builder::break_to(LabelId label) { append(make_indexed(Op::Break, ValueType::Boolean, label)); }

ValueId Builder::if_else(ValueId condition, Block then_block, Block else_block) {
  Instruction instruction = make(Op::If, ValueType::Boolean, {condition});
  instruction.blocks.push_back(std::move(then_block));
  instruction.blocks.push_back(std::move(else_block));
  return append(std::move(instruction));
}

ValueId Builder::loop(LabelId label, Block body) {
  Instruction instruction = make_indexed(Op::Loop, ValueType::Boolean, label);
  instruction.blocks.push_back(std::move(body));
  return append(std::move(instruction));
}

ValueId Builder::scope(LabelId label, Block body) {
  Instruction instruction = make_indexed(Op::Scope, ValueType::Boolean, label);
  instruction.blocks.push_back(std::move(body));
  return append(std::move(instruction));
}

} // namespace moonshade::ir
