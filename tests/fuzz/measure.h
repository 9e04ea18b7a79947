// Processor time and memory of one call, printed, and asserted to be within what only growth without bound exceeds.
#pragma once

#include <cstdio>
#include <ctime>
#include <gtest/gtest.h>
#include <string>
#include <sys/resource.h>
#include <sys/time.h>

namespace moonshade::fuzz {

inline constexpr double kMaxSeconds = 20;
inline constexpr long kMaxKilobytes = 2L << 20; // 2 GiB, of the whole process
inline constexpr unsigned kHangSeconds = 100;

#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

/// Runs from its construction on; what goes on without end is ended, and the program and its test with it.
class Measure {
public:
  Measure() { end_after(kHangSeconds); }
  ~Measure() { end_after(0); }
  Measure(const Measure&) = delete;
  Measure& operator=(const Measure&) = delete;

  /// Of the processor, by all threads: a busy machine is no growth.
  double seconds() const { return double(std::clock() - start_) / CLOCKS_PER_SEC; }
  /// The greatest of the process so far.
  static long kilobytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  }

private:
  /// Of the processor's time, too; a program that only waits is ended by the test's own limit.
  static void end_after(unsigned seconds) {
    const itimerval limit{{}, {time_t(seconds), 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
  }

  std::clock_t start_ = std::clock();
};

inline void expect_bounded(const Measure& measure, size_t input_bytes, const std::string& verdict) {
  const double seconds = measure.seconds();
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::printf("%-28s %8zu bytes %8.3f s %6ld MB  %s\n", name.substr(name.rfind('/') + 1).c_str(), input_bytes, seconds,
              Measure::kilobytes() >> 10, verdict.c_str());
  if (kIsSanitized) return;
  EXPECT_LT(seconds, kMaxSeconds);
  EXPECT_LT(Measure::kilobytes(), kMaxKilobytes);
}

} // namespace moonshade::fuzz
