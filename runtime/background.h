// Jobs of a BackgroundCompiler (shader.h), for the runtime's own files.
#pragma once

#include "runtime/shader.h"

#include <functional>

namespace moonshade {

/// Hands a job over. Jobs run one after the other; one that waits when the compiler goes never runs.
void run_in_background(BackgroundCompiler& compiler, std::function<void()> job);

} // namespace moonshade
