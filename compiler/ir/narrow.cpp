// narrow_variables: how far each variable can get from 0, as the sum over its stores (narrow.h).
#include "compiler/ir/narrow.h"

#include "compiler/ir/walk.h"

#include <algorithm>
#include <optional>

namespace moonshade::ir {
namespace {

constexpr uint64_t kGreatest = INT32_MAX;
constexpr int kMaxDepth = 8;

/// How far a stored value can be from 0, or from what the variable was.
struct Reach {
  uint64_t from_zero = 0, from_itself = 0;
};

std::optional<uint64_t> small_constant(const Function& function, ValueId id) {
  const Instruction& instruction = function.instructions[id];
  if (instruction.op != Op::ConstInteger) return std::nullopt;
  const auto magnitude = instruction.integer < 0 ? 0 - static_cast<uint64_t>(instruction.integer)
                                                 : static_cast<uint64_t>(instruction.integer);
  return magnitude <= kGreatest ? std::optional(magnitude) : std::nullopt;
}

std::optional<Reach> reach(const Function& function, ValueId id, VariableId variable, int depth = 0) {
  const Instruction& instruction = function.instructions[id];
  if (depth > kMaxDepth) return std::nullopt;
  switch (instruction.op) {
  case Op::ConstInteger:
    if (const auto constant = small_constant(function, id)) return Reach{*constant, 0};
    return std::nullopt;
  case Op::Load:
    return instruction.index == variable ? std::optional(Reach{}) : std::nullopt;
  case Op::Add:
  case Op::Sub:
    for (const size_t side : {size_t{0}, size_t{1}}) {
      if (instruction.op == Op::Sub && side == 1) break; // a constant less the variable
      const auto constant = small_constant(function, instruction.operands[1 - side]);
      if (!constant) continue;
      auto other = reach(function, instruction.operands[side], variable, depth + 1);
      if (!other) return std::nullopt;
      return Reach{other->from_zero + *constant, other->from_itself + *constant};
    }
    return std::nullopt;
  case Op::Select: {
    const auto a = reach(function, instruction.operands[1], variable, depth + 1);
    const auto b = reach(function, instruction.operands[2], variable, depth + 1);
    if (!a || !b) return std::nullopt;
    return Reach{std::max(a->from_zero, b->from_zero), std::max(a->from_itself, b->from_itself)};
  }
  default:
    return std::nullopt;
  }
}

} // namespace

std::vector<bool> narrow_variables(const Function& function, uint64_t step_limit) {
  const size_t count = function.variables.size();
  std::vector<bool> narrow(count);
  std::vector<uint64_t> furthest(count), change(count);
  for (VariableId i = function.captures; i < count; ++i)
    narrow[i] = function.variables[i].type == ValueType::Integer && function.variables[i].count == 1;
  for_each_instruction(function, [&](ValueId id) {
    const Instruction& instruction = function.instructions[id];
    for (const VariableId variable : instruction.variables) // to a function that does not know
      narrow[variable] = false;
    if (instruction.op != Op::Store || !narrow[instruction.index]) return;
    const auto found = reach(function, instruction.operands[0], instruction.index);
    narrow[instruction.index] = found.has_value();
    if (!found) return;
    furthest[instruction.index] = std::max(furthest[instruction.index], found->from_zero);
    change[instruction.index] = std::min(change[instruction.index] + found->from_itself, kGreatest);
  });
  const uint64_t steps = std::min(step_limit, kGreatest) + 1;
  for (VariableId i = 0; i < count; ++i)
    narrow[i] = narrow[i] && furthest[i] + change[i] * steps <= kGreatest;
  return narrow;
}

} // namespace moonshade::ir
