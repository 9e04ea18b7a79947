// `texture` for stock Lua: what looks up images is the host's.
#pragma once

struct lua_State;

namespace moonshade {

/// How a host looks up an image for stock Lua: `file` as the script names it, `source` the number that push_texture
/// got, at[0..2] u, v and width. Null, or what is wrong.
struct LuaImages {
  const void* context;
  const char* (*look_up)(const void* context, const char* file, unsigned source, bool raw, const double* at,
                         double* rgba);
};

/// The host's images for this state, which they must outlive.
void set_images(lua_State* state, const LuaImages* images);

/// Pushes texture(file, uv [, width] [, { raw = true }]) for the scripts of one source file.
void push_texture(lua_State* state, unsigned source);

} // namespace moonshade
