// vec2, vec3 and vec4 as full userdata of stock Lua: immutable values of doubles, told from other userdata by a tag at
// the beginning of the block rather than by looking up metatables by name.
#pragma once

#include "stdlib/vec.h"

#include <lua.hpp>

#include <span>

namespace moonshade {

/// What a value on Lua's stack is to the library.
struct LuaValue {
  enum class Kind : uint8_t { None, Nil, Boolean, Integer, Number, Vec2, Vec3, Vec4, Other };
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

/// The type of the value at the index, as the language's manual writes it.
const char* lua_type_name(lua_State* state, int index);

/// Makes the vectors' metatables; the table on top of the stack holds the functions that become methods.
void open_vectors(lua_State* state);

/// The constructors vec2, vec3, vec4, rgb, as Lua functions.
int construct_vec2(lua_State* state);
int construct_vec3(lua_State* state);
int construct_vec4(lua_State* state);
int construct_rgb(lua_State* state);

} // namespace moonshade
