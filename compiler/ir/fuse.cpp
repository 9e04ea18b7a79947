// fuse, for f32: a product that is added to or subtracted from once becomes part of an fma. The rules are fixed, and
// the pass runs at every level of optimisation, before a width is chosen, so that the bits are the same everywhere:
//
//   x + y    where x is a product a*b used nowhere else:      fma(a, b, y)
//            where y is a product a*b used nowhere else:      fma(a, b, x)
//   x - y    where x is a product a*b used nowhere else:      fma(a, b, -y)
//            where y is a product a*b used nowhere else:      fma(-a, b, x)      (exact: a*b is not rounded)
//            Where both are, x, unless y has to wait longer for its factors: it then waits for one operation less.
//   mix(a, b, t) of constants, where a + (b - a) rounds to b: fma(t, b - a, a)   (b at t = 1, as mix promises)
//
// for numbers and vectors, in order of execution. Only `mul` counts as a product, not what the library computes.
#include "compiler/ir/passes.h"
#include "compiler/ir/waits.h"
#include "compiler/ir/walk.h"

#include <algorithm>
#include <cmath>

namespace moonshade::ir {
namespace {

/// The constants that a value consists of; empty where it is no constant.
std::vector<float> constants_of(const Function& function, ValueId id) {
  const Instruction& value = function.instructions[id];
  if (value.op == Op::ConstNumber) return {static_cast<float>(value.number)};
  if (value.op != Op::Construct) return {};
  std::vector<float> constants;
  for (const ValueId operand : value.operands) {
    if (function.instructions[operand].op != Op::ConstNumber) return {};
    constants.push_back(static_cast<float>(function.instructions[operand].number));
  }
  return constants;
}

/// What has to be added to `from` to come to `to`, by component, as floats; empty where that does not lead there.
std::vector<float> differences(const std::vector<float>& from, const std::vector<float>& to) {
  if (from.empty() || to.empty()) return {};
  std::vector<float> result(std::max(from.size(), to.size()));
  for (size_t c = 0; c < result.size(); ++c) {
    const float a = from[from.size() == 1 ? 0 : c], b = to[to.size() == 1 ? 0 : c];
    result[c] = b - a;
    if (!std::isfinite(result[c]) || a + result[c] != b) return {};
  }
  return result;
}

class Fusing {
public:
  explicit Fusing(Function& function) : function_(function), uses_(count_uses(function)), waits_(function) {
    // What is printed is no use: the numbers are to be those of code without prints.
    for_each_instruction(function, [&](ValueId id) {
      if (function.instructions[id].op != Op::Print) return;
      for (const ValueId operand : function.instructions[id].operands)
        --uses_[operand];
    });
  }

  void run() {
    rewrite_blocks(function_, [&](ValueId id, std::vector<ValueId>& result) {
      const Instruction& instruction = function_.instructions[id]; // moved away by what is appended
      const bool is_sum = instruction.op == Op::Add || instruction.op == Op::Sub;
      if (is_sum && (instruction.type == ValueType::Number || is_vector(instruction.type))) {
        fuse_sum(id, result);
      } else if (instruction.op == Op::CallLibrary && instruction.library->name == "mix") {
        fuse_mix(id, result);
      }
      result.push_back(id);
      return true;
    });
  }

private:
  bool is_product(ValueId id) const { return function_.instructions[id].op == Op::Mul && uses_[id] == 1; }

  /// In the place and at the line of `at`.
  ValueId append(Op op, ValueType type, std::vector<ValueId> operands, ValueId at, std::vector<ValueId>& result,
                 double number = 0) {
    Instruction instruction{};
    instruction.op = op;
    instruction.type = type;
    instruction.operands = std::move(operands);
    instruction.number = number;
    instruction.span = function_.instructions[at].span;
    return ir::append(function_, result, std::move(instruction));
  }

  void become_fma(ValueId id, std::vector<ValueId> operands) {
    Instruction& instruction = function_.instructions[id];
    instruction.op = Op::Fma;
    instruction.library = nullptr;
    instruction.operands = std::move(operands);
  }

  void fuse_sum(ValueId id, std::vector<ValueId>& result) {
    const bool is_difference = function_.instructions[id].op == Op::Sub;
    const ValueId x = function_.instructions[id].operands[0], y = function_.instructions[id].operands[1];
    const bool left = is_product(x) && !(is_product(y) && waits_(y) > waits_(x));
    if (!left && !is_product(y)) return;
    std::vector<ValueId> operands = function_.instructions[left ? x : y].operands;
    ValueId addend = left ? y : x;
    if (is_difference) {
      ValueId& negated = left ? addend : operands[0];
      negated = append(Op::Neg, function_.instructions[negated].type, {negated}, id, result);
    }
    operands.push_back(addend);
    become_fma(id, std::move(operands));
  }

  void fuse_mix(ValueId id, std::vector<ValueId>& result) {
    const std::vector<ValueId> operands = function_.instructions[id].operands;
    const ValueType type = function_.instructions[id].type;
    const std::vector<float> way =
        differences(constants_of(function_, operands[0]), constants_of(function_, operands[1]));
    if (way.empty()) return;
    std::vector<ValueId> parts;
    for (const float part : way)
      parts.push_back(append(Op::ConstNumber, ValueType::Number, {}, id, result, part));
    // A number beside vectors counts for each component.
    const auto widened = [&](std::vector<ValueId> values) {
      const bool fits = values.size() == 1 && function_.instructions[values[0]].type == type;
      return fits ? values[0] : append(Op::Construct, type, std::move(values), id, result);
    };
    const ValueId t = widened({operands[2]}), b = widened(std::move(parts)), a = widened({operands[0]});
    become_fma(id, {t, b, a});
  }

  Function& function_;
  std::vector<uint32_t> uses_; ///< of what the function had at the beginning
  Waits waits_;
};

} // namespace

void fuse(Module& module) {
  for (Function& function : module.functions) {
    Fusing(function).run();
    remove_dead_code(function);
  }
}

} // namespace moonshade::ir
