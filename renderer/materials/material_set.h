// The materials of a scene with their shaders loaded, and the evaluation of a run of points of one material: height
// first (it bends the normal), then every slot, each by one call for the whole run.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/materials/shader_source.h"
#include "renderer/materials/shading_batch.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace moonshade::renderer {

/// Points that faulted, for the report at the end: one line per shader, entry, kind and place of the first of a run.
struct FaultKey {
  std::string file, entry;
  uint8_t code = 0;
  uint32_t line = 0;
  std::string message;
  /// In the order in which a reader goes through the files.
  friend bool operator<(const FaultKey& a, const FaultKey& b) {
    return std::tie(a.file, a.line, a.entry, a.code, a.message) < std::tie(b.file, b.line, b.entry, b.code, b.message);
  }
};
using FaultLog = std::map<FaultKey, uint64_t>;

/// `height` with its derivatives by p, P and uv, of those that it has: where each begins among the results, or 0.
struct HeightGradient {
  EntryCall call;
  unsigned by_local = 0, by_world = 0, by_uv = 0;
  bool unit_tangents = false; ///< `by_uv`: slopes, per length along the tangents, as images have them
};

/// What is asked of the compiler for HeightGradient.
Gradient height_gradient();

/// Adds the faults of one call to the log: those reported, and the codes of results that are not finite.
void note_faults(const EntryCall& call, const uint8_t* codes, size_t count, const FaultReport& report,
                 FaultLog& faults);

/// What a volume's shaders say; where there is no call, the constant.
struct VolumeCalls {
  std::optional<EntryCall> density, color, emission, anisotropy;
  float density_constant = 0, anisotropy_constant = 0;
  Vec3 color_constant{0.8f}, emission_constant{0};

  bool glows() const { return emission || !is_black(emission_constant); }
};

struct CompiledMaterial {
  std::array<Vec3, kSlotCount> constants; ///< in range
  std::array<std::optional<EntryCall>, kSlotCount> calls;
  std::optional<EntryCall> height;
  std::optional<VolumeCalls> volume; ///< then there is no surface
  /// Where the shader gives it and `bump` asks for it; or an image's.
  std::optional<HeightGradient> gradient;
  BumpMode bump = BumpMode::Gradient;
  uint32_t needs = 0; ///< channels that any of its entries reads
  bool emits_outward_only = false;
  bool thin = false;
  Vec3 absorption{0};
  std::optional<Vec3> average_emission; ///< as the scene says

  bool emits() const {
    return !volume && (may_differ(Slot::Emission, 0) || !is_black(constants[size_t(Slot::Emission)]));
  }
  /// A light sample has to ask the shader what arrives.
  bool emission_varies() const { return emits() && (calls[size_t(Slot::Emission)] || may_differ(Slot::Opacity, 1)); }
  bool measures_emission() const { return emission_varies() && !average_emission; }
  Vec3 known_emission() const { return average_emission.value_or(constants[size_t(Slot::Emission)]); }
  /// Light may pass straight through: shadows have to look twice.
  bool passable() const {
    return volume || may_differ(Slot::Opacity, 1) || (thin && may_differ(Slot::Transmission, 0));
  }
  /// Light goes through what it encloses: a path that slipped in unseen would be wrong all the way.
  bool has_inside() const { return volume || (!thin && may_differ(Slot::Transmission, 0)); }
  /// Lambert's law and nothing else.
  bool only_diffuse() const {
    return !volume && !emits() && !may_differ(Slot::Reflectance, 0) && !may_differ(Slot::Metallic, 0) &&
           !may_differ(Slot::Transmission, 0) && !may_differ(Slot::Opacity, 1) && !may_differ(Slot::Ior, 1);
  }
  bool bends() const { return height || gradient; }
  bool has_shaders() const {
    return bends() || std::any_of(calls.begin(), calls.end(), [](const auto& call) { return call.has_value(); });
  }
  bool may_differ(Slot slot, float value) const {
    const Vec3& constant = constants[size_t(slot)];
    bool same = constant.x == value &&
                (slot_infos()[size_t(slot)].components == 1 || (constant.y == value && constant.z == value));
    return calls[size_t(slot)].has_value() || !same;
  }
};

class MaterialSet {
public:
  /// Error: diagnostics of shaders that do not compile, or slots they do not give. `overrides`: material name, then
  /// parameter, then text.
  static std::string build(const Scene& scene, ShaderSource& source,
                           const std::map<std::string, std::map<std::string, std::string>>& overrides,
                           MaterialSet& materials, std::string& warnings);

  size_t size() const { return materials_.size(); }
  const CompiledMaterial& operator[](size_t index) const { return materials_[index]; }
  /// By material: whether light may pass straight through.
  std::vector<uint8_t> passable() const;
  bool any_passable() const { return any_passable_; }
  bool any_has_inside() const {
    return std::any_of(materials_.begin(), materials_.end(), [](const CompiledMaterial& m) { return m.has_inside(); });
  }
  bool any_emits() const {
    return std::any_of(materials_.begin(), materials_.end(),
                       [](const CompiledMaterial& m) { return m.emits() || (m.volume && m.volume->glows()); });
  }
  /// Lanes of the compiled shaders; 1 where there are none.
  unsigned width() const { return width_; }

  /// Every slot of the points that a shader gives into the batch's results, with values kept in range; sets `faulted`
  /// where it fails.
  void shade(const CompiledMaterial& material, ShadingBatch& batch, size_t begin, size_t count, FaultLog& faults) const;

private:
  std::vector<CompiledMaterial> materials_;
  unsigned width_ = 1;
  bool any_passable_ = false;
};

} // namespace moonshade::renderer
