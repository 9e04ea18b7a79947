// Means were measured over 4e6 points, but for those that are known. Those of `noise` are fractal.h's.
#include "stdlib/sums.h"

#include "stdlib/fractal.h"

#include <iterator>

namespace moonshade {
namespace {

constexpr NoiseSum kSums[] = {{"fbm", SumShape::Same, false},
                              {"turbulence", SumShape::Magnitude, false},
                              {"ridged", SumShape::Ridge, false},
                              {"hybrid", SumShape::Same, false},
                              {"warp", SumShape::Same, true}};

/// Of the noise, of its magnitude, and of (1 - its magnitude)^2, by dimensions.
struct Means {
  std::string_view noise;
  double of[3][4];
};

using stdlib::kMeanMagnitude, stdlib::kMeanRidge;

constexpr Means kMeans[] = {
    {"noise",
     {{0, 0, 0, 0},
      {kMeanMagnitude<1>, kMeanMagnitude<2>, kMeanMagnitude<3>, kMeanMagnitude<4>},
      {kMeanRidge<1>, kMeanRidge<2>, kMeanRidge<3>, kMeanRidge<4>}}},
    {"perlin", {{0, 0, 0, 0}, {0.1426, 0.2074, 0.2205, 0.2385}, {0.7525, 0.6505, 0.6322, 0.6092}}},
    {"valuenoise", {{0, 0, 0, 0}, {0.4422, 0.3786, 0.3302, 0.2882}, {0.3840, 0.4474, 0.5000, 0.5493}}},
    {"cellnoise", {{0.5, 0.5, 0.5, 0.5}, {0.5, 0.5, 0.5, 0.5}, {1.0 / 3, 1.0 / 3, 1.0 / 3, 1.0 / 3}}},
    {"worley", {{0.2918, 0.4296, 0.5203, 0.5901}, {0.2918, 0.4296, 0.5203, 0.5901}, {0.5417, 0.3614, 0.2598, 0.1925}}},
    {"gabor", {{0, 0, 0, 0}, {0.2659, 0.2650, 0.2615, 0}, {0.5785, 0.5810, 0.5881, 0}}},
};

} // namespace

const NoiseSum* find_noise_sum(std::string_view name) {
  for (const NoiseSum& sum : kSums)
    if (sum.name == name) return &sum;
  return nullptr;
}

std::string_view lua_name(const NoiseSum& sum, unsigned dimensions) {
  constexpr std::string_view kWarps[] = {"warp1", "warp2", "warp3", "warp4"};
  return sum.by_dimensions ? kWarps[dimensions - 1] : sum.name;
}

double default_mean(const NoiseSum& sum, std::string_view noise, unsigned dimensions) {
  const Means* means = &kMeans[0];
  for (const Means& row : kMeans)
    if (row.noise == noise) means = &row;
  return means->of[static_cast<unsigned>(sum.shape)][dimensions - 1];
}

} // namespace moonshade
