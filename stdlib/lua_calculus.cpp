// Central differences (lua_calculus.h).
#include "stdlib/lua_calculus.h"

#include "stdlib/lua_vector.h"

#include <cmath>

namespace moonshade {
namespace {

/// The stencil of the eighth order: f'(x) h = sum of c[i] (f(x + (i+1) h) - f(x - (i+1) h)).
constexpr double kStencil[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
/// For |x| <= 1; a power of two, so that x + h is what it says. Cancellation costs 2^-53 / h, the stencil h^8
/// f^(9)/630.
constexpr double kStep = 0x1p-15;

/// The point: 1 to 4 numbers; a number, not a vector, where `size` is 0.
struct Point {
  double at[4];
  unsigned size;
  unsigned count() const { return size == 0 ? 1 : size; }
};

void push(lua_State* state, const Point& point) {
  if (point.size == 0)
    lua_pushnumber(state, point.at[0]);
  else
    push_vector(state, std::span(point.at, point.size));
}

Point point_at(lua_State* state, int index, const char* function) {
  const LuaValue value = lua_value(state, index);
  if (!value.is_scalar() && value.size() == 0)
    luaL_error(state, "bad argument #%d 'p' to '%s' (number or vector expected, got %s)", index, function,
               lua_type_name(state, index));
  Point point{{}, value.size()};
  for (unsigned i = 0; i < point.count(); ++i)
    point.at[i] = value.at(i);
  return point;
}

/// f(point), f being the first argument.
double call(lua_State* state, const Point& point, const char* function) {
  lua_pushvalue(state, 1);
  push(state, point);
  lua_call(state, 1, 1);
  const LuaValue value = lua_value(state, -1);
  if (!value.is_scalar())
    luaL_error(state, "'%s' takes a function that gives a number, not %s", function, lua_type_name(state, -1));
  const double result = value.at(0);
  lua_pop(state, 1);
  return result;
}

Point gradient(lua_State* state, const char* function) {
  if (lua_type(state, 1) != LUA_TFUNCTION)
    luaL_error(state, "bad argument #1 'f' to '%s' (function expected, got %s)", function, lua_type_name(state, 1));
  luaL_checkstack(state, 4, "too many gradients in one another");
  const Point p = point_at(state, 2, function);
  Point result{{}, p.size};
  for (unsigned i = 0; i < p.count(); ++i) {
    const double size = std::abs(p.at[i]);
    const double h = size > 1 && std::isfinite(size) ? std::ldexp(kStep, std::ilogb(size)) : kStep;
    for (int k = 0; k < 4; ++k) {
      Point above = p, below = p;
      above.at[i] += (k + 1) * h;
      below.at[i] -= (k + 1) * h;
      const double rise = call(state, above, function) - call(state, below, function);
      result.at[i] += kStencil[k] * rise;
    }
    result.at[i] /= h;
  }
  return result;
}

} // namespace

int lua_gradient(lua_State* state) {
  push(state, gradient(state, "gradient"));
  return 1;
}

int lua_fwidth(lua_State* state) {
  const Point g = gradient(state, "fwidth");
  const LuaValue width = lua_value(state, 3);
  if (!width.is_scalar())
    luaL_error(state, "bad argument #3 'fw' to 'fwidth' (number expected, got %s)", lua_type_name(state, 3));
  double square = 0;
  for (unsigned i = 0; i < g.count(); ++i)
    square += g.at[i] * g.at[i];
  lua_pushnumber(state, std::sqrt(square) * std::abs(width.at(0)));
  return 1;
}

} // namespace moonshade
