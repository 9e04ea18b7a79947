#include "renderer/lights/emission.h"

#include "renderer/geometry/float_environment.h"
#include "renderer/integrators/hit_shader.h"
#include "renderer/lights/endless.h"
#include "renderer/sampling/sampler.h"

namespace moonshade::renderer {

namespace {

constexpr uint32_t kPoints = 4096;   ///< looked at, of an object
constexpr uint32_t kMostEach = 1024; ///< of a triangle
constexpr size_t kBatch = 1024;

/// Looks at points of one object from outside, a batch at a time.
class Meter {
public:
  using Value = Vec3 (*)(const SurfaceValues&);
  Meter(const Scene& scene, const Geometry& geometry, const MaterialSet& materials, Value value)
      : geometry_(geometry), shader_(scene, geometry, materials, kBatch), value_(value) {
    rays_.reserve(kBatch);
  }

  /// What is seen counts for sums[owner].
  void look(uint32_t object, uint32_t primitive, const Vec3& at, const Vec3& normal, std::vector<DVec3>& sums,
            uint32_t owner) {
    if (endless_) return;
    float away = 1e-3f * std::max(1e-3f, geometry_.bounds().radius());
    rays_.push_back({at + normal * away, 0, -normal, kInfinity});
    shader_.add(owner, rays_.back(), {object, primitive, away}, 0, 0);
    if (rays_.size() == kBatch) flush(sums);
  }
  void flush(std::vector<DVec3>& sums) {
    shader_.shade(faults_, stats_, [&](const CompiledMaterial&, size_t begin, size_t end) {
      for (size_t k = begin; k < end; ++k)
        if (!shader_.faulted(k)) sums[shader_.owner(k)] += DVec3(value_(shader_.values(k)));
    });
    shader_.clear();
    rays_.clear();
    endless_ = endless_points(faults_) >= kMostEndless;
  }

private:
  const Geometry& geometry_;
  HitShader shader_;
  Value value_;
  std::vector<Ray> rays_;
  FaultLog faults_;
  WorkerStats stats_;
  bool endless_ = false;
};

/// Where emission varies, a share of the object's mean everywhere: points may be brighter than what was seen of their
/// triangle.
template <typename Varies> void leave_none_out(ObjectEmission& emission, Varies varies) {
  DVec3 sum(0);
  for (const Vec3& mean : emission.mean)
    sum += DVec3(mean);
  Vec3 floor = Vec3(sum / double(emission.mean.size())) * 0.05f;
  for (size_t t = 0; t < emission.mean.size(); ++t)
    if (varies(t)) emission.mean[t] += floor;
}

void measure_mesh(const PlacedObject& placed, uint32_t id, const MaterialSet& materials, Meter& meter,
                  ObjectEmission& emission) {
  const Mesh& mesh = *placed.object->mesh;
  uint32_t count = uint32_t(mesh.triangles.size());
  uint32_t each = std::clamp(kPoints / std::max(count, 1u), count > 100000 ? 1u : 4u, kMostEach);
  std::vector<DVec3> sums(count, DVec3(0));
  for (uint32_t t = 0; t < count; ++t) {
    const CompiledMaterial& material = materials[placed.material_of(t)];
    if (!material.measures_emission()) continue;
    const Mesh::Corners& c = mesh.triangles[t];
    const Vec3 &a = placed.vertices[c[0]], &b = placed.vertices[c[1]], &d = placed.vertices[c[2]];
    Vec3 normal = normalize_or(glm::cross(b - a, d - a), Vec3(0)) * (placed.mirrored ? -1.0f : 1.0f);
    if (is_black(normal) || !is_finite(normal)) continue;
    for (uint32_t k = 0; k < each; ++k) {
      Vec2 u = Sampler(5, t, k).two(id);
      float root = std::sqrt(u.x);
      meter.look(id, t, a * (1 - root) + b * (root * (1 - u.y)) + d * (root * u.y), normal, sums, t);
    }
  }
  meter.flush(sums);
  for (uint32_t t = 0; t < count; ++t) {
    const CompiledMaterial& material = materials[placed.material_of(t)];
    emission.mean[t] = material.measures_emission() ? Vec3(sums[t] / double(each)) : material.known_emission();
    emission.by_shader |= material.emission_varies();
  }
  leave_none_out(emission, [&](size_t t) { return materials[placed.material_of(uint32_t(t))].emission_varies(); });
}

Vec3 emitted(const SurfaceValues& v) { return v.emission * v.opacity; }
Vec3 sent_on(const SurfaceValues& v) {
  return (v.color * (1 - v.transmission) * (Vec3(1) - v.reflectance) + v.reflectance) * v.opacity;
}

/// A point of a sphere, evenly.
void look_at_sphere(const PlacedObject& placed, uint32_t id, const Vec2& u, Meter& meter, std::vector<DVec3>& sums) {
  float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
  Vec3 unit(r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z);
  Vec3 at = Vec3(placed.object->to_world * Vec4(unit * placed.object->radius, 1));
  meter.look(id, 0, at, normalize_or(placed.normal_matrix * unit, unit), sums, 0);
}

void measure_sphere(const PlacedObject& placed, uint32_t id, const CompiledMaterial& material, Meter& meter,
                    ObjectEmission& emission) {
  emission.by_shader = material.emission_varies();
  if (!material.measures_emission()) {
    emission.mean[0] = material.known_emission();
    return;
  }
  std::vector<DVec3> sums(1, DVec3(0));
  for (uint32_t k = 0; k < kMostEach; ++k)
    look_at_sphere(placed, id, Sampler(5, 0, k).two(id), meter, sums);
  meter.flush(sums);
  emission.mean[0] = Vec3(sums[0] / double(kMostEach));
}

} // namespace

std::vector<ObjectEmission> measure_emission(const Scene& scene, const Geometry& geometry,
                                             const MaterialSet& materials) {
  DefaultFloatEnvironment environment;
  std::vector<ObjectEmission> result(scene.objects.size());
  std::unique_ptr<Meter> meter;
  for (uint32_t id = 0; id < result.size(); ++id) {
    const PlacedObject& placed = geometry.objects()[id];
    bool emits = false;
    for (uint32_t m : placed.object->materials)
      emits |= materials[m].emits();
    if (!emits) continue;
    if (!meter) meter = std::make_unique<Meter>(scene, geometry, materials, emitted);
    bool mesh = placed.object->shape == Shape::Mesh;
    result[id].mean.assign(mesh ? placed.object->mesh->triangles.size() : 1, Vec3(0));
    if (mesh)
      measure_mesh(placed, id, materials, *meter, result[id]);
    else
      measure_sphere(placed, id, materials[placed.object->materials[0]], *meter, result[id]);
    if (std::all_of(result[id].mean.begin(), result[id].mean.end(), is_black)) result[id] = {};
  }
  return result;
}

std::vector<Vec3> average_colors(const Scene& scene, const Geometry& geometry, const MaterialSet& materials) {
  DefaultFloatEnvironment environment;
  constexpr uint32_t kEach = 256;
  std::vector<Vec3> colors(scene.objects.size(), Vec3(0));
  Meter meter(scene, geometry, materials, sent_on);
  for (uint32_t id = 0; id < colors.size(); ++id) {
    const PlacedObject& placed = geometry.objects()[id];
    if (materials[placed.object->materials[0]].volume) continue;
    std::vector<DVec3> sums;
    std::vector<float> areas;
    if (placed.object->shape == Shape::Sphere) {
      sums.resize(1), areas = {float(kEach)};
      for (uint32_t k = 0; k < kEach; ++k)
        look_at_sphere(placed, id, Sampler(6, 0, k).two(id), meter, sums);
    } else {
      // Some of its triangles, a point on each, by area.
      const Mesh& mesh = *placed.object->mesh;
      for (uint32_t k = 0; k < kEach && !mesh.triangles.empty(); ++k) {
        Vec2 u = Sampler(6, 0, k).two(id);
        uint32_t t = uint32_t(uint64_t(k) * mesh.triangles.size() / kEach);
        const Mesh::Corners& c = mesh.triangles[t];
        Vec3 a = placed.vertices[c[0]], b = placed.vertices[c[1]], d = placed.vertices[c[2]];
        Vec3 across = glm::cross(b - a, d - a), normal = normalize_or(across, Vec3(0));
        if (is_black(normal) || !is_finite(normal)) continue;
        float root = std::sqrt(u.x);
        sums.emplace_back(0);
        areas.push_back(glm::length(across));
        meter.look(id, t, a * (1 - root) + b * (root * (1 - u.y)) + d * (root * u.y),
                   normal * (placed.mirrored ? -1.0f : 1.0f), sums, uint32_t(sums.size() - 1));
      }
    }
    meter.flush(sums);
    DVec3 sum(0);
    double weight = 0;
    for (size_t k = 0; k < sums.size(); ++k) {
      bool sphere = placed.object->shape == Shape::Sphere;
      sum += sums[k] * (sphere ? 1.0 : double(areas[k]));
      weight += double(areas[k]);
    }
    if (weight > 0) colors[id] = Vec3(sum / weight);
  }
  return colors;
}

} // namespace moonshade::renderer
