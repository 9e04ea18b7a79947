// Runs a scene file in stock Lua 5.4 with bounds on memory, instructions and time, and without io, os, debug, package,
// coroutine, load, metatables or pattern matching (whose time nothing bounds). A scene describes by calling functions
// with one table each; the sandbox only records these calls, so that no C++ frame is ever left by a Lua error.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace moonshade::renderer {

/// A Lua value as plain data.
struct SceneValue {
  struct Nil {};
  using List = std::vector<SceneValue>;
  using Fields = std::map<std::string, SceneValue>;
  std::variant<Nil, bool, int64_t, double, std::string, List, Fields> value;
  int64_t call = -1; ///< index of the recorded call that gave this table (a material's handle), or -1

  bool is_nil() const { return std::holds_alternative<Nil>(value); }
};

/// `sphere{ ... }` at a line.
struct SceneCall {
  size_t function = 0; ///< index in the list of functions
  uint32_t line = 0;
  SceneValue::Fields fields;
  SceneValue::List items; ///< what has no name
};

struct SandboxLimits {
  size_t memory_bytes = size_t(256) << 20;
  uint64_t instructions = 200'000'000;
  double seconds = 4; ///< of processor time; only calls that take long for one instruction come near it
  size_t calls = 1'000'000;
};

struct SandboxRun {
  std::vector<SceneCall> calls;
  std::vector<std::string> printed; ///< by `print`, at most 100 calls
  std::string error;                ///< "FILE:LINE: ..."
};

using SandboxConstants = std::map<std::string, std::variant<int64_t, double>>;

/// Runs `text`; `functions` are the names it may call, `constants` what it may read.
SandboxRun run_scene_file(const std::string& name, std::string_view text, std::span<const std::string_view> functions,
                          const SandboxConstants& constants, const SandboxLimits& limits = {});

} // namespace moonshade::renderer
