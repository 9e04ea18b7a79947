// What compiled code calls for the look-ups of a block of lanes (runtime/images.cpp).
#pragma once

#include <cstdint>

namespace moonshade::codegen {

/// Results of a look-up: the vec4; or it and how it changes by u and by v.
inline constexpr uint32_t kTextureValues = 4, kTextureSlopes = 12;

/// Looks up image number `image` of those that stand at CodeInfo::image_slot of the instance's constants. `at`: `count`
/// each of u, v and width; `gives`: `count` each of `results` numbers. `active`: a byte for each lane, 0 where nobody
/// looks at the result (which is then 0); null: all are.
extern "C" void moonshade_texture_f32(const void* images, int64_t image, uint32_t count, uint32_t results,
                                      const uint8_t* active, const float* at, float* gives);
extern "C" void moonshade_texture_f64(const void* images, int64_t image, uint32_t count, uint32_t results,
                                      const uint8_t* active, const double* at, double* gives);

} // namespace moonshade::codegen
