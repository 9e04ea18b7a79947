// The OBJ reader: a mesh whose indices lie within its arrays and whose numbers are finite, or an error with a place.
#include "renderer/scene/obj_reader.h"
#include "tests/fuzz/target.h"

#include <cmath>

namespace moonshade::renderer {
namespace {

using fuzz::require;

bool is_index(uint32_t index, size_t count, bool may_be_none) {
  return index < count || (may_be_none && index == Mesh::kNoIndex);
}

void check_corners(const std::vector<Mesh::Corners>& corners, size_t count, bool may_be_none, const Mesh& mesh,
                   const char* what) {
  if (corners.empty()) return;
  require(corners.size() == mesh.triangles.size(), std::string(what) + ": not one entry a triangle");
  for (const Mesh::Corners& corner : corners)
    for (uint32_t index : corner)
      require(is_index(index, count, may_be_none), std::string(what) + ": an index out of range");
}

void check_mesh(const ObjReading& obj) {
  const Mesh& mesh = *obj.mesh;
  require(!mesh.triangles.empty(), "a mesh without triangles");
  check_corners(mesh.triangles, mesh.positions.size(), false, mesh, "triangles");
  check_corners(mesh.normal_corners, mesh.normals.size(), true, mesh, "normals");
  check_corners(mesh.uv_corners, mesh.uvs.size(), true, mesh, "texture coordinates");
  for (const Mesh::Corners& triangle : mesh.triangles)
    for (uint32_t index : triangle)
      require(is_finite(mesh.positions[index]), "a triangle with a position that is not finite");
  for (const Vec3& normal : mesh.normals)
    require(is_finite(normal), "a normal that is not finite");
  for (const Vec2& uv : mesh.uvs)
    require(std::isfinite(uv.x) && std::isfinite(uv.y), "a texture coordinate that is not finite");
  require(mesh.material_slots.empty() || mesh.material_slots.size() == mesh.triangles.size(),
          "material slots: not one entry a triangle");
  for (uint32_t slot : mesh.material_slots)
    require(slot < obj.materials.size(), "a material slot out of range");
}

} // namespace
} // namespace moonshade::renderer

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  const renderer::ObjReading obj = renderer::parse_obj("fuzz.obj", fuzz::text_of(data, size), renderer::Folders());
  fuzz::require((obj.mesh != nullptr) == obj.error.empty(), "either a mesh or an error");
  if (obj.mesh)
    renderer::check_mesh(obj);
  else
    fuzz::require(obj.error.starts_with("fuzz.obj:"), "an error without its place: " + obj.error);
  return 0;
}
