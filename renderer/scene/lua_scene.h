// Scenes in Lua: what camera{}, render{}, material{}, sphere{}, box{}, rectangle{}, plane{}, obj{} and light{} mean,
// checked field by field. The reference for those who write scenes is docs/scenes.md; a new field belongs there, too.
#pragma once

#include "renderer/scene/folders.h"
#include "renderer/scene/scene.h"

#include <map>
#include <string>
#include <string_view>

namespace moonshade::renderer {

/// The scene may read the constants `time` and `frame`, both 0 until there is animation.
SceneReading parse_lua_scene(const std::string& path, std::string_view text, const Folders& folders);

} // namespace moonshade::renderer
