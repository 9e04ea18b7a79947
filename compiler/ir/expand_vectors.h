// The library's functions of vectors and matrices (dot, refract, determinant, ...) as arithmetic on components, for
// derivatives: those of rows as they are would have a column for each component, and to the second order one for each
// pair of them.
#pragma once

#include "compiler/ir/ir.h"

#include <map>

namespace moonshade::ir {

class VectorExpander {
public:
  explicit VectorExpander(Module& module) : module_(module) {}

  /// A function that does what `function` does, in whatever it calls too, without calls of those rows: `function`
  /// itself where it has none, else a copy, added to the module. Values are the same up to the rounding of float.
  FunctionId expanded(FunctionId function);

private:
  Module& module_;
  std::map<FunctionId, FunctionId> known_;
};

} // namespace moonshade::ir
