// Wavefront MTL, read by a pass of our own: the common numbers and images, and the three statements that name shaders,
// `texture_shader x.lua` (the file's `color`), `bump_shader x.lua` (its `height`) and `reflect_shader x.lua` (its
// `reflectance`), each also written with a blank instead of the underscore.
#pragma once

#include "renderer/scene/folders.h"
#include "renderer/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace moonshade::renderer {

struct MtlReading {
  std::vector<Material> materials;
  std::string error;
  std::vector<std::string> warnings;
};

MtlReading read_mtl(const std::string& path, const Folders& folders);
MtlReading parse_mtl(const std::string& path, std::string_view text, const Folders& folders);

} // namespace moonshade::renderer
