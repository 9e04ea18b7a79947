// Photons traced a batch at a time, as paths are: rays together, hits sorted by material, shaders called once for all.
// A photon's numbers depend on the seed, the pass and its own number alone, and a batch delivers in order of these
// numbers.
#pragma once

#include "renderer/integrators/hit_shader.h"
#include "renderer/integrators/miss_shader.h"
#include "renderer/integrators/photon_map.h"
#include "renderer/integrators/volume_tracker.h"
#include "renderer/lights/photon_source.h"

namespace moonshade::renderer {

/// A sphere around what the camera sees, for photons to be aimed at.
struct Focus {
  Vec3 center{0};
  float radius = 1;
};
Focus focus_of(const PreparedScene& scene);

/// Where photons are kept: surfaces so rough that following reflections finds less than looking up what arrives.
inline uint8_t gathered_lobes(const Bsdf& bsdf) {
  constexpr float kRough = 0.2f; // alpha
  return kDiffuseLobe | (bsdf.alpha() >= kRough ? kFacetLobe : 0);
}

class PhotonTracer {
public:
  PhotonTracer(const PreparedScene& scene, const PhotonSource& source, VolumeControls& controls, size_t capacity);

  /// Adds what photons [first, first + count) leave behind after at least one bounce (direct light is sampled
  /// otherwise). `count` is at most the capacity.
  void trace(uint32_t pass, uint32_t first, uint32_t count, std::vector<Photon>& photons);

  const WorkerStats& stats() const { return stats_; }
  const FaultLog& faults() const { return faults_; }

private:
  struct Path {
    Ray ray;
    Vec3 power{0};
    Sampler sampler;
    Media media{};
    uint32_t segments = 0, bounces = 0;
    bool alive = true;
  };
  struct Kept {
    uint32_t path, segment;
    Photon photon;
  };
  enum Draw : uint32_t { kLobe, kDirection, kSurvival, kOpacity, kDrawCount };
  uint32_t dimension(const Path& path, Draw draw) const {
    return PhotonSource::kDimensions + path.segments * kDrawCount + draw;
  }
  void start(uint32_t pass, uint32_t first, uint32_t count);
  void ask_emitters();
  void ask_volumes();
  void meet(uint32_t index, const Hit& hit);
  void track_volumes();
  void bounce(const CompiledMaterial& material, size_t k);

  const PreparedScene& scene_;
  const Settings& settings_;
  const PhotonSource& source_;
  HitShader shader_;
  MissShader miss_shader_;
  std::vector<Path> paths_;
  std::vector<EmittedPhoton> emitted_;
  std::vector<uint32_t> active_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<Kept> kept_;
  std::unique_ptr<VolumeTracker> tracker_; ///< only where there are volumes
  std::vector<Flight> flights_;
  std::vector<uint32_t> glowing_;
  std::vector<Vec3> points_, emission_;
  WorkerStats stats_;
  FaultLog faults_;
};

} // namespace moonshade::renderer
