// Points on surfaces from a ray and the ids of what it met. The offset bounds the error of the point and of the next
// intersection with the same primitive (both grow with the size of the coordinates involved).
#include "renderer/geometry/geometry.h"

namespace moonshade::renderer {

namespace {

constexpr float kRelativeError = 7.0f / (1 << 24); // seven roundings

struct Barycentric {
  double u, v, distance;
};

/// Möller and Trumbore in double; the result is kept on the triangle.
Barycentric meet(const DVec3& a, const DVec3& e1, const DVec3& e2, const Ray& ray) {
  DVec3 d(ray.direction);
  DVec3 p = glm::cross(d, e2);
  double determinant = glm::dot(e1, p);
  if (determinant == 0) return {1.0 / 3, 1.0 / 3, glm::dot(a + (e1 + e2) / 3.0 - DVec3(ray.origin), d)};
  DVec3 t = DVec3(ray.origin) - a;
  DVec3 q = glm::cross(t, e1);
  double u = std::clamp(glm::dot(t, p) / determinant, 0.0, 1.0);
  double v = std::clamp(glm::dot(d, q) / determinant, 0.0, 1.0);
  if (u + v > 1) {
    double excess = 1 / (u + v);
    u *= excess, v *= excess;
  }
  return {u, v, glm::dot(e2, q) / determinant};
}

float largest(const Vec3& v) { return max_component(glm::abs(v)); }

/// Derivatives of P by the texture coordinates of the corners.
bool derivatives(const Vec2 uv[3], const Vec3& e1, const Vec3& e2, Vec3& dpdu, Vec3& dpdv) {
  Vec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
  float determinant = d1.x * d2.y - d1.y * d2.x;
  if (!(std::abs(determinant) > 1e-20f)) return false;
  float inverse = 1 / determinant;
  dpdu = (e1 * d2.y - e2 * d1.y) * inverse;
  dpdv = (e2 * d1.x - e1 * d2.x) * inverse;
  return is_finite(dpdu) && is_finite(dpdv) && !is_black(glm::cross(dpdu, dpdv));
}

} // namespace

SurfacePoint Geometry::triangle_point(const PlacedObject& placed, const Ray& ray, const Hit& hit) const {
  const Mesh& mesh = *placed.object->mesh;
  const Mesh::Corners& corner = mesh.triangles[hit.primitive];
  const Vec3 a = placed.vertices[corner[0]], b = placed.vertices[corner[1]], c = placed.vertices[corner[2]];
  DVec3 e1 = DVec3(b) - DVec3(a), e2 = DVec3(c) - DVec3(a);
  Barycentric at = meet(DVec3(a), e1, e2, ray);
  SurfacePoint s;
  s.distance = float(at.distance);
  s.world = Vec3(DVec3(a) + e1 * at.u + e2 * at.v);
  s.offset = kRelativeError * std::max(largest(a), std::max(largest(b), largest(c)));
  if (placed.identity) {
    s.local = s.world;
  } else {
    DVec3 la(mesh.positions[corner[0]]), lb(mesh.positions[corner[1]]), lc(mesh.positions[corner[2]]);
    s.local = Vec3(la + (lb - la) * at.u + (lc - la) * at.v);
    // Embree meets an instance in object space: its errors there count as well.
    if (placed.vertices.kept().empty())
      s.offset += kRelativeError * placed.greatest_scale *
                  std::max(largest(Vec3(la)), std::max(largest(Vec3(lb)), largest(Vec3(lc))));
  }
  s.geometric_normal = Vec3(glm::normalize(glm::cross(e1, e2))) * (placed.mirrored ? -1.0f : 1.0f);

  float u = float(at.u), v = float(at.v), w = 1 - u - v;
  s.shading_normal = s.geometric_normal;
  if (!mesh.normal_corners.empty()) {
    const Mesh::Corners& n = mesh.normal_corners[hit.primitive];
    Vec3 normal = mesh.normals[n[0]] * w + mesh.normals[n[1]] * u + mesh.normals[n[2]] * v;
    if (!placed.identity) normal = placed.normal_matrix * normal;
    s.shading_normal = normalize_or(normal, s.geometric_normal);
    // The file's normals say which side is outside, whatever the order of the corners.
    if (glm::dot(s.shading_normal, s.geometric_normal) < 0) s.geometric_normal = -s.geometric_normal;
  }
  Vec2 uv[3] = {{0, 0}, {1, 0}, {1, 1}};
  if (!mesh.uv_corners.empty() && mesh.uv_corners[hit.primitive][0] != Mesh::kNoIndex) {
    const Mesh::Corners& t = mesh.uv_corners[hit.primitive];
    for (int i = 0; i < 3; ++i)
      if (t[i] != Mesh::kNoIndex) uv[i] = mesh.uvs[t[i]];
  }
  s.uv = uv[0] * w + uv[1] * u + uv[2] * v;
  if (!derivatives(uv, Vec3(e1), Vec3(e2), s.dpdu, s.dpdv)) {
    Frame frame(s.geometric_normal);
    s.dpdu = frame.s, s.dpdv = frame.t;
  }
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
  return placed.object->shape == Shape::Mesh ? triangle_point(placed, ray, hit) : sphere_point(placed, ray, hit);
}

} // namespace moonshade::renderer
