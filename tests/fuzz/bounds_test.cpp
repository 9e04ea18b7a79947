// Whatever a program of up to a megabyte holds, the whole compiler ends soon, in bounded memory, with code or with
// diagnostics. Each test prints time, memory and the verdict; it fails only far beyond what is usual (2 s), where the
// cause is growth without bound and not a busy machine.
#include "runtime/shader.h"
#include "tests/fuzz/hostile.h"

#include <chrono>
#include <cstdio>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

namespace moonshade::fuzz {

void PrintTo(const HostileProgram& program, std::ostream* out) { *out << program.name; }

namespace {

constexpr double kMaxSeconds = 20;
constexpr long kMaxKilobytes = 2L << 20; // 2 GiB, of the whole process
constexpr unsigned kHangSeconds = 100;

#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

std::string verdict_of(const Compilation& compilation) {
  if (compilation.program) {
    const CompileTimes& times = compilation.program->times();
    std::ostringstream text;
    text.precision(2);
    text << std::fixed << "compiled: parse " << times.parse / 1e3 << ", sema " << times.sema / 1e3 << ", ir "
         << times.ir / 1e3 << ", emit " << times.emit / 1e3 << ", optimise " << times.optimize / 1e3 << ", code "
         << times.codegen / 1e3 << " s";
    return text.str();
  }
  return compilation.diagnostics.substr(0, std::min<size_t>(compilation.diagnostics.find('\n'), 160));
}

class Bounds : public testing::TestWithParam<HostileProgram> {};

TEST_P(Bounds, TheCompilerEndsSoon) {
  const std::string text = GetParam().text();
  alarm(kHangSeconds); // a hang ends the program, and with it the test
  const auto start = std::chrono::steady_clock::now();
  const Compilation compilation = compile("hostile.lua", text, {});
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf("%-28s %8zu bytes %8.3f s %6ld MB  %s\n", GetParam().name.c_str(), text.size(), time.count(),
              peak_kilobytes() >> 10, verdict_of(compilation).c_str());
  EXPECT_NE(compilation.program == nullptr, compilation.diagnostics.empty());
  EXPECT_EQ(compilation.diagnostics.find("internal-error"), std::string::npos) << compilation.diagnostics;
  if (!kIsSanitized) {
    EXPECT_LT(time.count(), kMaxSeconds);
    EXPECT_LT(peak_kilobytes(), kMaxKilobytes);
  }
  alarm(0);
}

INSTANTIATE_TEST_SUITE_P(Hostile, Bounds, testing::ValuesIn(hostile_programs()),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace moonshade::fuzz
