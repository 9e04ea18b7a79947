// The look-up of images as a row of the library. It stands in no table: its body is the host's (runtime/image.h), so
// there is no bitcode of it, and compiled code calls out for all lanes at once (emit_images.cpp).
#pragma once

#include "stdlib/library.h"

namespace moonshade {

/// vec4 texture(integer image, vec2 uv, number width): the number of an image among the shader's.
const LibraryFunction& texture_row();

/// Its derivative, by uv alone: the value, and how it changes by u and by v.
const LibraryDerivative& texture_derivative();

/// Either of the two.
bool is_texture(const LibraryFunction& row);

} // namespace moonshade
