// Wavefront OBJ: the geometry by tinyobjloader, fed line by line so that every message can name its line.
#pragma once

#include "renderer/scene/folders.h"
#include "renderer/scene/mesh_builder.h"
#include "renderer/scene/scene.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::renderer {

struct ObjReading {
  std::shared_ptr<Mesh> mesh;      ///< null where `error` is set
  std::vector<Material> materials; ///< those that faces use, in the order of Mesh::material_slots
  std::string error;
  std::vector<std::string> warnings;
};

ObjReading read_obj(const std::string& path, const Folders& folders);

/// As a model of one object.
Model model_of_obj(const std::string& path, const Folders& folders);

/// The same for a text; `path` names it in messages, and its folder is where material files are looked for.
ObjReading parse_obj(const std::string& path, std::string_view text, const Folders& folders);

} // namespace moonshade::renderer
