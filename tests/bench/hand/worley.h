// Worley's F1 in three dimensions by hand, with the library's feature points: the 27 cells around the point row by row,
// without the rows that are too far away on every lane; where F1 reaches beyond these cells, all of the 125.
#pragma once

#include "tests/bench/hand/simplex.h"

namespace hand {

template <int N> struct Worley {
  F<N> x, y, z;
  U<N> hx, hy, hz;
  F<N> nearest = 1e30f;

  HAND void cell(U<N> row, F<N> base_x, F<N> base_y, F<N> base_z, int i) {
    const U<N> combined = row ^ (hx + uint32_t(i) * 0x9e3779b1u), square = combined * combined;
    const U<N> hash = (square ^ (square >> 15)) * 0x2c1b3c6du;
    const F<N> dx = to_float<N>(bits<I<N>>(hash >> 22)) * 0x1p-10f + (base_x + float(i));
    const F<N> dy = to_float<N>(bits<I<N>>(hash >> 12 & 1023u)) * 0x1p-10f + base_y;
    const F<N> dz = to_float<N>(bits<I<N>>(hash >> 2 & 1023u)) * 0x1p-10f + base_z;
    nearest = least<F<N>>(nearest, dx * dx + dy * dy + dz * dz);
  }
  HAND void row(int j, int k, int reach) {
    const F<N> low_y = float(j) - y, low_z = float(k) - z, zero = 0.0f;
    const F<N> away_y = greatest<F<N>>(greatest<F<N>>(low_y, -1.0f - low_y), zero);
    const F<N> away_z = greatest<F<N>>(greatest<F<N>>(low_z, -1.0f - low_z), zero);
    if constexpr (N == 1) {
      if (!(away_y * away_y + away_z * away_z < nearest)) return;
    } else {
      if (!any<N>(away_y * away_y + away_z * away_z < nearest)) return;
    }
    const U<N> hash = (hy + uint32_t(j) * 0x85ebca77u) ^ (hz + uint32_t(k) * 0xc2b2ae3du);
    const float half = 0x1p-11f;
    cell(hash, half - x, low_y + half, low_z + half, 0);
    for (int i = 1; i <= reach; ++i) {
      cell(hash, half - x, low_y + half, low_z + half, i);
      cell(hash, half - x, low_y + half, low_z + half, -i);
    }
  }
  HAND F<N> run(Vec3<N> p) {
    const F<N> i = floor(p.x), j = floor(p.y), k = floor(p.z), one = 1.0f;
    x = p.x - i, y = p.y - j, z = p.z - k;
    hx = lattice<N>(i) * 0x9e3779b1u, hy = lattice<N>(j) * 0x85ebca77u, hz = lattice<N>(k) * 0xc2b2ae3du;
    static constexpr int8_t kRows[9][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                           {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
#pragma clang loop unroll(disable)
    for (const int8_t(&r)[2] : kRows)
      row(r[0], r[1], 1);
    const F<N> side =
        least<F<N>>(least<F<N>>(least<F<N>>(x, one - x), least<F<N>>(y, one - y)), least<F<N>>(z, one - z));
    const auto beyond = (side + 1.0f) * (side + 1.0f) < nearest;
    bool some;
    if constexpr (N == 1)
      some = beyond;
    else
      some = any<N>(beyond);
    if (some) {
#pragma clang loop unroll(disable)
      for (int k = -2; k <= 2; ++k)
#pragma clang loop unroll(disable)
        for (int j = -2; j <= 2; ++j)
          row(j, k, 2);
    }
    return root(nearest);
  }
};

} // namespace hand
