// The controls of one render: those measured when the scene was loaded, raised between passes where a density turned
// out to be greater. Within a pass they stay as they are, so that every sample is as good as any other and none depends
// on threads; what is raised depends on the samples of whole passes alone.
#pragma once

#include "renderer/checkpoint/archive.h"

#include <cstdint>
#include <vector>

namespace moonshade::renderer {

class VolumeSet;

class VolumeControls {
public:
  explicit VolumeControls(const VolumeSet& volumes);

  float at(uint32_t object, size_t cell) const { return controls_[first_[object] + cell]; }
  /// A density above the control of its cell. From any thread: the greatest counts, whoever comes first.
  void note(uint32_t object, size_t cell, float density);
  /// After a whole pass.
  void raise();
  void exchange(Archive& archive);

private:
  std::vector<size_t> first_; ///< by object
  std::vector<float> controls_, wanted_;
};

} // namespace moonshade::renderer
