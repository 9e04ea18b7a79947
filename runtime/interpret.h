// The stock-Lua oracle: the same shader file run by liblua5.4 beside the module `moonshade`, every argument over the
// Lua stack, always in double. Its states have no io, os, debug, package or load.
//
// Where stock Lua goes on with a value that the dialect has no place for (LANGUAGE section 9: the step limit, and
// conversions to an integer that no integer represents), these states raise the dialect's fault, so that values and
// faults are those of compiled code under f64.
#pragma once

#include "runtime/frontend.h"
#include "runtime/shader.h"

namespace moonshade {

struct InterpretOptions {
  /// Count steps exactly as compiled code does and fault at the limit; costs time. Off: only a coarse guard against
  /// endless loops, for which calls of functions do not count.
  bool count_steps = true;
  /// 0, and count_steps off: no guard at all, for measurements of shaders that are known to end.
  uint64_t step_limit = 1'000'000;
  /// Once many points have met the limit, what a point may take falls to some times what points took that ended: an
  /// endless shader then faults at every point, but soon.
  bool impatient = false;
  /// Opens the shader's images.
  ImageOpener images = {};
};

/// Loads a checked shader into stock Lua. run() serves any number of threads: each call borrows a Lua state of its own.
Instantiation interpret(const CheckedShader& shader, const std::map<std::string, Constant>& parameters,
                        const InterpretOptions& options);

} // namespace moonshade
