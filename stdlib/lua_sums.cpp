// The environment of sums.lua holds the module's functions and what the text defines, so that a shader's own names do
// not reach it. What the caller leaves out is filled in here, as sema does it for compiled code.
#include "stdlib/lua_sums.h"

#include "stdlib/library.h"
#include "stdlib/lua_vector.h"
#include "stdlib/sums.h"

#include <lua.hpp>

namespace moonshade {
namespace {

/// Registry keys: the environment, and the names of the library's noises by function.
constexpr char kEnvironment = 0, kNoises = 0;
constexpr const char* kSums[] = {"fbm", "turbulence", "ridged", "hybrid", "warp"};

/// The name of the function at the index, where it is a noise of the library.
std::string_view noise_name(lua_State* state, int index) {
  lua_rawgetp(state, LUA_REGISTRYINDEX, &kNoises);
  lua_pushvalue(state, index);
  lua_rawget(state, -2);
  const char* name = lua_tostring(state, -1); // which the registry keeps
  lua_pop(state, 2);
  return name == nullptr ? std::string_view{} : name;
}

/// sum(f, p, ...). Upvalues: the function of the table's rows, the name.
int sum(lua_State* state) {
  constexpr int kRows = 1, kName = 2;
  if (!lua_isfunction(state, 1)) return lua_tocfunction(state, lua_upvalueindex(kRows))(state);
  const char* name = lua_tostring(state, lua_upvalueindex(kName));
  const NoiseSum& kind = *find_noise_sum(name);
  const LibraryFunction& row = library_overloads(name).front();
  // f, what the row takes, and the mean.
  const int most = row.parameter_count + 2, given = lua_gettop(state);
  if (given > most) return luaL_error(state, "too many arguments to '%s' (at most %d, got %d)", name, most, given);
  const LuaValue p = lua_value(state, 2);
  for (int i = 2; i <= (given < 2 ? 2 : given); ++i)
    if (!lua_value(state, i).is_scalar() && (i != 2 || p.size() == 0))
      return luaL_error(state, "bad argument #%d to '%s' (number%s expected, got %s)", i, name,
                        i == 2 ? " or vector" : "", i > given ? "no value" : lua_type_name(state, i));
  const unsigned dimensions = p.size() == 0 ? 1 : p.size();
  luaL_checkstack(state, most + 2, "too many arguments");
  lua_rawgetp(state, LUA_REGISTRYINDEX, &kEnvironment);
  lua_getfield(state, -1, lua_name(kind, dimensions).data());
  lua_remove(state, -2);
  lua_pushvalue(state, 1);
  for (int i = 2; i <= most; ++i) {
    if (i > given)
      lua_pushnumber(state,
                     i < most ? row.defaults[size_t(i - 2)] : default_mean(kind, noise_name(state, 1), dimensions));
    else if (lua_value(state, i).is_scalar())
      lua_pushnumber(state, lua_value(state, i).at(0)); // integers count as numbers
    else
      lua_pushvalue(state, i);
  }
  lua_call(state, most, 1);
  return 1;
}

} // namespace

void load_sums(lua_State* state, std::string_view text, const char* chunk) {
  if (luaL_loadbufferx(state, text.data(), text.size(), chunk, "t") != LUA_OK) lua_error(state);
  lua_rawgetp(state, LUA_REGISTRYINDEX, &kEnvironment);
  lua_setupvalue(state, -2, 1);
  lua_call(state, 0, 0);
}

void open_sums(lua_State* state) {
  lua_newtable(state); // the environment
  lua_pushnil(state);
  while (lua_next(state, -3) != 0) {
    lua_pushvalue(state, -2);
    lua_insert(state, -2);
    lua_rawset(state, -4);
  }
  lua_rawsetp(state, LUA_REGISTRYINDEX, &kEnvironment);
  lua_newtable(state);
  for (const char* name : {"noise", "perlin", "valuenoise", "cellnoise", "worley", "gabor"}) {
    lua_getfield(state, -2, name);
    lua_pushstring(state, name);
    lua_rawset(state, -3);
  }
  lua_rawsetp(state, LUA_REGISTRYINDEX, &kNoises);
  load_sums(state, library_lua(), "=moonshade/sums.lua");
  for (const char* name : kSums) {
    lua_getfield(state, -1, name);
    lua_pushstring(state, name);
    lua_pushcclosure(state, sum, 2);
    lua_pushvalue(state, -1);
    lua_setglobal(state, name);
    lua_setfield(state, -2, name);
  }
}

} // namespace moonshade
