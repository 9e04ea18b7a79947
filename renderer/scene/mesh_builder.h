// Meshes from files whose vertices carry position, normal and texture coordinates together (PLY, glTF): checks every
// face, cuts polygons into triangles, and counts what it leaves out.
#pragma once

#include "renderer/scene/scene.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace moonshade::renderer {

/// A model's objects, with indices into its own materials; none where `error` is set.
struct Model {
  std::vector<Object> objects;
  std::vector<Material> materials;
  std::string error;
  std::vector<std::string> warnings;
};

class MeshBuilder {
public:
  /// Squares and products of what lies farther out leave the range of floats.
  static constexpr float kFarthest = 1e15f;

  MeshBuilder() : mesh_(std::make_shared<Mesh>()) {}

  /// Fill these first; normals and uvs for every vertex or none.
  std::vector<Vec3>& positions() { return mesh_->positions; }
  std::vector<Vec3>& normals() { return mesh_->normals; }
  std::vector<Vec2>& uvs() { return mesh_->uvs; }

  /// A face by its vertices' indices. Error, or empty.
  std::string face(std::span<const uint32_t> corners);
  /// The mesh, null where it has no face; warnings begin with `path`.
  std::shared_ptr<const Mesh> finish(const std::string& path, std::vector<std::string>& warnings);

private:
  std::string add(std::span<const uint32_t> corners);
  bool has_area(const Mesh::Corners& corners) const;

  std::shared_ptr<Mesh> mesh_;
  size_t too_small_ = 0, not_finite_ = 0, no_area_ = 0;
  std::vector<Vec3> polygon_;
  std::vector<Mesh::Corners> triangles_;
};

} // namespace moonshade::renderer
