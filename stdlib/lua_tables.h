// The library's functions of arrays, for stock Lua: ramp, palette, catmullrom, bspline of (x, { values }).
#pragma once

struct lua_State;

namespace moonshade {

/// Pushes the function `name`. Where a global of that name stands already, which takes other arguments, it is called
/// with all that is not a table second.
void push_table_function(lua_State* state, const char* name);

} // namespace moonshade
