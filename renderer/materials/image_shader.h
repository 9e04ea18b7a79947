// An image in the place of a shader: what a model's material names for a slot has one entry, of the slot's name, which
// reads `uv`; what it names for bumps has the entry of height_gradient() alone. Nothing else in the renderer knows of
// it.
#pragma once

#include "renderer/scene/scene.h"
#include "runtime/shader.h"

#include <memory>

namespace moonshade::renderer {

std::shared_ptr<const Shader> image_shader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image);

/// Its slopes are along unit tangents (HeightGradient::unit_tangents).
std::shared_ptr<const Shader> bump_image_shader(const BumpImage& how, std::shared_ptr<const Image> image);

} // namespace moonshade::renderer
