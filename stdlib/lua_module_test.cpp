// The module in an embedded stock Lua: its functions against direct calls, vectors, parameters, and every error.
#include "stdlib/lua_module.h"

#include "stdlib/fractal.h"
#include "stdlib/geometry.h"
#include "stdlib/library.h"
#include "stdlib/lua_vector.h"
#include "stdlib/perlin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lua.hpp>

#include <memory>
#include <string>

namespace moonshade {
namespace {

using testing::HasSubstr;

class LuaModule : public testing::Test {
protected:
  LuaModule() : owner_(luaL_newstate(), lua_close), lua_(owner_.get()) {
    luaL_openlibs(lua_);
    luaL_requiref(lua_, "moonshade", luaopen_moonshade, 0);
    lua_setglobal(lua_, "module");
  }

  /// Runs a chunk; its first result as tostring gives it, or the error's message.
  std::string run(const std::string& chunk) {
    lua_settop(lua_, 0);
    if (luaL_loadbuffer(lua_, chunk.data(), chunk.size(), "=chunk") != LUA_OK || lua_pcall(lua_, 0, 1, 0) != LUA_OK)
      return "error: " + std::string(lua_tostring(lua_, -1));
    return luaL_tolstring(lua_, -1, nullptr);
  }
  std::string value(const std::string& expression) { return run("return " + expression); }
  double number(const std::string& expression) {
    std::string text = value(expression);
    EXPECT_EQ(lua_type(lua_, 1), LUA_TNUMBER) << expression << " is " << text;
    return lua_tonumber(lua_, 1);
  }

  std::unique_ptr<lua_State, void (*)(lua_State*)> owner_;
  lua_State* lua_;
};

TEST_F(LuaModule, SetsGlobalsAndReturnsThem) {
  for (const LibraryFunction& row : library()) {
    std::string name(row.name);
    if (name.starts_with("op.") || name.starts_with("math.")) continue;
    EXPECT_EQ(value("type(" + name + ") == 'function' and module." + name + " == " + name), "true") << name;
  }
  EXPECT_EQ(value("module.vec3 == vec3 and module.param == param and rgb ~= nil"), "true");
  EXPECT_EQ(value("math.sin(0) == 0 and print ~= nil"), "true") << "Lua's own libraries stay";
}

TEST_F(LuaModule, CallsTheSameBodies) {
  using namespace stdlib;
  Vec<3, double> p = {{0.3, -1.7, 2.9}};
  Vec<2, double> q = {{0.3, -1.7}};
  EXPECT_EQ(number("noise(vec3(0.3, -1.7, 2.9))"), noise<double>(p));
  EXPECT_EQ(number("noise(vec2(0.3, -1.7))"), noise<double>(q));
  EXPECT_EQ(number("noise(0.3)"), noise<double>(0.3));
  EXPECT_EQ(number("perlin(vec3(0.3, -1.7, 2.9))"), perlin<double>(p));
  EXPECT_EQ(number("turbulence(vec3(0.3, -1.7, 2.9))"), (turbulence<double>(p, 6.0, 2.0, 0.5, 0.0))) << "defaults";
  EXPECT_EQ(number("turbulence(vec3(0.3, -1.7, 2.9), 3)"), (turbulence<double>(p, 3.0, 2.0, 0.5, 0.0)));
  EXPECT_EQ(number("fbm(vec2(0.3, -1.7), 4, 2.1, 0.4)"), (fbm<double>(q, 4.0, 2.1, 0.4, 0.0)));
  EXPECT_EQ(number("hash(5)"), hash<double>(5.0));
  EXPECT_EQ(number("hash(5.0)"), hash<double>(5.0));
  EXPECT_EQ(number("hash(math.maxinteger)"), hash_of_integer<double>(INT64_MAX));
  EXPECT_EQ(number("smoothstep(0, 1, 0.3)"), smoothstep(0.0, 1.0, 0.3));
  EXPECT_EQ(number("atan(1, -1)"), stdlib::atan2(1.0, -1.0));
  EXPECT_EQ(number("atan(2)"), stdlib::atan(2.0));
  EXPECT_EQ(number("length(vec4(1, 2, 3, 4))"), (length<double>(Vec<4, double>{{1, 2, 3, 4}})));
}

TEST_F(LuaModule, GivesNumbersForIntegers) {
  EXPECT_EQ(value("max(1, 2)"), "2.0");
  EXPECT_EQ(value("math.type(floor(1))"), "float");
  EXPECT_EQ(value("clamp(7, 0, 5)"), "5.0");
}

TEST_F(LuaModule, WorksByComponent) {
  EXPECT_EQ(value("abs(vec3(-1, 2, -0.5))"), "vec3(1.0, 2.0, 0.5)");
  EXPECT_EQ(value("mix(vec2(0, 1), vec2(1, 3), 0.5)"), "vec2(0.5, 2.0)");
  EXPECT_EQ(value("max(0, vec4(-1, 1, -2, 2))"), "vec4(0.0, 1.0, 0.0, 2.0)");
  EXPECT_EQ(value("smoothstep(0.0, vec2(1, 2), 1)"), "vec2(1.0, 0.5)");
}

TEST_F(LuaModule, HasMethodsOfVectors) {
  EXPECT_EQ(value("vec3(1, 2, 2):length()"), "3.0");
  EXPECT_EQ(value("vec3(0, 3, 0):normalize()"), "vec3(0.0, 1.0, 0.0)");
  EXPECT_EQ(value("vec3(1, 0, 0):dot(vec3(2, 5, 5))"), "2.0");
  EXPECT_EQ(value("vec2(0.5, 1):noise() == noise(vec2(0.5, 1))"), "true");
  EXPECT_THAT(value("vec3(1):nothing()"), HasSubstr("vec3 has no component or method 'nothing'"));
}

TEST_F(LuaModule, MethodsStayWhereTheGlobalIsShadowed) {
  EXPECT_EQ(run("length = nil return vec2(3, 4):length()"), "5.0");
}

// Vectors
// ---------------------------------------------------------------------------------------------------------------

TEST_F(LuaModule, ConstructsVectors) {
  EXPECT_EQ(value("vec3(1, 2.5, 3)"), "vec3(1.0, 2.5, 3.0)");
  EXPECT_EQ(value("vec4(7)"), "vec4(7.0, 7.0, 7.0, 7.0)");
  EXPECT_EQ(value("vec4(vec2(1, 2), 3, 4)"), "vec4(1.0, 2.0, 3.0, 4.0)");
  EXPECT_EQ(value("vec3(1, vec2(2, 3))"), "vec3(1.0, 2.0, 3.0)");
  EXPECT_EQ(value("vec2(vec2(1, 2))"), "vec2(1.0, 2.0)");
  EXPECT_EQ(value("rgb(0.25, 0.5, 1)"), "vec3(0.25, 0.5, 1.0)");
  EXPECT_THAT(value("vec3(1, 2)"), HasSubstr("chunk:1: 'vec3' takes 3 components or one number, got 2 components"));
  EXPECT_THAT(value("vec2(vec3(1))"), HasSubstr("'vec2' takes 2 components or one number, got 3"));
  EXPECT_THAT(value("vec2(1, 'x')"), HasSubstr("bad argument #2 to 'vec2' (number or vector expected, got string)"));
  EXPECT_THAT(value("rgb()"), HasSubstr("'rgb' takes 3 components"));
}

TEST_F(LuaModule, ReadsComponents) {
  EXPECT_EQ(value("vec4(1, 2, 3, 4).w"), "4.0");
  EXPECT_EQ(value("rgb(1, 2, 3).g"), "2.0");
  EXPECT_EQ(value("vec3(1, 2, 3)[1]"), "1.0");
  EXPECT_EQ(value("vec3(1, 2, 3)[3.0]"), "3.0");
  EXPECT_EQ(value("vec3(1, 2, 3).zyx"), "vec3(3.0, 2.0, 1.0)");
  EXPECT_EQ(value("vec2(1, 2).xxyy"), "vec4(1.0, 1.0, 2.0, 2.0)");
  EXPECT_EQ(value("vec4(1, 2, 3, 4).ra"), "vec2(1.0, 4.0)");
  for (const char* wrong : {"vec2(1).z", "vec3(1).w", "vec3(1).xr", "vec3(1).xyzxy", "vec3(1)['']"})
    EXPECT_THAT(value(wrong), HasSubstr("has no component or method")) << wrong;
  for (const char* wrong : {"vec3(1)[0]", "vec3(1)[4]", "vec3(1)[1.5]", "vec3(1)[true]"})
    EXPECT_THAT(value(wrong), HasSubstr("vec3 has no component [")) << wrong;
}

TEST_F(LuaModule, CalculatesByComponent) {
  EXPECT_EQ(value("vec2(1, 2) + vec2(3, 4)"), "vec2(4.0, 6.0)");
  EXPECT_EQ(value("1 - vec2(1, 2)"), "vec2(0.0, -1.0)");
  EXPECT_EQ(value("vec2(1, 2) * 2"), "vec2(2.0, 4.0)");
  EXPECT_EQ(value("2 / vec2(1, 4)"), "vec2(2.0, 0.5)");
  EXPECT_EQ(value("vec2(7, -7) // 2"), "vec2(3.0, -4.0)");
  EXPECT_EQ(value("vec2(7, -7) % 3"), "vec2(1.0, 2.0)");
  EXPECT_EQ(value("vec2(2, 3) ^ 2"), "vec2(4.0, 9.0)");
  EXPECT_EQ(value("2 ^ vec2(2, 3)"), "vec2(4.0, 8.0)");
  EXPECT_EQ(value("-vec3(1, -2, 3)"), "vec3(-1.0, 2.0, -3.0)");
  EXPECT_EQ(value("vec2(1, 2) == vec2(1, 2)"), "true");
  EXPECT_EQ(value("vec2(1, 2) == vec2(1, 3)"), "false");
  EXPECT_EQ(value("vec2(1, 1) == vec3(1, 1, 1)"), "false");
  EXPECT_EQ(value("vec2(0/0) == vec2(0/0)"), "false");
  EXPECT_THAT(value("vec2(1) + vec3(1)"), HasSubstr("chunk:1: '+' of vec2 and vec3"));
  EXPECT_THAT(value("vec2(1) * 'x'"), HasSubstr("'*' of vec2 and string"));
  EXPECT_THAT(value("vec2(1) % nil"), HasSubstr("'%' of vec2 and nil"));
  EXPECT_THAT(value("vec2(1) < vec2(2)"), HasSubstr("attempt to compare two vec2 values"));
}

TEST_F(LuaModule, VectorsCannotBeChanged) {
  EXPECT_THAT(run("local v = vec3(1) v.x = 2"), HasSubstr("chunk:1: a vec3 cannot be changed in place"));
  EXPECT_THAT(run("local v = vec3(1) v[1] = 2"), HasSubstr("cannot be changed in place"));
  EXPECT_EQ(value("getmetatable(vec3(1))"), "false");
}

TEST_F(LuaModule, OtherUserdataAreNoVectors) {
  EXPECT_THAT(value("length(io.stdout)"), HasSubstr("got userdata"));
  EXPECT_THAT(value("vec3(1) + io.stdout"), HasSubstr("'+' of vec3 and userdata"));
}

TEST_F(LuaModule, VectorsPassThroughTheHost) {
  const double components[] = {1, 2, 3};
  push_vector(lua_, components);
  lua_setglobal(lua_, "v");
  EXPECT_EQ(value("v * 2"), "vec3(2.0, 4.0, 6.0)");
  auto found = vector_at(lua_, 1);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[2], 6);
  lua_pushnumber(lua_, 1);
  EXPECT_TRUE(vector_at(lua_, -1).empty());
}

// Errors
// ----------------------------------------------------------------------------------------------------------------

TEST_F(LuaModule, NamesFunctionAndArgument) {
  EXPECT_THAT(value("mix(1, 2)"),
              HasSubstr("chunk:1: bad argument #3 't' to 'mix' (number or vector expected, got no value)"));
  EXPECT_THAT(value("smoothstep(0, {}, 1)"),
              HasSubstr("bad argument #2 'b' to 'smoothstep' (number or vector expected, got table)"));
  EXPECT_THAT(value("noise('0.5')"),
              HasSubstr("bad argument #1 'p' to 'noise' (number, vec2, vec3 or vec4 expected, got string)"));
  EXPECT_THAT(value("dot(vec3(1), vec2(1))"), HasSubstr("bad argument #2 'b' to 'dot' (vec3 expected, got vec2)"));
  EXPECT_THAT(value("cross(1, 2)"), HasSubstr("bad argument #1 'a' to 'cross' (vec3 expected, got integer)"));
  EXPECT_THAT(value("mix(1, 2, 3, 4)"), HasSubstr("too many arguments to 'mix' (at most 3, got 4)"));
  EXPECT_THAT(value("mix(1, 2, 3, 4, 5, 6, 7, 8, 9, 10)"),
              HasSubstr("too many arguments to 'mix' (at most 3, got 10)"));
  EXPECT_THAT(value("mix(vec2(1), vec3(1), 0)"),
              HasSubstr("the arguments of 'mix' do not fit each other: vec2, vec3, integer"));
  EXPECT_THAT(value("sin(nil)"), HasSubstr("bad argument #1 'x' to 'sin' (number or vector expected, got nil)"));
  EXPECT_THAT(value("fbm(vec2(1), vec2(1))"),
              HasSubstr("bad argument #2 'octaves' to 'fbm' (number expected, got vec2)"));
}

// Parameters
// --------------------------------------------------------------------------------------------------------------

TEST_F(LuaModule, ParametersHaveDefaultsAndOverrides) {
  EXPECT_EQ(value("param('scale', 4.0)"), "4.0");
  lua_pushinteger(lua_, 2);
  override_parameter(lua_, "scale");
  EXPECT_EQ(value("param('scale', 4.0, { min = 1 })"), "2.0") << "an integer for a number";
  EXPECT_EQ(value("param('other', vec2(1))"), "vec2(1.0, 1.0)");
  const double tint[] = {0.5, 0.25, 1};
  push_vector(lua_, tint);
  override_parameter(lua_, "tint");
  EXPECT_EQ(value("param('tint', rgb(1, 1, 1), { doc = 'colour' })"), "vec3(0.5, 0.25, 1.0)");
  lua_pushboolean(lua_, false);
  override_parameter(lua_, "on");
  EXPECT_EQ(value("param('on', true)"), "false");
}

TEST_F(LuaModule, ParametersAreChecked) {
  lua_pushnumber(lua_, 0.5);
  override_parameter(lua_, "scale");
  EXPECT_THAT(value("param('scale', 4)"), HasSubstr("parameter 'scale' takes integer, not number"));
  EXPECT_THAT(value("param('scale', vec2(1))"), HasSubstr("parameter 'scale' takes vec2, not number"));
  EXPECT_THAT(value("param('scale', 4.0, { min = 1 })"), HasSubstr("parameter 'scale' is 0.5, below its minimum of 1"));
  EXPECT_THAT(value("param('scale', 4.0, { max = 0.25 })"),
              HasSubstr("parameter 'scale' is 0.5, above its maximum of 0.25"));
  EXPECT_THAT(value("param('scale')"), HasSubstr("'param' takes a name, a default and a table"));
  EXPECT_THAT(value("param(1, 2)"), HasSubstr("'param' takes a name, a default and a table"));
}

} // namespace
} // namespace moonshade
