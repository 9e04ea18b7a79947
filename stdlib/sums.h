// Sums of a noise that is given as a function (sums.lua): which there are, and what an octave leaves that is too fine
// for the pixel.
#pragma once

#include <string_view>

namespace moonshade {

/// What a sum makes of the noise n: n itself, its magnitude, or (1 - abs(n))^2.
enum class SumShape : unsigned char { Same, Magnitude, Ridge };

struct NoiseSum {
  std::string_view name;
  SumShape shape;
  bool by_dimensions; ///< a function of its own for each number of coordinates: "warp2"
};

/// Null where `name` is no sum of noise.
const NoiseSum* find_noise_sum(std::string_view name);

/// The function's name in sums.lua.
std::string_view lua_name(const NoiseSum& sum, unsigned dimensions);

/// The mean over space of what the sum makes of a noise of the library, in 1 to 4 dimensions. Of a noise that is none
/// of these (empty) that of `noise`, as in the sums without a function.
double default_mean(const NoiseSum& sum, std::string_view noise, unsigned dimensions);

/// The text of sums.lua.
std::string_view library_lua();

} // namespace moonshade
