// Inside `build` only: the derivatives that a module needs, whose places are reserved before they can be made.
#pragma once

#include "compiler/ir/ir.h"

#include <map>

namespace moonshade::ir {

class Derivatives {
public:
  /// Functions are reserved from `first` on: the first id that no specialisation has.
  explicit Derivatives(FunctionId first) : first_(first) {}

  /// The function that gives the result of `function` and its gradient by its first parameter. `declared` is its
  /// outside, with one parameter that is a number or a vector and one result that is a number.
  FunctionId of(FunctionId function, const Function& declared);
  /// The same for a row of the library, called with one argument.
  FunctionId of(const LibraryFunction& row, Span span);

  /// Once all specialisations are translated: adds the reserved functions to the module and makes the derivatives.
  void make(Module& module);

private:
  FunctionId reserve(Function function);

  FunctionId first_;
  std::vector<Function> reserved_;
  std::map<FunctionId, FunctionId> by_function_; ///< derivatives by what they are made of
  std::map<const LibraryFunction*, FunctionId> by_row_;
};

} // namespace moonshade::ir
