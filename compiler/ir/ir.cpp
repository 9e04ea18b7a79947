// The table of operations.
#include "compiler/ir/ir.h"

#include <array>

namespace moonshade::ir {

const OpInfo& info(Op op) {
  static constexpr std::array kTable = {
#define OP(name, text, operands, shape) OpInfo{text, operands, OpShape::shape},
#include "compiler/ir/ops.def"
  };
  return kTable[static_cast<size_t>(op)];
}

} // namespace moonshade::ir
