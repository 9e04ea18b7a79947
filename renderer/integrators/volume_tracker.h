// Ways through volumes, many at once: each advances to its next tentative collision with the cells' controls, then the
// shader says for all of them together what is there. Two ways to go on:
//
//   distance       weighted tracking (Galtier et al. 2013): a collision is real with probability mu / (mu + |c - mu|),
//                  mu being the density and c the control, and carries the weight that makes up for it; none where mu
//                  <= c
//   transmittance  ratio tracking: each tentative collision leaves (c - mu) / c
//   glow           the same, and what is emitted on the way
#pragma once

#include "renderer/integrators/task.h"
#include "renderer/prepared_scene.h"
#include "renderer/sampling/sampler.h"
#include "renderer/volumes/volume_controls.h"

namespace moonshade::renderer {

/// A straight way within one volume.
struct Flight {
  uint32_t owner = 0;
  Hit hit{}; ///< what ends it
  uint32_t object = 0;
  Ray ray; ///< ends at `far`, which is finite
  float width = 0, spread = 0;
  Sampler sampler; ///< for this way alone
  // Results.
  bool collided = false, faulted = false;
  float distance = 0; ///< of a real collision
  float weight = 1;   ///< of what goes on, or transmittance: may be negative, is 1 on average over all chances
  Vec3 glow{0};       ///< emission on the way, as seen from the origin
  Vec3 albedo{0};
  float anisotropy = 0;

  // On the way.
  Vec3 local{0}, step{0}; ///< origin and direction in object space
  float at = 0, scale = 1;
  int cell[3] = {}, turn[3] = {};
  float next[3] = {}, every[3] = {};
  uint32_t drawn = 0;
};

class VolumeTracker {
public:
  /// Both outlive this.
  VolumeTracker(const PreparedScene& scene, VolumeControls& controls, size_t capacity);

  enum class Mode : uint8_t { Distance, Transmittance, Glow };
  void run(std::vector<Flight>& flights, Mode mode, FaultLog& faults, WorkerStats& stats);

  /// What a volume emits at its points; nothing where its shader faults. At most as many as the capacity.
  void emission(uint32_t object, std::span<const Vec3> points, Vec3* emitted, FaultLog& faults, WorkerStats& stats);

private:
  void begin(Flight& flight) const;
  bool advance(Flight& flight, float& control) const;
  void look(std::vector<Flight>& flights, size_t begin, size_t end, Mode mode, FaultLog& faults);
  void collide(std::vector<Flight>& flights, const CompiledMaterial& material, FaultLog& faults);
  void call(const EntryCall& entry, size_t count, unsigned components, size_t result, FaultLog& faults);
  const CompiledMaterial& material_of(uint32_t object) const;
  Vec3 emitted_at(const VolumeCalls& volume, size_t k) const;

  const PreparedScene& scene_;
  VolumeControls& controls_;
  size_t capacity_;
  ShadingBatch batch_;
  std::vector<uint32_t> active_, real_;
  std::vector<float> control_;
  std::vector<uint8_t> failed_;
};

} // namespace moonshade::renderer
