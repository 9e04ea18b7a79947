// Vectors in stock Lua. Arithmetic is that of the language's manual, section 5: by component, a number beside a vector
// counting for each, by the same bodies as compiled code.
#include "stdlib/lua_vector.h"

#include "stdlib/numbers.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace moonshade {
namespace {

using Kind = LuaValue::Kind;

struct VectorBlock {
  const void* tag;
  double components[];
};

/// Tags are the addresses of these; their values name the types. Metatables lie in the registry under the same keys.
/// The index is the number of components: 2 to 4, and 9 and 16 of matrices.
constexpr std::array<const char*, 17> kTypeNames = {"",     "", "vec2", "vec3", "vec4", "", "", "",    "",
                                                    "mat3", "", "",     "",     "",     "", "", "mat4"};
const void* tag_of(unsigned size) { return &kTypeNames[size]; }

constexpr size_t block_size(unsigned size) { return sizeof(VectorBlock) + size * sizeof(double); }

double* push_new(lua_State* state, unsigned size) {
  auto* block = static_cast<VectorBlock*>(lua_newuserdatauv(state, block_size(size), 0));
  block->tag = tag_of(size);
  lua_rawgetp(state, LUA_REGISTRYINDEX, tag_of(size));
  lua_setmetatable(state, -2);
  return block->components;
}

/// Raises an error that begins with the position of the calling Lua code.
[[noreturn]] void fail(lua_State* state, const char* format, const char* a = "", const char* b = "") {
  luaL_where(state, 1);
  lua_pushfstring(state, format, a, b);
  lua_concat(state, 2);
  lua_error(state);
  __builtin_unreachable();
}

// Components
// ------------------------------------------------------------------------------------------------------------

/// The index of a component letter within its set, 4 for no letter.
unsigned letter_index(char letter, const char* letters) {
  unsigned i = 0;
  while (i < 4 && letters[i] != letter)
    ++i;
  return i;
}

/// Pushes the components that `key` names from one set of letters; false where it names none.
bool push_swizzle(lua_State* state, const LuaValue& vector, const char* key, size_t length, const char* letters) {
  unsigned picked[4];
  for (size_t i = 0; i < length; ++i) {
    picked[i] = letter_index(key[i], letters);
    if (picked[i] >= vector.size()) return false;
  }
  if (length == 1) {
    lua_pushnumber(state, vector.components[picked[0]]);
    return true;
  }
  double* result = push_new_vector(state, length);
  for (size_t i = 0; i < length; ++i)
    result[i] = vector.components[picked[i]];
  return true;
}

/// v.x, v.zyx, v[1], v.length; the methods' table is the first upvalue.
int index_vector(lua_State* state) {
  LuaValue vector = lua_value(state, 1);
  unsigned size = vector.size();
  if (size == 0) fail(state, "attempt to index a %s as a vector", lua_type_name(state, 1));
  if (lua_type(state, 2) == LUA_TSTRING) {
    size_t length;
    const char* key = lua_tolstring(state, 2, &length);
    if (length >= 1 && length <= 4 &&
        (push_swizzle(state, vector, key, length, "xyzw") || push_swizzle(state, vector, key, length, "rgba")))
      return 1;
    lua_pushvalue(state, 2);
    if (lua_rawget(state, lua_upvalueindex(1)) != LUA_TNIL) return 1;
    fail(state, "%s has no component or method '%s'", kTypeNames[size], key);
  }
  int is_integer;
  lua_Integer index = lua_tointegerx(state, 2, &is_integer);
  if (!is_integer || index < 1 || index > size)
    fail(state, "%s has no component [%s]", kTypeNames[size], luaL_tolstring(state, 2, nullptr));
  lua_pushnumber(state, vector.components[index - 1]);
  return 1;
}

// Operators
// -------------------------------------------------------------------------------------------------------------

struct Add {
  static constexpr const char* symbol = "+";
  static double apply(double a, double b) { return a + b; }
};
struct Subtract {
  static constexpr const char* symbol = "-";
  static double apply(double a, double b) { return a - b; }
};
struct Multiply {
  static constexpr const char* symbol = "*";
  static double apply(double a, double b) { return a * b; }
};
struct Divide {
  static constexpr const char* symbol = "/";
  static double apply(double a, double b) { return a / b; }
};
struct FloorDivide {
  static constexpr const char* symbol = "//";
  static double apply(double a, double b) { return stdlib::floor_divide(a, b); }
};
struct Modulo {
  static constexpr const char* symbol = "%";
  static double apply(double a, double b) { return stdlib::mod(a, b); }
};
struct Power {
  static constexpr const char* symbol = "^";
  static double apply(double a, double b) { return stdlib::power(a, b); }
};

template <class Operator> int binary(lua_State* state) {
  LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  unsigned size = a.size() ? a.size() : b.size();
  if ((a.size() != size && !a.is_scalar()) || (b.size() != size && !b.is_scalar()))
    refuse_operands(state, Operator::symbol);
  double* result = push_new_vector(state, size);
  for (unsigned i = 0; i < size; ++i)
    result[i] = Operator::apply(a.at(i), b.at(i));
  return 1;
}

int negate(lua_State* state) {
  LuaValue a = lua_value(state, 1);
  double* result = push_new_vector(state, a.size());
  for (unsigned i = 0; i < a.size(); ++i)
    result[i] = -a.components[i];
  return 1;
}

int equal_vectors(lua_State* state) {
  LuaValue a = lua_value(state, 1), b = lua_value(state, 2);
  bool equal = a.size() != 0 && a.size() == b.size();
  for (unsigned i = 0; equal && i < a.size(); ++i)
    equal = a.components[i] == b.components[i];
  lua_pushboolean(state, equal);
  return 1;
}

constexpr luaL_Reg kMetamethods[] = {
    {"__newindex", refuse_assignment}, {"__add", binary<Add>},          {"__sub", binary<Subtract>},
    {"__mul", binary<Multiply>},       {"__div", binary<Divide>},       {"__idiv", binary<FloorDivide>},
    {"__mod", binary<Modulo>},         {"__pow", binary<Power>},        {"__unm", negate},
    {"__eq", equal_vectors},           {"__tostring", describe_vector}, {nullptr, nullptr}};

// Constructors
// ----------------------------------------------------------------------------------------------------------

/// Numbers and vectors strung together, or one number for each component.
int construct(lua_State* state, const char* name, unsigned size) {
  int count = lua_gettop(state);
  double strung[4] = {};
  unsigned have = 0;
  for (int i = 1; i <= count; ++i) {
    LuaValue value = lua_value(state, i);
    unsigned components = value.is_scalar() ? 1 : value.size();
    if (components == 0) {
      lua_pushfstring(state, "bad argument #%d to '%s' (number or vector expected, got %s)", i, name,
                      lua_type_name(state, i));
      fail(state, "%s", lua_tostring(state, -1));
    }
    for (unsigned k = 0; k < components; ++k, ++have)
      if (have < 4) strung[have] = value.at(k);
  }
  if (count == 1 && have == 1) {
    for (unsigned k = 1; k < size; ++k)
      strung[k] = strung[0];
  } else if (have != size) {
    lua_pushfstring(state, "'%s' takes %d components or one number, got %d components", name, int(size), int(have));
    fail(state, "%s", lua_tostring(state, -1));
  }
  double* result = push_new_vector(state, size);
  for (unsigned k = 0; k < size; ++k)
    result[k] = strung[k];
  return 1;
}

} // namespace

int refuse_assignment(lua_State* state) {
  fail(state, "a %s cannot be changed in place: make a new one", lua_type_name(state, 1));
}

void refuse_operands(lua_State* state, const char* symbol) {
  luaL_where(state, 1);
  lua_pushfstring(state, "'%s' of %s and %s", symbol, lua_type_name(state, 1), lua_type_name(state, 2));
  lua_concat(state, 2);
  lua_error(state);
  __builtin_unreachable();
}

/// "vec2(1.0, 2.5)", numbers as Lua writes them.
int describe_vector(lua_State* state) {
  LuaValue a = lua_value(state, 1);
  luaL_Buffer buffer;
  luaL_buffinit(state, &buffer);
  luaL_addstring(&buffer, lua_type_name(state, 1));
  const unsigned count = a.columns() != 0 ? a.columns() * a.columns() : a.size();
  for (unsigned i = 0; i < count; ++i) {
    luaL_addstring(&buffer, i == 0 ? "(" : ", ");
    lua_pushnumber(state, a.components[i]);
    luaL_tolstring(state, -1, nullptr);
    lua_remove(state, -2);
    luaL_addvalue(&buffer);
  }
  luaL_addstring(&buffer, ")");
  luaL_pushresult(&buffer);
  return 1;
}

int construct_vec2(lua_State* state) { return construct(state, "vec2", 2); }
int construct_vec3(lua_State* state) { return construct(state, "vec3", 3); }
int construct_vec4(lua_State* state) { return construct(state, "vec4", 4); }
int construct_rgb(lua_State* state) { return construct(state, "rgb", 3); }

LuaValue lua_value(lua_State* state, int index) {
  LuaValue value;
  switch (lua_type(state, index)) {
  case LUA_TNUMBER:
    if (lua_isinteger(state, index)) {
      value.kind = Kind::Integer;
      value.integer = lua_tointegerx(state, index, nullptr);
    } else {
      value.kind = Kind::Number;
      value.number = lua_tonumberx(state, index, nullptr);
    }
    break;
  case LUA_TBOOLEAN:
    value.kind = Kind::Boolean;
    value.boolean = lua_toboolean(state, index);
    break;
  case LUA_TNONE:
    value.kind = Kind::None;
    break;
  case LUA_TNIL:
    value.kind = Kind::Nil;
    break;
  case LUA_TUSERDATA: {
    size_t length = lua_rawlen(state, index);
    if (length < block_size(2)) break;
    auto* block = static_cast<const VectorBlock*>(lua_touserdata(state, index));
    constexpr struct {
      unsigned size;
      Kind kind;
    } kKinds[] = {{2, Kind::Vec2}, {3, Kind::Vec3}, {4, Kind::Vec4}, {9, Kind::Mat3}, {16, Kind::Mat4}};
    for (const auto& [size, kind] : kKinds) {
      if (block->tag != tag_of(size) || length != block_size(size)) continue;
      value.kind = kind;
      value.components = block->components;
    }
    break;
  }
  default:
    break;
  }
  return value;
}

std::span<const double> vector_at(lua_State* state, int index) {
  LuaValue value = lua_value(state, index);
  return value.size() == 0 ? std::span<const double>() : std::span<const double>(value.components, value.size());
}

double* push_new_vector(lua_State* state, unsigned size) { return push_new(state, size); }
double* push_new_matrix(lua_State* state, unsigned size) { return push_new(state, size * size); }

void push_vector(lua_State* state, std::span<const double> components) {
  double* to = push_new_vector(state, components.size());
  std::memcpy(to, components.data(), components.size_bytes());
}

const char* lua_type_name(lua_State* state, int index) {
  LuaValue value = lua_value(state, index);
  if (value.size() != 0) return kTypeNames[value.size()];
  if (value.columns() != 0) return kTypeNames[size_t(value.columns()) * value.columns()];
  if (value.kind == Kind::Integer) return "integer";
  return value.kind == Kind::None ? "no value" : lua_typename(state, lua_type(state, index));
}

void open_type(lua_State* state, unsigned components, const luaL_Reg* metamethods, lua_CFunction index) {
  lua_newtable(state);
  luaL_setfuncs(state, metamethods, 0);
  lua_pushvalue(state, -2);
  lua_pushcclosure(state, index, 1);
  lua_setfield(state, -2, "__index");
  lua_pushstring(state, kTypeNames[components]);
  lua_setfield(state, -2, "__name");
  lua_pushboolean(state, false);
  lua_setfield(state, -2, "__metatable");
  lua_rawsetp(state, LUA_REGISTRYINDEX, tag_of(components));
}

void open_vectors(lua_State* state) {
  for (unsigned size = 2; size <= 4; ++size)
    open_type(state, size, kMetamethods, index_vector);
}

} // namespace moonshade
