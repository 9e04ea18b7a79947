// C's functions under names of ours (externals.h), and their table for who links the library's bitcode.
#include "stdlib/externals.h"

#include "stdlib/library.h"

#include <cmath>

namespace {

/// Lua's math.log with a base (lmathlib.c).
double log_to_base(double x, double base) {
  if (base == 2.0) return std::log2(x);
  if (base == 10.0) return std::log10(x);
  return std::log(x) / std::log(base);
}

using std::acos, std::asin, std::atan, std::atan2, std::cos, std::exp, std::fmod, std::log, std::pow, std::sin,
    std::tan;

} // namespace

extern "C" {
#define ONE(name)                                                                                                      \
  double moonshade_##name(double x) noexcept { return name(x); }                                                       \
  void moonshade_##name##_lanes(double* result, const double* x, unsigned count) noexcept {                            \
    for (unsigned i = 0; i < count; ++i)                                                                               \
      result[i] = name(x[i]);                                                                                          \
  }
#define TWO(name)                                                                                                      \
  double moonshade_##name(double x, double y) noexcept { return name(x, y); }                                          \
  void moonshade_##name##_lanes(double* result, const double* x, const double* y, unsigned count) noexcept {           \
    for (unsigned i = 0; i < count; ++i)                                                                               \
      result[i] = name(x[i], y[i]);                                                                                    \
  }
MS_EXTERNALS(ONE, TWO)
#undef ONE
#undef TWO
}

namespace moonshade {

std::span<const LibraryExternal> library_externals() {
#define ENTRY(name)                                                                                                    \
  {"moonshade_" #name, reinterpret_cast<void*>(&moonshade_##name)},                                                    \
      {"moonshade_" #name "_lanes", reinterpret_cast<void*>(&moonshade_##name##_lanes)},
  static const LibraryExternal externals[] = {MS_EXTERNALS(ENTRY, ENTRY)};
#undef ENTRY
  return externals;
}

} // namespace moonshade
