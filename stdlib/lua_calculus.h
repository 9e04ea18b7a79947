// The calculus of the dialect for stock Lua: derivatives by differences, where compiled code has exact ones.
#pragma once

#include <lua.hpp>

namespace moonshade {

/// gradient(f, p): of a function that gives a number, by the number or vector p, as central differences of the eighth
/// order; to about 1e-10 of the function's size where it is smooth within |p| / 8000 (at least 1 / 8000).
int lua_gradient(lua_State* state);

/// fwidth(f, p, fw): how much f changes over the footprint fw around p: the gradient's length times fw.
int lua_fwidth(lua_State* state);

} // namespace moonshade
