// glTF 2.0, as text (.gltf, with its buffers beside it or within) or binary (.glb), by tinygltf: nodes, triangles and
// the numbers and images of materials (beside the file or within). Normal maps, skins, morph targets and animations are
// passed over with a warning, as is an image that is not there.
#pragma once

#include "renderer/scene/folders.h"
#include "renderer/scene/mesh_builder.h"

#include <string>
#include <string_view>

namespace moonshade::renderer {

/// Buffers and images are files of `folders`.
Model read_gltf(const std::string& path, const Folders& folders);

/// The same for a file's bytes; `path` names it in messages, and its folder is where buffers are looked for.
Model parse_gltf(const std::string& path, std::string_view bytes, const Folders& folders);

} // namespace moonshade::renderer
