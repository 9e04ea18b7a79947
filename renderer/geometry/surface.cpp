// Points on surfaces from a ray and the ids of what it met, one by one.
#include "renderer/geometry/geometry.h"
#include "renderer/geometry/triangle_point.h"

namespace moonshade::renderer {

static float largest(const Vec3& v) { return max_component(glm::abs(v)); }

SurfacePoint Geometry::triangle_at(const PlacedObject& placed, const Ray& ray, const Hit& hit) const {
  const Mesh& mesh = *placed.object->mesh;
  const Mesh::Corners& corner = mesh.triangles[hit.primitive];
  auto lane = [](const Vec3& v) { return lanes::V3<float>{{v.x, v.y, v.z}}; };
  auto vector = [](const lanes::V3<float>& v) { return Vec3(v[0], v[1], v[2]); };
  bool smooth = !mesh.normal_corners.empty();
  const Mesh::Corners n = smooth ? mesh.normal_corners[hit.primitive] : Mesh::Corners{};
  auto normal = [&](int k) { return lane(smooth ? mesh.normals[n[size_t(k)]] : Vec3(0)); };
  const Vec3 &la = mesh.positions[corner[0]], &lb = mesh.positions[corner[1]], &lc = mesh.positions[corner[2]];
  const Mat3& m = placed.normal_matrix;
  TrianglePoint<float> at = triangle_point<float>({lane(ray.origin),
                                                   lane(ray.direction),
                                                   lane(placed.vertices[corner[0]]),
                                                   lane(placed.vertices[corner[1]]),
                                                   lane(placed.vertices[corner[2]]),
                                                   {placed.mirrored},
                                                   {placed.identity},
                                                   lane(la),
                                                   lane(lb),
                                                   lane(lc),
                                                   {{lane(m[0]), lane(m[1]), lane(m[2])}},
                                                   {smooth},
                                                   normal(0),
                                                   normal(1),
                                                   normal(2)});
  SurfacePoint s;
  s.world = vector(at.world), s.local = vector(at.local);
  s.geometric_normal = vector(at.geometric_normal), s.shading_normal = vector(at.shading_normal);
  s.distance = at.distance, s.offset = at.offset;
  // Embree meets an instance in object space: its errors there count as well.
  if (!placed.identity && placed.vertices.kept().empty())
    s.offset += kRelativeError * placed.greatest_scale * std::max(largest(la), std::max(largest(lb), largest(lc)));
  float uv[3][2] = {{0, 0}, {1, 0}, {1, 1}};
  if (!mesh.uv_corners.empty() && mesh.uv_corners[hit.primitive][0] != Mesh::kNoIndex) {
    const Mesh::Corners& t = mesh.uv_corners[hit.primitive];
    for (size_t i = 0; i < 3; ++i)
      if (t[i] != Mesh::kNoIndex) uv[i][0] = mesh.uvs[t[i]].x, uv[i][1] = mesh.uvs[t[i]].y;
  }
  TexturePoint<float> texture = texture_point(at, uv);
  s.uv = {texture.u, texture.v};
  s.dpdu = vector(texture.dpdu), s.dpdv = vector(texture.dpdv);
  return s;
}

SurfacePoint Geometry::sphere_point(const PlacedObject& placed, const Ray& ray, const Hit& hit) const {
  const Object& object = *placed.object;
  double first = hit.distance, second = hit.distance;
  intersect_sphere(placed, ray.origin, ray.direction, first, second);
  double distance = std::abs(first - hit.distance) <= std::abs(second - hit.distance) ? first : second;
  DVec3 o(placed.to_object * glm::dvec4(DVec3(ray.origin), 1.0));
  DVec3 d(placed.to_object * glm::dvec4(DVec3(ray.direction), 0.0));
  DVec3 local = glm::normalize(o + d * distance) * double(object.radius);
  DMat4 m(object.to_world);
  SurfacePoint s;
  s.distance = float(distance);
  s.local = Vec3(local);
  s.world = Vec3(m * glm::dvec4(local, 1.0));
  s.offset = kRelativeError * (largest(s.world) + 2 * object.radius * placed.scale + largest(Vec3(object.to_world[3])));
  Vec3 unit = Vec3(local / double(object.radius));
  s.geometric_normal = s.shading_normal = normalize_or(placed.normal_matrix * unit, unit);
  // Latitude and longitude around y; v = 1 on top.
  float phi = std::atan2(unit.z, unit.x);
  if (phi < 0) phi += 2 * kPi;
  float theta = std::acos(std::clamp(-unit.y, -1.0f, 1.0f));
  s.uv = Vec2(phi / (2 * kPi), theta / kPi);
  Vec3 du(-unit.z, 0, unit.x);
  Vec3 side = normalize_or(du, Vec3(0, 0, 1));
  s.dpdu = placed.linear * (du * (2 * kPi * object.radius));
  s.dpdv = placed.linear * (glm::cross(side, unit) * (kPi * object.radius));
  if (is_black(s.dpdu)) s.dpdu = placed.linear * (side * 1e-6f);
  return s;
}

SurfacePoint Geometry::surface(const Ray& ray, const Hit& hit) const {
  const PlacedObject& placed = objects_[hit.object];
  return placed.object->shape == Shape::Mesh ? triangle_at(placed, ray, hit) : sphere_point(placed, ray, hit);
}

} // namespace moonshade::renderer
