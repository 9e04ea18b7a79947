// Scenes in Lua: what camera{}, sphere{}, obj{}, material{}, light{}, render{} and the rest mean, checked field by
// field.
//
//     camera{ from = {0, 2, 6}, to = {0, 1, 0}, up = {0, 1, 0}, fov = 40 }       fov: vertical, degrees
//     render{ width, height, samples, seed, depth, integrator = "path"|"whitted", exposure, tonemap, clamp, time, frame
//     } local m = material{ name, shader = "copper.lua", params = { scale = 8 }, bump = "gradient"|"paper",
//                         color, reflectance, roughness, metallic, emission, ior, height }
//         (a constant, or the name of a shader file whose entry of that name is used; `height` a file only)
//     sphere{ center, radius, material = m }      p is measured from the centre
//     rectangle{ center, u, v, material }         half its sides; faces cross(u, v)
//     plane{ point, normal, size, material }      a large square
//     box{ center, size, material }
//     obj{ file = "model.obj", material }           its own materials where `material` is left out
//     light{ type = "sun", direction (towards it), color, intensity, angle }
//     light{ type = "sky", zenith, horizon, ground, color, intensity }
//     light{ type = "point", position, color, intensity }
//     light{ type = "area", center, u, v, color, intensity, two_sided }          two_sided = false: cross(u, v) side
//     only
// Objects also take `scale`, `rotate` = {x, y, z} degrees, `translate`, applied in this order.
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
