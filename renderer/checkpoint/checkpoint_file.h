// A render that can be gone on with, as a file: identity, state of the render, and a hash of both. It is written beside
// and renamed, and reaches the disk before it takes the place of the one before: whatever happens, one of them is
// whole.
#pragma once

#include "renderer/checkpoint/archive.h"
#include "renderer/checkpoint/identity.h"

#include <memory>
#include <string>

namespace moonshade::renderer {

/// Where the checkpoint of an image lies.
std::string checkpoint_path(const std::string& image);

/// Error, or empty; then the old checkpoint, if any, is still there.
std::string write_checkpoint(const std::string& path, const Identity& identity, RenderState& state);

/// A checkpoint opened and found whole, with the identity given.
struct OpenedCheckpoint {
  std::unique_ptr<Archive> state; ///< for RenderOptions::resume; null where there is no checkpoint, or an error
  std::string error;              ///< damaged, or another render's
};
OpenedCheckpoint open_checkpoint(const std::string& path, const Identity& identity);

} // namespace moonshade::renderer
