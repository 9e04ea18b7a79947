// The bitcode of the library's exports and of its derivatives', ten domains each, as data. The build makes the files
// (CMakeLists.txt).
#include "stdlib/library.h"

#pragma clang diagnostic ignored "-Wc23-extensions"

namespace moonshade {
namespace {

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

std::span<const char> bitcode(Precision precision, unsigned width) {
  bool f32 = precision == Precision::F32;
  switch (width) {
  case 1:
    return f32 ? std::span<const char>(f32_w1) : f64_w1;
  case 4:
    return f32 ? std::span<const char>(f32_w4) : f64_w4;
  case 8:
    return f32 ? std::span<const char>(f32_w8) : f64_w8;
  case 16:
    return f32 ? std::span<const char>(f32_w16) : f64_w16;
  case 32:
    return f32 ? std::span<const char>(f32_w32) : f64_w32;
  default:
    return {};
  }
}
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

std::span<const char> bitcode(Precision precision, unsigned width) {
  bool f32 = precision == Precision::F32;
  switch (width) {
  case 1:
    return f32 ? std::span<const char>(f32_w1) : f64_w1;
  case 4:
    return f32 ? std::span<const char>(f32_w4) : f64_w4;
  case 8:
    return f32 ? std::span<const char>(f32_w8) : f64_w8;
  case 16:
    return f32 ? std::span<const char>(f32_w16) : f64_w16;
  case 32:
    return f32 ? std::span<const char>(f32_w32) : f64_w32;
  default:
    return {};
  }
}
} // namespace derivatives

} // namespace

std::span<const char> library_bitcode(Precision precision, unsigned width) {
  return exports::bitcode(precision, width);
}
std::span<const char> derivative_bitcode(Precision precision, unsigned width) {
  return derivatives::bitcode(precision, width);
}

} // namespace moonshade
