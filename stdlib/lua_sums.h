// Sums of a noise that is given as a function, for stock Lua: sums.lua in an environment of its own.
#pragma once

#include <string_view>

struct lua_State;

namespace moonshade {

/// Around the global functions that sum simplex noise, also in the module's table on top of the stack: with a function
/// first they call that of sums.lua.
void open_sums(lua_State* state);

/// Loads another text of sums.lua in place of the one that is there: with counted steps. Raises Lua's errors.
void load_sums(lua_State* state, std::string_view text, const char* chunk);

} // namespace moonshade
