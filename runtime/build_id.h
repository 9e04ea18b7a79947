// Which build this is: the identifiers that the linker gave to what holds this library's code, and to LLVM.
#pragma once

#include <string>

namespace moonshade {

/// A hash of the program's or shared library's contents (its GNU build id), as hexadecimal digits; empty where it was
/// linked without.
const std::string& library_build_id();
const std::string& llvm_build_id();

} // namespace moonshade
