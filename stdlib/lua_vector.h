// vec2, vec3, vec4, mat3 and mat4 as full userdata of stock Lua: immutable values of doubles, told from other userdata
// by a tag at the beginning of the block rather than by looking up metatables by name.
#pragma once

#include "stdlib/vec.h"

#include <lua.hpp>

#include <span>

namespace moonshade {

/// What a value on Lua's stack is to the library.
struct LuaValue {
  enum class Kind : uint8_t { None, Nil, Boolean, Integer, Number, Vec2, Vec3, Vec4, Mat3, Mat4, Other };
  Kind kind = Kind::Other;
  union {
    bool boolean;
    int64_t integer;
    double number;
    const double* components;
  };

  bool is_scalar() const { return kind == Kind::Integer || kind == Kind::Number; }
  /// 2 to 4 for vectors, else 0.
  unsigned size() const {
    return kind >= Kind::Vec2 && kind <= Kind::Vec4 ? unsigned(kind) - unsigned(Kind::Vec2) + 2 : 0;
  }
  /// How many columns a matrix has, else 0.
  unsigned columns() const { return kind == Kind::Mat3 ? 3 : kind == Kind::Mat4 ? 4 : 0; }
  /// The value as a number, the components' where it is a vector.
  double at(unsigned component) const {
    return kind == Kind::Number ? number : kind == Kind::Integer ? double(integer) : components[component];
  }
};

LuaValue lua_value(lua_State* state, int index);

/// The components of the vector at the index; empty where there is none. Valid while Lua keeps the value.
std::span<const double> vector_at(lua_State* state, int index);

/// Pushes a new vector of 2 to 4 components, for the caller to fill. The module must have been opened.
double* push_new_vector(lua_State* state, unsigned size);
void push_vector(lua_State* state, std::span<const double> components);

/// The same of matrices: size * size components, column by column.
double* push_new_matrix(lua_State* state, unsigned size);

/// The type of the value at the index, as the language's manual writes it.
const char* lua_type_name(lua_State* state, int index);

/// Makes the vectors' and the matrices' metatables; the table on top of the stack holds the functions that become
/// methods.
void open_vectors(lua_State* state);
void open_matrices(lua_State* state);

/// Makes the metatable of a type of so many components, with these metamethods, `index` its __index.
void open_type(lua_State* state, unsigned components, const luaL_Reg* metamethods, lua_CFunction index);
/// Metamethods of any type of the library: refuses assignment to components; says what the value is.
int refuse_assignment(lua_State* state);
int describe_vector(lua_State* state);
/// Raises an error for an operator whose two operands, the arguments, do not fit each other.
[[noreturn]] void refuse_operands(lua_State* state, const char* symbol);

/// The constructors vec2, vec3, vec4, rgb, as Lua functions.
int construct_vec2(lua_State* state);
int construct_vec3(lua_State* state);
int construct_vec4(lua_State* state);
int construct_rgb(lua_State* state);
/// And of matrices (lua_matrix.cpp).
int construct_mat3(lua_State* state);
int construct_mat4(lua_State* state);

} // namespace moonshade
