#include "lua_verdict.h"

extern "C" {
#include <lauxlib.h>
#include <lua.h>
}

#include <array>
#include <cstdlib>

namespace moonshade::test {
namespace {

bool is_capacity_error(std::string_view message) {
  // "C stack overflow", "function or expression needs too many registers", "too many local variables (limit is 200)",
  // "control structure too long", "not enough memory"
  constexpr auto kSigns = std::to_array<std::string_view>(
      {"too many", "overflow", "C stack", "limit is", "too long", "not enough memory", "chunk has too many"});
  for (const std::string_view sign : kSigns)
    if (message.find(sign) != std::string_view::npos) return true;
  return false;
}

/// luaL_loadfilex skips these, luaL_loadbufferx does not.
std::string_view without_first_line(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (!text.starts_with("#")) return text;
  const size_t end = text.find('\n');
  return end == std::string_view::npos ? std::string_view() : text.substr(end);
}

} // namespace

Lua::Lua() : state_(luaL_newstate(), lua_close) {}

Lua::Result Lua::load(std::string_view text) {
  lua_State* lua = state_.get();
  const std::string_view body = without_first_line(text);
  Result result{Verdict::Accepts, {}};
  if (luaL_loadbufferx(lua, body.data(), body.size(), "=t", "t") != LUA_OK) {
    size_t size = 0;
    const char* message = lua_tolstring(lua, -1, &size);
    result.message.assign(message, size);
    // Only the text before "near" is the parser's own; what follows is the program's.
    const std::string_view own = std::string_view(result.message).substr(0, result.message.find(" near "));
    result.verdict =
        is_capacity_error(own) && own.find("escape too large") == own.npos && own.find("value too large") == own.npos
            ? Verdict::OutOfCapacity
            : Verdict::Refuses;
    if (result.message.starts_with("t:")) result.line = std::atoi(result.message.c_str() + 2);
  }
  lua_settop(lua, 0);
  return result;
}

std::string Lua::code(std::string_view text) {
  lua_State* lua = state_.get();
  std::string code;
  const auto append = [](lua_State*, const void* bytes, size_t size, void* out) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(bytes), size);
    return 0;
  };
  const std::string_view body = without_first_line(text);
  if (luaL_loadbufferx(lua, body.data(), body.size(), "=t", "t") == LUA_OK) lua_dump(lua, append, &code, 1);
  lua_settop(lua, 0);
  return code;
}

Lua::Value Lua::literal(std::string_view literal) {
  lua_State* lua = state_.get();
  const std::string text = "return " + std::string(literal);
  Value value;
  if (luaL_loadbufferx(lua, text.data(), text.size(), "=t", "t") == LUA_OK && lua_pcall(lua, 0, 1, 0) == LUA_OK) {
    if (lua_isinteger(lua, -1)) {
      value = lua_tointeger(lua, -1);
    } else if (lua_type(lua, -1) == LUA_TNUMBER) {
      value = lua_tonumber(lua, -1);
    } else if (lua_type(lua, -1) == LUA_TSTRING) {
      size_t size = 0;
      const char* bytes = lua_tolstring(lua, -1, &size);
      value = std::string(bytes, size);
    }
  }
  lua_settop(lua, 0);
  return value;
}

} // namespace moonshade::test
