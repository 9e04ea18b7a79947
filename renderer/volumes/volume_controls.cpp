#include "renderer/volumes/volume_controls.h"

#include "renderer/volumes/volume_set.h"

#include <atomic>

namespace moonshade::renderer {

VolumeControls::VolumeControls(const VolumeSet& volumes) {
  for (uint32_t object = 0; object < volumes.object_count(); ++object) {
    first_.push_back(controls_.size());
    if (const Volume* volume = volumes.of(object))
      controls_.insert(controls_.end(), volume->controls.begin(), volume->controls.end());
  }
  wanted_.resize(controls_.size());
}

void VolumeControls::note(uint32_t object, size_t cell, float density) {
  std::atomic_ref<float> wanted(wanted_[first_[object] + cell]);
  float before = wanted.load(std::memory_order_relaxed);
  while (before < density && !wanted.compare_exchange_weak(before, density, std::memory_order_relaxed)) {
  }
}

void VolumeControls::raise() {
  for (size_t k = 0; k < controls_.size(); ++k) {
    if (wanted_[k] > controls_[k]) controls_[k] = wanted_[k] * Volume::kSafety;
    wanted_[k] = 0;
  }
}

void VolumeControls::exchange(Archive& archive) {
  archive.expect<uint64_t>(controls_.size());
  archive.bytes(controls_.data(), controls_.size() * sizeof(float));
}

} // namespace moonshade::renderer
