// narrow_variables: how far each variable can get from 0, as the sum over its stores (narrow.h). A store of what
// another variable held counts with how far that one can get, where this is known by itself.
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

class Reaches {
public:
  Reaches(const Function& function, uint64_t step_limit)
      : function_(function), steps_(std::min(step_limit, kGreatest) + 1), stores_(function.variables.size()),
        bounds_(function.variables.size()) {
    for (VariableId i = 0; i < bounds_.size(); ++i) {
      const Variable& variable = function.variables[i];
      const bool candidate = i >= function.captures && variable.type == ValueType::Integer && variable.count == 1;
      bounds_[i].is_found = !candidate;
    }
    for_each_instruction(function, [&](ValueId id) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::Store) stores_[instruction.index].push_back(instruction.operands[0]);
      for (const VariableId variable : instruction.variables) // to a function that does not know
        bounds_[variable].is_found = true;
    });
  }

  /// How far from 0 the variable can get; nothing where that is not known, or beyond 32 bits.
  std::optional<uint64_t> bound(VariableId variable, int depth = 0) {
    Bound& bound = bounds_[variable];
    if (!bound.is_found) {
      bound.is_found = true; // as without one, for what refers to it meanwhile
      bound.distance = sum_of_stores(variable, depth);
    }
    return bound.distance;
  }

private:
  struct Bound {
    bool is_found = false;
    std::optional<uint64_t> distance;
  };

  std::optional<uint64_t> sum_of_stores(VariableId variable, int depth) {
    uint64_t furthest = 0, change = 0;
    for (const ValueId value : stores_[variable]) {
      const auto found = reach(value, variable, depth);
      if (!found) return std::nullopt;
      furthest = std::max(furthest, found->from_zero);
      change = std::min(change + found->from_itself, kGreatest);
    }
    const uint64_t distance = furthest + change * steps_;
    return distance <= kGreatest ? std::optional(distance) : std::nullopt;
  }

  std::optional<Reach> reach(ValueId id, VariableId variable, int depth) {
    const Instruction& instruction = function_.instructions[id];
    if (depth > kMaxDepth) return std::nullopt;
    switch (instruction.op) {
    case Op::ConstInteger:
      if (const auto constant = small_constant(function_, id)) return Reach{*constant, 0};
      return std::nullopt;
    case Op::Load:
      if (instruction.index == variable) return Reach{};
      if (const auto other = bound(instruction.index, depth + 1)) return Reach{*other, 0};
      return std::nullopt;
    case Op::Add:
    case Op::Sub:
      return reach_of_sum(instruction, variable, depth);
    case Op::Select: {
      const auto a = reach(instruction.operands[1], variable, depth + 1);
      const auto b = reach(instruction.operands[2], variable, depth + 1);
      if (!a || !b) return std::nullopt;
      return Reach{std::max(a->from_zero, b->from_zero), std::max(a->from_itself, b->from_itself)};
    }
    default:
      return std::nullopt;
    }
  }

  std::optional<Reach> reach_of_sum(const Instruction& sum, VariableId variable, int depth) {
    for (const size_t side : {size_t{0}, size_t{1}}) {
      if (sum.op == Op::Sub && side == 1) break; // a constant less the variable
      const auto constant = small_constant(function_, sum.operands[1 - side]);
      if (!constant) continue;
      const auto other = reach(sum.operands[side], variable, depth + 1);
      if (!other) return std::nullopt;
      return Reach{other->from_zero + *constant, other->from_itself + *constant};
    }
    return std::nullopt;
  }

  const Function& function_;
  const uint64_t steps_;
  std::vector<std::vector<ValueId>> stores_; ///< values, by variable
  std::vector<Bound> bounds_;
};

} // namespace

std::vector<bool> narrow_variables(const Function& function, uint64_t step_limit) {
  std::vector<bool> narrow(function.variables.size());
  Reaches reaches(function, step_limit);
  for (VariableId i = 0; i < narrow.size(); ++i)
    narrow[i] = reaches.bound(i).has_value();
  return narrow;
}

} // namespace moonshade::ir
