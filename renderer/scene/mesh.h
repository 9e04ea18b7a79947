// Making meshes whole: polygons into triangles, normals where a file has none, bounds.
#pragma once

#include "renderer/scene/scene.h"

#include <span>
#include <vector>

namespace moonshade::renderer {

/// Corners (positions in `polygon`) of triangles that fill a polygon of at least three points; concave and slightly
/// bent polygons included.
void triangulate(std::span<const Vec3> polygon, std::vector<std::array<uint32_t, 3>>& triangles);

/// Smoothing as the file asks for it: per triangle a group, 0 = flat; nothing where the file does not speak of it, then
/// edges sharper than `crease_degrees` stay sharp.
struct Smoothing {
  std::vector<uint32_t> groups; ///< per triangle, or empty
  float crease_degrees = 50;
};

/// Fills in normals, weighted by the angle of each corner, for the triangles whose first normal corner is
/// Mesh::kNoIndex (all of them where `normal_corners` is empty).
void compute_missing_normals(Mesh& mesh, const Smoothing& smoothing);

} // namespace moonshade::renderer
