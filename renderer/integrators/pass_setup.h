// What some integrators do before a pass, on all threads: sending out photons; once, gathering irradiance.
#pragma once

#include "renderer/integrators/irradiance_cache.h"
#include "renderer/integrators/photon_tracer.h"

#include <memory>
#include <tbb/task_arena.h>

namespace moonshade::renderer {

class PassSetup {
public:
  static bool needed(IntegratorKind integrator) {
    return integrator == IntegratorKind::Sppm || integrator == IntegratorKind::Irradiance;
  }

  /// All outlive this. `batch_photons` are traced together.
  PassSetup(const PreparedScene& scene, VolumeControls& controls, tbb::task_arena& arena, size_t batch_photons);

  void prepare(uint32_t pass);
  const PhotonMap& photons() const { return photons_; }
  const IrradianceCache* cache() const { return cache_.get(); }
  /// Adds what was counted so far.
  void collect(WorkerStats& stats, FaultLog& faults) const;

private:
  const PreparedScene& scene_;
  VolumeControls& controls_;
  tbb::task_arena& arena_;
  uint32_t batch_photons_;
  Focus focus_;
  PhotonSource source_;
  std::vector<std::unique_ptr<PhotonTracer>> workers_;
  PhotonMap photons_;
  std::unique_ptr<IrradianceCache> cache_;
  WorkerStats cache_stats_;
  FaultLog cache_faults_;
};

} // namespace moonshade::renderer
