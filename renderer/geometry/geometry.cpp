// Objects in world space and Embree's scene over them. Which of two equal hits a packet of rays reports may depend on
// all of them: packets are for those who always form the same ones. From the camera they take a quarter of the time,
// after a bounce 0.85 of it.
#include "renderer/geometry/geometry.h"

#include "renderer/geometry/embree_api.h"
#include "renderer/geometry/float_environment.h"
#include "stdlib/lane.h"

#include <cstring>
#include <map>

namespace moonshade::renderer {

struct Geometry::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::map<const Mesh*, RTCScene> shared; ///< meshes that stand in the scene several times
  std::string error;

  ~Embree() {
    for (const auto& [mesh, mesh_scene] : shared)
      rtcReleaseScene(mesh_scene);
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

Geometry::Geometry() : embree_(std::make_unique<Embree>()) {}
Geometry::~Geometry() = default;

WorldVertices::WorldVertices(const Object& object, bool keep) : mesh_(object.mesh.get()), to_world_(object.to_world) {
  if (!keep) return;
  kept_.reserve(mesh_->positions.size() + 1);
  bool identity = object.to_world == Mat4(1.0f);
  for (const Vec3& p : mesh_->positions)
    kept_.push_back(identity ? p : Vec3(to_world_ * glm::dvec4(DVec3(p), 1.0)));
  kept_.push_back(Vec3(0));
}

namespace {

PlacedObject place(const Object& object, bool instanced) {
  PlacedObject placed;
  placed.object = &object;
  DMat4 m(object.to_world);
  placed.to_object = glm::inverse(m);
  placed.linear = Mat3(object.to_world);
  placed.normal_matrix = Mat3(glm::transpose(DMat3(placed.to_object)));
  double determinant = glm::determinant(DMat3(m));
  placed.mirrored = determinant < 0;
  placed.identity = object.to_world == Mat4(1.0f);
  placed.scale = float(std::cbrt(std::abs(determinant)));
  placed.greatest_scale =
      std::max(glm::length(placed.linear[0]), std::max(glm::length(placed.linear[1]), glm::length(placed.linear[2])));
  Box box;
  if (object.shape == Shape::Sphere) {
    placed.extent = 2 * object.radius;
    return placed;
  }
  placed.vertices = WorldVertices(object, !instanced);
  for (const Vec3& p : object.mesh->positions)
    if (is_finite(p)) box.add(p);
  placed.extent = box.empty() ? 1.0f : max_component(box.high - box.low);
  return placed;
}

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& placed = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  Box box = bounds_of(*placed.object);
  Vec3 slack = (glm::abs(box.low) + glm::abs(box.high)) * 1e-6f; // the box is computed in float
  box.low -= slack;
  box.high += slack;
  args->bounds_o->lower_x = box.low.x, args->bounds_o->lower_y = box.low.y, args->bounds_o->lower_z = box.low.z;
  args->bounds_o->upper_x = box.high.x, args->bounds_o->upper_y = box.high.y, args->bounds_o->upper_z = box.high.z;
}

/// The nearest crossing within the ray's range, or infinity.
float sphere_distance(const PlacedObject& placed, RTCRayN* ray, unsigned count, unsigned i) {
  Vec3 origin(RTCRayN_org_x(ray, count, i), RTCRayN_org_y(ray, count, i), RTCRayN_org_z(ray, count, i));
  Vec3 direction(RTCRayN_dir_x(ray, count, i), RTCRayN_dir_y(ray, count, i), RTCRayN_dir_z(ray, count, i));
  float near = RTCRayN_tnear(ray, count, i), far = RTCRayN_tfar(ray, count, i);
  double first, second;
  if (!intersect_sphere(placed, origin, direction, first, second)) return kInfinity;
  if (float(first) > near && float(first) < far) return float(first);
  if (float(second) > near && float(second) < far) return float(second);
  return kInfinity;
}

void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& placed = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    float distance = sphere_distance(placed, ray, args->N, i);
    if (distance == kInfinity) continue;
    RTCRayN_tfar(ray, args->N, i) = distance;
    RTCHitN_geomID(hit, args->N, i) = args->geomID;
    RTCHitN_primID(hit, args->N, i) = args->primID;
    RTCHitN_instID(hit, args->N, i, 0) = args->context->instID[0];
  }
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
  const auto& placed = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  if (placed.passable && placed.passable[placed.material_of(0)]) return;
  for (unsigned i = 0; i < args->N; ++i)
    if (args->valid[i] && sphere_distance(placed, args->ray, args->N, i) != kInfinity)
      RTCRayN_tfar(args->ray, args->N, i) = -kInfinity;
}

/// Lets shadow rays through triangles that do not block them.
void keep_opaque(const RTCFilterFunctionNArguments* args) {
  const auto& placed = *static_cast<const PlacedObject*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i)
    if (args->valid[i] && placed.passable[placed.material_of(RTCHitN_primID(args->hit, args->N, i))])
      args->valid[i] = 0;
}

/// The same for a mesh that several objects share: which of them it is, the hit says.
void keep_opaque_instance(const RTCFilterFunctionNArguments* args) {
  const auto* objects = static_cast<const PlacedObject*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    const PlacedObject& placed = objects[RTCHitN_instID(args->hit, args->N, i, 0)];
    if (placed.passable[placed.material_of(RTCHitN_primID(args->hit, args->N, i))]) args->valid[i] = 0;
  }
}

bool lets_through(const PlacedObject& placed) {
  return placed.passable && std::any_of(placed.object->materials.begin(), placed.object->materials.end(),
                                        [&](uint32_t material) { return placed.passable[material] != 0; });
}

void set_ray(RTCRay& out, const Ray& ray) {
  out.org_x = ray.origin.x, out.org_y = ray.origin.y, out.org_z = ray.origin.z;
  out.dir_x = ray.direction.x, out.dir_y = ray.direction.y, out.dir_z = ray.direction.z;
  out.tnear = ray.near, out.tfar = ray.far;
  out.time = 0;
  out.mask = UINT32_MAX;
  out.id = 0;
  out.flags = 0;
}

} // namespace

bool intersect_sphere(const PlacedObject& placed, const Vec3& origin, const Vec3& direction, double& first,
                      double& second) {
  DVec3 o(placed.to_object * glm::dvec4(DVec3(origin), 1.0));
  DVec3 d(placed.to_object * glm::dvec4(DVec3(direction), 0.0));
  double radius = placed.object->radius;
  double a = glm::dot(d, d), b = glm::dot(o, d);
  // The discriminant from the distance of the line to the centre: no cancellation far away.
  DVec3 nearest = o - d * (b / a);
  double inside = radius * radius - glm::dot(nearest, nearest);
  if (!(inside >= 0) || !(a > 0)) return false;
  double half = std::sqrt(inside / a);
  first = -b / a - half;
  second = -b / a + half;
  return true;
}

/// Everything a kernel needs to know of an object's triangles.
static TriangleSource source_of(const PlacedObject& placed) {
  TriangleSource source;
  source.materials = placed.object->materials.data();
  for (int k = 0; k < 9; ++k)
    source.normal_matrix[k] = placed.normal_matrix[k / 3][k % 3], source.linear[k] = placed.linear[k / 3][k % 3];
  source.scale = placed.scale;
  source.mirrored = placed.mirrored, source.identity = placed.identity;
  if (placed.object->shape != Shape::Mesh) return source;
  const Mesh& mesh = *placed.object->mesh;
  if (!mesh.material_slots.empty()) source.material_slots = mesh.material_slots.data();
  if (placed.vertices.kept().empty()) return source;
  auto floats = [](const auto& values) { return values.empty() ? nullptr : &values[0][0]; };
  source.vertices = floats(placed.vertices.kept());
  source.triangles = floats(mesh.triangles);
  source.positions = floats(mesh.positions);
  if (!mesh.normal_corners.empty())
    source.normals = floats(mesh.normals), source.normal_corners = floats(mesh.normal_corners);
  if (!mesh.uv_corners.empty()) source.uvs = floats(mesh.uvs), source.uv_corners = floats(mesh.uv_corners);
  return source;
}

std::unique_ptr<Geometry> Geometry::build(const Scene& scene, std::string& error, std::vector<uint8_t> passable,
                                          bool watertight) {
  std::unique_ptr<Geometry> geometry(new Geometry);
  geometry->watertight_ = watertight;
  geometry->passable_ = std::move(passable);
  geometry->objects_.reserve(scene.objects.size()); // Embree keeps pointers to its elements
  std::map<const Mesh*, size_t> uses;
  for (const Object& object : scene.objects)
    if (object.shape == Shape::Mesh && object.mesh->triangles.size() >= kInstancedTriangles) ++uses[object.mesh.get()];
  for (const Object& object : scene.objects) {
    geometry->objects_.push_back(place(object, uses[object.mesh.get()] > 1));
    if (!geometry->passable_.empty()) geometry->objects_.back().passable = geometry->passable_.data();
    geometry->bounds_.add(bounds_of(object));
  }
  for (const PlacedObject& placed : geometry->objects_)
    geometry->sources_.push_back(source_of(placed));
  DefaultFloatEnvironment restore; // committing flushes denormals in this thread
  if (!geometry->commit(error)) return nullptr;
  return geometry;
}

RTCScene Geometry::new_scene() const {
  RTCScene scene = rtcNewScene(embree_->device);
  rtcSetSceneFlags(scene, watertight_ ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  return scene;
}

RTCGeometry Geometry::triangles(PlacedObject& placed, bool instanced) {
  const Mesh& mesh = *placed.object->mesh;
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (instanced) {
    // Embree reads four floats at a vertex: its own buffer ends as it needs.
    void* buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                           mesh.positions.size());
    if (buffer) std::memcpy(buffer, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
    rtcSetGeometryUserData(geometry, objects_.data());
  } else {
    std::span<const Vec3> vertices = placed.vertices.kept();
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0, sizeof(Vec3),
                               vertices.size() - 1);
    rtcSetGeometryUserData(geometry, &placed);
    if (lets_through(placed)) rtcSetGeometryOccludedFilterFunction(geometry, keep_opaque);
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Mesh::Corners), mesh.triangles.size());
  return geometry;
}

RTCGeometry Geometry::instance_of(PlacedObject& placed) {
  RTCScene& shared = embree_->shared[placed.object->mesh.get()];
  if (!shared) {
    shared = new_scene();
    RTCGeometry mesh = triangles(placed, true);
    // Any of the objects may let light through; those that do not pass the filter at once.
    bool any = std::any_of(objects_.begin(), objects_.end(), [&](const PlacedObject& other) {
      return other.object->mesh == placed.object->mesh && lets_through(other);
    });
    if (any) rtcSetGeometryOccludedFilterFunction(mesh, keep_opaque_instance);
    rtcCommitGeometry(mesh);
    rtcAttachGeometryByID(shared, mesh, 0);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(shared);
  }
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared);
  rtcSetGeometryTimeStepCount(geometry, 1);
  const Mat4& m = placed.object->to_world;
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &m[0][0]);
  return geometry;
}

void Geometry::attach(unsigned id) {
  PlacedObject& placed = objects_[id];
  RTCGeometry geometry = nullptr;
  if (placed.object->shape == Shape::Mesh) {
    geometry = placed.vertices.kept().empty() ? instance_of(placed) : triangles(placed, false);
  } else {
    geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, &placed);
    rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, sphere_intersect);
    rtcSetGeometryOccludedFunction(geometry, sphere_occluded);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_->scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

size_t Geometry::triangle_count() const {
  size_t count = 0;
  for (const PlacedObject& placed : objects_)
    if (placed.object->shape == Shape::Mesh) count += placed.object->mesh->triangles.size();
  return count;
}

/// A careful tree takes twice as long to build and saves 7 % of each ray's time: worth it up to some size.
static RTCBuildQuality quality_for(size_t triangles) {
  return triangles <= 2'000'000 ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
}

bool Geometry::commit(std::string& error) {
  Embree& e = *embree_;
  e.device = rtcNewDevice(nullptr);
  if (!e.device) return error = "Embree finds no device", false;
  rtcSetDeviceErrorFunction(
      e.device, [](void* user, RTCError, const char* text) { static_cast<Embree*>(user)->error = text ? text : "?"; },
      &e);
  e.scene = new_scene();
  rtcSetSceneBuildQuality(e.scene, quality_for(triangle_count()));
  for (unsigned id = 0; id < objects_.size(); ++id)
    attach(id);
  rtcCommitScene(e.scene);
  if (!e.error.empty()) return error = "Embree: " + e.error, false;
  return true;
}

/// What Embree reports of one ray.
static Hit hit_of(unsigned geometry, unsigned instance, unsigned primitive, float distance) {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
  return {instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry, primitive, distance};
}

Hit Geometry::closest(const Ray& ray) const {
  EmbreeQuery with;
  RTCRayHit query;
  set_ray(query.ray, ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  query.hit.primID = 0;
  embree_intersect(embree_->scene, with, query);
  return hit_of(query.hit.geomID, query.hit.instID[0], query.hit.primID, query.ray.tfar);
}

using Four = stdlib::Wide<float, 4>;

/// Four numbers of each of four records, side by side.
static void transpose(const float* const (&records)[4], float* x, float* y, float* z, float* w) {
  Four r[4];
  for (int k = 0; k < 4; ++k)
    std::memcpy(&r[k], records[k], sizeof r[k]);
  Four a = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5), b = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
  Four c = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5), d = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
  Four columns[4] = {__builtin_shufflevector(a, c, 0, 1, 4, 5), __builtin_shufflevector(a, c, 2, 3, 6, 7),
                     __builtin_shufflevector(b, d, 0, 1, 4, 5), __builtin_shufflevector(b, d, 2, 3, 6, 7)};
  float* to[4] = {x, y, z, w};
  for (int k = 0; k < 4; ++k)
    std::memcpy(to[k], &columns[k], sizeof columns[k]);
}

/// Places behind the last ray repeat the first.
static void set_rays(RTCRay16& to, std::span<const Ray* const> rays) {
  for (size_t i = 0; i < 16; i += 4) {
    const float *begins[4], *ends[4];
    for (size_t k = 0; k < 4; ++k) {
      const Ray& ray = *rays[i + k < rays.size() ? i + k : 0];
      begins[k] = &ray.origin.x, ends[k] = &ray.direction.x;
    }
    transpose(begins, to.org_x + i, to.org_y + i, to.org_z + i, to.tnear + i);
    transpose(ends, to.dir_x + i, to.dir_y + i, to.dir_z + i, to.tfar + i);
  }
  for (size_t i = 0; i < 16; ++i)
    to.time[i] = 0, to.mask[i] = UINT32_MAX, to.id[i] = 0, to.flags[i] = 0;
}

void Geometry::closest_together(std::span<const Ray* const> rays, Hit* hits, bool coherent) const {
  constexpr size_t kPacket = 16;
  EmbreeQuery with(coherent);
  alignas(64) int valid[kPacket];
  RTCRayHit16 query;
  set_rays(query.ray, rays);
  for (size_t i = 0; i < kPacket; ++i) {
    valid[i] = i < rays.size() ? -1 : 0;
    query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID[i] = 0;
  }
  embree_intersect(embree_->scene, with, valid, query);
  for (size_t i = 0; i < rays.size(); ++i)
    hits[i] = hit_of(query.hit.geomID[i], query.hit.instID[0][i], query.hit.primID[i], query.ray.tfar[i]);
}

void Geometry::occluded(std::span<const Ray> rays, uint8_t* blocked) const {
  EmbreeQuery with;
  RTCRay query;
  for (size_t i = 0; i < rays.size(); ++i) {
    set_ray(query, rays[i]);
    embree_occluded(embree_->scene, with, query);
    blocked[i] = query.tfar < 0;
  }
}

} // namespace moonshade::renderer
