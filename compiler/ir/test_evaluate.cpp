// For tests: what single instructions compute, by the letter of ir.h. See test_interpreter.h.
#include "compiler/ir/test_interpreter.h"

#include <cmath>
#include <cstdlib>

namespace moonshade::ir::test {
namespace {

using Operands = std::vector<Value>;

uint64_t bits(int64_t value) { return static_cast<uint64_t>(value); }

bool compare(const Instruction& instruction, const Operands& operands) {
  const Value &a = operands[0], &b = operands[1];
  const bool less = instruction.op == Op::Lt, equality = instruction.op == Op::Eq || instruction.op == Op::Ne;
  bool result = true;
  if (equality) {
    if (a.type == ValueType::Boolean)
      result = a.boolean == b.boolean;
    else if (a.type == ValueType::Integer)
      result = a.integer == b.integer;
    else
      for (unsigned i = 0; i < component_count(a.type); ++i)
        result = result && a.numbers[i] == b.numbers[i];
    return (instruction.op == Op::Eq) == result;
  }
  if (a.type == ValueType::Integer) return less ? a.integer < b.integer : a.integer <= b.integer;
  return less ? a.numbers[0] < b.numbers[0] : a.numbers[0] <= b.numbers[0];
}

bool booleans(const Instruction& instruction, const Operands& operands) {
  const bool a = operands[0].boolean;
  const bool b = instruction.operands.size() > 1 && operands[1].boolean;
  switch (instruction.op) {
  case Op::And:
    return a && b;
  case Op::Or:
    return a || b;
  case Op::Xor:
    return a != b;
  case Op::Not:
    return !a;
  default:
    std::abort();
  }
}

uint64_t integers(const Instruction& instruction, const Operands& operands) {
  const uint64_t a = bits(operands[0].integer);
  const uint64_t b = instruction.operands.size() > 1 ? bits(operands[1].integer) : 0;
  switch (instruction.op) {
  case Op::Add:
    return a + b;
  case Op::Sub:
    return a - b;
  case Op::Mul:
    return a * b;
  case Op::Neg:
    return 0 - a;
  case Op::And:
    return a & b;
  case Op::Or:
    return a | b;
  case Op::Xor:
    return a ^ b;
  case Op::Not:
    return ~a;
  default:
    std::abort();
  }
}

double numbers(const Instruction& instruction, const Operands& operands, unsigned i) {
  const double a = operands[0].numbers[i];
  const double b = instruction.operands.size() > 1 ? operands[1].numbers[i] : 0;
  switch (instruction.op) {
  case Op::Add:
    return a + b;
  case Op::Sub:
    return a - b;
  case Op::Mul:
    return a * b;
  case Op::Div:
    return a / b;
  case Op::Neg:
    return -a;
  case Op::Fma:
    return std::fma(a, b, operands[2].numbers[i]);
  default:
    std::abort();
  }
}

} // namespace

Value evaluate(const Instruction& instruction, const Operands& operands) {
  Value result;
  result.type = instruction.type;
  switch (instruction.op) {
  case Op::ConstBoolean:
    return Value::of(instruction.integer != 0);
  case Op::ConstInteger:
    return Value::of(instruction.integer);
  case Op::ConstNumber:
    return Value::of(instruction.number);
  case Op::Select:
    return operands[operands[0].boolean ? 1 : 2];
  case Op::Component:
    return Value::of(operands[0].numbers[instruction.index]);
  case Op::IntegerToNumber:
    return Value::of(static_cast<double>(operands[0].integer));
  case Op::Construct:
    for (unsigned i = 0; i < component_count(instruction.type); ++i)
      result.numbers[i] = operands[instruction.operands.size() == 1 ? 0 : i].numbers[0];
    return result;
  case Op::Eq:
  case Op::Ne:
  case Op::Lt:
  case Op::Le:
    return Value::of(compare(instruction, operands));
  default:
    break;
  }
  if (instruction.type == ValueType::Boolean) {
    result.boolean = booleans(instruction, operands);
  } else if (instruction.type == ValueType::Integer) {
    result.integer = static_cast<int64_t>(integers(instruction, operands));
  } else {
    for (unsigned i = 0; i < component_count(instruction.type); ++i)
      result.numbers[i] = numbers(instruction, operands, i);
  }
  return result;
}

} // namespace moonshade::ir::test
