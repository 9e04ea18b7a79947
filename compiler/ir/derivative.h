// Derivatives of functions, exact, in forward mode.
//
// From a function F comes a function F' that computes what F does and, beside each number, its derivatives in K
// directions at once: the components of the parameters that F is differentiated by.
//
//   values      A value's derivative is a number for each component and direction, except where it is zero whatever the
//               arguments: such derivatives do not exist, and nothing is computed from them. (Nobody could remove them
//               later: x*0 is not 0.) Integers and booleans are constants, so are globals; conversions to an integer,
//               floor and comparisons end a derivative.
//   variables   Beside a variable stand variables for its derivatives, one for each component and direction for which
//               something that has one may be stored anywhere (found by iteration: loops, captures). They are stored
//               and loaded where the variable is; a store of a constant stores zeros.
//   control     F' takes the same branches and faults and counts the same steps: the derivative of an `if`, a `select`
//               or a loop is that of what was executed.
//   calls       A call becomes a call of its function's derivative, made once for each set of derivatives that its
//               arguments and captures have; those come as further arguments (numbers) and captures, and go as further
//               results. A call that has none stays as it is.
//   library     A call becomes one of the row's derivative (stdlib/library.h), which gives the value and the
//   derivatives
//               by its arguments; the chain rule follows. dual.h says what they are at kinks.
//
// The values are computed by the very instructions of F.
#pragma once

#include "compiler/ir/ir.h"

#include <span>

namespace moonshade::ir {

/// More directions than this are too many for one derivative: two inputs of four components and more.
inline constexpr unsigned kMaxDirections = 16;

/// Adds a function with the parameters and captures of `function` and its results, followed, for each number and each
/// component of a vector among them, by the gradient by each of `parameters` (indices; numbers or vectors, at most
/// kMaxDirections components together), which has the parameter's type. Captures count as constants; it stores in them
/// what `function` does. What is made here may be differentiated once more, if rows of vectors were expanded before
/// (expand_vectors.h): of those the library has no second derivatives.
FunctionId add_gradient(Module& module, FunctionId function, std::span<const uint32_t> parameters);

/// How often the library's functions that `function` uses are differentiated already. Beyond kMaxOrder the library has
/// no derivatives: what has this order must not be differentiated again.
unsigned derivative_order(const Module& module, FunctionId function);
inline constexpr unsigned kMaxOrder = 2;

} // namespace moonshade::ir
