#include "renderer/integrators/miss_shader.h"

#include "renderer/integrators/hit_shader.h"
#include "renderer/kernels/kernels.h"

namespace moonshade::renderer {

MissShader::MissShader(const PreparedScene& scene, size_t capacity)
    : lights_(*scene.lights), knows_density_(lights_.has_formulas_only()) {
  owners_.reserve(capacity), directions_.reserve(capacity), spreads_.reserve(capacity);
  radiance_.resize(capacity), density_.resize(capacity), faulted_.resize(capacity), codes_.resize(capacity);
  if (lights_.asks_shaders())
    batch_ = std::make_unique<ShadingBatch>(capacity, scene.scene.settings.time, scene.scene.settings.frame);
}

void MissShader::ask(FaultLog& faults, WorkerStats& stats) {
  size_t count = owners_.size();
  if (knows_density_) {
    std::span<const EnvironmentLight> formulas = lights_.formulas();
    kernels().surroundings(formulas.data(), formulas.size(), float(lights_.count()), directions_.data(), count,
                           radiance_.data(), density_.data());
    return;
  }
  for (size_t k = 0; k < count; ++k)
    radiance_[k] = lights_.environment(directions_[k]);
  if (!batch_) return;
  std::fill_n(faulted_.begin(), count, uint8_t(0));
  double start = thread_seconds();
  for (const Environment& environment : lights_.environments()) {
    if (!environment.by_shader()) continue;
    environment.shade(*batch_, directions_.data(), spreads_.data(), count, radiance_.data(), codes_.data(), faults);
    stats.shading_points += count;
    for (size_t k = 0; k < count; ++k)
      faulted_[k] |= codes_[k];
  }
  stats.shader_seconds += thread_seconds() - start;
}

} // namespace moonshade::renderer
