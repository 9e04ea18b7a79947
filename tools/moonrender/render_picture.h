// One picture from the scene's file to the image's: read, prepare, render with checkpoints and live views, write.
#pragma once

#include "tools/moonrender/live.h"
#include "tools/moonrender/options.h"

#include <atomic>
#include <memory>
#include <optional>

namespace moonshade::moonrender {

/// What the pictures of one run share.
struct Session {
  std::unique_ptr<renderer::ShaderSource> shaders; ///< each file is compiled once for all frames
  LiveViews live;
  renderer::RenderProgress* progress = nullptr;
};

/// `frame`: nothing where the render is no animation. Gives the exit status; messages go to standard error.
int render_picture(const Options& options, std::optional<int64_t> frame, Session& session);

/// Prints a message of this kind, "FILE:LINE: text" as "FILE:LINE: error: text", and gives the status.
int fail(int status, const std::string& message);

} // namespace moonshade::moonrender
