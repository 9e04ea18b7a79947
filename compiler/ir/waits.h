// How long values have to be waited for: by it passes choose which of two equally good forms to make.
#pragma once

#include "compiler/ir/ir.h"

#include <algorithm>

namespace moonshade::ir {

/// Counts operations, one after the other, from arguments, constants and variables on; a call counts as eight. Values
/// are numbered in order of execution.
class Waits {
public:
  explicit Waits(const Function& function) : function_(function) {}

  uint32_t operator()(ValueId value) {
    while (waits_.size() <= value)
      waits_.push_back(count(function_.instructions[waits_.size()]));
    return waits_[value];
  }

private:
  uint32_t count(const Instruction& instruction) const {
    if (instruction.operands.empty()) return instruction.op == Op::Call || instruction.op == Op::CallLibrary ? 8 : 0;
    uint32_t longest = 0;
    for (const ValueId operand : instruction.operands)
      longest = std::max(longest, operand < waits_.size() ? waits_[operand] : 0);
    switch (instruction.op) {
    case Op::Call:
    case Op::CallLibrary:
      return longest + 8;
    case Op::Component:
    case Op::Construct:
    case Op::Result:
      return longest;
    default:
      return longest + 1;
    }
  }

  const Function& function_;
  std::vector<uint32_t> waits_;
};

} // namespace moonshade::ir
