// Prints: found, and taken out where nobody listens.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

namespace moonshade::ir {

bool has_prints(const Module& module) {
  bool found = false;
  for (const Function& function : module.functions)
    for_each_instruction(function, [&](ValueId id) { found = found || function.instructions[id].op == Op::Print; });
  return found;
}

void remove_prints(Module& module) {
  for (Function& function : module.functions)
    rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
      if (function.instructions[id].op != Op::Print) result.push_back(id);
      return true;
    });
}

} // namespace moonshade::ir
