// Scenes in Lua: what camera{}, render{}, material{}, sphere{}, box{}, rectangle{}, plane{}, obj{} and light{} mean,
// checked field by field. The reference for those who write scenes is docs/scenes.md; a new field belongs there, too.
#pragma once

#include "renderer/scene/folders.h"
#include "renderer/scene/scene.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace moonshade::renderer {

/// The moment to describe; the scene reads it as `time` and `frame`.
struct Animation {
  std::optional<int64_t> frame = std::nullopt; ///< nothing: a single picture, and `render` may set both
  double time = 0;                             ///< seconds
};

SceneReading parse_lua_scene(const std::string& path, std::string_view text, const Folders& folders,
                             const Animation& animation = {});

} // namespace moonshade::renderer
