// Differences of stock Lua against closed forms and against the exact derivatives of the library.
#include "stdlib/derivative.h"
#include "stdlib/lua_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lua.hpp>

#include <cmath>
#include <memory>
#include <string>

namespace moonshade {
namespace {

using testing::HasSubstr;

std::string run(const std::string& expression) {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> owner(luaL_newstate(), lua_close);
  lua_State* state = owner.get();
  luaL_openlibs(state);
  luaL_requiref(state, "moonshade", luaopen_moonshade, 0);
  lua_settop(state, 0);
  if (luaL_loadstring(state, ("return " + expression).c_str()) != LUA_OK || lua_pcall(state, 0, 1, 0) != LUA_OK)
    return lua_tostring(state, -1);
  return luaL_tolstring(state, -1, nullptr);
}
double number(const std::string& expression) { return std::stod(run(expression)); }

TEST(LuaCalculus, GivesSlopesAndGradients) {
  EXPECT_NEAR(number("gradient(function(x) return x ^ 3 end, 2)"), 12, 1e-9);
  EXPECT_NEAR(number("gradient(function(x) return math.sin(x) end, 1000.0)"), std::cos(1000.0), 1e-9);
  EXPECT_NEAR(number("gradient(function(p) return p.x * p.y + p.z end, vec3(2, 3, 4)).y"), 2, 1e-11);
  EXPECT_EQ(run("gradient(function(p) return 7 end, vec2(1, 2)) == vec2(0, 0)"), "true");
  EXPECT_NEAR(number("gradient(function(x) return gradient(math.sin, x) end, 0.5)"), -std::sin(0.5), 1e-6);
}

TEST(LuaCalculus, AgreesWithTheExactGradientOfNoise) {
  using namespace stdlib;
  using D = Dual<double, 3>;
  for (double at : {0.3, 1.7, 12.9}) {
    Vec<3, D> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = D::of(at + 0.37 * i);
      p[i].active = 1u << i;
      p[i].d[i] = 1;
    }
    const D exact = noise<D>(p);
    const std::string point =
        "vec3(" + std::to_string(at) + "," + std::to_string(at + 0.37) + "," + std::to_string(at + 0.74) + ")";
    EXPECT_NEAR(number("gradient(noise, " + point + ").x"), exact.d[0], 1e-8);
    EXPECT_NEAR(number("gradient(noise, " + point + ").z"), exact.d[2], 1e-8);
  }
}

TEST(LuaCalculus, GivesTheChangeOverAFootprint) {
  EXPECT_NEAR(number("fwidth(function(p) return 3 * p.x - 4 * p.y end, vec2(1, 1), 0.1)"), 0.5, 1e-10);
}

TEST(LuaCalculus, SaysWhatIsWrong) {
  EXPECT_THAT(run("gradient(3, 4)"), HasSubstr("bad argument #1 'f' to 'gradient' (function expected, got"));
  EXPECT_THAT(run("gradient(noise, true)"), HasSubstr("bad argument #2 'p' to 'gradient' (number or vector expected"));
  EXPECT_THAT(run("gradient(function(p) return p end, vec2(1, 2))"), HasSubstr("a function that gives a number, not"));
  EXPECT_THAT(run("fwidth(noise, 1)"), HasSubstr("bad argument #3 'fw' to 'fwidth' (number expected"));
}

} // namespace
} // namespace moonshade
