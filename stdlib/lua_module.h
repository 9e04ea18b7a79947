// The standard library for stock Lua 5.4: module `moonshade`, the same function bodies over doubles that compiled code
// runs, so that a shader means in the interpreter what it means compiled.
//
// Vectors are userdata (lua_vector.h). Of the table's rows the module has all but operators, which the vectors'
// metatables bring, and `math.*`, which is Lua's own library. Nothing here allocates but for results.
#pragma once

extern "C" {
struct lua_State;

/// Opens the module: sets its functions as globals, and returns them in a table.
[[gnu::visibility("default")]] int luaopen_moonshade(lua_State* state);
}

namespace moonshade {

/// Pops a value: the shader's parameter `name` has it from now on, instead of its default, where `param` is called
/// after this. `param` raises an error where the value does not fit the default's type or the stated range.
void override_parameter(lua_State* state, const char* name);

} // namespace moonshade
