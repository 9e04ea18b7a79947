// Bump mapping: normals bent by `height`, through its exact gradient or by six differences.
#pragma once

#include "renderer/kernels/kernels.h"
#include "renderer/materials/material_set.h"

namespace moonshade::renderer {

/// A run of points whose outward normals are to be bent.
struct BumpRun {
  const Geometry& geometry;
  const Met* met;            ///< of the first of them
  const PointArrays& points; ///< of the batch
};

/// Bends the normals of points [begin, begin + count), whose inputs stand in the batch, by the material's height, and
/// turns them to the viewer. A point where height faults keeps its normal.
void bend_normals(const CompiledMaterial& material, ShadingBatch& batch, size_t begin, size_t count, const BumpRun& run,
                  FaultLog& faults);

} // namespace moonshade::renderer
