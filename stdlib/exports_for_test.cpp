// Addresses of the exports, and calls of them in blocks.
#include "stdlib/exports_for_test.h"

#include <cstring>
#include <iterator>
#include <stdexcept>

// Every export, declared without its parameters: only its address is taken.
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  extern "C" void ms_##symbol##_f32_w1();                                                                              \
  extern "C" void ms_##symbol##_f32_w4();                                                                              \
  extern "C" void ms_##symbol##_f32_w8();                                                                              \
  extern "C" void ms_##symbol##_f32_w16();                                                                             \
  extern "C" void ms_##symbol##_f32_w32();                                                                             \
  extern "C" void ms_##symbol##_f64_w1();                                                                              \
  extern "C" void ms_##symbol##_f64_w4();                                                                              \
  extern "C" void ms_##symbol##_f64_w8();                                                                              \
  extern "C" void ms_##symbol##_f64_w16();                                                                             \
  extern "C" void ms_##symbol##_f64_w32();
#include "stdlib/table.def"

namespace moonshade::test {
namespace {

using Address = void (*)();

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  {{ms_##symbol##_f32_w1, ms_##symbol##_f32_w4, ms_##symbol##_f32_w8, ms_##symbol##_f32_w16, ms_##symbol##_f32_w32},   \
   {ms_##symbol##_f64_w1, ms_##symbol##_f64_w4, ms_##symbol##_f64_w8, ms_##symbol##_f64_w16, ms_##symbol##_f64_w32}},
constexpr Address kExports[][2][kWidths.size()] = {
#include "stdlib/table.def"
};

void call(void* function, void** p, unsigned count) {
  using P = void*;
  switch (count) {
  case 2:
    return reinterpret_cast<void (*)(P, P)>(function)(p[0], p[1]);
  case 3:
    return reinterpret_cast<void (*)(P, P, P)>(function)(p[0], p[1], p[2]);
  case 4:
    return reinterpret_cast<void (*)(P, P, P, P)>(function)(p[0], p[1], p[2], p[3]);
  case 5:
    return reinterpret_cast<void (*)(P, P, P, P, P)>(function)(p[0], p[1], p[2], p[3], p[4]);
  default:
    throw std::logic_error("an export with more parameters than the test knows");
  }
}

/// One argument or result of a call: aligned for the widest vectors, sixteen components of 32 doubles.
struct alignas(256) Slot {
  unsigned char bytes[16 * 32 * 8];
};

} // namespace

void* export_address(const LibraryFunction& row, Precision precision, unsigned width) {
  size_t w = 0;
  while (kWidths[w] != width)
    ++w;
  size_t index = &row - library().data();
  return reinterpret_cast<void*>(kExports[index][precision == Precision::F64][w]);
}

unsigned component_size(ValueType type, Precision precision) {
  if (type == ValueType::Boolean) return 1;
  return type == ValueType::Integer || precision == Precision::F64 ? 8 : 4;
}

std::vector<Column> run_export(const LibraryFunction& row, Precision precision, unsigned width,
                               std::span<const Column> arguments, unsigned points) {
  std::vector<Column> results;
  for (unsigned i = 0; i < row.result_count; ++i) {
    ValueType type = row.results[i];
    results.push_back(
        {type, std::vector<unsigned char>(component_count(type) * component_size(type, precision) * points)});
  }
  std::vector<Slot> slots(results.size() + arguments.size());
  std::vector<void*> pointers;
  for (Slot& slot : slots)
    pointers.push_back(slot.bytes);
  // One block's lanes of a column to or from its slot.
  auto each_component = [&](const Column& column, unsigned first, auto copy) {
    unsigned size = component_size(column.type, precision);
    for (unsigned c = 0; c < component_count(column.type); ++c)
      copy(c * size * width, size_t(size) * (c * points + first), size * width);
  };
  void* function = export_address(row, precision, width);
  for (unsigned first = 0; first < points; first += width) {
    for (size_t i = 0; i < arguments.size(); ++i)
      each_component(arguments[i], first, [&](size_t slot, size_t column, size_t size) {
        std::memcpy(slots[results.size() + i].bytes + slot, arguments[i].bytes.data() + column, size);
      });
    call(function, pointers.data(), unsigned(pointers.size()));
    for (size_t i = 0; i < results.size(); ++i)
      each_component(results[i], first, [&](size_t slot, size_t column, size_t size) {
        std::memcpy(results[i].bytes.data() + column, slots[i].bytes + slot, size);
      });
  }
  return results;
}

bool exports_can_run() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

} // namespace moonshade::test
