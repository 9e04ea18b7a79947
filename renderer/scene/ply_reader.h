// PLY (Turk 1994): ascii and binary of either byte order; positions, normals, texture coordinates and polygons.
// Everything else that a file holds is read past.
#pragma once

#include "renderer/scene/folders.h"
#include "renderer/scene/mesh_builder.h"

#include <string>
#include <string_view>

namespace moonshade::renderer {

Model read_ply(const std::string& path);

/// The same for a file's bytes; `path` names it in messages.
Model parse_ply(const std::string& path, std::string_view bytes);

} // namespace moonshade::renderer
