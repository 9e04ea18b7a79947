// Rays towards lights, a batch at a time. What is opaque blocks them; a second look goes through what is not (surfaces
// whose opacity a shader gives, thin glass), sorted by material like any other hits. Then lights that shaders describe
// are asked what they send.
#pragma once

#include "renderer/integrators/hit_shader.h"
#include "renderer/integrators/miss_shader.h"
#include "renderer/integrators/volume_tracker.h"

namespace moonshade::renderer {

/// What else there is to know of a shadow where surfaces or volumes let light through, or shaders say what lights send.
struct ShadowDetails {
  float width = 0, spread = 0; ///< of the footprint
  Emitter emitter = Emitter::Known;
  Hit light{}; ///< Emitter::Surface: where the ray ends; Emitter::Volume: the object
  Media media{};
  Sampler sampler{}; ///< for its way through volumes
  Vec3 glow{0};      ///< Emitter::Volume: what of it arrives, gathered on the way
};

class ShadowTracer {
public:
  ShadowTracer(const PreparedScene& scene, VolumeControls& controls, size_t capacity);

  /// For how many more there is room.
  size_t room() const { return capacity_ - count_; }
  bool empty() const { return count_ == 0; }
  bool wants_details() const { return wants_details_; }
  void add(const Shadow& shadow) { shadows_[count_++] = shadow; }
  /// Where details are wanted.
  void add(const Shadow& shadow, const ShadowDetails& details) {
    details_[count_] = details;
    add(shadow);
  }
  /// Those of them that are `wanted` (not 0), where no details are.
  void add(const Shadow* shadows, const uint32_t* wanted, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      shadows_[count_] = shadows[i]; // there is a place for one too many: no branch that nobody foresees
      count_ += wanted[i] != 0;
    }
  }
  /// Afterwards contributions are what arrives; they are shown in the order in which they were added.
  template <typename Deliver> void trace(FaultLog& faults, WorkerStats& stats, Deliver deliver) {
    arrive(faults, stats);
    for (size_t k = 0; k < count_; ++k)
      if (!is_black(shadows_[k].contribution)) deliver(shadows_[k].owner, shadows_[k].contribution);
    count_ = 0;
  }

private:
  void arrive(FaultLog& faults, WorkerStats& stats);
  void pass_through(FaultLog& faults, WorkerStats& stats);
  void track_volumes(int surface, FaultLog& faults, WorkerStats& stats);
  void fly(std::vector<Flight>& flights, VolumeTracker::Mode mode, FaultLog& faults, WorkerStats& stats);
  void ask_emitters(FaultLog& faults, WorkerStats& stats);

  const PreparedScene& scene_;
  size_t capacity_, count_ = 0;
  bool wants_details_;
  std::vector<Shadow> shadows_;        ///< one more than there may be
  std::vector<ShadowDetails> details_; ///< parallel to them, or empty
  std::vector<Ray> rays_;
  std::vector<uint8_t> blocked_;
  // Only where something lets light through, or a light's emission comes from a shader.
  std::unique_ptr<HitShader> shader_;
  MissShader miss_shader_;
  std::vector<Hit> hits_;
  std::vector<uint32_t> active_;
  std::unique_ptr<VolumeTracker> tracker_; ///< only where there are volumes
  std::vector<Flight> flights_, glowing_;
};

} // namespace moonshade::renderer
