// What is no face for a renderer (two corners, no area, no place) is left out; what cannot be meant is an error.
#include "renderer/scene/mesh_builder.h"

#include "renderer/scene/mesh.h"

namespace moonshade::renderer {

bool MeshBuilder::has_area(const Mesh::Corners& t) const {
  DVec3 a(mesh_->positions[t[0]]), b(mesh_->positions[t[1]]), c(mesh_->positions[t[2]]);
  DVec3 area = glm::cross(b - a, c - a);
  return glm::dot(area, area) > 0;
}

std::string MeshBuilder::face(std::span<const uint32_t> corners) {
  const std::vector<Vec3>& positions = mesh_->positions;
  polygon_.clear();
  bool finite = true;
  for (uint32_t corner : corners) {
    if (corner >= positions.size())
      return "the face names vertex " + std::to_string(corner) + " of " + std::to_string(positions.size());
    const Vec3& p = positions[corner];
    finite &= is_finite(p);
    if (is_finite(p) && max_component(glm::abs(p)) > kFarthest)
      return "vertex " + std::to_string(corner) + " lies too far out; coordinates reach to 1e15";
    polygon_.push_back(p);
  }
  if (corners.size() < 3) return ++too_small_, "";
  if (!finite) return ++not_finite_, "";
  triangles_.clear();
  triangulate(polygon_, triangles_);
  for (const Mesh::Corners& t : triangles_) {
    Mesh::Corners triangle = {corners[t[0]], corners[t[1]], corners[t[2]]};
    if (has_area(triangle))
      mesh_->triangles.push_back(triangle);
    else
      ++no_area_;
  }
  return "";
}

std::shared_ptr<const Mesh> MeshBuilder::finish(const std::string& path, std::vector<std::string>& warnings) {
  auto say = [&](size_t count, const char* what) {
    if (count) warnings.push_back(path + ": " + std::to_string(count) + what);
  };
  say(too_small_, " faces with fewer than three corners skipped");
  say(not_finite_, " faces with a vertex that is not finite skipped");
  say(no_area_, " triangles without area skipped");
  Mesh& mesh = *mesh_;
  if (mesh.triangles.empty()) return nullptr;
  if (!mesh.uvs.empty()) mesh.uv_corners = mesh.triangles;
  for (Vec2& uv : mesh.uvs)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = Vec2(0);
  if (!mesh.normals.empty()) {
    for (Vec3& n : mesh.normals)
      n = is_finite(n) ? normalize_or(n, Vec3(0)) : Vec3(0);
    mesh.normal_corners = mesh.triangles;
    for (Mesh::Corners& t : mesh.normal_corners)
      if (is_black(mesh.normals[t[0]]) || is_black(mesh.normals[t[1]]) || is_black(mesh.normals[t[2]]))
        t.fill(Mesh::kNoIndex); // a normal that points nowhere is none
  }
  compute_missing_normals(mesh, {});
  return mesh_;
}

} // namespace moonshade::renderer
