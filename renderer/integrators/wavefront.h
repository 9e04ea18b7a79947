// The heart of rendering. One Wavefront belongs to one thread and carries a batch of paths from the camera to their
// ends, a bounce of all of them at a time: rays are traced together, hits are sorted by material, and each material's
// shaders are called once for all its points. What a hit then does is the integrator's part: path_scatter.cpp follows
// every kind of light with multiple importance sampling, whitted_scatter.cpp direct light and mirrors.
//
// A path's numbers depend on its seed, pixel and sample alone; which paths share a batch changes nothing.
#pragma once

#include "renderer/camera.h"
#include "renderer/integrators/task.h"
#include "renderer/materials/bsdf.h"
#include "renderer/prepared_scene.h"
#include "renderer/sampling/sampler.h"

#include <ctime>
#include <vector>

namespace moonshade::renderer {

class Wavefront {
public:
  /// `scene` outlives this; `capacity` is the most paths a task may have.
  Wavefront(const PreparedScene& scene, size_t capacity);

  /// Traces the paths of a task, to their ends.
  void run(const Task& task, const SampleOutputs& out);

  const WorkerStats& stats() const { return stats_; }
  const FaultLog& faults() const { return faults_; }

private:
  struct Path {
    Ray ray;
    Vec3 throughput{1}, radiance{0};
    Sampler sampler;
    float pdf = 0;    ///< of the direction, by the surface it comes from
    float width = 0;  ///< of the footprint at the ray's origin
    float spread = 0; ///< its growth per distance
    uint32_t segments = 0;
    bool mirror = true; ///< no light sampling could have found what this ray finds
    bool alive = true;
    bool faulted = false;
  };
  struct Shadow {
    uint32_t path;
    Vec3 contribution;
  };
  /// Numbers drawn at one vertex.
  enum Draw : uint32_t { kLightChoice, kLightPoint, kLobe, kDirection, kRoulette, kDrawCount };

  void generate(const Task& task);
  void trace();
  void leave(Path& path);
  void sort_by_material();
  void shade_run(uint32_t material, size_t begin, size_t end);
  void fill_inputs(uint32_t needs, size_t k);
  void fill_normal(size_t k);
  SurfaceValues values_at(size_t k) const;
  bool end_if_faulted(Path& path, size_t k);
  Bsdf bsdf_at(const Path& path, size_t k, const SurfaceValues& values) const;

  void scatter_path(const CompiledMaterial& material, size_t begin, size_t end);
  void sample_light(Path& path, uint32_t index, size_t k, const Bsdf& bsdf);
  bool sample_bsdf(Path& path, size_t k, const Bsdf& bsdf);
  void scatter_whitted(const CompiledMaterial& material, size_t begin, size_t end);

  /// Continues a path from point `k`.
  void follow(Path& path, size_t k, const Vec3& direction, float spread);
  void add_shadow(uint32_t path, size_t k, const LightSample& light, const Vec3& contribution);
  void trace_shadows();
  uint32_t dimension(const Path& path, Draw draw) const { return 1 + path.segments * kDrawCount + draw; }
  void deliver(const Task& task, const SampleOutputs& out);
  void note_first_hits(uint32_t material, size_t begin, size_t end);

  /// What this thread has run so far; waiting for a core does not count.
  static double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
  /// Time since the last lap, in seconds.
  double lap() {
    double now = thread_seconds(), seconds = now - last_;
    last_ = now;
    return seconds;
  }

  const PreparedScene& scene_;
  const Settings& settings_;
  CameraRays camera_;
  ShadingBatch batch_;
  WorkerStats stats_;
  FaultLog faults_;
  double last_ = 0;
  FirstHit* first_ = nullptr; ///< of the task's paths, where asked for

  std::vector<Path> paths_;
  std::vector<uint32_t> active_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  // Of the hits, sorted by material.
  std::vector<uint32_t> run_start_;    ///< by material
  std::vector<uint32_t> hit_material_; ///< by active ray
  std::vector<uint32_t> path_of_;
  std::vector<Hit> hit_of_;
  std::vector<SurfacePoint> points_; ///< normals outward until shaded, then towards the viewer
  std::vector<BumpTarget> targets_;
  // Shadow rays not traced yet.
  std::vector<Ray> shadow_rays_;
  std::vector<Shadow> shadows_;
  std::vector<uint8_t> blocked_;
};

} // namespace moonshade::renderer
