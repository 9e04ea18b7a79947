// The library as a definition file for LuaLS (https://luals.github.io): every function of the table with its overloads
// and its line of documentation, the functions that the compiler itself knows, and the vectors and matrices with their
// components, operators and methods.
#pragma once

#include <string>

namespace moonshade::sema {

std::string luals_definitions();

} // namespace moonshade::sema
