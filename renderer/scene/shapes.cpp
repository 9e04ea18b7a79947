// Rectangles and boxes as meshes with flat normals.
#include "renderer/scene/shapes.h"

namespace moonshade::renderer {

static void add_rectangle(Mesh& mesh, const Vec3& center, const Vec3& u, const Vec3& v) {
  uint32_t first = uint32_t(mesh.positions.size());
  const Vec2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Vec2& c : corners) {
    mesh.positions.push_back(center + (2 * c.x - 1) * u + (2 * c.y - 1) * v);
    mesh.uvs.push_back(c);
  }
  for (Mesh::Corners t : {Mesh::Corners{first, first + 1, first + 2}, Mesh::Corners{first, first + 2, first + 3}}) {
    mesh.triangles.push_back(t);
    mesh.uv_corners.push_back(t);
  }
}

std::shared_ptr<const Mesh> make_rectangle(const Vec3& center, const Vec3& u, const Vec3& v) {
  auto mesh = std::make_shared<Mesh>();
  add_rectangle(*mesh, center, u, v);
  return mesh;
}

std::shared_ptr<const Mesh> make_box(const Vec3& center, const Vec3& size) {
  auto mesh = std::make_shared<Mesh>();
  for (int axis = 0; axis < 3; ++axis)
    for (float side : {-1.0f, 1.0f}) {
      Vec3 out(0), u(0), v(0);
      int second = (axis + 1) % 3, third = (axis + 2) % 3;
      out[axis] = side * size[axis] / 2;
      u[second] = size[second] / 2;
      v[third] = side * size[third] / 2;
      add_rectangle(*mesh, center + out, u, v);
    }
  return mesh;
}

} // namespace moonshade::renderer
