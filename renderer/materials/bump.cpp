#include "renderer/materials/bump.h"

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

/// The paper's way: the outward unit normal minus the unit vector of u, u being twice the gradient.
Vec3 paper_normal(const PlacedObject& placed, const Vec3& normal, const Vec3& g) {
  Vec3 local = normalize_or(glm::transpose(placed.linear) * normal, normal);
  Vec3 bent = local - normalize_or(g, Vec3(0));
  return normalize_or(placed.normal_matrix * normalize_or(bent, local), normal);
}

void bend_by_gradient(const HeightGradient& gradient, ShadingBatch& batch, size_t begin, size_t count,
                      const BumpRun& run, FaultLog& faults) {
  uint8_t* codes = batch.scratch_codes.data();
  std::fill_n(codes, count, uint8_t(0));
  float* out[EntryCall::kMaxResults];
  for (unsigned c = 0; c < gradient.call.components(); ++c)
    out[c] = batch.heights[c].data();
  FaultReport report;
  gradient.call.run(batch, begin, count, EntryCall::inputs_of(batch, begin), out, codes, report);
  if (report.count || std::count(codes, codes + count, kNotFinite))
    note_faults(gradient.call, codes, count, report, faults);
  HeightArrays heights{};
  for (unsigned c = 0; c < 3; ++c) {
    if (gradient.by_local) heights.by_local[c] = batch.heights[gradient.by_local + c].data();
    if (gradient.by_world) heights.by_world[c] = batch.heights[gradient.by_world + c].data();
    if (gradient.by_uv && c < 2) heights.by_uv[c] = batch.heights[gradient.by_uv + c].data();
  }
  heights.unit_tangents = gradient.unit_tangents;
  heights.codes = codes;
  kernels().bend_normals(run.geometry.sources().data(), run.met, count, heights, run.points, begin);
}

void bend_by_differences(const EntryCall& height, BumpMode mode, ShadingBatch& batch, size_t begin, size_t count,
                         const BumpRun& run, FaultLog& faults) {
  EntryCall::Inputs inputs = EntryCall::inputs_of(batch, begin);
  EntryCall::Inputs displaced = inputs;
  for (int c = 0; c < 3; ++c) {
    displaced[kLocal + c] = batch.scratch_inputs[c].data();
    displaced[kWorld + c] = batch.scratch_inputs[3 + c].data();
  }
  auto placed = [&](size_t k) -> const PlacedObject& { return run.geometry.objects()[run.met[k].hit.object]; };
  // The gradient itself is wanted of shaders that cannot give it: then ε is as small as floats allow.
  const float widening = mode == BumpMode::Gradient ? 0.0f : 0.5f;
  auto epsilon = [&](size_t k) { return std::max(1e-4f * placed(k).extent, widening * inputs[kFootprint][k]); };
  uint8_t* codes = batch.scratch_codes.data();
  std::fill_n(codes, count, uint8_t(0));
  for (int sample = 0; sample < 6; ++sample) {
    int axis = sample / 2;
    float sign = sample % 2 ? -1.0f : 1.0f;
    for (size_t k = 0; k < count; ++k) {
      Vec3 step(0);
      step[axis] = sign * epsilon(k);
      Vec3 world_step = placed(k).linear * step;
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
  // The heights are read; gradients take the place of the first three.
  for (size_t k = 0; k < count; ++k) {
    if (codes[k]) continue;
    Vec3 g = central_difference(batch, inputs, k, epsilon(k));
    if (mode == BumpMode::Paper && is_finite(g) && !is_black(g)) {
      Vec3 normal(run.points.outward[0][begin + k], run.points.outward[1][begin + k], run.points.outward[2][begin + k]);
      normal = paper_normal(placed(k), normal, g);
      for (int c = 0; c < 3; ++c)
        run.points.outward[c][begin + k] = normal[c];
    }
    for (int c = 0; c < 3; ++c)
      batch.heights[size_t(c)][k] = g[c];
  }
  HeightArrays heights{};
  if (mode != BumpMode::Paper)
    for (size_t c = 0; c < 3; ++c)
      heights.by_local[c] = batch.heights[c].data();
  heights.codes = codes;
  kernels().bend_normals(run.geometry.sources().data(), run.met, count, heights, run.points, begin);
}

} // namespace

Gradient height_gradient() { return {"height", {"p", "P", "uv"}}; }

void bend_normals(const CompiledMaterial& material, ShadingBatch& batch, size_t begin, size_t count, const BumpRun& run,
                  FaultLog& faults) {
  if (material.gradient)
    bend_by_gradient(*material.gradient, batch, begin, count, run, faults);
  else
    bend_by_differences(*material.height, material.bump, batch, begin, count, run, faults);
}

} // namespace moonshade::renderer
