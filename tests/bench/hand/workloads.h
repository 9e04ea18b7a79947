// The ten workloads by hand on N lanes: points in, results out, structure of arrays, the count a multiple of N. What
// the shaders of shaders/bench/ compute, in the shape that an engineer would give it with vectors at hand.
#pragma once

#include "tests/bench/hand/kernels.h"
#include "tests/bench/hand/perlin.h"
#include "tests/bench/hand/simplex.h"
#include "tests/bench/hand/worley.h"

namespace hand {

template <int N> struct Workloads {
  template <class Body> HAND static void numbers(const float* const* in, float* const* out, size_t count, Body body) {
#pragma clang loop vectorize(disable) interleave(disable) unroll(disable)
    for (size_t i = 0; i < count; i += N)
      store<N>(out[0] + i, body(Vec3<N>{load<N>(in[0] + i), load<N>(in[1] + i), load<N>(in[2] + i)}));
  }
  template <class Body> HAND static void vectors(const float* const* in, float* const* out, size_t count, Body body) {
#pragma clang loop vectorize(disable) interleave(disable) unroll(disable)
    for (size_t i = 0; i < count; i += N) {
      const Vec3<N> v = body(Vec3<N>{load<N>(in[0] + i), load<N>(in[1] + i), load<N>(in[2] + i)});
      store<N>(out[0] + i, v.x), store<N>(out[1] + i, v.y), store<N>(out[2] + i, v.z);
    }
  }

  template <class Noise> HAND static F<N> octaves(Vec3<N> p, int count, Noise noise) {
    F<N> sum = 0.0f;
    float weight = 1;
#pragma clang loop unroll(disable)
    for (int i = 0; i < count; ++i) {
      sum += weight * noise(p);
      p = p * 2, weight *= 0.5f;
    }
    return sum;
  }
  template <class Noise> HAND static Vec3<N> marble_of(Vec3<N> p, Noise noise) {
    const F<N> bend = octaves(p, 6, [&](Vec3<N> q) __attribute__((always_inline)) { return magnitude(noise(q)); });
    return mix<N>({0.28f, 0.30f, 0.34f}, {0.90f, 0.88f, 0.84f}, 0.5f + 0.5f * sine<N>(2.0f * p.x + 5.0f * bend));
  }
  HAND static F<N> height(Vec3<N> p) {
    return octaves(p, 4, [](Vec3<N> q) __attribute__((always_inline)) { return Simplex<N>::noise(q); });
  }

  static void noise(const float* const* in, float* const* out, size_t count) {
    numbers(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) { return Simplex<N>::noise(p); });
  }
  static void marble(const float* const* in, float* const* out, size_t count) {
    vectors(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      return marble_of(p, [](Vec3<N> q) __attribute__((always_inline)) { return Simplex<N>::noise(q); });
    });
  }
  static void perlin_once(const float* const* in, float* const* out, size_t count) {
    numbers(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) { return perlin<N>(p); });
  }
  static void marble_perlin(const float* const* in, float* const* out, size_t count) {
    vectors(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      return marble_of(p, [](Vec3<N> q) __attribute__((always_inline)) { return perlin<N>(q); });
    });
  }
  static void planet(const float* const* in, float* const* out, size_t count) {
    vectors(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      const F<N> h = octaves(p * 0.5f, 8, [](Vec3<N> q) __attribute__((always_inline)) { return perlin<N>(q); });
      const F<N> one = 1.0f;
      if constexpr (N == 1) {
        if (h < 0) return mix<1>({0.03f, 0.20f, 0.30f}, {0.01f, 0.04f, 0.12f}, least(-2 * h, one));
        if (h < 0.4f) return mix<1>({0.09f, 0.21f, 0.05f}, {0.24f, 0.19f, 0.15f}, 2.5f * h);
        return mix<1>({0.24f, 0.19f, 0.15f}, {0.90f, 0.92f, 0.95f}, least(4 * (h - 0.4f), one));
      } else {
        const auto sea = h < 0.0f, land = h < 0.4f;
        const F<N> t =
            choose(sea, least<F<N>>(-2.0f * h, one), choose(land, F<N>(2.5f * h), least<F<N>>(4.0f * (h - 0.4f), one)));
        const auto blend = [&](float deep, float shallow, float grass, float rock,
                               float snow) __attribute__((always_inline)) {
          const F<N> a = choose(sea, F<N>(shallow), choose(land, F<N>(grass), F<N>(rock)));
          const F<N> slope = choose(sea, F<N>(deep - shallow), choose(land, F<N>(rock - grass), F<N>(snow - rock)));
          return a + t * slope;
        };
        return Vec3<N>{blend(0.01f, 0.03f, 0.09f, 0.24f, 0.90f), blend(0.04f, 0.20f, 0.21f, 0.19f, 0.92f),
                       blend(0.12f, 0.30f, 0.05f, 0.15f, 0.95f)};
      }
    });
  }
  static void mandelbrot(const float* const* in, float* const* out, size_t count) {
    numbers(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      const F<N> cx = p.x * 0.3125f - 2.0f, cy = p.y * 0.3125f - 1.25f;
      F<N> x = 0.0f, y = 0.0f, n = 0.0f;
      if constexpr (N == 1) {
        int steps = 0;
        for (; steps < 256 && x * x + y * y <= 4.0f; ++steps) {
          const float next = x * x - y * y + cx;
          y = 2 * x * y + cy, x = next;
        }
        n = float(steps);
      } else {
        // A lane that has left the circle goes on outside: it does not come back, nor does a NaN.
        for (int step = 0; step < 256; ++step) {
          const F<N> xx = x * x, yy = y * y;
          const auto inside = bits<I<N>>(xx + yy) <= 0x40800000;
          if (!any<N>(inside)) break;
          n = choose(inside, F<N>(n + 1.0f), n);
          y = (x + x) * y + cy, x = xx - yy + cx;
        }
      }
      return F<N>(n * (1.0f / 256));
    });
  }
  static void worley(const float* const* in, float* const* out, size_t count) {
    numbers(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) { return Worley<N>().run(p); });
  }
  static void brick(const float* const* in, float* const* out, size_t count) {
    vectors(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      const F<N> row = floor<F<N>>(4.0f * p.y), x = 2.0f * p.x + 0.5f * row, column = floor(x);
      const F<N> u = x - column, v = 4.0f * p.y - row;
      const auto mixed = [](U<N> h) __attribute__((always_inline)) {
        h = (h ^ (h >> 16)) * 0x7feb352du;
        h = (h ^ (h >> 15)) * 0x846ca68bu;
        return h ^ (h >> 16);
      };
      const U<N> hash = mixed(mixed(bits<U<N>>(column)) * 0x9e3779b1u + bits<U<N>>(row));
      const F<N> t = to_float<N>(bits<I<N>>(hash >> 8)) * 0x1p-24f;
      const auto mortar = (u < 0.04f) | (v < 0.08f);
      const Vec3<N> c = mix<N>({0.42f, 0.14f, 0.09f}, {0.66f, 0.29f, 0.17f}, t);
      return Vec3<N>{choose(mortar, F<N>(0.62f), c.x), choose(mortar, F<N>(0.60f), c.y),
                     choose(mortar, F<N>(0.56f), c.z)};
    });
  }
  static void differences(const float* const* in, float* const* out, size_t count) {
    vectors(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      F<N> value[6];
#pragma clang loop unroll(disable)
      for (int i = 0; i < 6; ++i) {
        const float step = (i & 1) == 0 ? 1.0f / 1024 : -1.0f / 1024;
        const float sx = i < 2 ? step : 0, sy = i >> 1 == 1 ? step : 0, sz = i >= 4 ? step : 0;
        value[i] = height(Vec3<N>{p.x + sx, p.y + sy, p.z + sz});
      }
      return Vec3<N>{512.0f * (value[0] - value[1]), 512.0f * (value[2] - value[3]), 512.0f * (value[4] - value[5])};
    });
  }
  static void slope(const float* const* in, float* const* out, size_t count) {
    vectors(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) {
      Vec3<N> sum = {0.0f, 0.0f, 0.0f};
      float scale = 1, weight = 1;
#pragma clang loop unroll(disable)
      for (int i = 0; i < 4; ++i) {
        sum = sum + Simplex<N>::gradient(p) * (weight * scale);
        p = p * 2, scale *= 2, weight *= 0.5f;
      }
      return sum;
    });
  }
  static void bump_height(const float* const* in, float* const* out, size_t count) {
    numbers(in, out, count, [](Vec3<N> p) __attribute__((always_inline)) { return height(p); });
  }
};

template <int N> Kernel kernel_of(const char* workload) {
  using W = Workloads<N>;
  static constexpr struct {
    const char* name;
    Kernel kernel;
  } kKernels[] = {{"W1", W::noise},         {"W2", W::marble},     {"W3a", W::perlin_once},   {"W3b", W::marble_perlin},
                  {"W4", W::planet},        {"W5", W::mandelbrot}, {"W6", W::worley},         {"W7", W::brick},
                  {"W8fd", W::differences}, {"W8ad", W::slope},    {"height", W::bump_height}};
  for (const auto& entry : kKernels)
    if (std::strcmp(entry.name, workload) == 0) return entry.kernel;
  return nullptr;
}

} // namespace hand
