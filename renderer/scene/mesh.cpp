// Triangulation by ear clipping, and angle-weighted normals.
#include "renderer/scene/mesh.h"

#include <numeric>

namespace moonshade::renderer {

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Newell's normal: twice the area of the polygon, whatever its shape.
DVec3 newell_normal(std::span<const Vec3> polygon) {
  DVec3 normal(0);
  DVec3 origin(polygon[0]);
  for (size_t i = 0; i < polygon.size(); ++i)
    normal += glm::cross(DVec3(polygon[i]) - origin, DVec3(polygon[(i + 1) % polygon.size()]) - origin);
  return normal;
}

struct Flat {
  double x, y;
};
double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along its normal, counter-clockwise.
std::vector<Flat> project(std::span<const Vec3> polygon, const DVec3& normal) {
  int axis = 2;
  if (std::abs(normal.x) >= std::abs(normal.y) && std::abs(normal.x) >= std::abs(normal.z))
    axis = 0;
  else if (std::abs(normal.y) >= std::abs(normal.z))
    axis = 1;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Flat> flat;
  for (const Vec3& p : polygon)
    flat.push_back({sign * p[u], p[v]});
  return flat;
}

bool is_convex(const std::vector<Flat>& flat) {
  size_t n = flat.size();
  for (size_t i = 0; i < n; ++i)
    if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0) return false;
  return true;
}

bool is_ear(const std::vector<Flat>& flat, const std::vector<uint32_t>& left, size_t at) {
  size_t n = left.size();
  uint32_t before = left[(at + n - 1) % n], here = left[at], after = left[(at + 1) % n];
  const Flat &a = flat[before], &b = flat[here], &c = flat[after];
  if (turn(a, b, c) <= 0) return false;
  for (uint32_t other : left) {
    if (other == before || other == here || other == after) continue;
    const Flat& p = flat[other];
    bool on_corner = (p.x == a.x && p.y == a.y) || (p.x == b.x && p.y == b.y) || (p.x == c.x && p.y == c.y);
    if (!on_corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

void fan(size_t count, Triangles& triangles) {
  for (uint32_t i = 1; i + 1 < count; ++i)
    triangles.push_back({0, i, i + 1});
}

void clip_ears(const std::vector<Flat>& flat, Triangles& triangles) {
  std::vector<uint32_t> left(flat.size());
  std::iota(left.begin(), left.end(), 0u);
  size_t at = 0, misses = 0, patience = 32 * flat.size(); // hostile polygons would take cubic time
  while (left.size() > 3 && misses < left.size() && patience-- > 0) {
    size_t n = left.size();
    at %= n;
    if (is_ear(flat, left, at)) {
      triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
      left.erase(left.begin() + std::ptrdiff_t(at));
      misses = 0;
    } else {
      ++at, ++misses;
    }
  }
  // What has no ear left (it crosses itself) is filled as a fan.
  for (size_t i = 1; i + 1 < left.size(); ++i)
    triangles.push_back({left[0], left[i], left[i + 1]});
}

} // namespace

void triangulate(std::span<const Vec3> polygon, Triangles& triangles) {
  constexpr size_t kEarClippingLimit = 1024; // the time is quadratic, and no larger face comes from a modeller
  if (polygon.size() == 3) return triangles.push_back({0, 1, 2});
  std::vector<Flat> flat = project(polygon, newell_normal(polygon));
  if (polygon.size() == 4) {
    // The diagonal that leaves both halves facing one way; the shorter one where both do.
    bool first = turn(flat[0], flat[1], flat[2]) >= 0 && turn(flat[0], flat[2], flat[3]) >= 0;
    bool second = turn(flat[0], flat[1], flat[3]) >= 0 && turn(flat[1], flat[2], flat[3]) >= 0;
    bool first_shorter = glm::distance(polygon[0], polygon[2]) <= glm::distance(polygon[1], polygon[3]);
    if (first && (!second || first_shorter)) return fan(4, triangles);
    triangles.push_back({0, 1, 3});
    triangles.push_back({1, 2, 3});
    return;
  }
  if (polygon.size() > kEarClippingLimit || is_convex(flat)) return fan(polygon.size(), triangles);
  clip_ears(flat, triangles);
}

namespace {

/// For each position the first one that lies at the same place: exporters repeat positions along seams.
std::vector<uint32_t> welded(const std::vector<Vec3>& positions) {
  std::vector<uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  auto key = [&](uint32_t i) { return std::array{positions[i].x, positions[i].y, positions[i].z}; };
  // NaN compares with nothing: such positions, which no triangle uses, stay out of the order.
  std::erase_if(order, [&](uint32_t i) { return !is_finite(positions[i]); });
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

/// For each (welded) position the corners (3 * triangle + corner) that meet there.
struct CornersOfPositions {
  std::vector<uint32_t> start, corners;

  explicit CornersOfPositions(const Mesh& mesh) : start(mesh.positions.size() + 1), corners(3 * mesh.triangles.size()) {
    std::vector<uint32_t> place = welded(mesh.positions);
    for (const Mesh::Corners& t : mesh.triangles)
      for (uint32_t p : t)
        ++start[place[p] + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<uint32_t> next(start.begin(), start.end() - 1);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (uint32_t c = 0; c < 3; ++c)
        corners[next[place[mesh.triangles[t][c]]]++] = 3 * t + c;
  }
};

/// Unit normal of a triangle and the angle at one of its corners.
Vec3 face_normal(const Mesh& mesh, uint32_t triangle) {
  const Mesh::Corners& t = mesh.triangles[triangle];
  Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  return Vec3(glm::normalize(glm::cross(DVec3(b) - DVec3(a), DVec3(c) - DVec3(a))));
}

float corner_angle(const Mesh& mesh, uint32_t triangle, uint32_t corner) {
  const Mesh::Corners& t = mesh.triangles[triangle];
  Vec3 p = mesh.positions[t[corner]];
  Vec3 a = normalize_or(mesh.positions[t[(corner + 1) % 3]] - p, Vec3(0));
  Vec3 b = normalize_or(mesh.positions[t[(corner + 2) % 3]] - p, Vec3(0));
  return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
}

} // namespace

void compute_missing_normals(Mesh& mesh, const Smoothing& smoothing) {
  if (mesh.normal_corners.empty())
    mesh.normal_corners.assign(mesh.triangles.size(), {Mesh::kNoIndex, Mesh::kNoIndex, Mesh::kNoIndex});
  CornersOfPositions around(mesh);
  std::vector<Vec3> faces(mesh.triangles.size());
  for (uint32_t t = 0; t < faces.size(); ++t)
    faces[t] = face_normal(mesh, t);
  std::vector<float> angles(3 * faces.size());
  for (uint32_t c = 0; c < angles.size(); ++c)
    angles[c] = corner_angle(mesh, c / 3, c % 3);

  float crease = std::cos(smoothing.crease_degrees * kPi / 180);
  auto joined = [&](uint32_t t, uint32_t other) {
    if (t == other) return true;
    if (!smoothing.groups.empty()) return smoothing.groups[t] != 0 && smoothing.groups[t] == smoothing.groups[other];
    return glm::dot(faces[t], faces[other]) >= crease;
  };
  for (size_t position = 0; position < mesh.positions.size(); ++position) {
    size_t first_here = mesh.normals.size();
    for (uint32_t at = around.start[position]; at < around.start[position + 1]; ++at) {
      uint32_t triangle = around.corners[at] / 3, corner = around.corners[at] % 3;
      uint32_t& slot = mesh.normal_corners[triangle][corner];
      if (slot != Mesh::kNoIndex) continue;
      Vec3 sum(0);
      // A vertex where hundreds of faces meet would cost quadratic time; beyond this bound its faces stay flat.
      if (around.start[position + 1] - around.start[position] <= 512)
        for (uint32_t k = around.start[position]; k < around.start[position + 1]; ++k)
          if (joined(triangle, around.corners[k] / 3)) sum += faces[around.corners[k] / 3] * angles[around.corners[k]];
      Vec3 normal = normalize_or(sum, faces[triangle]);
      auto same = std::find(mesh.normals.begin() + std::ptrdiff_t(first_here), mesh.normals.end(), normal);
      slot = uint32_t(same - mesh.normals.begin());
      if (same == mesh.normals.end()) mesh.normals.push_back(normal);
    }
  }
}

Box bounds_of(const Object& object) {
  Box box;
  if (object.shape == Shape::Mesh) {
    for (const Mesh::Corners& corners : object.mesh->triangles) // a vertex of no face is not seen
      for (uint32_t corner : corners)
        box.add(Vec3(object.to_world * Vec4(object.mesh->positions[corner], 1)));
    return box;
  }
  Vec3 center(object.to_world[3]), reach;
  for (int row = 0; row < 3; ++row)
    reach[row] =
        object.radius * glm::length(Vec3(object.to_world[0][row], object.to_world[1][row], object.to_world[2][row]));
  box.add(center - reach);
  box.add(center + reach);
  return box;
}

Box bounds_of(const Scene& scene) {
  Box box;
  for (const Object& object : scene.objects)
    box.add(bounds_of(object));
  return box;
}

} // namespace moonshade::renderer
