#include "renderer/integrators/pass_setup.h"

#include "renderer/geometry/float_environment.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace moonshade::renderer {

namespace {

/// Of all passes' variance and bias together, alpha = 2/3 leaves the least (Knaus and Zwicker 2011).
float radius_scale(uint32_t pass) {
  constexpr double kAlpha = 2.0 / 3;
  double squared = 1;
  for (uint32_t i = 1; i <= pass; ++i)
    squared *= (i + kAlpha) / (i + 1);
  return float(std::sqrt(squared));
}

} // namespace

PassSetup::PassSetup(const PreparedScene& scene, VolumeControls& controls, tbb::task_arena& arena, size_t batch_photons)
    : scene_(scene), controls_(controls), arena_(arena), batch_photons_(uint32_t(batch_photons)),
      focus_(focus_of(scene)), source_(*scene.geometry, *scene.lights, focus_.center, focus_.radius),
      workers_(size_t(arena.max_concurrency())) {}

void PassSetup::prepare(uint32_t pass) {
  if (scene_.scene.settings.integrator == IntegratorKind::Irradiance) {
    if (!cache_) cache_ = std::make_unique<IrradianceCache>(scene_, arena_, cache_stats_, cache_faults_);
    return;
  }
  uint32_t count = scene_.scene.settings.photons, tasks = (count + batch_photons_ - 1) / batch_photons_;
  std::vector<std::vector<Photon>> parts(tasks);
  arena_.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<uint32_t>(0, tasks, 1),
        [&](const tbb::blocked_range<uint32_t>& range) {
          DefaultFloatEnvironment environment;
          auto& worker = workers_[size_t(tbb::this_task_arena::current_thread_index())];
          if (!worker) worker = std::make_unique<PhotonTracer>(scene_, source_, controls_, batch_photons_);
          for (uint32_t task = range.begin(); task < range.end(); ++task) {
            uint32_t first = task * batch_photons_;
            worker->trace(pass, first, std::min(batch_photons_, count - first), parts[task]);
          }
        },
        tbb::simple_partitioner());
  });
  std::vector<Photon> all;
  for (const std::vector<Photon>& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  photons_ = PhotonMap(std::move(all), count, radius_scale(pass));
}

void PassSetup::collect(WorkerStats& stats, FaultLog& faults) const {
  stats += cache_stats_;
  for (const auto& [key, count] : cache_faults_)
    faults[key] += count;
  for (const auto& worker : workers_) {
    if (!worker) continue;
    WorkerStats photons = worker->stats();
    photons.paths = 0; // paths are the camera's
    stats += photons;
    for (const auto& [key, count] : worker->faults())
      faults[key] += count;
  }
}

} // namespace moonshade::renderer
