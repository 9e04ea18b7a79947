// What emission must know of a function of the IR before it begins: from the uniformity analysis, how lanes leave its
// constructs; and for each variable its home, the innermost block that holds all its accesses.
#pragma once

#include "compiler/codegen/masks.h"
#include "compiler/ir/ir.h"
#include "compiler/ir/uniformity.h"

#include <unordered_map>
#include <vector>

namespace moonshade::codegen {

struct FunctionFacts {
  const ir::Uniformity* uniformity = nullptr;
  std::vector<TargetFacts> labels; ///< by LabelId
  TargetFacts function;
  /// By VariableId; null: a capture, or never accessed.
  std::vector<const ir::Block*> homes;
  /// By VariableId: a loop that holds all reads of the variable and that lanes enter once in the life of its home, so
  /// that lanes which have left it never read the variable again; kNone: there is none.
  std::vector<ir::LabelId> last_loops;
  /// By VariableId: an integer that 32 bits hold.
  std::vector<bool> narrow;
  /// Of calls of the library: a bit for each result from the second on that something uses.
  std::unordered_map<ir::ValueId, uint32_t> further_results;
};

FunctionFacts function_facts(const ir::Function& function, const ir::Uniformity& uniformity, uint64_t step_limit);

/// Instructions of the IR that a call of each function comes to when its callees are emitted in place, and which
/// functions are too big for that and get LLVM functions of their own.
struct SizePlan {
  std::vector<uint64_t> size;
  std::vector<bool> outlined;
};
SizePlan plan_sizes(const ir::Module& module);

/// Whether any point could fault: whether a `fault` or a `step` stands in what `function` runs.
struct FaultFacts {
  bool faults = false;
  bool steps = false;
};
std::vector<FaultFacts> fault_facts(const ir::Module& module);

/// Visits the instructions of a block and of those nested there, in order.
template <class Visit> void each_instruction(const ir::Function& function, const ir::Block& block, Visit&& visit) {
  for (const ir::ValueId id : block.instructions) {
    const ir::Instruction& instruction = function.instructions[id];
    visit(instruction);
    for (const ir::Block& inner : instruction.blocks)
      each_instruction(function, inner, visit);
  }
}

} // namespace moonshade::codegen
