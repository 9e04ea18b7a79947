// The tables of machine code that the build made (CMakeLists.txt, split_exports.cpp).
#include "stdlib/native_library.h"

#include <algorithm>

namespace moonshade {

/// What a file of machine code shows of itself.
struct NativeTable {
  uint64_t count;
  const NativeExport* exports;
};

#define NATIVE(precision, width, processor)                                                                            \
  extern "C" const NativeTable moonshade_native_exports_##precision##_w##width;                                        \
  extern "C" const NativeTable moonshade_native_derivatives_##precision##_w##width;
MS_NATIVE_DOMAINS
#undef NATIVE

namespace {

namespace precisions {
constexpr Precision f32 = Precision::F32, f64 = Precision::F64;
}

struct Domain {
  Precision precision;
  unsigned width;
  std::string_view processor;
  const NativeTable *exports, *derivatives;
};

constexpr Domain kDomains[] = {
#define NATIVE(precision, width, processor)                                                                            \
  {precisions::precision, width, processor, &moonshade_native_exports_##precision##_w##width,                          \
   &moonshade_native_derivatives_##precision##_w##width},
    MS_NATIVE_DOMAINS
#undef NATIVE
};

} // namespace

const NativeExport* NativeExports::find(std::string_view name) const {
  const auto found =
      std::ranges::lower_bound(exports, name, {}, [](const NativeExport& row) { return std::string_view(row.name); });
  return found != exports.end() && found->name == name ? &*found : nullptr;
}

NativeExports native_exports(Precision precision, unsigned width, bool derivatives) {
  for (const Domain& domain : kDomains)
    if (domain.precision == precision && domain.width == width) {
      const NativeTable& table = derivatives ? *domain.derivatives : *domain.exports;
      return {domain.processor, {table.exports, table.count}};
    }
  return {};
}

} // namespace moonshade
