// C functions here hold no C++ objects: a Lua error may leave them at any call (liblua5.4 uses longjmp).
#include "renderer/scene/lua_sandbox.h"

#include "renderer/scene/nearest_name.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <lua.hpp>

namespace moonshade::renderer {

namespace {

struct Budget {
  size_t used = 0, limit = 0;
  uint64_t instructions_left = 0;
  size_t calls_left = 0;
  double end = 0; ///< in seconds of this thread
  uint32_t entered = 0;
  int line = 0;              ///< that was seen to run last
  bool is_exhausted = false; ///< memory was refused
};

/// Processor time of this thread.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

void* allocate(void* user, void* block, size_t old_size, size_t new_size) {
  Budget& budget = *static_cast<Budget*>(user);
  if (!block) old_size = 0;
  if (new_size > old_size && budget.used + (new_size - old_size) > budget.limit) {
    budget.is_exhausted = true; // Lua collects its garbage and asks once more
    return nullptr;
  }
  if (new_size == 0) {
    std::free(block);
    budget.used -= old_size;
    return nullptr;
  }
  void* moved = std::realloc(block, new_size);
  if (moved) budget.used = budget.used - old_size + new_size;
  return moved;
}

constexpr int kHookInterval = 1000;

Budget& budget_of(lua_State* L) {
  void* user = nullptr;
  lua_getallocf(L, &user);
  return *static_cast<Budget*>(user);
}

constexpr uint32_t kEnteredInterval = 16;

/// The innermost level from `level` on that is a line of the scene, which `where` then tells; or `level`.
int level_of_line(lua_State* L, int level, lua_Debug& where) {
  for (int at = level; lua_getstack(L, at, &where); ++at)
    if (lua_getinfo(L, "l", &where) && where.currentline > 0) return at;
  where.currentline = 0;
  return level;
}

[[noreturn]] void end_run(lua_State* L, int level, const char* limit) {
  luaL_where(L, level);
  lua_pushfstring(L, "the scene runs too long (%s limit)", limit);
  lua_concat(L, 2);
  lua_error(L);
  std::abort();
}

/// Every so many instructions and calls. (One call of the library counts as one instruction, however long it takes:
/// that is what the clock is for.)
void watch(lua_State* L, lua_Debug* event) {
  Budget& budget = budget_of(L);
  const bool is_call = event->event != LUA_HOOKCOUNT;
  lua_Debug where;
  const int level = level_of_line(L, is_call ? 1 : 0, where); // what runs, not what it calls
  if (where.currentline > 0) budget.line = where.currentline;
  if (!is_call) {
    if (budget.instructions_left < kHookInterval) end_run(L, level, "instruction");
    budget.instructions_left -= kHookInterval;
  } else if (++budget.entered % kEnteredInterval != 0) {
    return;
  }
  if (thread_seconds() > budget.end) end_run(L, level, "time");
}

const char kCalls = 0;   // registry key: list of recorded calls
const char kHandles = 0; // registry key: table -> index of its call
const char kPrinted = 0; // registry key: list of printed lines

/// `name{ fields }`: appends { function, line, shallow copy of the fields } to the list; gives the table back.
int record(lua_State* L) {
  const char* name = lua_tostring(L, lua_upvalueindex(2));
  if (lua_gettop(L) != 1 || lua_type(L, 1) != LUA_TTABLE)
    return luaL_error(L, "'%s' takes one table: %s{ field = value, ... }", name, name);
  Budget& budget = budget_of(L);
  if (budget.calls_left-- == 0) return luaL_error(L, "the scene describes too many things");
  lua_Debug where;
  int line = lua_getstack(L, 1, &where) && lua_getinfo(L, "l", &where) ? where.currentline : 0;
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kCalls);
  lua_Integer index = lua_Integer(lua_rawlen(L, -1)) + 1;
  lua_createtable(L, 3, 0);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_rawseti(L, -2, 1);
  lua_pushinteger(L, line);
  lua_rawseti(L, -2, 2);
  lua_newtable(L);
  for (lua_pushnil(L); lua_next(L, 1);) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, -4);
  }
  lua_rawseti(L, -2, 3);
  lua_rawseti(L, -2, index);
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kHandles);
  lua_pushvalue(L, 1);
  lua_pushinteger(L, index - 1);
  lua_rawset(L, -3);
  lua_settop(L, 1);
  return 1;
}

int print_line(lua_State* L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kPrinted);
  lua_Integer count = lua_Integer(lua_rawlen(L, -1));
  if (count >= 100) return 0;
  int arguments = lua_gettop(L) - 1;
  lua_pushliteral(L, "");
  for (int i = 1; i <= arguments; ++i) {
    if (i > 1) lua_pushliteral(L, "\t"), lua_concat(L, 2);
    luaL_tolstring(L, i, nullptr);
    lua_concat(L, 2);
  }
  lua_rawseti(L, -2, count + 1);
  return 0;
}

int vector(lua_State* L) {
  int count = lua_gettop(L);
  lua_createtable(L, count, 0);
  for (int i = 1; i <= count; ++i) {
    lua_pushvalue(L, i);
    lua_rawseti(L, -2, i);
  }
  return 1;
}

/// `string.rep`, whose copies of nothing would take the whole range of integers.
int repeat(lua_State* L) {
  size_t length = 0, separator = 0;
  luaL_checklstring(L, 1, &length);
  luaL_optlstring(L, 3, "", &separator);
  if (length + separator == 0) return lua_pushliteral(L, ""), 1;
  return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

/// `table.insert` and `table.remove`: of a table with holes Lua may give a length of up to 2^63, over which they loop.
int change_list(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  constexpr size_t kMostItems = size_t(1) << 24; // more fit into no sandbox
  if (lua_rawlen(L, 1) > kMostItems) return luaL_error(L, "the table is too long, or has holes");
  return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

/// Puts `function`, which has the original as its upvalue, in the place of a library's function.
void guard(lua_State* L, const char* library, const char* name, lua_CFunction function) {
  lua_getglobal(L, library);
  lua_getfield(L, -1, name);
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
}

// Keys in an order that does not depend on addresses, so that a scene built with `pairs` is the same every time.
const char kSortedPairs[] = R"(
local next, sort, type = next, table.sort, type
function pairs(t)
  local keys = {}
  for k in next, t do keys[#keys + 1] = k end
  sort(keys, function(a, b)
    local ta, tb = type(a), type(b)
    if ta ~= tb then return ta < tb end
    if ta == "number" or ta == "string" then return a < b end
    return false
  end)
  local i = 0
  return function()
    i = i + 1
    local k = keys[i]
    if k ~= nil then return k, t[k] end
  end
end
_G.next = nil
)";

void remove(lua_State* L, const char* library, std::span<const char* const> names) {
  if (library)
    lua_getglobal(L, library);
  else
    lua_pushglobaltable(L);
  for (const char* name : names) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
  }
  lua_pop(L, 1);
}

struct SetUp {
  std::span<const std::string_view> functions;
  const SandboxConstants* constants;
};

int set_up(lua_State* L) {
  const SetUp& facts = *static_cast<const SetUp*>(lua_touserdata(L, 1));
  luaL_requiref(L, "_G", luaopen_base, 1);
  luaL_requiref(L, LUA_MATHLIBNAME, luaopen_math, 1);
  luaL_requiref(L, LUA_STRLIBNAME, luaopen_string, 1);
  luaL_requiref(L, LUA_TABLIBNAME, luaopen_table, 1);
  lua_settop(L, 0);
  static const char* const kBase[] = {"load",         "loadfile", "dofile", "collectgarbage", "setmetatable",
                                      "getmetatable", "pcall",    "xpcall", "rawset",         "rawget",
                                      "rawequal",     "rawlen",   "warn"};
  static const char* const kString[] = {"find", "match", "gmatch", "gsub", "dump", "pack", "unpack", "packsize"};
  static const char* const kTable[] = {"move"};
  remove(L, nullptr, kBase);
  remove(L, LUA_STRLIBNAME, kString);
  remove(L, LUA_TABLIBNAME, kTable);
  guard(L, LUA_STRLIBNAME, "rep", repeat);
  guard(L, LUA_TABLIBNAME, "insert", change_list);
  guard(L, LUA_TABLIBNAME, "remove", change_list);
  for (const char* key : {&kCalls, &kHandles, &kPrinted}) {
    lua_newtable(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, key);
  }
  // Lua 5.4 seeds math.random at random; a scene is the same every time.
  lua_getglobal(L, LUA_MATHLIBNAME);
  lua_getfield(L, -1, "randomseed");
  lua_pushinteger(L, 0);
  lua_call(L, 1, 0);
  lua_settop(L, 0);
  if (luaL_loadbufferx(L, kSortedPairs, sizeof kSortedPairs - 1, "=pairs", "t") != LUA_OK) return lua_error(L);
  lua_call(L, 0, 0);
  lua_register(L, "print", print_line);
  for (const char* name : {"vec2", "vec3", "rgb"})
    lua_register(L, name, vector);
  for (size_t i = 0; i < facts.functions.size(); ++i) {
    lua_pushinteger(L, lua_Integer(i));
    lua_pushlstring(L, facts.functions[i].data(), facts.functions[i].size());
    lua_pushcclosure(L, record, 2);
    lua_pushlstring(L, facts.functions[i].data(), facts.functions[i].size());
    lua_insert(L, -2);
    lua_pushglobaltable(L);
    lua_insert(L, -3);
    lua_rawset(L, -3);
    lua_pop(L, 1);
  }
  for (const auto& [name, value] : *facts.constants) {
    if (const auto* integer = std::get_if<int64_t>(&value))
      lua_pushinteger(L, *integer);
    else
      lua_pushnumber(L, std::get<double>(value));
    lua_setglobal(L, name.c_str());
  }
  return 0;
}

/// Reads a finished Lua state into plain data. No call here can raise an error (nothing is allocated in Lua).
class Exporter {
public:
  explicit Exporter(lua_State* L) : L_(L) {}

  /// The table at the top of the stack into `fields` and `items`.
  bool table(SceneValue::Fields& fields, SceneValue::List& items, int depth) {
    size_t length = lua_rawlen(L_, -1);
    if (depth > 16 || length > 10'000'000 || !lua_checkstack(L_, 4)) return false;
    for (size_t i = 1; i <= length; ++i) {
      lua_rawgeti(L_, -1, lua_Integer(i));
      bool ok = value(items.emplace_back(), depth + 1);
      lua_pop(L_, 1);
      if (!ok) return false;
    }
    for (lua_pushnil(L_); lua_next(L_, -2);) {
      bool ok = true;
      if (lua_type(L_, -2) == LUA_TSTRING) {
        size_t size = 0;
        const char* key = lua_tolstring(L_, -2, &size);
        ok = value(fields[std::string(key, size)], depth + 1);
      } else if (!lua_isinteger(L_, -2) || lua_tointeger(L_, -2) < 1 || size_t(lua_tointeger(L_, -2)) > length) {
        ok = false;
      }
      lua_pop(L_, 1);
      if (!ok) return lua_pop(L_, 1), false;
    }
    return true;
  }

private:
  bool value(SceneValue& out, int depth) {
    if (values_left_-- == 0) return false; // tables that stand in many places are many values
    switch (lua_type(L_, -1)) {
    case LUA_TNIL:
      return true;
    case LUA_TBOOLEAN:
      out.value = lua_toboolean(L_, -1) != 0;
      return true;
    case LUA_TNUMBER:
      if (lua_isinteger(L_, -1))
        out.value = int64_t(lua_tointeger(L_, -1));
      else
        out.value = double(lua_tonumber(L_, -1));
      return true;
    case LUA_TSTRING: {
      size_t size = 0;
      const char* text = lua_tolstring(L_, -1, &size);
      out.value = std::string(text, size);
      return true;
    }
    case LUA_TTABLE:
      break;
    default:
      return false; // a function
    }
    lua_rawgetp(L_, LUA_REGISTRYINDEX, &kHandles);
    lua_pushvalue(L_, -2);
    lua_rawget(L_, -2);
    if (lua_isinteger(L_, -1)) out.call = lua_tointeger(L_, -1);
    lua_pop(L_, 2);
    if (out.call >= 0) return true; // its fields stand in the recorded call
    SceneValue::Fields fields;
    SceneValue::List items;
    if (!table(fields, items, depth)) return false;
    if (!fields.empty() && !items.empty()) return false;
    if (!items.empty() || fields.empty())
      out.value = std::move(items);
    else
      out.value = std::move(fields);
    return true;
  }
  lua_State* L_;
  size_t values_left_ = 5'000'000;
};

/// What Lua's own loader passes over: a byte order mark, and a first line that begins with '#' (but for its end, so
/// that lines keep their numbers).
std::string_view without_head(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.starts_with('#')) text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
  return text;
}

std::string error_text(lua_State* L, std::span<const std::string_view> functions) {
  const char* raw = lua_tostring(L, -1);
  std::string text = raw ? raw : "the scene raised an error that is no string";
  // "attempt to call a nil value (global 'sphre')"
  size_t at = text.find("(global '");
  if (at == std::string::npos) return text;
  std::string name = text.substr(at + 9, text.find('\'', at + 9) - at - 9);
  return text + did_you_mean(name, functions);
}

} // namespace

SandboxRun run_scene_file(const std::string& name, std::string_view text, std::span<const std::string_view> functions,
                          const SandboxConstants& constants, const SandboxLimits& limits) {
  SandboxRun run;
  Budget budget{0, limits.memory_bytes, limits.instructions, limits.calls, thread_seconds() + limits.seconds, 0};
  lua_State* L = lua_newstate(allocate, &budget);
  if (!L) return run.error = name + ": not enough memory", run;
  SetUp facts{functions, &constants};
  lua_pushcfunction(L, set_up);
  lua_pushlightuserdata(L, &facts);
  std::string chunk_name = "@" + name;
  bool ok = lua_pcall(L, 1, 0, 0) == LUA_OK;
  lua_sethook(L, watch, LUA_MASKCOUNT | LUA_MASKCALL, kHookInterval);
  text = without_head(text);
  ok = ok && luaL_loadbufferx(L, text.data(), text.size(), chunk_name.c_str(), "t") == LUA_OK;
  const int status = ok ? lua_pcall(L, 0, 0, 0) : LUA_ERRSYNTAX;
  ok = status == LUA_OK;
  lua_sethook(L, nullptr, 0, 0);
  if (!ok) run.error = error_text(L, functions);
  if (status == LUA_ERRMEM && budget.is_exhausted) {
    const std::string line = budget.line > 0 ? ":" + std::to_string(budget.line) : "";
    run.error = name + line + ": the scene takes more than " + std::to_string(limits.memory_bytes >> 20) +
                " MiB while it is read (memory limit)";
  }
  if (!ok && run.error.find(name) != 0) run.error = name + ": " + run.error;
  budget.limit = SIZE_MAX;
  lua_settop(L, 0);

  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kPrinted) == LUA_TTABLE)
    for (size_t i = 1, n = lua_rawlen(L, -1); i <= n; ++i, lua_settop(L, 1)) {
      lua_rawgeti(L, -1, lua_Integer(i));
      size_t length = 0;
      const char* text = lua_tolstring(L, -1, &length);
      run.printed.emplace_back(text, length);
    }
  lua_settop(L, 0);
  if (ok && lua_rawgetp(L, LUA_REGISTRYINDEX, &kCalls) == LUA_TTABLE) {
    Exporter exporter(L);
    for (size_t i = 1, n = lua_rawlen(L, 1); i <= n && run.error.empty(); ++i, lua_settop(L, 1)) {
      SceneCall call;
      lua_rawgeti(L, 1, lua_Integer(i));
      lua_rawgeti(L, 2, 1);
      call.function = size_t(lua_tointeger(L, -1));
      lua_rawgeti(L, 2, 2);
      call.line = uint32_t(lua_tointeger(L, -1));
      lua_rawgeti(L, 2, 3);
      if (!exporter.table(call.fields, call.items, 0))
        run.error = name + ":" + std::to_string(call.line) + ": " + std::string(functions[call.function]) +
                    ": holds a function, a table nested too deeply, a table with both names and places, or too much";
      run.calls.push_back(std::move(call));
    }
  }
  lua_close(L);
  return run;
}

} // namespace moonshade::renderer
