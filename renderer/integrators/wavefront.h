// The heart of rendering. One Wavefront belongs to one thread and carries a batch of paths from the camera to their
// ends, a bounce of all of them at a time: rays are traced together, hits are sorted by material, and each material's
// shaders are called once for all its points. What a hit then does is the integrator's part: path_scatter.cpp follows
// every kind of light with multiple importance sampling, whitted_scatter.cpp direct light and mirrors, sppm_scatter.cpp
// looks up photons, irradiance_scatter.cpp cached irradiance.
//
// A path's numbers depend on its seed, pixel and sample alone; which paths share a batch changes nothing. Rays are
// traced in packets, which are always those of a sample of one group of pixels (task.h).
#pragma once

#include "renderer/camera.h"
#include "renderer/integrators/hit_shader.h"
#include "renderer/integrators/path.h"
#include "renderer/integrators/photon_map.h"
#include "renderer/integrators/shadow_tracer.h"
#include "renderer/integrators/task.h"
#include "renderer/prepared_scene.h"
#include "renderer/sampling/sampler.h"

#include <vector>

namespace moonshade::renderer {

class Wavefront {
public:
  /// `scene` and `controls` outlive this; `capacity` is the most paths a task may have.
  Wavefront(const PreparedScene& scene, VolumeControls& controls, size_t capacity);

  /// Traces the paths of a task, to their ends.
  void run(const Task& task, const SampleOutputs& out);

  const WorkerStats& stats() const { return stats_; }
  const FaultLog& faults() const { return faults_; }

private:
  void generate(const Task& task);
  void trace();
  void take_hits();
  void meet(uint32_t index, const Hit& hit);
  void track_volumes();
  void scatter_in_volume(uint32_t index, const Flight& flight);
  void leave(const MissShader::Arrival& arrival);
  void scatter(const CompiledMaterial& material, size_t begin, size_t end);
  bool end_if_faulted(Path& path, size_t k);
  bool passes(Path& path, size_t k, const SurfaceValues& values);
  void absorb(Path& path, const CompiledMaterial& material, size_t k, const SurfaceValues& values) const;
  bool may_bounce(const Path& path) const { return path.bounces + 1 < settings_.depth; }

  void scatter_path(const CompiledMaterial& material, size_t begin, size_t end);
  /// What all blocks of a material have in common.
  struct BlockMaterial {
    bool only_diffuse, thin;
    AlbedoTables albedos;
    std::vector<std::pair<const float*, LaneFloats*>> shaded; ///< by shaders, and where it goes in the block
  };
  BlockMaterial block_material(const CompiledMaterial& material);
  void scatter_block(const BlockMaterial& material, const size_t* points, size_t count);
  void load_block(const BlockMaterial& material, const size_t* points, size_t count);
  void add_shadows(size_t count);
  void add_emission(Path& path, const CompiledMaterial& material, size_t k, const SurfaceValues& values);
  void sample_light(Path& path, uint32_t index, size_t k, const Bsdf& bsdf, uint8_t lobes, bool both_ways);
  bool sample_bsdf(Path& path, size_t k, const Bsdf& bsdf, uint8_t lobes);
  void scatter_whitted(const CompiledMaterial& material, size_t begin, size_t end);
  void scatter_sppm(const CompiledMaterial& material, size_t begin, size_t end);
  void scatter_irradiance(const CompiledMaterial& material, size_t begin, size_t end);
  Vec3 gather(const Path& path, size_t k, const Bsdf& bsdf, uint8_t lobes) const;

  /// Continues a path from point `k`.
  void follow(Path& path, size_t k, const Vec3& direction, float spread);
  /// Continues it as if the surface were not there.
  void go_straight(Path& path, size_t k);
  bool survives(Path& path);
  void add_shadow(uint32_t path, size_t k, const LightSample& light, const Vec3& contribution);
  void add_shadow(const Shadow& shadow, const LightSample& light, float width, float spread);
  void trace_shadows();
  static uint32_t dimension(const Path& path, Draw draw) { return dimension_of(path.segments, draw); }
  void deliver(const Task& task, const SampleOutputs& out);
  void note_first_hits(size_t begin, size_t end);

  /// Time since the last lap, in seconds.
  double lap() {
    double now = thread_seconds(), seconds = now - last_;
    last_ = now;
    return seconds;
  }

  const PreparedScene& scene_;
  const Settings& settings_;
  const Kernels& kernels_;
  CameraRays camera_;
  HitShader shader_;
  MissShader miss_shader_;
  ShadowTracer shadows_;
  WorkerStats stats_;
  FaultLog faults_;
  double last_ = 0;
  bool looks_at_first_ = false;
  std::vector<FirstHit> first_; ///< of the task's paths, where asked for
  const PhotonMap* photons_ = nullptr;
  const IrradianceCache* cache_ = nullptr;

  std::vector<Path> paths_;       ///< group by group, in these sample by sample
  std::vector<uint32_t> packets_; ///< by path: alike for a sample of one group
  std::vector<uint32_t> active_;  ///< in the order of paths
  std::vector<const Ray*> rays_;
  std::vector<Hit> hits_;
  std::unique_ptr<VolumeTracker> tracker_; ///< only where there are volumes
  std::vector<Flight> flights_;
  Path camera_path_{}; ///< at the camera, before its ray is known
  ScatterBlock block_{};
  LightSample block_lights_[kLanes];
};

} // namespace moonshade::renderer
