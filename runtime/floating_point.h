// The default floating-point environment for the time of a batch call, whatever the host has set: rounding to nearest,
// denormals kept. (Renderers and `-ffast-math` switch denormals off; the same bits must come out all the same.)
#pragma once

#include <cfenv>

#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>
#define MOONSHADE_HAS_MXCSR 1
#endif

namespace moonshade {

class DefaultFloatingPoint {
public:
#ifdef MOONSHADE_HAS_MXCSR
  // Compiled code and the library use no x87; its environment is slow to save.
  DefaultFloatingPoint() : saved_(_mm_getcsr()) { _mm_setcsr(kDefault); }
  ~DefaultFloatingPoint() { _mm_setcsr(saved_); }
#else
  DefaultFloatingPoint() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatingPoint() { std::fesetenv(&saved_); }
#endif
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

private:
#ifdef MOONSHADE_HAS_MXCSR
  static constexpr unsigned kDefault = 0x1f80; // every exception masked, to nearest, nothing flushed
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

} // namespace moonshade

#undef MOONSHADE_HAS_MXCSR
