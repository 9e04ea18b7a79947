// The readers of PLY and glTF: objects whose meshes' indices lie within their arrays and whose numbers are finite, or
// an error with a place.
#include "renderer/scene/gltf_reader.h"
#include "renderer/scene/ply_reader.h"
#include "tests/fuzz/target.h"

#include <cmath>

namespace moonshade::renderer {
namespace {

using fuzz::require;

void check_corners(const std::vector<Mesh::Corners>& corners, size_t count, const Mesh& mesh, const char* what) {
  if (corners.empty()) return;
  require(corners.size() == mesh.triangles.size(), std::string(what) + ": not one entry a triangle");
  for (const Mesh::Corners& corner : corners)
    for (uint32_t index : corner)
      require(index < count, std::string(what) + ": an index out of range");
}

void check_mesh(const Mesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh without triangles");
  check_corners(mesh.triangles, mesh.positions.size(), mesh, "triangles");
  check_corners(mesh.normal_corners, mesh.normals.size(), mesh, "normals");
  check_corners(mesh.uv_corners, mesh.uvs.size(), mesh, "texture coordinates");
  for (const Mesh::Corners& triangle : mesh.triangles)
    for (uint32_t index : triangle)
      require(is_finite(mesh.positions[index]), "a triangle with a position that is not finite");
  for (const Vec3& normal : mesh.normals)
    require(is_finite(normal), "a normal that is not finite");
  for (const Vec2& uv : mesh.uvs)
    require(std::isfinite(uv.x) && std::isfinite(uv.y), "a texture coordinate that is not finite");
}

void check_model(const Model& model) {
  for (const Object& object : model.objects) {
    check_mesh(*object.mesh);
    require(object.materials.size() == 1 && object.materials[0] < model.materials.size(), "a material out of range");
  }
  for (const Material& material : model.materials)
    for (const auto& value : material.values)
      require(!value || is_finite(*value), "a material that is not finite");
}

} // namespace
} // namespace moonshade::renderer

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  std::string_view text = fuzz::text_of(data, size);
  const renderer::Model model = text.starts_with("ply") ? renderer::parse_ply("fuzz", text)
                                                        : renderer::parse_gltf("fuzz", text, renderer::Folders());
  fuzz::require(model.objects.empty() != model.error.empty(), "either objects or an error");
  if (model.error.empty())
    renderer::check_model(model);
  else
    fuzz::require(model.error.starts_with("fuzz:"), "an error without its place: " + model.error);
  return 0;
}
