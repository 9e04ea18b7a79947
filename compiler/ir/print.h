// The textual form of the IR, for --emit=ir and for tests. Stable: values are numbered in order of appearance, numbers
// are printed exactly (%.17g), one instruction a line, nesting by indentation.
//
//   global @0 scale: number, parameter 0
//   entry height = height
//   function height(p: vec3) -> number {
//     var $0.sum: number
//     %0: vec3 = argument 0
//     %1: number = const.n 0.5
//     store $0.sum, %1
//     loop #0 {
//       if %2 {
//         break #0
//       }
//     }
//     return %1
//   }
#pragma once

#include "compiler/ir/ir.h"

#include <iosfwd>
#include <string>

namespace moonshade::ir {

void print(const Module& module, std::ostream& out);
std::string to_text(const Module& module);
std::string to_text(const Module& module, const Function& function);

} // namespace moonshade::ir
