// By the bodies of spline.h, over doubles, for each component (lua_tables.h).
#include "stdlib/lua_tables.h"

#include "stdlib/lua_vector.h"
#include "stdlib/spline.h"

#include <lua.hpp>

#include <string_view>

namespace moonshade {
namespace {

enum Kind : lua_Integer { Ramp, Palette, Catmullrom, Bspline };

/// One component of the value at x; at(i) gives that of the element from 0.
template <class At> double interpolate(lua_Integer kind, double x, int count, At at) {
  switch (kind) {
  case Ramp:
    return stdlib::table_linear(x, count, at);
  case Catmullrom:
    return stdlib::table_catmullrom(x, count, at);
  case Bspline:
    return stdlib::table_bspline(x, count, at);
  default: {
    // One span for each value, and from the last back to the first.
    const stdlib::Span<double> span = stdlib::find_span(stdlib::fract(x), count);
    const double next = span.index + 1;
    return stdlib::mix(at(span.index), at(next == count ? 0 : next), span.place);
  }
  }
}

/// The element at an index from 0 of the table at 2: its components stay valid, as the table keeps it.
LuaValue element(lua_State* state, double index) {
  lua_rawgeti(state, 2, lua_Integer(index) + 1);
  const LuaValue value = lua_value(state, -1);
  lua_pop(state, 1);
  return value;
}

/// Upvalues: the kind, the name, and the function for other arguments, if there is one.
int call(lua_State* state) {
  const lua_Integer kind = lua_tointegerx(state, lua_upvalueindex(1), nullptr);
  const char* name = lua_tostring(state, lua_upvalueindex(2));
  if (lua_gettop(state) != 2 || lua_type(state, 2) != LUA_TTABLE) {
    if (lua_type(state, lua_upvalueindex(3)) != LUA_TFUNCTION)
      return luaL_error(state, "'%s' takes a number and an array, not %s and %s", name, lua_type_name(state, 1),
                        lua_type_name(state, 2));
    lua_pushvalue(state, lua_upvalueindex(3));
    lua_insert(state, 1);
    lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
    return lua_gettop(state);
  }
  const LuaValue x = lua_value(state, 1);
  const int count = int(lua_rawlen(state, 2)), least = kind == Catmullrom || kind == Bspline ? 4 : 1;
  if (!x.is_scalar())
    return luaL_error(state, "bad argument #1 'x' to '%s' (number expected, got %s)", name, lua_type_name(state, 1));
  if (count < least) return luaL_error(state, "'%s' takes an array of at least %d values, not %d", name, least, count);
  const unsigned size = element(state, 0).size();
  for (int i = 0; i < count; ++i) {
    const LuaValue value = element(state, i);
    if (value.size() != size || (size == 0 && !value.is_scalar()))
      return luaL_error(state, "the values of '%s' are numbers or vectors of one size", name);
  }
  const auto component = [&](unsigned c) {
    return interpolate(kind, x.at(0), count, [&](double index) { return element(state, index).at(c); });
  };
  if (size == 0) {
    lua_pushnumber(state, component(0));
    return 1;
  }
  double* to = push_new_vector(state, size);
  for (unsigned c = 0; c < size; ++c)
    to[c] = component(c);
  return 1;
}

} // namespace

void push_table_function(lua_State* state, const char* name) {
  constexpr std::string_view kNames[] = {"ramp", "palette", "catmullrom", "bspline"};
  lua_Integer kind = 0;
  while (kNames[kind] != name)
    ++kind;
  lua_pushinteger(state, kind);
  lua_pushstring(state, name);
  lua_getglobal(state, name);
  lua_pushcclosure(state, call, 3);
}

} // namespace moonshade
