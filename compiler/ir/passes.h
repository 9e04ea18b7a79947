// The passes over the IR, each a free function in a file of its own. Each keeps every bit of every result and every
// fault, but `fuse`, which is part of what f32 means.
#pragma once

#include "compiler/ir/ir.h"
#include "compiler/sema/shader_info.h"

namespace moonshade::ir {

/// Drops functions that neither `init` nor an entry reaches; the others keep their order. (reachability.cpp)
void remove_unreachable(Module& module);

/// Constant globals, copies, constants, dead values and branches, small ifs to selects. (simplify.cpp and its parts)
void simplify(Module& module);

/// Globals that `init` stores once, unconditionally, a constant: their loads become the constant. (forward_globals.cpp)
void forward_constant_globals(Module& module);

/// Folds operations on constants where float and double agree; removes ifs on constants. (fold.cpp)
void fold_constants(Function& function);

/// Comparisons of integers that the ranges of their values decide become constants. (ranges.cpp)
void decide_comparisons(Function& function);

/// Loads of variables that are stored once become the stored value. (forward_variables.cpp)
void forward_variables(Function& function);

/// Ifs that only choose between cheap values become selects. (select.cpp)
void convert_ifs_to_selects(Function& function);

/// Of equal computations, the later takes the value of the earlier. (share_values.cpp)
void share_values(Function& function);

/// Of variables that always hold the same, one is left. (share_variables.cpp)
void share_variables(Function& function);

/// Values without a use, stores to variables that are never loaded, unused variables. (dead_code.cpp)
void remove_dead_code(Function& function);

/// Whether some function prints; takes all prints out. (prints.cpp)
bool has_prints(const Module& module);
void remove_prints(Module& module);

/// f32 only: a*b + c and its kin become fma. (fuse.cpp)
void fuse(Module& module);

/// Removes all `step`s where no point can take more than Module::step_limit of them. (steps.cpp)
void remove_bounded_steps(Module& module);

/// Counters of loops that are read behind the loop, too: a second variable for the reads inside. (split_counters.cpp)
void split_counters(Function& function);

/// All passes in order; debug builds verify after each and abort where one broke a rule.
void optimize(Module& module, Precision precision);

/// Makes constants of the parameters of an optimised module: the values, by parameter, as they are stored into the
/// parameters' globals (of a string its index).
void bake_parameters(Module& module, const std::vector<Constant>& values);

} // namespace moonshade::ir
