// The module's functions, made from table.def: for each name one C function that tries the name's rows as the compiler
// does, first with arguments of exactly the rows' types, then with integers as numbers, then by component.
#include "stdlib/lua_module.h"

#include "stdlib/library.h"
#include "stdlib/lua_calculus.h"
#include "stdlib/lua_images.h"
#include "stdlib/lua_sums.h"
#include "stdlib/lua_tables.h"
#include "stdlib/lua_vector.h"
#include "stdlib/signature.h"

#include <cstdio>
#include <iterator>
#include <tuple>

namespace moonshade {
namespace {

using namespace stdlib;
using Kind = LuaValue::Kind;

// The table as types --------------------------------------------------------------------------------------------------

enum Trait { Plain, Componentwise };

#define DEFAULTS(...) __VA_ARGS__ __VA_OPT__(, )
#define FUNCTION(name_, symbol, function, type, defaults_, traits, parameters, doc)                                    \
  MS_ROW(symbol, function, type)                                                                                       \
  struct Facts_##symbol {                                                                                              \
    using Row = Row_##symbol::Of<double>;                                                                              \
    static constexpr std::string_view name = name_;                                                                    \
    static constexpr bool componentwise = traits == Componentwise;                                                     \
    static constexpr double defaults[] = {defaults_ 0.0};                                                              \
    static constexpr unsigned default_count = std::size(defaults) - 1;                                                 \
  };
#include "stdlib/table.def"

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) Facts_##symbol,
using Table = std::tuple<
#include "stdlib/table.def"
    void>;
template <size_t I> using FactsAt = std::tuple_element_t<I, Table>;
constexpr size_t kRowCount = std::tuple_size_v<Table> - 1;

// Values to and from Lua ----------------------------------------------------------------------------------------------

template <class T> struct Argument;
template <> struct Argument<double> {
  static bool fits(const LuaValue& value, bool convert) {
    return value.kind == Kind::Number || (convert && value.kind == Kind::Integer);
  }
  static double read(const LuaValue& value) { return value.at(0); }
};
template <> struct Argument<int64_t> {
  static bool fits(const LuaValue& value, bool) { return value.kind == Kind::Integer; }
  static int64_t read(const LuaValue& value) { return value.integer; }
};
template <int N> struct Argument<Vec<N, double>> {
  static bool fits(const LuaValue& value, bool) { return value.size() == N; }
  static Vec<N, double> read(const LuaValue& value) {
    Vec<N, double> vector;
    for (int i = 0; i < N; ++i)
      vector[i] = value.components[i];
    return vector;
  }
};

template <int N> struct Argument<Mat<N, double>> {
  static bool fits(const LuaValue& value, bool) { return value.columns() == N; }
  static Mat<N, double> read(const LuaValue& value) {
    return matrix_of<double, N>([&](int row, int column) { return value.components[column * N + row]; });
  }
};

void push(lua_State* state, double value) { lua_pushnumber(state, value); }
template <int N> void push(lua_State* state, const Vec<N, double>& value) {
  double* to = push_new_vector(state, N);
  for (int i = 0; i < N; ++i)
    to[i] = value[i];
}

template <int N> void push(lua_State* state, const Mat<N, double>& value) {
  double* to = push_new_matrix(state, N);
  for (int i = 0; i < N * N; ++i)
    to[i] = value[i / N][i % N];
}

// Calls ---------------------------------------------------------------------------------------------------------------

constexpr unsigned kMaxArguments = LibraryFunction::kMaxParameters;

/// The arguments of a call; room for defaults behind those given.
struct Arguments {
  LuaValue values[kMaxArguments];
  unsigned count;
};

/// One row, with its parameters.
template <class Facts, class... P> struct RowCall {
  static constexpr unsigned kCount = sizeof...(P);
  using Indices = std::make_index_sequence<kCount>;

  static bool fill_defaults(Arguments& arguments) {
    constexpr unsigned required = kCount - Facts::default_count;
    if (arguments.count < required || arguments.count > kCount) return false;
    for (unsigned i = arguments.count; i < kCount; ++i) {
      arguments.values[i].kind = Kind::Number;
      arguments.values[i].number = Facts::defaults[i - required];
    }
    return true;
  }

  /// Calls the row if the arguments fit, and pushes its results; false where they do not.
  static bool call(lua_State* state, Arguments& arguments, bool convert) {
    return fill_defaults(arguments) && [&]<size_t... I>(std::index_sequence<I...>) {
      if (!(Argument<P>::fits(arguments.values[I], convert) && ...)) return false;
      for_each_result(Facts::Row::call(Argument<P>::read(arguments.values[I])...),
                      [&](const auto& result) { push(state, result); });
      return true;
    }(Indices());
  }

  /// The same, by component: all vectors of one size, the rest scalars.
  static bool call_by_component(lua_State* state, Arguments& arguments) {
    if constexpr (!Facts::componentwise) {
      return false;
    } else {
      if (!fill_defaults(arguments)) return false;
      unsigned size = common_size(arguments.values);
      if (size == 0) return false;
      double* to = push_new_vector(state, size);
      [&]<size_t... I>(std::index_sequence<I...>) {
        for (unsigned k = 0; k < size; ++k)
          to[k] = Facts::Row::call(arguments.values[I].at(k)...);
      }(Indices());
      return true;
    }
  }

private:
  /// The size of all vectors among the arguments; 0 where there is none, or another kind, or different sizes.
  static unsigned common_size(const LuaValue* values) {
    unsigned size = 0;
    for (unsigned i = 0; i < kCount; ++i) {
      if (values[i].is_scalar()) continue;
      if (values[i].size() == 0 || (size != 0 && values[i].size() != size)) return 0;
      size = values[i].size();
    }
    return size;
  }
};

template <class Facts> struct RowCallOf {
  template <class... P> using With = RowCall<Facts, P...>;
  using Type = typename Signature<typename Facts::Row::Type>::template Parameters<With>;
};

// Errors --------------------------------------------------------------------------------------------------------------

/// A message of bounded length, put together without allocation.
class Message {
public:
  template <class... A> void add(const char* format, A... arguments) {
    if (length_ < sizeof text_) length_ += std::snprintf(text_ + length_, sizeof text_ - length_, format, arguments...);
  }
  [[noreturn]] void raise(lua_State* state) const {
    luaL_where(state, 1);
    lua_pushstring(state, text_);
    lua_concat(state, 2);
    lua_error(state);
    __builtin_unreachable();
  }

private:
  char text_[400] = "";
  size_t length_ = 0;
};

bool takes(const LibraryFunction& row, unsigned parameter, const LuaValue& value) {
  switch (row.parameters[parameter]) {
  case ValueType::Number:
    return value.is_scalar() || (row.componentwise && value.size() != 0);
  case ValueType::Integer:
    return value.kind == Kind::Integer;
  case ValueType::Boolean:
    return value.kind == Kind::Boolean;
  case ValueType::Mat3:
  case ValueType::Mat4:
    return value.columns() != 0 && matrix_type(value.columns()) == row.parameters[parameter];
  default:
    return value.size() != 0 && vector_type(value.size()) == row.parameters[parameter];
  }
}

/// How many of the arguments the row takes; more than were given where it misses some.
unsigned taken(const LibraryFunction& row, const Arguments& arguments) {
  unsigned i = 0;
  while (i < arguments.count && i < row.parameter_count && takes(row, i, arguments.values[i]))
    ++i;
  return i;
}

/// The name of a parameter, from the row's list.
std::string_view parameter_name(const LibraryFunction& row, unsigned index) {
  std::string_view names = row.parameter_names;
  for (; index > 0; --index)
    names.remove_prefix(names.find(' ') + 1);
  return names.substr(0, names.find(' '));
}

/// What the rows that get furthest expect there: "number or vector", "vec2, vec3 or vec4".
void add_expected(Message& message, std::span<const LibraryFunction> rows, const Arguments& arguments, unsigned at) {
  const char* names[8];
  unsigned count = 0;
  auto add = [&](const char* name) {
    for (unsigned i = 0; i < count; ++i)
      if (std::string_view(names[i]) == name) return;
    if (count < std::size(names)) names[count++] = name;
  };
  for (const LibraryFunction& row : rows) {
    if (at >= row.parameter_count || taken(row, arguments) < at) continue;
    add(name_of(row.parameters[at]).data());
    if (row.componentwise) add("vector");
  }
  for (unsigned i = 0; i < count; ++i)
    message.add("%s%s", i == 0 ? "" : i + 1 == count ? " or " : ", ", names[i]);
}

/// No row takes the arguments: says which is wrong.
[[noreturn]] void refuse(lua_State* state, std::span<const LibraryFunction> rows, const Arguments& arguments) {
  const LibraryFunction* furthest = &rows[0];
  for (const LibraryFunction& row : rows)
    if (taken(row, arguments) > taken(*furthest, arguments)) furthest = &row;
  unsigned at = taken(*furthest, arguments);
  Message message;
  const char* name = rows[0].name.data();
  if (at < furthest->parameter_count && (at < arguments.count || at < furthest->required_count)) {
    std::string_view parameter = parameter_name(*furthest, at);
    message.add("bad argument #%u '%.*s' to '%s' (", at + 1, int(parameter.size()), parameter.data(), name);
    add_expected(message, rows, arguments, at);
    message.add(" expected, got %s)", at < arguments.count ? lua_type_name(state, int(at) + 1) : "no value");
  } else if (arguments.count > furthest->parameter_count) {
    message.add("too many arguments to '%s' (at most %u, got %d)", name, furthest->parameter_count, lua_gettop(state));
  } else {
    message.add("the arguments of '%s' do not fit each other:", name);
    for (unsigned i = 0; i < arguments.count; ++i)
      message.add("%s %s", i == 0 ? "" : ",", lua_type_name(state, int(i) + 1));
  }
  message.raise(state);
}

// Functions -----------------------------------------------------------------------------------------------------------

/// The Lua function of the rows First .. First + sizeof...(I) - 1, which have one name.
template <size_t First, size_t... I> int call_rows(lua_State* state) {
  Arguments arguments;
  int given = lua_gettop(state);
  arguments.count = given > int(kMaxArguments) ? kMaxArguments : unsigned(given);
  for (unsigned i = 0; i < arguments.count; ++i)
    arguments.values[i] = lua_value(state, int(i) + 1);
  if ((RowCallOf<FactsAt<First + I>>::Type::call(state, arguments, false) || ...)) return lua_gettop(state) - given;
  if ((RowCallOf<FactsAt<First + I>>::Type::call(state, arguments, true) || ...)) return lua_gettop(state) - given;
  if ((RowCallOf<FactsAt<First + I>>::Type::call_by_component(state, arguments) || ...))
    return lua_gettop(state) - given;
  refuse(state, library_overloads(FactsAt<First>::name), arguments);
}

template <size_t First, size_t... I> constexpr lua_CFunction function_of_rows(std::index_sequence<I...>) {
  return call_rows<First, I...>;
}

/// How many rows from `First` on have its name.
template <size_t First> constexpr size_t count_overloads() {
  return []<size_t... I>(std::index_sequence<I...>) {
    size_t count = 0;
    ((count += FactsAt<I>::name == FactsAt<First>::name), ...);
    return count;
  }(std::make_index_sequence<kRowCount>());
}

/// Not operators, nor what Lua's own math library has.
constexpr bool is_bound(std::string_view name) { return !name.starts_with("op.") && !name.starts_with("math."); }

/// Sets the function at the top of the stack as a global and in the module's table below the methods' table below it.
void set_function(lua_State* state, const char* name, lua_CFunction function, bool is_method) {
  lua_pushcfunction(state, function);
  lua_pushvalue(state, -1);
  lua_setglobal(state, name);
  lua_pushvalue(state, -1);
  lua_setfield(state, -4, name); // the module
  if (is_method)
    lua_setfield(state, -2, name);
  else
    lua_pop(state, 1);
}

/// A method of vectors or matrices: a function that takes one first.
bool is_method(std::string_view name) {
  for (const LibraryFunction& row : library_overloads(name))
    if (row.componentwise || is_vector(row.parameters[0]) || is_matrix(row.parameters[0])) return true;
  return false;
}

template <size_t First> void set_function_of_row(lua_State* state) {
  if constexpr (is_bound(FactsAt<First>::name)) {
    constexpr bool is_first = First == 0 || FactsAt < First == 0 ? 0 : First - 1 > ::name != FactsAt<First>::name;
    if constexpr (is_first) {
      constexpr auto function = function_of_rows<First>(std::make_index_sequence<count_overloads<First>()>());
      set_function(state, FactsAt<First>::name.data(), function, is_method(FactsAt<First>::name));
    }
  }
}

// Parameters ----------------------------------------------------------------------------------------------------------

/// The registry key of the overrides' table.
constexpr char kOverridesKey = 0;

/// Raises an error unless meta.<field> is absent or `fits` says that the number lies on its right side.
void check_bound(lua_State* state, const char* name, const LuaValue& value, const char* field, bool is_lower) {
  if (lua_type(state, 3) != LUA_TTABLE) return;
  lua_getfield(state, 3, field);
  LuaValue bound = lua_value(state, -1);
  for (unsigned i = 0; bound.is_scalar() && i < (value.size() ? value.size() : 1); ++i) {
    double x = value.at(i), limit = bound.at(0);
    if (is_lower ? x >= limit : x <= limit) continue;
    Message message;
    message.add("parameter '%s' is %.14g, %s its %s of %.14g", name, x, is_lower ? "below" : "above",
                is_lower ? "minimum" : "maximum", limit);
    message.raise(state);
  }
  lua_pop(state, 1);
}

/// The override on top of the stack as a value of the default's type; an integer becomes a number where that is one.
void check_override(lua_State* state, const char* name) {
  LuaValue expected = lua_value(state, 2), value = lua_value(state, -1);
  bool same = lua_type(state, 2) == lua_type(state, -1) && expected.size() == value.size();
  if (expected.kind == Kind::Integer) same = value.kind == Kind::Integer;
  if (!same) {
    Message message;
    message.add("parameter '%s' takes %s, not %s", name, lua_type_name(state, 2), lua_type_name(state, -1));
    message.raise(state);
  }
  if (expected.kind == Kind::Number && value.kind == Kind::Integer) {
    lua_pop(state, 1);
    lua_pushnumber(state, double(value.integer));
  }
  if (!value.is_scalar() && value.size() == 0) return;
  check_bound(state, name, value, "min", true);
  check_bound(state, name, value, "max", false);
}

/// param(name, default [, meta]): the default, or what the host gave.
int param(lua_State* state) {
  if (lua_type(state, 1) != LUA_TSTRING || lua_isnoneornil(state, 2)) {
    Message message;
    message.add("'param' takes a name, a default and a table, not %s and %s", lua_type_name(state, 1),
                lua_type_name(state, 2));
    message.raise(state);
  }
  lua_settop(state, 3);
  if (lua_rawgetp(state, LUA_REGISTRYINDEX, &kOverridesKey) == LUA_TTABLE) {
    lua_pushvalue(state, 1);
    if (lua_rawget(state, -2) != LUA_TNIL) {
      check_override(state, lua_tostring(state, 1));
      return 1;
    }
  }
  lua_pushvalue(state, 2);
  return 1;
}

} // namespace

void override_parameter(lua_State* state, const char* name) {
  if (lua_rawgetp(state, LUA_REGISTRYINDEX, &kOverridesKey) != LUA_TTABLE) {
    lua_pop(state, 1);
    lua_newtable(state);
    lua_pushvalue(state, -1);
    lua_rawsetp(state, LUA_REGISTRYINDEX, &kOverridesKey);
  }
  lua_pushvalue(state, -2);
  lua_setfield(state, -2, name);
  lua_pop(state, 2);
}

} // namespace moonshade

int luaopen_moonshade(lua_State* state) {
  using namespace moonshade;
  lua_newtable(state); // the module
  lua_newtable(state); // methods
  [&]<size_t... I>(std::index_sequence<I...>) {
    (set_function_of_row<I>(state), ...);
  }(std::make_index_sequence<kRowCount>());
  set_function(state, "vec2", construct_vec2, false);
  set_function(state, "vec3", construct_vec3, false);
  set_function(state, "vec4", construct_vec4, false);
  set_function(state, "rgb", construct_rgb, false);
  set_function(state, "mat3", construct_mat3, false);
  set_function(state, "mat4", construct_mat4, false);
  set_function(state, "param", param, false);
  set_function(state, "gradient", lua_gradient, false);
  set_function(state, "fwidth", lua_fwidth, false);
  for (const char* name : {"ramp", "palette", "catmullrom", "bspline"}) {
    push_table_function(state, name);
    lua_pushvalue(state, -1);
    lua_setglobal(state, name);
    lua_setfield(state, -3, name); // the module
  }
  push_texture(state, 0);
  lua_pushvalue(state, -1);
  lua_setglobal(state, "texture");
  lua_setfield(state, -3, "texture"); // the module
  open_vectors(state);
  open_matrices(state);
  lua_pop(state, 1);
  open_sums(state);
  return 1;
}
