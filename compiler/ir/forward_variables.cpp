// forward_variables: a load gives the value that the variable is known to hold there: the one stored last, or loaded
// last, on the only way to it. What a branch or loop stores is unknown behind it; what a loop stores is unknown at the
// beginning of its body too. Calls may store the variables that they capture, and two captures may be one variable.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

namespace moonshade::ir {
namespace {

class Forwarding {
public:
  explicit Forwarding(Function& function)
      : function_(function), known_(function.variables.size(), kNone), replacements_(function.instructions.size()) {}

  void run() { walk(function_.body); }

private:
  struct Change {
    VariableId variable;
    ValueId before;
  };

  void set(VariableId variable, ValueId value) {
    log_.push_back({variable, known_[variable]});
    known_[variable] = value;
  }

  void forget(VariableId variable) {
    set(variable, kNone);
    stored_.push_back(variable);
  }

  void store(VariableId variable, ValueId value) {
    if (variable < function_.captures)
      for (VariableId other = 0; other < function_.captures; ++other)
        if (function_.variables[other].type == function_.variables[variable].type) forget(other);
    set(variable, value);
    stored_.push_back(variable);
  }

  /// A block inside: what it learns is forgotten behind it, and what it stored too.
  void walk_inner(Block& block) {
    const size_t log_begin = log_.size(), stored_begin = stored_.size();
    walk(block);
    while (log_.size() > log_begin) {
      known_[log_.back().variable] = log_.back().before;
      log_.pop_back();
    }
    // Each variable once; the list is handed on to the block around.
    std::sort(stored_.begin() + static_cast<std::ptrdiff_t>(stored_begin), stored_.end());
    stored_.erase(std::unique(stored_.begin() + static_cast<std::ptrdiff_t>(stored_begin), stored_.end()),
                  stored_.end());
    pending_.assign(stored_.begin() + static_cast<std::ptrdiff_t>(stored_begin), stored_.end());
  }

  void forget_stores_of(const Block& block) {
    for_each_instruction(function_, block, [&](ValueId id) {
      const Instruction& instruction = function_.instructions[id];
      if (instruction.op == Op::Store || instruction.op == Op::StoreElement) forget_aliases(instruction.index);
      if (instruction.op == Op::Call)
        for (const VariableId variable : instruction.variables)
          forget_aliases(variable);
    });
  }

  void forget_aliases(VariableId variable) {
    forget(variable);
    if (variable < function_.captures)
      for (VariableId other = 0; other < function_.captures; ++other)
        forget(other);
  }

  void walk(Block& block) {
    std::vector<ValueId> result;
    result.reserve(block.instructions.size());
    for (const ValueId id : block.instructions) {
      Instruction& instruction = function_.instructions[id];
      replacements_.apply(instruction);
      switch (instruction.op) {
      case Op::Load:
        if (known_[instruction.index] != kNone) {
          replacements_.replace(id, known_[instruction.index]);
          continue;
        }
        set(instruction.index, id);
        break;
      case Op::Store:
        store(instruction.index, instruction.operands[0]);
        break;
      case Op::Call:
        for (const VariableId variable : instruction.variables)
          forget_aliases(variable);
        break;
      case Op::Loop:
        forget_stores_of(instruction.blocks[0]);
        break;
      default:
        break;
      }
      // Branches are walked with what is known before them; what either stores is unknown behind both.
      std::vector<VariableId> stored;
      for (Block& inner : instruction.blocks) {
        walk_inner(inner);
        stored.insert(stored.end(), pending_.begin(), pending_.end());
      }
      for (const VariableId variable : stored)
        set(variable, kNone);
      result.push_back(id);
    }
    block.instructions = std::move(result);
  }

  Function& function_;
  std::vector<ValueId> known_; ///< by variable: the value that it holds, or kNone
  std::vector<Change> log_;
  std::vector<VariableId> stored_;  ///< by the blocks that are open
  std::vector<VariableId> pending_; ///< by the block that was just closed
  Replacements replacements_;
};

} // namespace

void forward_variables(Function& function) { Forwarding(function).run(); }

} // namespace moonshade::ir
