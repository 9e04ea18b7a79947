// remove_unreachable: specialisations that nothing calls any more go.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

namespace moonshade::ir {

void remove_unreachable(Module& module) {
  std::vector<FunctionId> pending{module.init};
  for (const Entry& entry : module.entries)
    pending.push_back(entry.function);
  std::vector<bool> reached(module.functions.size());
  while (!pending.empty()) {
    const FunctionId id = pending.back();
    pending.pop_back();
    if (reached[id]) continue;
    reached[id] = true;
    const Function& function = module.functions[id];
    for_each_instruction(function, [&](ValueId value) {
      if (function.instructions[value].op == Op::Call) pending.push_back(function.instructions[value].index);
    });
  }
  std::vector<FunctionId> renumbered(module.functions.size(), kNone);
  std::vector<Function> kept;
  for (FunctionId id = 0; id < module.functions.size(); ++id) {
    if (!reached[id]) continue;
    renumbered[id] = static_cast<FunctionId>(kept.size());
    kept.push_back(std::move(module.functions[id]));
  }
  module.functions = std::move(kept);
  module.init = renumbered[module.init];
  for (Entry& entry : module.entries)
    entry.function = renumbered[entry.function];
  for (Function& function : module.functions)
    for (Instruction& instruction : function.instructions)
      if (instruction.op == Op::Call) instruction.index = renumbered[instruction.index];
}

} // namespace moonshade::ir
