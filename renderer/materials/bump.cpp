// Bump mapping: normals bent by `height`, through its exact gradient or by six differences (material_set.h).
#include "renderer/materials/material_set.h"

#include <algorithm>

namespace moonshade::renderer {

namespace {

/// ∇h by p at one point, from the heights at p ± ε, where p ± ε are the floats nearest to that.
Vec3 central_difference(const ShadingBatch& batch, const EntryCall::Inputs& inputs, size_t k, float epsilon) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    float p = inputs[kLocal + axis][k], step = (p + epsilon) - (p - epsilon);
    g[axis] = (batch.heights[2 * axis][k] - batch.heights[2 * axis + 1][k]) / step;
  }
  return g;
}

/// The outward unit normal, bent by the surface gradient in object space (Mikkelsen 2010), or the paper's way: minus
/// the unit vector of u, u being twice the gradient.
Vec3 bent_normal(const PlacedObject& placed, const Vec3& normal, const Vec3& g, BumpMode mode) {
  Vec3 local = normalize_or(glm::transpose(placed.linear) * normal, normal);
  Vec3 bent = mode == BumpMode::Paper ? local - normalize_or(g, Vec3(0)) : local - (g - local * glm::dot(g, local));
  return normalize_or(placed.normal_matrix * normalize_or(bent, local), normal);
}

/// Bends the normal of a point by the gradient of height by p.
void bend_point(const BumpTarget& target, const Vec3& g, BumpMode mode) {
  if (!is_finite(g) || is_black(g)) return;
  target.point->shading_normal = bent_normal(*target.placed, target.point->shading_normal, g, mode);
}

/// The gradients of u and v by p, along the surface: each rises by 1 along its own tangent and stays along the other.
void gradients_of_uv(const BumpTarget& target, Vec3& by_u, Vec3& by_v) {
  Mat3 to_local = glm::transpose(target.placed->normal_matrix);
  Vec3 u = to_local * target.point->dpdu, v = to_local * target.point->dpdv, across = glm::cross(u, v);
  float square = glm::dot(across, across);
  by_u = glm::cross(v, across) / square;
  by_v = glm::cross(across, u) / square;
}

/// The total derivative of height by p: P moves as M p, and uv along the surface.
Vec3 total_derivative(const HeightGradient& gradient, const ShadingBatch& batch, size_t k, const BumpTarget& target) {
  auto vector_at = [&](unsigned at) {
    return Vec3(batch.heights[at][k], batch.heights[at + 1][k], batch.heights[at + 2][k]);
  };
  Vec3 g(0);
  if (gradient.by_local) g += vector_at(gradient.by_local);
  if (gradient.by_world) g += glm::transpose(target.placed->linear) * vector_at(gradient.by_world);
  if (gradient.by_uv) {
    Vec3 by_u, by_v;
    gradients_of_uv(target, by_u, by_v);
    g += by_u * batch.heights[gradient.by_uv][k] + by_v * batch.heights[gradient.by_uv + 1][k];
  }
  return g;
}

} // namespace

Gradient height_gradient() { return {"height", {"p", "P", "uv"}}; }

void MaterialSet::bend(const CompiledMaterial& material, ShadingBatch& batch, size_t begin, size_t count,
                       const BumpTarget* targets, FaultLog& faults) const {
  if (material.gradient)
    bend_by_gradient(*material.gradient, batch, begin, count, targets, faults);
  else if (material.height)
    bend_by_differences(*material.height, material.bump, batch, begin, count, targets, faults);
}

void MaterialSet::bend_by_gradient(const HeightGradient& gradient, ShadingBatch& batch, size_t begin, size_t count,
                                   const BumpTarget* targets, FaultLog& faults) const {
  uint8_t* codes = batch.scratch_codes.data();
  std::fill_n(codes, count, uint8_t(0));
  float* out[EntryCall::kMaxResults];
  for (unsigned c = 0; c < gradient.call.components(); ++c)
    out[c] = batch.heights[c].data();
  FaultReport report;
  gradient.call.run(batch, begin, count, EntryCall::inputs_of(batch, begin), out, codes, report);
  if (report.count || std::count(codes, codes + count, kNotFinite))
    note_faults(gradient.call, codes, count, report, faults);
  for (size_t k = 0; k < count; ++k)
    if (!codes[k]) bend_point(targets[k], total_derivative(gradient, batch, k, targets[k]), BumpMode::Gradient);
}

void MaterialSet::bend_by_differences(const EntryCall& height, BumpMode mode, ShadingBatch& batch, size_t begin,
                                      size_t count, const BumpTarget* targets, FaultLog& faults) const {
  EntryCall::Inputs inputs = EntryCall::inputs_of(batch, begin);
  EntryCall::Inputs displaced = inputs;
  for (int c = 0; c < 3; ++c) {
    displaced[kLocal + c] = batch.scratch_inputs[c].data();
    displaced[kWorld + c] = batch.scratch_inputs[3 + c].data();
  }
  // The gradient itself is wanted of shaders that cannot give it: then ε is as small as floats allow.
  const float widening = mode == BumpMode::Gradient ? 0.0f : 0.5f;
  auto epsilon = [&](size_t k) { return std::max(1e-4f * targets[k].placed->extent, widening * targets[k].footprint); };
  uint8_t* codes = batch.scratch_codes.data();
  std::fill_n(codes, count, uint8_t(0));
  for (int sample = 0; sample < 6; ++sample) {
    int axis = sample / 2;
    float sign = sample % 2 ? -1.0f : 1.0f;
    for (size_t k = 0; k < count; ++k) {
      Vec3 step(0);
      step[axis] = sign * epsilon(k);
      Vec3 world_step = targets[k].placed->linear * step;
      for (int c = 0; c < 3; ++c) {
        batch.scratch_inputs[c][k] = inputs[kLocal + c][k] + step[c];
        batch.scratch_inputs[3 + c][k] = inputs[kWorld + c][k] + world_step[c];
      }
    }
    float* out[1] = {batch.heights[sample].data()};
    FaultReport sample_report;
    // Codes of this sample stand behind those of the others, which they must not erase.
    uint8_t* sample_codes = batch.faulted.data() + begin;
    std::fill_n(sample_codes, count, uint8_t(0));
    height.run(batch, begin, count, displaced, out, sample_codes, sample_report);
    for (size_t k = 0; k < count; ++k)
      codes[k] = codes[k] ? codes[k] : sample_codes[k];
    if (sample_report.count)
      note_faults(height, nullptr, 0, sample_report, faults);
    else if (std::count(sample_codes, sample_codes + count, kNotFinite))
      note_faults(height, sample_codes, count, {}, faults);
  }
  for (size_t k = 0; k < count; ++k) {
    if (codes[k]) continue;
    bend_point(targets[k], central_difference(batch, inputs, k, epsilon(k)), mode);
  }
}

} // namespace moonshade::renderer
