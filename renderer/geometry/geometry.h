// The scene's shapes, placed in the world and ready for rays. Embree finds which primitive a ray meets; where it meets
// it is computed here again from the ids, in double, so that points do not depend on Embree's instruction set.
#pragma once

#include "renderer/scene/scene.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

struct RTCGeometryTy; // Embree's
struct RTCSceneTy;

namespace moonshade::renderer {

struct Ray {
  Vec3 origin{0};
  float near = 0;
  Vec3 direction{0};
  float far = kInfinity;
};

struct Hit {
  static constexpr uint32_t kNone = UINT32_MAX;
  uint32_t object = kNone;
  uint32_t primitive = 0;
  float distance = 0;
  bool found() const { return object != kNone; }
};

/// What there is to know of a point on a surface. Normals point outward, not yet to the viewer.
struct SurfacePoint {
  Vec3 world{0}, local{0}; ///< in world and object space
  Vec3 geometric_normal{0}, shading_normal{0};
  Vec2 uv{0};
  Vec3 dpdu{0}, dpdv{0};
  float distance = 0; ///< along the ray
  float offset = 0;   ///< how far a ray must start from the surface not to meet it again
};

/// The vertices of a mesh in world space: kept, or, where the mesh stands in the scene several times and is kept once
/// in object space, computed anew each time. The bits are the same.
class WorldVertices {
public:
  WorldVertices() = default;
  WorldVertices(const Object& object, bool keep);

  Vec3 operator[](uint32_t index) const {
    return kept_.empty() ? Vec3(to_world_ * glm::dvec4(DVec3(mesh_->positions[index]), 1.0)) : kept_[index];
  }
  /// One more than there are follows, for Embree's wide loads; empty where they are not kept.
  std::span<const Vec3> kept() const { return kept_; }

private:
  const Mesh* mesh_ = nullptr;
  DMat4 to_world_{1.0};
  std::vector<Vec3> kept_;
};

/// One object, placed.
struct PlacedObject {
  const Object* object = nullptr;
  WorldVertices vertices; ///< of a mesh
  DMat4 to_object{1.0};
  Mat3 linear{1.0f};        ///< of the object's matrix
  Mat3 normal_matrix{1.0f}; ///< inverse transpose of `linear`
  bool mirrored = false;
  bool identity = false;
  float scale = 1; ///< mean scale of the object's matrix
  float greatest_scale = 1;
  float extent = 1; ///< largest side of the object's box in object space
  /// By material: whether shadow rays look through it; null: none is.
  const uint8_t* passable = nullptr;

  uint32_t material_of(uint32_t primitive) const {
    if (object->shape != Shape::Mesh || object->mesh->material_slots.empty()) return object->materials[0];
    return object->materials[object->mesh->material_slots[primitive]];
  }
};

/// Where the corners of an object's triangles stand, for kernels that see plain data only. An object that is no mesh of
/// its own (a sphere, a mesh that is kept once for several) has none.
struct TriangleSource {
  const uint32_t* materials = nullptr;
  const uint32_t* material_slots = nullptr; ///< by primitive; null: all are of the first
  const float* vertices = nullptr;          ///< in world space, a number more than there are
  const uint32_t* triangles = nullptr;
  const float* positions = nullptr; ///< in object space
  const float* normals = nullptr;   ///< null: flat
  const uint32_t* normal_corners = nullptr;
  const float* uvs = nullptr;
  const uint32_t* uv_corners = nullptr;        ///< null: none
  float normal_matrix[9] = {}, linear[9] = {}; ///< by columns
  float scale = 1;
  bool mirrored = false, identity = true;

  uint32_t material_of(uint32_t primitive) const { return materials[material_slots ? material_slots[primitive] : 0]; }
};

class Geometry {
public:
  /// A mesh with as many triangles is kept once where several objects have it.
  static constexpr size_t kInstancedTriangles = 1000;

  /// Keeps a reference to the scene's objects. Null and an error where Embree fails (memory). `passable`, by material:
  /// surfaces that `occluded` looks through; empty: none. `watertight`: no ray slips through between two triangles that
  /// share an edge; without, one of some 10^5 to 10^8 does, and each takes a fifth less of time.
  static std::unique_ptr<Geometry> build(const Scene& scene, std::string& error, std::vector<uint8_t> passable = {},
                                         bool watertight = true);
  ~Geometry();
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;

  bool watertight() const { return watertight_; }
  std::span<const PlacedObject> objects() const { return objects_; }
  const Box& bounds() const { return bounds_; }
  /// By object.
  std::span<const TriangleSource> sources() const { return sources_; }

  Hit closest(const Ray& ray) const;
  void closest(std::span<const Ray> rays, Hit* hits) const {
    for (size_t i = 0; i < rays.size(); ++i)
      hits[i] = closest(rays[i]);
  }
  /// The same for at most 16 rays from near each other, `coherent` where they also go nearly the same way. Which of two
  /// equally near hits is reported may depend on all of them.
  void closest_together(std::span<const Ray* const> rays, Hit* hits, bool coherent) const;
  /// 1 where something opaque lies between near and far.
  void occluded(std::span<const Ray> rays, uint8_t* blocked) const;

  SurfacePoint surface(const Ray& ray, const Hit& hit) const;

private:
  struct Embree;
  Geometry();
  bool commit(std::string& error);
  size_t triangle_count() const;
  RTCSceneTy* new_scene() const;
  RTCGeometryTy* triangles(PlacedObject& placed, bool instanced);
  RTCGeometryTy* instance_of(PlacedObject& placed);
  void attach(unsigned id);
  SurfacePoint triangle_at(const PlacedObject& placed, const Ray& ray, const Hit& hit) const;
  SurfacePoint sphere_point(const PlacedObject& placed, const Ray& ray, const Hit& hit) const;

  std::vector<uint8_t> passable_;
  bool watertight_ = true;
  std::vector<PlacedObject> objects_;
  std::vector<TriangleSource> sources_;
  Box bounds_;
  std::unique_ptr<Embree> embree_;
};

/// Distances at which a ray meets the sphere of an object, in order; false where it does not.
bool intersect_sphere(const PlacedObject& placed, const Vec3& origin, const Vec3& direction, double& first,
                      double& second);

} // namespace moonshade::renderer
