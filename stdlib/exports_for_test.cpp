// Addresses of the exports, and calls of them in blocks.
#include "stdlib/exports_for_test.h"

#include <cstring>
#include <iterator>
#include <stdexcept>
#include <utility>

// Every export, declared without its parameters: only its address is taken.
#define DECLARE(symbol)                                                                                                \
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
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) DECLARE(symbol)
#include "stdlib/table.def"
#define DERIVATIVE(symbol, suffix, parameters, pointers) DECLARE(symbol##__##suffix)
#include "stdlib/derivatives.def"

namespace moonshade::test {
namespace {

using Address = void (*)();

#define ADDRESSES(symbol)                                                                                              \
  {{ms_##symbol##_f32_w1, ms_##symbol##_f32_w4, ms_##symbol##_f32_w8, ms_##symbol##_f32_w16, ms_##symbol##_f32_w32},   \
   {ms_##symbol##_f64_w1, ms_##symbol##_f64_w4, ms_##symbol##_f64_w8, ms_##symbol##_f64_w16, ms_##symbol##_f64_w32}},
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) ADDRESSES(symbol)
constexpr Address kExports[][2][kWidths.size()] = {
#include "stdlib/table.def"
};
#define DERIVATIVE(symbol, suffix, parameters, pointers) ADDRESSES(symbol##__##suffix)
constexpr Address kDerivatives[][2][kWidths.size()] = {
#include "stdlib/derivatives.def"
};

void call(void* function, void** p, unsigned count) {
  using P = void*;
  const auto call_with = [&]<size_t... I>(std::index_sequence<I...>) {
    reinterpret_cast<void (*)(decltype(P(p[I]))...)>(function)(p[I]...);
  };
  const auto call_if = [&]<size_t N>(std::integral_constant<size_t, N>) {
    if (count == N) call_with(std::make_index_sequence<N>());
    return count == N;
  };
  const bool called = [&]<size_t... N>(std::index_sequence<N...>) {
    return (call_if(std::integral_constant<size_t, N + 2>()) || ...);
  }(std::make_index_sequence<35>()); // 2 to 36 pointers
  if (!called) throw std::logic_error("an export with more parameters than the test knows");
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
  const bool f64 = precision == Precision::F64;
  if (is_derivative_export(row.symbol)) {
    size_t index = 0;
    while (library_derivatives()[index].function.symbol != row.symbol)
      ++index;
    return reinterpret_cast<void*>(kDerivatives[index][f64][w]);
  }
  return reinterpret_cast<void*>(kExports[&row - library().data()][f64][w]);
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
