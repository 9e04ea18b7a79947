// An image in the place of a shader: what a model's material names for a slot has one entry, of the slot's name, which
// reads `uv`. Nothing else in the renderer knows of it.
#pragma once

#include "renderer/scene/scene.h"
#include "runtime/shader.h"

#include <memory>

namespace moonshade::renderer {

std::shared_ptr<const Shader> image_shader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image);

} // namespace moonshade::renderer
