// Tables in vector registers, for the processors that can look each lane up in them: AVX-512 with VBMI. Only the code
// generator knows the processor, so it answers moonshade_target_has_tables and gives the look-ups their bodies
// (compiler/codegen/tables.cpp); bitcode that is compiled without it, and native code, has none (gather.ll.in).
//
//     if constexpr (has_tables<L>)
//       if (moonshade_target_has_tables()) return /* the same bits, by tables */;
#pragma once

#include "stdlib/dual.h"
#include "stdlib/lane.h"

namespace moonshade::stdlib {

/// Lanes that fill such registers.
template <class L> inline constexpr bool has_tables = false;
template <PlainLane L> inline constexpr bool has_tables<L> = is_f32<L> && (width_of<L> == 16 || width_of<L> == 32);

extern "C" {
bool moonshade_target_has_tables();
// At each byte of the indices the entry of 256 bytes; for each lane, by the lowest four bits, that of 16 floats.
void moonshade_table_of_256_w16(void* result, const void* table, const void* indices);
void moonshade_table_of_256_w32(void* result, const void* table, const void* indices);
void moonshade_table_of_16_w16(void* result, const void* table, const void* indices);
void moonshade_table_of_16_w32(void* result, const void* table, const void* indices);
}

template <class U> MS_INLINE U table_of_256(const uint8_t* table, U indices) {
  U result;
  if constexpr (width_of<U> == 16)
    moonshade_table_of_256_w16(&result, table, &indices);
  else
    moonshade_table_of_256_w32(&result, table, &indices);
  return result;
}
template <class L> MS_INLINE L table_of_16(const float* table, UInt32<L> indices) {
  L result;
  if constexpr (width_of<L> == 16)
    moonshade_table_of_16_w16(&result, table, &indices);
  else
    moonshade_table_of_16_w32(&result, table, &indices);
  return result;
}

} // namespace moonshade::stdlib
