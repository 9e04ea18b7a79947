// Whatever a program of up to a megabyte holds, the whole compiler ends soon, in bounded memory, with code or with
// diagnostics. Each test prints time, memory and the verdict; it fails only far beyond what is usual (2 s), where the
// cause is growth without bound and not a busy machine.
#include "runtime/shader.h"
#include "tests/fuzz/hostile.h"
#include "tests/fuzz/measure.h"

#include <gtest/gtest.h>
#include <sstream>

namespace moonshade::fuzz {

void PrintTo(const HostileProgram& program, std::ostream* out) { *out << program.name; }

namespace {

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
  const Measure measure;
  const Compilation compilation = compile("hostile.lua", text, {});
  expect_bounded(measure, text.size(), verdict_of(compilation));
  EXPECT_EQ(compilation.program == nullptr, compilation.diagnostics.find("error: ") != std::string::npos)
      << compilation.diagnostics;
  EXPECT_EQ(compilation.diagnostics.find("internal-error"), std::string::npos) << compilation.diagnostics;
}

INSTANTIATE_TEST_SUITE_P(Hostile, Bounds, testing::ValuesIn(hostile_programs()),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace moonshade::fuzz
