// All lights of a scene, ready to be sampled: points, spots, sun, sky, surroundings, and objects whose material emits,
// by their average emission: surfaces, and volumes that glow. A light is chosen uniformly.
//
// Directions that leave the scene form one "environment" of sun, sky and surroundings: its radiance and density are
// sums over all, so that a direction drawn for one of them is weighed as the mixture that it is.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/lights/emission.h"
#include "renderer/lights/environment.h"
#include "renderer/lights/light_lanes.h"
#include "renderer/scene/scene.h"
#include "renderer/volumes/volume_set.h"

#include <optional>
#include <span>
#include <vector>

namespace moonshade::renderer {

struct ScatterBlock;

/// Who says what a light sends: the sample itself, or a shader yet to be asked; of a volume, all that glows along the
/// ray, up to the first surface.
enum class Emitter : uint8_t { Known, Surface, Surroundings, Volume };

/// Light that may arrive at a point from a direction, if nothing is in between.
struct LightSample {
  Vec3 direction{0};
  float distance = 0; ///< infinite for the environment; of a volume, to where the last of it ends
  Vec3 radiance{0};   ///< black: nothing from here. For a light without extent: irradiance on a facing surface
  float pdf = 0;      ///< per solid angle, choice of the light included
  bool delta = false; ///< no ray can find it by chance; then `pdf` is that of the choice alone
  /// Where not Known, `radiance` is 1 and still to be multiplied by what is emitted towards the point.
  Emitter emitter = Emitter::Known;
  uint32_t object = 0, primitive = 0; ///< Surface, Volume
};

class LightSet {
public:
  LightSet(const Scene& scene, const Geometry& geometry, const VolumeSet& volumes, std::vector<ObjectEmission> emission,
           std::vector<Environment> environments);

  size_t count() const { return lights_.size(); }
  /// One light chosen by `choice`, and a point of it by what is left of that and `u`.
  LightSample sample(const Vec3& point, float choice, const Vec2& u) const;
  /// The same for the lights that a block of points has drawn: what is a formula is left to the kernel (kernels.h), the
  /// rest is found. Emitters of the other points are Known.
  void look_up(ScatterBlock& block, size_t count, LightSample* others) const;
  /// A given light by itself, as direct lighting sums them: the density is that of this light alone, and the sun counts
  /// as irradiance from a direction within its disc. Not for skies.
  LightSample sample_light(size_t light, const Vec3& point, const Vec2& u, float w) const;
  bool is_sky(size_t light) const { return lights_[light].kind == Kind::Sky || lights_[light].kind == Kind::Around; }

  /// What shaders give excluded.
  Vec3 environment(const Vec3& direction) const;
  /// Surroundings by shaders, whose radiance is to be added to that.
  bool asks_shaders() const { return asks_shaders_; }
  /// Objects whose emission a shader gives.
  bool asks_surfaces() const {
    return std::any_of(lights_.begin(), lights_.end(), [](const Entry& e) { return e.by_shader; });
  }
  std::span<const Environment> environments() const { return environments_; }
  /// Where the surroundings are formulas only, `formulas` are all of them, and their density is
  /// environment_pdf's times the number of lights.
  bool has_formulas_only() const { return formulas_only_; }
  std::span<const EnvironmentLight> formulas() const { return formulas_; }
  /// Density of `sample` for a direction that leaves the scene.
  float environment_pdf(const Vec3& direction) const;
  /// Density of `sample` for a point on an object, seen from `distance` away along `direction`; 0 where the object is
  /// not sampled.
  float object_pdf(uint32_t object, uint32_t primitive, const Vec3& from, const Vec3& direction, float distance,
                   const Vec3& normal) const;
  /// Density of `sample` for a direction in which a volume may be; 0 where it is not sampled.
  float volume_pdf(uint32_t object, const Vec3& from, const Vec3& direction) const;
  /// Irradiance of the skies, without what stands before them, on a surface with this normal.
  Vec3 sky_irradiance(const Vec3& normal) const;

private:
  friend class PhotonSource;
  enum class Kind : uint8_t { Point, Spot, Sun, Sky, Around, Mesh, Sphere, Ellipsoid, Volume };
  struct Entry {
    Kind kind = Kind::Point;
    Light light{};
    uint32_t object = 0;
    Vec3 center{0};
    float radius = 0;
    float one_minus_cos = 0;             ///< Sun
    std::vector<uint32_t> triangles;     ///< Mesh: those that emit
    std::vector<float> cumulative;       ///< Mesh: over their weights; Sky: over bands of height
    std::vector<float> band_density;     ///< Sky: per solid angle, by band
    std::vector<float> triangle_pdf;     ///< Mesh: density per area, by primitive; 0 where it does not emit
    std::vector<LightTriangle> emitting; ///< Mesh: parallel to `triangles`; emission is 1 where a shader is asked
    Vec3 emission{0};                    ///< Sphere, Ellipsoid
    float power = 0;                     ///< Mesh: luminance of its mean emission, times area
    bool by_shader = false;              ///< emission is a mean
    bool one_sided = false;
    float cos_inner = 1, cos_outer = 1; ///< Spot
    uint32_t around = 0;                ///< Around: index into environments_
    const GlowGrid* glow = nullptr;     ///< Volume
  };

  /// What look_up needs of a light that is a choice from a table, by formula from there: an emitting mesh, or a sky.
  struct Choice {
    std::span<const float> cumulative; ///< empty: it is none
    const LightTriangle* emitting = nullptr;
    const Entry* by_shader = nullptr; ///< or null
  };
  Choice choice_of(const Entry& entry) const;

  void add_sky(const Light& light);
  void add_point_or_sun(const Light& light);
  void add_mesh(const PlacedObject& placed, uint32_t id, const ObjectEmission& emission);
  void add_sphere(const PlacedObject& placed, uint32_t id, const ObjectEmission& emission);
  LightSample sample_mesh(const Entry& entry, const Vec3& point, const Vec2& u) const;
  LightSample sample_sphere(const Entry& entry, const Vec3& point, const Vec2& u) const;
  LightSample sample_ellipsoid(const Entry& entry, const Vec3& point, const Vec2& u) const;
  LightSample sample_point(const Entry& entry, const Vec3& point) const;
  /// Of point `i`.
  void look_up_other(ScatterBlock& block, size_t i, LightSample& found) const;
  /// As `sample` does, of a light that is chosen.
  LightSample sample_of(size_t light, const Vec3& point, const Vec2& u, float w) const;
  LightSample sample_entry(const Entry& entry, const Vec3& point, const Vec2& u, float w) const;
  LightSample sample_volume(const Entry& entry, const Vec3& point, const Vec2& u, float w) const;
  LightSample sample_environment(const Vec3& direction) const;
  static float spot_share(const Entry& entry, const Vec3& to_light);
  static float ellipsoid_pdf(const PlacedObject& placed, const Vec3& unit);
  static uint32_t choose(std::span<const float> cumulative, float& u);
  /// Of a sun or a sky; refers to its entry.
  static EnvironmentLight formula_of(const Entry& entry);
  /// Density of a direction by one of the lights far away.
  float entry_pdf(const Entry& entry, const Vec3& direction) const;
  const Geometry& geometry_;
  const Scene& scene_;
  std::vector<Environment> environments_;
  bool asks_shaders_ = false;
  std::vector<Entry> lights_;
  std::vector<Choice> choices_;            ///< parallel to `lights_`
  std::vector<EnvironmentLight> formulas_; ///< sun and sky
  std::vector<uint32_t> environment_;      ///< lights that are sun, sky or surroundings
  bool formulas_only_ = true;
  std::vector<int32_t> light_of_object_;
  std::vector<Vec3> irradiance_; ///< of the skies, by the normal's y from -1 to 1
};

} // namespace moonshade::renderer
