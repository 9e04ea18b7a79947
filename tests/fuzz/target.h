// What a fuzz target consists of: one function that takes any bytes and returns, having checked what must hold of
// them. It is driven by libFuzzer (preset `fuzz`), which looks for inputs that crash it, and by replay_main.cpp in
// every other build, which runs the kept inputs. A property that does not hold ends the program, as a crash does.
#pragma once

#include "compiler/base/diagnostics.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace moonshade::fuzz {

/// Inputs of more bytes are passed over: what is slow because it is long is tested by bounds_test.cpp.
inline constexpr size_t kMaxInput = 16384;

inline std::string_view text_of(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Says what does not hold, and aborts.
[[noreturn]] void fail(const std::string& what);
void require(bool holds, const std::string& what);

/// A number that follows from the bytes alone, to choose options by (so that any text is an input, without a header).
uint64_t choice_of(std::string_view text);

/// Every diagnostic has a message and spans within its text, and every form prints them: text without control
/// characters and of bounded length, JSON and SARIF that parse.
void check_diagnostics(const Diagnostics& diagnostics, const SourceSet& sources);

} // namespace moonshade::fuzz
