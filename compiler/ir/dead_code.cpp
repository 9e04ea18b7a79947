// remove_dead_code: what has no effect and no use goes, from the end to the beginning, so that a value whose only use
// was dead goes in the same walk. Then scopes that nothing breaks out of dissolve, and variables and instructions are
// numbered anew.
#include "compiler/ir/builder.h"
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

namespace moonshade::ir {
namespace {

constexpr int kMaxRounds = 8;

/// Executed for its value alone.
bool is_removable(Op op) {
  return info(op).shape == OpShape::Value || op == Op::Load || op == Op::LoadGlobal || op == Op::LoadElement ||
         op == Op::LoadGlobalElement;
}

/// Variables that something may read: loaded here, captured from outside, or passed to a call.
std::vector<bool> read_variables(const Function& function) {
  std::vector<bool> read(function.variables.size());
  for (VariableId i = 0; i < function.captures; ++i)
    read[i] = true;
  for_each_instruction(function, [&](ValueId id) {
    const Instruction& instruction = function.instructions[id];
    if (instruction.op == Op::Load || instruction.op == Op::LoadElement) read[instruction.index] = true;
    if (instruction.op == Op::Call)
      for (const VariableId variable : instruction.variables)
        read[variable] = true;
  });
  return read;
}

class Sweep {
public:
  Sweep(Function& function, const std::vector<bool>& read)
      : function_(function), read_(read), used_(function.instructions.size()) {}

  /// True where something went.
  bool run() {
    sweep(function_.body);
    return changed_;
  }

private:
  bool is_dead(ValueId id) {
    Instruction& instruction = function_.instructions[id];
    if (is_removable(instruction.op)) return !used_[id];
    if (instruction.op == Op::Store || instruction.op == Op::StoreElement) return !read_[instruction.index];
    for (Block& block : instruction.blocks)
      sweep(block);
    if (instruction.op != Op::If && instruction.op != Op::Scope) return false;
    return std::ranges::all_of(instruction.blocks, [](const Block& block) { return block.instructions.empty(); });
  }

  void sweep(Block& block) {
    std::vector<ValueId> kept;
    for (size_t i = block.instructions.size(); i-- > 0;) {
      const ValueId id = block.instructions[i];
      if (is_dead(id)) {
        changed_ = true;
        continue;
      }
      for (const ValueId operand : function_.instructions[id].operands)
        used_[operand] = true;
      kept.push_back(id);
    }
    std::ranges::reverse(kept);
    block.instructions = std::move(kept);
  }

  Function& function_;
  const std::vector<bool>& read_;
  std::vector<bool> used_;
  bool changed_ = false;
};

/// A scope that no break names is its body. (What follows a body that does not end is never executed.)
void dissolve_scopes(Function& function) {
  std::vector<bool> named(function.next_label);
  for_each_instruction(function, [&](ValueId id) {
    if (function.instructions[id].op == Op::Break) named[function.instructions[id].index] = true;
  });
  rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
    Instruction& instruction = function.instructions[id];
    if (instruction.op != Op::Scope || named[instruction.index]) {
      result.push_back(id);
      return true;
    }
    const Block& body = instruction.blocks[0];
    result.insert(result.end(), body.instructions.begin(), body.instructions.end());
    return falls_through(function, body);
  });
}

/// Leaves only the instructions that stand in blocks and the variables in use, numbered in order of appearance.
void renumber(Function& function) {
  std::vector<ValueId> new_value(function.instructions.size(), kNone);
  std::vector<VariableId> new_variable(function.variables.size(), kNone);
  std::vector<bool> used(function.variables.size());
  uint32_t count = 0;
  for_each_instruction(function, [&](ValueId id) {
    new_value[id] = count++;
    const Instruction& instruction = function.instructions[id];
    switch (instruction.op) {
    case Op::Load:
    case Op::Store:
    case Op::LoadElement:
    case Op::StoreElement:
      used[instruction.index] = true;
      break;
    case Op::Call:
      for (const VariableId variable : instruction.variables)
        used[variable] = true;
      break;
    default:
      break;
    }
  });
  std::vector<Variable> variables;
  for (VariableId i = 0; i < function.variables.size(); ++i) {
    if (!used[i] && i >= function.captures) continue;
    new_variable[i] = static_cast<VariableId>(variables.size());
    variables.push_back(std::move(function.variables[i]));
  }
  std::vector<Instruction> instructions(count);
  for (ValueId id = 0; id < new_value.size(); ++id) {
    if (new_value[id] == kNone) continue;
    Instruction& instruction = function.instructions[id];
    for (ValueId& operand : instruction.operands)
      operand = new_value[operand];
    if (instruction.op == Op::Load || instruction.op == Op::Store || instruction.op == Op::LoadElement ||
        instruction.op == Op::StoreElement)
      instruction.index = new_variable[instruction.index];
    for (VariableId& variable : instruction.variables)
      variable = new_variable[variable];
    for (Block& block : instruction.blocks)
      for (ValueId& inner : block.instructions)
        inner = new_value[inner];
    instructions[new_value[id]] = std::move(instruction);
  }
  for (ValueId& id : function.body.instructions)
    id = new_value[id];
  function.instructions = std::move(instructions);
  function.variables = std::move(variables);
}

} // namespace

void remove_dead_code(Function& function) {
  // A store that goes may take the last load of another variable with it; chains of that are short.
  for (int round = 0; round < kMaxRounds; ++round)
    if (!Sweep(function, read_variables(function)).run()) break;
  dissolve_scopes(function);
  renumber(function);
}

} // namespace moonshade::ir
