// What kernels work on: 16 lanes, and how they come from memory and go back.
#pragma once

#include "renderer/kernels/kernels.h"

/// Where members of records lie, as numbers.
#define AT(record, member) (offsetof(record, member) / sizeof(float))
#define LANES for (size_t i = 0; i < kLanes; ++i)

namespace moonshade::renderer::lanes16 {

using namespace lanes;
using F = Wide<float, int(kLanes)>;
using U = UInt32<F>;
using I = Int32<F>;
using M = Mask<F>;
using Vector = V3<F>;

MS_INLINE F load(const float* from) {
  F value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
MS_INLINE U load(const uint32_t* from) {
  U value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
template <class V> MS_INLINE void store(V value, void* to) { __builtin_memcpy(to, &value, sizeof value); }
MS_INLINE Vector load(const LaneFloats (&from)[3]) { return {{load(from[0]), load(from[1]), load(from[2])}}; }
MS_INLINE void store(const Vector& v, LaneFloats (&to)[3]) {
  for (int c = 0; c < 3; ++c)
    store(v[c], to[c]);
}
MS_INLINE M truth(U bits) { return stdlib::to_mask<F>(bits != U(0u)); }
MS_INLINE U bits_of(M mask) { return select(mask, U(1u), U(0u)); }

/// Four numbers of each lane.
struct Fours {
  F x, y, z, w;
};

/// Of each four lanes of both, four: those of `b` count from 16.
template <int i, int j, int k, int l> MS_INLINE F picked(F a, F b) {
  return __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4, i + 8, j + 8, k + 8, l + 8, i + 12,
                                 j + 12, k + 12, l + 12);
}

/// Within each four lanes, rows become columns; it is its own inverse.
MS_INLINE Fours transposed(const Fours& f) {
  F xy = picked<0, 16, 1, 17>(f.x, f.y), zw = picked<0, 16, 1, 17>(f.z, f.w);
  F xy2 = picked<2, 18, 3, 19>(f.x, f.y), zw2 = picked<2, 18, 3, 19>(f.z, f.w);
  return {picked<0, 1, 16, 17>(xy, zw), picked<2, 3, 18, 19>(xy, zw), picked<0, 1, 16, 17>(xy2, zw2),
          picked<2, 3, 18, 19>(xy2, zw2)};
}

using Four = Wide<float, 4>;

/// Those at number `first` of each lane's record.
template <class Record> MS_INLINE Fours load_fours(Record* const (&records)[kLanes], size_t first) {
  auto four = [&](size_t lane) __attribute__((always_inline)) {
    Four value;
    __builtin_memcpy(&value, reinterpret_cast<const float*>(records[lane]) + first, sizeof value);
    return value;
  };
  auto every_fourth = [&](size_t lane) __attribute__((always_inline)) {
    auto low = __builtin_shufflevector(four(lane), four(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    auto high = __builtin_shufflevector(four(lane + 8), four(lane + 12), 0, 1, 2, 3, 4, 5, 6, 7);
    return F(__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  };
  return transposed({every_fourth(0), every_fourth(1), every_fourth(2), every_fourth(3)});
}

template <class Record> MS_INLINE void store_fours(const Fours& fours, Record* const (&records)[kLanes], size_t first) {
  Fours rows = transposed(fours);
  auto put = [&](F row, size_t lane) __attribute__((always_inline)) {
    Four parts[4] = {__builtin_shufflevector(row, row, 0, 1, 2, 3), __builtin_shufflevector(row, row, 4, 5, 6, 7),
                     __builtin_shufflevector(row, row, 8, 9, 10, 11),
                     __builtin_shufflevector(row, row, 12, 13, 14, 15)};
#pragma clang loop unroll(full)
    for (size_t k = 0; k < 4; ++k)
      __builtin_memcpy(reinterpret_cast<float*>(records[lane + 4 * k]) + first, &parts[k], sizeof parts[k]);
  };
  put(rows.x, 0), put(rows.y, 1), put(rows.z, 2), put(rows.w, 3);
}

template <class Record> MS_INLINE Vector load_vector(Record* const (&records)[kLanes], size_t first) {
  Fours f = load_fours(records, first);
  return {{f.x, f.y, f.z}};
}

MS_INLINE Fours fours(const Vector& v, F w) { return {v[0], v[1], v[2], w}; }

} // namespace moonshade::renderer::lanes16
