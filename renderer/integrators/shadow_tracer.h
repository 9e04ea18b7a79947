// Rays towards lights, a batch at a time. What is opaque blocks them; a second look goes through what is not (surfaces
// whose opacity a shader gives, thin glass), sorted by material like any other hits. Then lights that shaders describe
// are asked what they send.
#pragma once

#include "renderer/integrators/hit_shader.h"
#include "renderer/integrators/miss_shader.h"
#include "renderer/integrators/volume_tracker.h"

namespace moonshade::renderer {

struct Shadow {
  Ray ray;
  uint32_t owner = 0;
  Vec3 contribution{0}; ///< where nothing is in between
  float width = 0, spread = 0;
  Emitter emitter = Emitter::Known;
  Hit light{}; ///< Emitter::Surface: where the ray ends; Emitter::Volume: the object
  Media media{};
  Sampler sampler{}; ///< for its way through volumes
  Vec3 glow{0};      ///< Emitter::Volume: what of it arrives, gathered on the way
};

class ShadowTracer {
public:
  ShadowTracer(const PreparedScene& scene, VolumeControls& controls, size_t capacity);

  bool full() const { return shadows_.size() == capacity_; }
  bool empty() const { return shadows_.empty(); }
  void add(const Shadow& shadow) {
    shadows_.push_back(shadow);
    asks_ |= shadow.emitter != Emitter::Known;
  }
  /// Afterwards contributions are what arrives; they are shown in the order in which they were added.
  template <typename Deliver> void trace(FaultLog& faults, WorkerStats& stats, Deliver deliver) {
    arrive(faults, stats);
    for (const Shadow& shadow : shadows_)
      if (!is_black(shadow.contribution)) deliver(shadow.owner, shadow.contribution);
    shadows_.clear();
    asks_ = false;
  }

private:
  void arrive(FaultLog& faults, WorkerStats& stats);
  void pass_through(FaultLog& faults, WorkerStats& stats);
  void track_volumes(int surface, FaultLog& faults, WorkerStats& stats);
  void fly(std::vector<Flight>& flights, VolumeTracker::Mode mode, FaultLog& faults, WorkerStats& stats);
  void ask_emitters(FaultLog& faults, WorkerStats& stats);

  const PreparedScene& scene_;
  size_t capacity_;
  std::vector<Shadow> shadows_;
  std::vector<Ray> rays_;
  std::vector<uint8_t> blocked_;
  bool asks_ = false; ///< some shadow's emitter is a shader
  // Only where something lets light through, or a light's emission comes from a shader.
  std::unique_ptr<HitShader> shader_;
  MissShader miss_shader_;
  std::vector<Hit> hits_;
  std::vector<uint32_t> active_;
  std::unique_ptr<VolumeTracker> tracker_; ///< only where there are volumes
  std::vector<Flight> flights_, glowing_;
};

} // namespace moonshade::renderer
