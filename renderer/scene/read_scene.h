// A scene from what the user names: a Lua scene, or a bare OBJ, which gets a camera that frames it, a sun and a sky.
#pragma once

#include "renderer/scene/lua_scene.h"
#include "renderer/scene/scene.h"

#include <string>

namespace moonshade::renderer {

SceneReading read_scene(const std::string& path, const Animation& animation = {});

/// A camera that sees all of `box` from a little above and to the side.
Camera framing_camera(const Box& box);

/// Sky and sun as a bare model gets them.
void add_daylight(Scene& scene);

} // namespace moonshade::renderer
