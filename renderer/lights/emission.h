// What surfaces emit on average, by which they are sampled as lights: the constant of a material, what its user says,
// or the mean of what its compiled shader gives over each triangle, measured when the scene is loaded.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/materials/material_set.h"

namespace moonshade::renderer {

struct ObjectEmission {
  std::vector<Vec3> mean; ///< by triangle; one for a sphere; empty: emits nothing
  bool by_shader = false; ///< then points differ from the mean
};

/// By object.
std::vector<ObjectEmission> measure_emission(const Scene& scene, const Geometry& geometry,
                                             const MaterialSet& materials);

/// Average of what each object's surface sends on, over its area: what indirect light takes it for.
std::vector<Vec3> average_colors(const Scene& scene, const Geometry& geometry, const MaterialSet& materials);

} // namespace moonshade::renderer
