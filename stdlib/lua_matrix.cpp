// Matrices in stock Lua: columns by index, and the operators of the language's manual, section 5, by the same bodies as
// compiled code.
#include "stdlib/lua_vector.h"
#include "stdlib/matrix.h"

namespace moonshade {
namespace {

using stdlib::Mat;
using stdlib::Vec;

/// m[1] is the first column; m:inverse(); the methods' table is the first upvalue.
int index_matrix(lua_State* state) {
  const LuaValue matrix = lua_value(state, 1);
  const unsigned size = matrix.columns();
  if (size == 0) luaL_error(state, "attempt to index a %s as a matrix", lua_type_name(state, 1));
  if (lua_type(state, 2) == LUA_TSTRING) {
    lua_pushvalue(state, 2);
    if (lua_rawget(state, lua_upvalueindex(1)) != LUA_TNIL) return 1;
    return luaL_error(state, "%s has no method '%s'", lua_type_name(state, 1), lua_tostring(state, 2));
  }
  int is_integer;
  const lua_Integer index = lua_tointegerx(state, 2, &is_integer);
  if (!is_integer || index < 1 || index > size)
    return luaL_error(state, "%s has no column [%s]", lua_type_name(state, 1), luaL_tolstring(state, 2, nullptr));
  double* column = push_new_vector(state, size);
  for (unsigned i = 0; i < size; ++i)
    column[i] = matrix.components[(index - 1) * size + i];
  return 1;
}

template <int N> Mat<N, double> matrix_at(const double* components) {
  return stdlib::matrix_of<double, N>([&](int row, int column) { return components[column * N + row]; });
}
template <int N> Vec<N, double> vector_at(const double* components) {
  Vec<N, double> v;
  for (int i = 0; i < N; ++i)
    v[i] = components[i];
  return v;
}

template <int N> int multiply(lua_State* state, const LuaValue& a, const LuaValue& b) {
  const Mat<N, double> m = matrix_at<N>(a.components);
  if (b.columns() == 0) {
    const Vec<N, double> product = stdlib::multiply<double>(m, vector_at<N>(b.components));
    double* to = push_new_vector(state, N);
    for (int i = 0; i < N; ++i)
      to[i] = product[i];
    return 1;
  }
  const Mat<N, double> product = stdlib::multiply<double>(m, matrix_at<N>(b.components));
  double* to = push_new_matrix(state, N);
  for (int i = 0; i < N * N; ++i)
    to[i] = product[i / N][i % N];
  return 1;
}

/// Pushes the matrix of operation(a, b) by component, a number standing for each.
template <class F> int by_component(lua_State* state, const LuaValue& a, const LuaValue& b, F operation) {
  const unsigned size = a.columns() != 0 ? a.columns() : b.columns();
  double* to = push_new_matrix(state, size);
  for (unsigned i = 0; i < size * size; ++i)
    to[i] = operation(a.at(i), b.at(i));
  return 1;
}

int multiply_any(lua_State* state) {
  const LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  const unsigned size = a.columns();
  if (size != 0 && (b.columns() == size || b.size() == size))
    return size == 3 ? multiply<3>(state, a, b) : multiply<4>(state, a, b);
  if (!a.is_scalar() && !b.is_scalar()) refuse_operands(state, "*");
  return by_component(state, a, b, [](double x, double y) { return x * y; });
}

int divide(lua_State* state) {
  const LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  if (a.columns() == 0 || !b.is_scalar()) refuse_operands(state, "/");
  return by_component(state, a, b, [](double x, double y) { return x / y; });
}

int add(lua_State* state) {
  const LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  if (a.columns() == 0 || a.columns() != b.columns()) refuse_operands(state, "+");
  return by_component(state, a, b, [](double x, double y) { return x + y; });
}

int subtract(lua_State* state) {
  const LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  if (a.columns() == 0 || a.columns() != b.columns()) refuse_operands(state, "-");
  return by_component(state, a, b, [](double x, double y) { return x - y; });
}

int negate(lua_State* state) {
  const LuaValue a = lua_value(state, 1);
  return by_component(state, a, a, [](double x, double) { return -x; });
}

int equal_matrices(lua_State* state) {
  const LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  bool equal = a.columns() != 0 && a.columns() == b.columns();
  for (unsigned i = 0; equal && i < a.columns() * a.columns(); ++i)
    equal = a.components[i] == b.components[i];
  lua_pushboolean(state, equal);
  return 1;
}

constexpr luaL_Reg kMetamethods[] = {{"__newindex", refuse_assignment},
                                     {"__add", add},
                                     {"__sub", subtract},
                                     {"__mul", multiply_any},
                                     {"__div", divide},
                                     {"__unm", negate},
                                     {"__eq", equal_matrices},
                                     {"__tostring", describe_vector},
                                     {nullptr, nullptr}};

/// One number on the diagonal, or a matrix cut, or grown as the identity is.
int construct_square(lua_State* state, const LuaValue& from, unsigned size) {
  const unsigned columns = from.columns();
  double* result = push_new_matrix(state, size);
  for (unsigned i = 0; i < size * size; ++i) {
    const unsigned column = i / size, row = i % size;
    if (column < columns && row < columns)
      result[i] = from.components[column * columns + row];
    else
      result[i] = column != row ? 0 : columns == 0 ? from.at(0) : 1;
  }
  return 1;
}

/// Numbers and vectors strung together, column by column; or what construct_square takes.
int construct(lua_State* state, const char* name, unsigned size) {
  const int count = lua_gettop(state);
  const LuaValue first = lua_value(state, 1);
  if (count == 1 && (first.is_scalar() || first.columns() != 0)) return construct_square(state, first, size);
  double strung[16] = {};
  unsigned have = 0;
  for (int i = 1; i <= count; ++i) {
    const LuaValue value = lua_value(state, i);
    const unsigned components = value.is_scalar() ? 1 : value.size();
    if (components == 0)
      return luaL_error(state, "bad argument #%d to '%s' (number or vector expected, got %s)", i, name,
                        lua_type_name(state, i));
    for (unsigned k = 0; k < components; ++k, ++have)
      if (have < 16) strung[have] = value.at(k);
  }
  if (have != size * size)
    return luaL_error(state, "'%s' takes %d components or one number, got %d components", name, int(size * size),
                      int(have));
  double* result = push_new_matrix(state, size);
  for (unsigned k = 0; k < size * size; ++k)
    result[k] = strung[k];
  return 1;
}

} // namespace

int construct_mat3(lua_State* state) { return construct(state, "mat3", 3); }
int construct_mat4(lua_State* state) { return construct(state, "mat4", 4); }

void open_matrices(lua_State* state) {
  open_type(state, 9, kMetamethods, index_matrix);
  open_type(state, 16, kMetamethods, index_matrix);
}

} // namespace moonshade
