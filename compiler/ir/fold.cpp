// fold_constants: operations on constants, and what constants decide. Numbers are folded only where the fold gives the
// same in float and in double, since the precision is chosen later: const.n holds a double that is rounded to the
// domain's number, so (float)(a op b) must be (float)a op (float)b, bit for bit. Nothing that gives a NaN is folded.
#include "compiler/ir/builder.h"
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace moonshade::ir {
namespace {

template <class T> std::optional<T> arithmetic(Op op, T a, T b) {
  switch (op) {
  case Op::Add:
    return a + b;
  case Op::Sub:
    return a - b;
  case Op::Mul:
    return a * b;
  case Op::Div:
    return a / b;
  default:
    return {};
  }
}

std::optional<double> fold_numbers(Op op, double a, double b) {
  const std::optional<double> wide = arithmetic<double>(op, a, b);
  const std::optional<float> narrow = arithmetic<float>(op, static_cast<float>(a), static_cast<float>(b));
  if (!wide || !narrow || std::isnan(*wide)) return {};
  if (std::bit_cast<uint32_t>(*narrow) != std::bit_cast<uint32_t>(static_cast<float>(*wide))) return {};
  return wide;
}

template <class T> std::optional<bool> compare(Op op, T a, T b) {
  switch (op) {
  case Op::Eq:
    return a == b;
  case Op::Ne:
    return a != b;
  case Op::Lt:
    return a < b;
  case Op::Le:
    return a <= b;
  default:
    return {};
  }
}

std::optional<int64_t> fold_integers(Op op, uint64_t a, uint64_t b) {
  switch (op) {
  case Op::Add:
    return static_cast<int64_t>(a + b);
  case Op::Sub:
    return static_cast<int64_t>(a - b);
  case Op::Mul:
    return static_cast<int64_t>(a * b);
  case Op::And:
    return static_cast<int64_t>(a & b);
  case Op::Or:
    return static_cast<int64_t>(a | b);
  case Op::Xor:
    return static_cast<int64_t>(a ^ b);
  default:
    return {};
  }
}

class Folding {
public:
  explicit Folding(Function& function) : function_(function), replacements_(function.instructions.size()) {}

  void run() {
    Block body = std::move(function_.body);
    walk(body);
    function_.body = std::move(body);
  }

private:
  void walk(Block& block) {
    std::vector<ValueId> result;
    result.reserve(block.instructions.size());
    bool reachable = true;
    for (size_t i = 0; i < block.instructions.size() && reachable; ++i)
      reachable = visit(block.instructions[i], result);
    block.instructions = std::move(result);
  }

  bool visit(ValueId id, std::vector<ValueId>& result) {
    replacements_.apply(at(id));
    switch (at(id).op) {
    case Op::If:
      if (const std::optional<bool> known = boolean(at(id).operands[0])) {
        Block taken = std::move(at(id).blocks[*known ? 0 : 1]);
        walk(taken);
        result.insert(result.end(), taken.instructions.begin(), taken.instructions.end());
        return falls_through(function_, taken);
      }
      break;
    case Op::Fault:
      if (boolean(at(id).operands[0]) == false) return true;
      break;
    default:
      if (info(at(id).op).shape == OpShape::Value) {
        if (at(id).op == Op::CallLibrary) compare_with_number(id, result);
        if (const ValueId same = equal_value(id); same != kNone) {
          replacements_.replace(id, same);
          return true;
        }
        fold_in_place(at(id));
      }
      break;
    }
    for (Block& inner : at(id).blocks)
      walk(inner);
    result.push_back(id);
    return falls_through(function_, at(id));
  }

  /// op.lt, op.le and op.eq compare an integer with a number exactly. A constant that float holds too is as exact as a
  /// number, and a plain comparison costs a fraction.
  void compare_with_number(ValueId id, std::vector<ValueId>& result) {
    const std::string_view name = at(id).library->name;
    if (name != "op.lt" && name != "op.le" && name != "op.eq") return;
    constexpr int64_t kExact = int64_t{1} << 24;
    for (const size_t i : {0u, 1u}) {
      const std::optional<int64_t> value = integer(at(id).operands[i]);
      if (!value || *value < -kExact || *value > kExact) continue;
      Instruction constant{};
      make_number(constant, static_cast<double>(*value));
      constant.span = at(id).span;
      function_.instructions.push_back(std::move(constant)); // moves the others
      result.push_back(static_cast<ValueId>(function_.instructions.size() - 1));
      Instruction& comparison = at(id);
      comparison.op = name == "op.lt" ? Op::Lt : name == "op.le" ? Op::Le : Op::Eq;
      comparison.library = nullptr;
      comparison.operands[i] = result.back();
      return;
    }
  }

  Instruction& at(ValueId id) { return function_.instructions[id]; }
  const Instruction& operand(const Instruction& instruction, size_t i) const {
    return function_.instructions[instruction.operands[i]];
  }

  std::optional<bool> boolean(ValueId id) const {
    const Instruction& instruction = function_.instructions[id];
    if (instruction.op != Op::ConstBoolean) return {};
    return instruction.integer != 0;
  }
  std::optional<int64_t> integer(ValueId id) const {
    const Instruction& instruction = function_.instructions[id];
    if (instruction.op != Op::ConstInteger) return {};
    return instruction.integer;
  }
  bool is_number(ValueId id, double value) const {
    const Instruction& instruction = function_.instructions[id];
    return instruction.op == Op::ConstNumber && instruction.number == value;
  }

  /// An earlier value that this one always equals, or kNone.
  ValueId equal_value(ValueId id) const {
    const Instruction& instruction = function_.instructions[id];
    const auto& operands = instruction.operands;
    switch (instruction.op) {
    case Op::Select:
      if (const auto known = boolean(operands[0])) return operands[*known ? 1 : 2];
      if (operands[1] == operands[2]) return operands[1];
      if (boolean(operands[1]) == true && boolean(operands[2]) == false) return operands[0];
      return kNone;
    case Op::And:
    case Op::Or: {
      if (operands[0] == operands[1]) return operands[0];
      if (instruction.type != ValueType::Boolean) return kNone;
      for (const size_t i : {0u, 1u})
        if (const auto known = boolean(operands[i])) {
          const bool passes = *known == (instruction.op == Op::And);
          return passes ? operands[1 - i] : operands[i];
        }
      return kNone;
    }
    case Op::Xor:
      for (const size_t i : {0u, 1u})
        if (boolean(operands[i]) == false) return operands[1 - i];
      return kNone;
    case Op::Not:
      return operand(instruction, 0).op == Op::Not ? operand(instruction, 0).operands[0] : kNone;
    case Op::Component: {
      const Instruction& vector = operand(instruction, 0);
      if (vector.op != Op::Construct) return kNone;
      return vector.operands.size() == 1 ? vector.operands[0] : vector.operands[instruction.index];
    }
    case Op::Add:
    case Op::Sub:
      return integer(operands[1]) == 0 ? operands[0] : kNone;
    case Op::Mul: // by one is exact for all numbers, zeros and infinities included
      if (integer(operands[1]) == 1 || is_number(operands[1], 1)) return operands[0];
      return integer(operands[0]) == 1 || is_number(operands[0], 1) ? operands[1] : kNone;
    case Op::Div:
      return is_number(operands[1], 1) ? operands[0] : kNone;
    default:
      return kNone;
    }
  }

  static void make_boolean(Instruction& instruction, bool value) {
    instruction.op = Op::ConstBoolean;
    instruction.type = ValueType::Boolean;
    instruction.integer = value;
    instruction.operands.clear();
  }
  static void make_integer(Instruction& instruction, int64_t value) {
    instruction.op = Op::ConstInteger;
    instruction.type = ValueType::Integer;
    instruction.integer = value;
    instruction.operands.clear();
  }
  static void make_number(Instruction& instruction, double value) {
    instruction.op = Op::ConstNumber;
    instruction.type = ValueType::Number;
    instruction.number = value;
    instruction.operands.clear();
  }

  void fold_in_place(Instruction& instruction) const {
    if (instruction.operands.size() == 1) return fold_unary(instruction);
    if (instruction.op == Op::Select && instruction.type == ValueType::Boolean) return fold_select(instruction);
    if (instruction.operands.size() != 2) return;
    const Instruction& a = operand(instruction, 0);
    const Instruction& b = operand(instruction, 1);
    if (a.op == Op::ConstInteger && b.op == Op::ConstInteger) {
      if (const auto value =
              fold_integers(instruction.op, static_cast<uint64_t>(a.integer), static_cast<uint64_t>(b.integer)))
        return make_integer(instruction, *value);
      if (const auto value = compare(instruction.op, a.integer, b.integer)) return make_boolean(instruction, *value);
    }
    if (a.op == Op::ConstBoolean && b.op == Op::ConstBoolean) {
      if (instruction.op == Op::Eq) return make_boolean(instruction, a.integer == b.integer);
      if (instruction.op == Op::Ne || instruction.op == Op::Xor)
        return make_boolean(instruction, a.integer != b.integer);
    }
    if (instruction.op == Op::Xor && instruction.type == ValueType::Boolean &&
        (a.op == Op::ConstBoolean || b.op == Op::ConstBoolean)) {
      // With false it was the other operand; with true it is its negation.
      const ValueId other = instruction.operands[a.op == Op::ConstBoolean ? 1 : 0];
      instruction.op = Op::Not;
      instruction.operands = {other};
      return;
    }
    if (a.op == Op::ConstNumber && b.op == Op::ConstNumber) {
      if (const auto value = fold_numbers(instruction.op, a.number, b.number)) return make_number(instruction, *value);
      const auto wide = compare(instruction.op, a.number, b.number);
      const auto narrow = compare(instruction.op, static_cast<float>(a.number), static_cast<float>(b.number));
      if (wide && wide == narrow) return make_boolean(instruction, *wide);
    }
  }

  /// What `and` and `or` become where both sides are evaluated.
  void fold_select(Instruction& instruction) const {
    const ValueId c = instruction.operands[0], a = instruction.operands[1], b = instruction.operands[2];
    if (b == c || boolean(b) == false) {
      instruction.op = Op::And;
      instruction.operands = {c, a};
    } else if (a == c || boolean(a) == true) {
      instruction.op = Op::Or;
      instruction.operands = {c, b};
    }
  }

  void fold_unary(Instruction& instruction) const {
    const Instruction& a = operand(instruction, 0);
    switch (instruction.op) {
    case Op::Neg:
      if (a.op == Op::ConstInteger)
        make_integer(instruction, static_cast<int64_t>(0 - static_cast<uint64_t>(a.integer)));
      else if (a.op == Op::ConstNumber && !std::isnan(a.number))
        make_number(instruction, -a.number);
      return;
    case Op::IntegerToNumber: {
      constexpr int64_t kExact = int64_t{1} << 53; // double holds it, so it is rounded once either way
      if (a.op == Op::ConstInteger && a.integer >= -kExact && a.integer <= kExact)
        make_number(instruction, static_cast<double>(a.integer));
      return;
    }
    case Op::Not:
      return fold_not(instruction, a);
    default:
      return;
    }
  }

  void fold_not(Instruction& instruction, const Instruction& a) const {
    if (a.op == Op::ConstBoolean) return make_boolean(instruction, a.integer == 0);
    if (a.op == Op::ConstInteger) return make_integer(instruction, ~a.integer);
    const bool of_integers = !a.operands.empty() && function_.instructions[a.operands[0]].type == ValueType::Integer;
    switch (a.op) {
    case Op::Eq:
    case Op::Ne:
      instruction.op = a.op == Op::Eq ? Op::Ne : Op::Eq;
      instruction.operands = std::vector<ValueId>(a.operands);
      return;
    case Op::Lt:
    case Op::Le: // not so for numbers: both ways are false for NaN
      if (!of_integers) return;
      instruction.op = a.op == Op::Lt ? Op::Le : Op::Lt;
      instruction.operands = {a.operands[1], a.operands[0]};
      return;
    default:
      return;
    }
  }

  Function& function_;
  Replacements replacements_;
};

} // namespace

void fold_constants(Function& function) { Folding(function).run(); }

} // namespace moonshade::ir
