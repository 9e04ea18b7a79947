// simplify: the small passes, one after the other, and once more where constants of the top level came to light.
#include "compiler/ir/passes.h"

namespace moonshade::ir {
namespace {

void simplify(Function& function) {
  // Folding ifs away makes stores the only way to a load, forwarding makes operands constant, and selects take the
  // place of variables: each round does what the one before made possible; three settle all but contrived cases.
  for (int round = 0; round < 3; ++round) {
    fold_constants(function);
    forward_variables(function);
    share_values(function);
    convert_ifs_to_selects(function);
    remove_dead_code(function);
  }
  share_variables(function);
  forward_variables(function);
  decide_comparisons(function);
  fold_constants(function);
  share_values(function);
  remove_dead_code(function);
}

} // namespace

void simplify(Module& module) {
  for (Function& function : module.functions)
    simplify(function);
  forward_constant_globals(module);
  for (Function& function : module.functions)
    simplify(function);
}

} // namespace moonshade::ir
