// Simplex noise in three dimensions by hand: the same lattice hash and the same twelve gradients as the library's
// `noise`, and its gradient in the same pass.
#pragma once

#include "tests/bench/hand/lanes.h"

namespace hand {

/// A lattice coordinate's bits, as the addition of a great number leaves them.
template <int N> HAND U<N> lattice(F<N> i) { return bits<U<N>>(i + 12582912.0f); }

/// 1/2 less the square of the way. (Left to itself, -ffast-math adds the half last.)
template <int N> HAND F<N> reach(F<N> x, F<N> y, F<N> z) {
  return fused(-z, z, fused(-y, y, fused(-x, x, F<N>(0.5f))));
}

template <int N> struct Simplex {
  static constexpr uint32_t kX = 0x9e3779b1u, kY = 0x85ebca77u, kZ = 0xc2b2ae3du;

  /// f(hash, x, y, z) for each of the four corners, with the way from the corner to the point.
  template <class Corner> HAND static void corners(Vec3<N> p, Corner f) {
    using Number = F<N>;
    const Number s = (p.x + p.y + p.z) * (1.0f / 3);
    const Number i = floor(p.x + s), j = floor(p.y + s), k = floor(p.z + s);
    const Number t = (i + j + k) * (1.0f / 6);
    const Number x = p.x - i + t, y = p.y - j + t, z = p.z - k + t;
    const U<N> hx = lattice<N>(i) * kX, hy = lattice<N>(j) * kY, hz = lattice<N>(k) * kZ;
    const U<N> hx1 = hx + kX, hy1 = hy + kY, hz1 = hz + kZ;
    const auto xy = mask<N>(x >= y), yz = mask<N>(y >= z), xz = mask<N>(x >= z);
    const auto x_first = xy & xz, y_first = ~xy & yz, z_first = ~xz & ~yz;
    const auto x_second = xy | xz, y_second = ~xy | yz, z_second = ~(xz & yz);
    f(hx ^ hy ^ hz, x, y, z);
    const auto step = [](auto along, Number d, float by) __attribute__((always_inline)) {
      return choose<N>(along, Number(d + (by - 1)), Number(d + by));
    };
    f(choose<N>(x_first, hx1, hx) ^ choose<N>(y_first, hy1, hy) ^ choose<N>(z_first, hz1, hz),
      step(x_first, x, 1.0f / 6), step(y_first, y, 1.0f / 6), step(z_first, z, 1.0f / 6));
    f(choose<N>(x_second, hx1, hx) ^ choose<N>(y_second, hy1, hy) ^ choose<N>(z_second, hz1, hz),
      step(x_second, x, 1.0f / 3), step(y_second, y, 1.0f / 3), step(z_second, z, 1.0f / 3));
    f(hx1 ^ hy1 ^ hz1, x - 0.5f, y - 0.5f, z - 0.5f);
  }

  /// One of a cube's twelve edges, from the square of the corner's hash.
  struct Edge {
    U<N> hash;
    Mask<N> first_is_y, second_is_z;
    U<N> first_sign, second_sign;
    HAND explicit Edge(U<N> combined) {
      hash = combined * combined;
      const I<N> place = bits<I<N>>(hash & 0x7fffffffu);
      first_is_y = mask<N>(place < 0x2aaaaaab);
      second_is_z = mask<N>(place < 0x55555555);
      first_sign = hash & 0x80000000u;
      second_sign = choose<N>(mask<N>((hash & 0x00400000u) != 0u), U<N>(0x80000000u), U<N>(0u));
    }
    HAND F<N> along(F<N> x, F<N> y, F<N> z) const {
      return flip<N>(choose<N>(first_is_y, y, x), first_sign) + flip<N>(choose<N>(second_is_z, z, y), second_sign);
    }
  };

  HAND static F<N> noise(Vec3<N> p) {
    F<N> sum = 0.0f;
    corners(p, [&](U<N> combined, F<N> x, F<N> y, F<N> z) __attribute__((always_inline)) {
      F<N> t = greatest<F<N>>(reach<N>(x, y, z), F<N>(0.0f));
      t = t * t;
      sum += t * t * Edge(combined).along(x, y, z);
    });
    return sum * 76.88f;
  }

  /// The gradient of the noise alone.
  HAND static Vec3<N> gradient(Vec3<N> p) {
    F<N> gx = 0.0f, gy = 0.0f, gz = 0.0f, fx = 0.0f, fy = 0.0f, fz = 0.0f;
    const F<N> zero = 0.0f;
    corners(p, [&](U<N> combined, F<N> x, F<N> y, F<N> z) __attribute__((always_inline)) {
      const F<N> t = greatest<F<N>>(reach<N>(x, y, z), zero);
      const F<N> t2 = t * t, t4 = t2 * t2;
      const Edge edge(combined);
      const F<N> fall = t2 * t * edge.along(x, y, z);
      fx += fall * x, fy += fall * y, fz += fall * z;
      const F<N> u = flip<N>(t4, edge.first_sign), v = flip<N>(t4, edge.second_sign);
      gx += choose<N>(edge.first_is_y, zero, u);
      gy += choose<N>(edge.first_is_y, u, zero) + choose<N>(edge.second_is_z, zero, v);
      gz += choose<N>(edge.second_is_z, v, zero);
    });
    return {76.88f * (gx - 8.0f * fx), 76.88f * (gy - 8.0f * fy), 76.88f * (gz - 8.0f * fz)};
  }
};

/// One lane: the hash's signs by branches of data would only mispredict; masks of one lane are 0 and -1.
template <> struct Simplex<1> {
  static uint32_t corner_hash(int i, int j, int k) {
    const uint32_t h = (uint32_t(i) + 0x4b400000u) * 0x9e3779b1u ^ (uint32_t(j) + 0x4b400000u) * 0x85ebca77u ^
                       (uint32_t(k) + 0x4b400000u) * 0xc2b2ae3du;
    return h * h;
  }
  struct Corner {
    float t, u, v;
    bool first_is_y, second_is_z;
    HAND Corner(uint32_t hash, float x, float y, float z) {
      t = 0.5f - x * x - y * y - z * z;
      t = t < 0 ? 0 : t;
      const uint32_t place = hash & 0x7fffffffu;
      first_is_y = place < 0x2aaaaaabu, second_is_z = place < 0x55555555u;
      u = bits<float>(0x3f800000u | (hash & 0x80000000u));
      v = bits<float>(0x3f800000u | ((hash << 9) & 0x80000000u));
    }
    HAND float along(float x, float y, float z) const { return u * (first_is_y ? y : x) + v * (second_is_z ? z : y); }
  };
  template <class F> HAND static void corners(Vec3<1> p, F f) {
    const float s = (p.x + p.y + p.z) * (1.0f / 3);
    const float fi = __builtin_floorf(p.x + s), fj = __builtin_floorf(p.y + s), fk = __builtin_floorf(p.z + s);
    const int i = int(fi), j = int(fj), k = int(fk);
    const float t = (fi + fj + fk) * (1.0f / 6);
    const float x = p.x - fi + t, y = p.y - fj + t, z = p.z - fk + t;
    const bool xy = x >= y, yz = y >= z, xz = x >= z;
    const int i1 = xy & xz, j1 = !xy & yz, k1 = !xz & !yz, i2 = xy | xz, j2 = !xy | yz, k2 = !(xz & yz);
    const float g = 1.0f / 6;
    f(corner_hash(i, j, k), x, y, z);
    f(corner_hash(i + i1, j + j1, k + k1), x - float(i1) + g, y - float(j1) + g, z - float(k1) + g);
    f(corner_hash(i + i2, j + j2, k + k2), x - float(i2) + 2 * g, y - float(j2) + 2 * g, z - float(k2) + 2 * g);
    f(corner_hash(i + 1, j + 1, k + 1), x - 0.5f, y - 0.5f, z - 0.5f);
  }
  HAND static float noise(Vec3<1> p) {
    float sum = 0;
    corners(p, [&](uint32_t hash, float x, float y, float z) __attribute__((always_inline)) {
      const Corner c(hash, x, y, z);
      sum += c.t * c.t * c.t * c.t * c.along(x, y, z);
    });
    return sum * 76.88f;
  }
  HAND static Vec3<1> gradient(Vec3<1> p) {
    Vec3<1> g = {0, 0, 0};
    corners(p, [&](uint32_t hash, float x, float y, float z) __attribute__((always_inline)) {
      const Corner c(hash, x, y, z);
      const float t2 = c.t * c.t, t4 = t2 * t2, fall = -8 * t2 * c.t * c.along(x, y, z);
      g.x += fall * x + (c.first_is_y ? 0 : t4 * c.u);
      g.y += fall * y + (c.first_is_y ? t4 * c.u : 0) + (c.second_is_z ? 0 : t4 * c.v);
      g.z += fall * z + (c.second_is_z ? t4 * c.v : 0);
    });
    return g * 76.88f;
  }
};

} // namespace hand
