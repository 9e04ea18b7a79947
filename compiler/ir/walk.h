// Walks over the blocks of a function that several passes need.
#pragma once

#include "compiler/ir/ir.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace moonshade::ir {

/// Calls visit(id) for each instruction that stands in the block or in a block nested there, in order of execution.
template <class Visit> void for_each_instruction(const Function& function, const Block& block, Visit&& visit) {
  for (const ValueId id : block.instructions) {
    visit(id);
    for (const Block& inner : function.instructions[id].blocks)
      for_each_instruction(function, inner, visit);
  }
}
template <class Visit> void for_each_instruction(const Function& function, Visit&& visit) {
  for_each_instruction(function, function.body, visit);
}

/// How often each value is an operand.
inline std::vector<uint32_t> count_uses(const Function& function) {
  std::vector<uint32_t> uses(function.instructions.size());
  for_each_instruction(function, [&](ValueId id) {
    for (const ValueId operand : function.instructions[id].operands)
      ++uses[operand];
  });
  return uses;
}

/// Appends an instruction to a function and to what is to stand in a block.
inline ValueId append(Function& function, std::vector<ValueId>& block, Instruction instruction) {
  function.instructions.push_back(std::move(instruction));
  block.push_back(static_cast<ValueId>(function.instructions.size() - 1));
  return block.back();
}

/// Builds each block anew, the outermost last: rewrite(id, result) is called for each instruction in order, after its
/// own inner blocks are done, and appends to `result` what stands in its place. It returns false where nothing that
/// follows in the block is executed any more.
template <class Rewrite> void rewrite_blocks(Function& function, Block& block, Rewrite&& rewrite) {
  std::vector<ValueId> result;
  result.reserve(block.instructions.size());
  for (const ValueId id : block.instructions) {
    for (size_t i = 0; i < function.instructions[id].blocks.size(); ++i) {
      // The rewriter may add instructions, which moves them: the block is taken out meanwhile.
      Block inner = std::move(function.instructions[id].blocks[i]);
      rewrite_blocks(function, inner, rewrite);
      function.instructions[id].blocks[i] = std::move(inner);
    }
    if (!rewrite(id, result)) break;
  }
  block.instructions = std::move(result);
}
template <class Rewrite> void rewrite_blocks(Function& function, Rewrite&& rewrite) {
  Block body = std::move(function.body);
  rewrite_blocks(function, body, rewrite);
  function.body = std::move(body);
}

/// A value that stands for another one, by ValueId; filled by a pass in order of execution, so that chains are short.
class Replacements {
public:
  explicit Replacements(size_t count) : by_value_(count, kNone) {}

  void replace(ValueId value, ValueId by) {
    if (value >= by_value_.size()) by_value_.resize(value + 1, kNone);
    by_value_[value] = (*this)(by);
  }
  ValueId operator()(ValueId value) const {
    return value < by_value_.size() && by_value_[value] != kNone ? by_value_[value] : value;
  }
  void apply(Instruction& instruction) const {
    for (ValueId& operand : instruction.operands)
      operand = (*this)(operand);
  }

private:
  std::vector<ValueId> by_value_;
};

} // namespace moonshade::ir
