#include "stdlib/lua_images.h"

#include "stdlib/lua_vector.h"

#include <lua.hpp>

namespace moonshade {
namespace {

/// The registry key of the host's images.
constexpr char kImages = 0;

bool read_raw(lua_State* state, int index) {
  lua_pushliteral(state, "raw");
  lua_rawget(state, index);
  const bool raw = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return raw;
}

int texture(lua_State* state) {
  int count = lua_gettop(state);
  const bool has_options = count > 2 && lua_istable(state, count);
  const bool raw = has_options && read_raw(state, count);
  if (has_options) --count;
  if (count > 3) return luaL_error(state, "too many arguments to 'texture'");
  if (lua_type(state, 1) != LUA_TSTRING)
    return luaL_error(state, "bad argument #1 'file' to 'texture' (string expected, got %s)", lua_type_name(state, 1));
  const LuaValue uv = lua_value(state, 2), width = lua_value(state, 3);
  if (count < 2 || uv.size() != 2)
    return luaL_error(state, "bad argument #2 'uv' to 'texture' (vec2 expected, got %s)", lua_type_name(state, 2));
  if (count > 2 && !width.is_scalar())
    return luaL_error(state, "bad argument #3 'width' to 'texture' (number expected, got %s)", lua_type_name(state, 3));
  lua_rawgetp(state, LUA_REGISTRYINDEX, &kImages);
  const auto* images = static_cast<const LuaImages*>(lua_touserdata(state, -1));
  if (images == nullptr) return luaL_error(state, "this host opens no images");
  const auto source = unsigned(lua_tointeger(state, lua_upvalueindex(1)));
  const double at[3] = {uv.at(0), uv.at(1), count > 2 ? width.at(0) : 0.0};
  double* rgba = push_new_vector(state, 4);
  if (const char* error = images->look_up(images->context, lua_tostring(state, 1), source, raw, at, rgba))
    return luaL_error(state, "the image '%s' cannot be used: %s", lua_tostring(state, 1), error);
  return 1;
}

} // namespace

void set_images(lua_State* state, const LuaImages* images) {
  lua_pushlightuserdata(state, const_cast<LuaImages*>(images));
  lua_rawsetp(state, LUA_REGISTRYINDEX, &kImages);
}

void push_texture(lua_State* state, unsigned source) {
  lua_pushinteger(state, lua_Integer(source));
  lua_pushcclosure(state, texture, 1);
}

} // namespace moonshade
