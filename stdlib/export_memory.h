// For the exports of one domain: their lane, and how values lie in memory (library.h). Needs MS_SCALAR and MS_WIDTH.
#pragma once

#include "stdlib/lane.h"

namespace moonshade::stdlib {

using Lane = Wide<MS_SCALAR, MS_WIDTH>;

// Values in memory: as lanes side by side, booleans as bytes.
template <class T> struct Memory {
  MS_INLINE static T load(const void* from) { return *static_cast<const T*>(from); }
  MS_INLINE static void store(void* to, const T& value) { *static_cast<T*>(to) = value; }
};
template <class I, int W> struct Memory<LaneMask<I, W>> {
  using Bytes = Wide<uint8_t, W>;
  MS_INLINE static LaneMask<I, W> load(const void* from) {
    if constexpr (W == 1)
      return {*static_cast<const Bytes*>(from) != 0};
    else
      return {__builtin_convertvector(*static_cast<const Bytes*>(from) != Bytes(uint8_t(0)), Wide<I, W>)};
  }
  MS_INLINE static void store(void* to, const LaneMask<I, W>& value) {
    if constexpr (W == 1)
      *static_cast<Bytes*>(to) = value.bits;
    else
      *static_cast<Bytes*>(to) = __builtin_convertvector(__builtin_convertvector(value.bits, Wide<bool, W>), Bytes);
  }
};

} // namespace moonshade::stdlib

#define EXPORT_NAME__(symbol, precision, width) ms_##symbol##_##precision##_w##width
#define EXPORT_NAME_(symbol, precision, width) EXPORT_NAME__(symbol, precision, width)
#define EXPORT_NAME(symbol) EXPORT_NAME_(symbol, MS_PRECISION, MS_WIDTH)
