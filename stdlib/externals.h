// The functions of C's mathematical library that the library takes as they are, under double numbers, where stock Lua
// calls them too. They are called by names of ours, so that no optimiser takes them for the functions it knows and
// replaces pow(x, -1) by 1/x, or rounds them another way; and for many lanes at once, one call a vector.
#pragma once

#define MS_EXTERNALS(ONE, TWO)                                                                                         \
  ONE(sin)                                                                                                             \
  ONE(cos) ONE(tan) ONE(asin) ONE(acos) ONE(atan) ONE(exp) ONE(log) TWO(atan2) TWO(pow) TWO(fmod) TWO(log_to_base)

extern "C" {
#define MS_PURE __attribute__((const))
#define ONE(name)                                                                                                      \
  MS_PURE double moonshade_##name(double x) noexcept;                                                                  \
  void moonshade_##name##_lanes(double* result, const double* x, unsigned count) noexcept;
#define TWO(name)                                                                                                      \
  MS_PURE double moonshade_##name(double x, double y) noexcept;                                                        \
  void moonshade_##name##_lanes(double* result, const double* x, const double* y, unsigned count) noexcept;
MS_EXTERNALS(ONE, TWO)
#undef ONE
#undef TWO
}
