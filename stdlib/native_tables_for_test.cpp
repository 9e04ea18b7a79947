// What the code generator and the bitcode bring with them (compiler/codegen/tables.cpp, stdlib/gather.ll.in), for the
// library as native code: plain look-ups, and no tables in registers.
#include "stdlib/tables.h"

#include <cstdint>
#include <cstring>

namespace {

template <int kLanes> void gather(void* result, const void* table, const void* offsets) {
  for (int i = 0; i < kLanes; ++i) {
    uint32_t offset = 0;
    std::memcpy(&offset, static_cast<const char*>(offsets) + 4 * i, 4);
    std::memcpy(static_cast<char*>(result) + 4 * i, static_cast<const char*>(table) + offset, 4);
  }
}

template <int kLanes> void bytes_of_table(void* result, const void* table, const void* indices) {
  for (int i = 0; i < 4 * kLanes; ++i)
    static_cast<uint8_t*>(result)[i] = static_cast<const uint8_t*>(table)[static_cast<const uint8_t*>(indices)[i]];
}

template <int kLanes> void floats_of_table(void* result, const void* table, const void* indices) {
  for (int i = 0; i < kLanes; ++i) {
    uint32_t index = 0;
    std::memcpy(&index, static_cast<const char*>(indices) + 4 * i, 4);
    std::memcpy(static_cast<char*>(result) + 4 * i, static_cast<const char*>(table) + 4 * (index & 15), 4);
  }
}

} // namespace

extern "C" {
bool moonshade_target_has_tables() { return false; }
void moonshade_gather_w8(void* result, const void* table, const void* offsets) { gather<8>(result, table, offsets); }
void moonshade_gather_w16(void* result, const void* table, const void* offsets) { gather<16>(result, table, offsets); }
void moonshade_table_of_256_w16(void* result, const void* table, const void* indices) {
  bytes_of_table<16>(result, table, indices);
}
void moonshade_table_of_256_w32(void* result, const void* table, const void* indices) {
  bytes_of_table<32>(result, table, indices);
}
void moonshade_table_of_16_w16(void* result, const void* table, const void* indices) {
  floats_of_table<16>(result, table, indices);
}
void moonshade_table_of_16_w32(void* result, const void* table, const void* indices) {
  floats_of_table<32>(result, table, indices);
}
}
