// Meshes made by the scene readers.
#pragma once

#include "renderer/scene/scene.h"

namespace moonshade::renderer {

/// A parallelogram around `center` with half sides `u` and `v`, facing cross(u, v); uv runs from 0 to 1.
std::shared_ptr<const Mesh> make_rectangle(const Vec3& center, const Vec3& u, const Vec3& v);

/// An axis-aligned box, facing outwards.
std::shared_ptr<const Mesh> make_box(const Vec3& center, const Vec3& size);

} // namespace moonshade::renderer
