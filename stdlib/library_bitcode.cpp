// The bitcode of the library's exports and of its derivatives', ten domains each, as data. The build makes the files
// (CMakeLists.txt).
#include "stdlib/library.h"

#pragma clang diagnostic ignored "-Wc23-extensions"

namespace moonshade {
namespace {

/// The files of one kind, by precision and in the order of kWidths.
struct Blobs {
  std::array<std::span<const char>, kWidths.size()> f32, f64;
};

std::span<const char> find(const Blobs& blobs, Precision precision, unsigned width) {
  for (size_t i = 0; i < kWidths.size(); ++i)
    if (kWidths[i] == width) return precision == Precision::F32 ? blobs.f32[i] : blobs.f64[i];
  return {};
}

namespace exports {
alignas(8) constexpr char f32_w1[] = {
#embed "exports_f32_w1.bc"
};
alignas(8) constexpr char f32_w4[] = {
#embed "exports_f32_w4.bc"
};
alignas(8) constexpr char f32_w8[] = {
#embed "exports_f32_w8.bc"
};
alignas(8) constexpr char f32_w16[] = {
#embed "exports_f32_w16.bc"
};
alignas(8) constexpr char f32_w32[] = {
#embed "exports_f32_w32.bc"
};
alignas(8) constexpr char f64_w1[] = {
#embed "exports_f64_w1.bc"
};
alignas(8) constexpr char f64_w4[] = {
#embed "exports_f64_w4.bc"
};
alignas(8) constexpr char f64_w8[] = {
#embed "exports_f64_w8.bc"
};
alignas(8) constexpr char f64_w16[] = {
#embed "exports_f64_w16.bc"
};
alignas(8) constexpr char f64_w32[] = {
#embed "exports_f64_w32.bc"
};

constexpr Blobs blobs = {{f32_w1, f32_w4, f32_w8, f32_w16, f32_w32}, {f64_w1, f64_w4, f64_w8, f64_w16, f64_w32}};
} // namespace exports

namespace derivatives {
alignas(8) constexpr char f32_w1[] = {
#embed "derivatives_f32_w1.bc"
};
alignas(8) constexpr char f32_w4[] = {
#embed "derivatives_f32_w4.bc"
};
alignas(8) constexpr char f32_w8[] = {
#embed "derivatives_f32_w8.bc"
};
alignas(8) constexpr char f32_w16[] = {
#embed "derivatives_f32_w16.bc"
};
alignas(8) constexpr char f32_w32[] = {
#embed "derivatives_f32_w32.bc"
};
alignas(8) constexpr char f64_w1[] = {
#embed "derivatives_f64_w1.bc"
};
alignas(8) constexpr char f64_w4[] = {
#embed "derivatives_f64_w4.bc"
};
alignas(8) constexpr char f64_w8[] = {
#embed "derivatives_f64_w8.bc"
};
alignas(8) constexpr char f64_w16[] = {
#embed "derivatives_f64_w16.bc"
};
alignas(8) constexpr char f64_w32[] = {
#embed "derivatives_f64_w32.bc"
};

constexpr Blobs blobs = {{f32_w1, f32_w4, f32_w8, f32_w16, f32_w32}, {f64_w1, f64_w4, f64_w8, f64_w16, f64_w32}};
} // namespace derivatives

namespace second {
alignas(8) constexpr char f32[] = {
#embed "second_derivatives_f32_w1.bc"
};
alignas(8) constexpr char f64[] = {
#embed "second_derivatives_f64_w1.bc"
};
} // namespace second

} // namespace

std::span<const char> library_bitcode(Precision precision, unsigned width) {
  return find(exports::blobs, precision, width);
}
std::span<const char> derivative_bitcode(Precision precision, unsigned width) {
  return find(derivatives::blobs, precision, width);
}
std::span<const char> second_derivative_bitcode(Precision precision) {
  if (precision == Precision::F32) return second::f32;
  return second::f64;
}

} // namespace moonshade
