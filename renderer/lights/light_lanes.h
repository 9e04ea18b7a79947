// What light samplers compute, written once for one point and for many: directions of the surroundings whose light is
// a formula (sky and sun), and points on emitting triangles.
#pragma once

#include "renderer/lane_math.h"
#include "renderer/sampling/warp.h"

namespace moonshade::renderer {

inline constexpr int kSkyBands = 256; ///< of equal solid angle, by the direction's height

/// A sky or a sun among the surroundings.
struct EnvironmentLight {
  bool is_sky = false;
  Vec3 zenith{0}, horizon{0}, ground{0}; ///< Sky
  const float* density = nullptr;        ///< Sky: by band
  Vec3 direction{0}, radiance{0};        ///< Sun: towards it
  float one_minus_cos = 0, disc_density = 0;
};

/// A triangle that emits, in fours of numbers.
struct alignas(64) LightTriangle {
  Vec3 a{0};
  float density = 0; ///< per area
  Vec3 b{0};
  float side = 1; ///< -1 where the object's matrix mirrors
  Vec3 c{0};
  float one_sided = 0; ///< or 1
  Vec3 emission{0};
  float emits = 0; ///< 1; 0: there is none
};
static_assert(sizeof(LightTriangle) == 64);

template <class L> MS_INLINE lanes::V3<L> sky_radiance(const EnvironmentLight& sky, L height) {
  using lanes::spread;
  lanes::V3<L> horizon = spread<L>(sky.horizon);
  auto above = !lanes::less(height, L(0.0f));
  L up = stdlib::sqrt(lanes::clamp(height, L(0.0f), L(1.0f)));
  L down = lanes::min(height * L(-20.0f), L(1.0f));
  L t = lanes::select(above, up, down * down * (L(3.0f) - L(2.0f) * down));
  lanes::V3<L> other = lanes::select<3>(above, spread<L>(sky.zenith), spread<L>(sky.ground));
  return horizon * (L(1.0f) - t) + other * t;
}

template <class L> MS_INLINE L table_at(const float* table, lanes::Int32<L> index) {
  if constexpr (stdlib::width_of<L> == 1) {
    return table[index];
  } else {
    L values;
#pragma clang loop unroll(full)
    for (int i = 0; i < stdlib::width_of<L>; ++i)
      values[i] = table[index[i]];
    return values;
  }
}

template <class L> MS_INLINE L sky_density(const EnvironmentLight& sky, L height) {
  // A height that is not a number becomes 0: lanes that are not asked for hold anything.
  L band = lanes::min(lanes::max(L(0.0f), (height + L(1.0f)) * L(0.5f * kSkyBands)), L(kSkyBands - 1.0f));
  return table_at<L>(sky.density, lanes::convert<lanes::Int32<L>>(band));
}

/// The sun's disc: |apart|^2 = 2 (1 - cos), exact for small angles.
template <class L> MS_INLINE lanes::Mask<L> within_disc(const EnvironmentLight& sun, const lanes::V3<L>& direction) {
  lanes::V3<L> apart = direction - lanes::spread<L>(sun.direction);
  return lanes::less_equal(lanes::dot(apart, apart), L(2 * sun.one_minus_cos));
}

/// Sums over all of them: radiance from a direction, and density by which it would be drawn for one of them.
template <class L>
MS_INLINE void surroundings(const EnvironmentLight* lights, size_t count, const lanes::V3<L>& direction,
                            lanes::V3<L>& radiance, L& density) {
  radiance = {{L(0.0f), L(0.0f), L(0.0f)}};
  density = L(0.0f);
  for (size_t k = 0; k < count; ++k) {
    const EnvironmentLight& light = lights[k];
    if (light.is_sky) {
      radiance = radiance + sky_radiance(light, direction[1]);
      density += sky_density(light, direction[1]);
    } else if (light.one_minus_cos > 0) {
      auto hit = within_disc(light, direction);
      L one = lanes::select(hit, L(1.0f), L(0.0f));
      radiance = radiance + lanes::spread<L>(light.radiance) * one;
      density += one * L(light.disc_density);
    }
  }
}

/// A direction of this height and azimuth (in turns).
template <class L> MS_INLINE lanes::V3<L> direction_at_height(L height, L turns) {
  L s, c, r = stdlib::sqrt(lanes::max(L(1.0f) - height * height, L(0.0f)));
  sine_and_cosine_of_turns(turns, s, c);
  return {{r * c, height, r * s}};
}

/// Points on emitting triangles. In: corners, density per area, the numbers drawn (the first within the triangle).
template <class L> struct AreaSample {
  lanes::V3<L> a, b, c;
  L u, v, density, side; ///< side: -1 where the object's matrix mirrors
  lanes::Mask<L> one_sided;
  // Out.
  lanes::V3<L> direction;
  L distance, pdf; ///< per solid angle; 0 where nothing is sent there
};

template <class L> MS_INLINE void sample_area(const lanes::V3<L>& point, AreaSample<L>& s) {
  using namespace lanes;
  L root = stdlib::sqrt(s.u);
  V3<L> at = s.a * (L(1.0f) - root) + s.b * (root * (L(1.0f) - s.v)) + s.c * (root * s.v);
  V3<L> to = at - point;
  L squared = dot(to, to);
  s.distance = stdlib::sqrt(squared);
  s.direction = to * (L(1.0f) / s.distance);
  V3<L> zero = {{L(0.0f), L(0.0f), L(0.0f)}};
  V3<L> normal = normalize_or(cross(s.b - s.a, s.c - s.a), zero) * s.side;
  L cosine = -dot(normal, s.direction);
  auto dark = !less(L(0.0f), squared) | equal(cosine, L(0.0f)) | (s.one_sided & less(cosine, L(0.0f)));
  s.pdf = select(dark, L(0.0f), s.density * squared / stdlib::abs(cosine));
}

} // namespace moonshade::renderer
