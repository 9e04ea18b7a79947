// Vectors, matrices and the few geometric helpers that every room of the renderer uses. Floats throughout; places that
// need more (hit points, spheres) compute in double and round once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace moonshade::renderer {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using DVec3 = glm::dvec3;
using DMat3 = glm::dmat3;
using DMat4 = glm::dmat4;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Luminance of linear Rec. 709.
inline float luminance(const Vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

inline float max_component(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline bool is_black(const Vec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/// `v` of length one, or `otherwise` where it has no direction.
inline Vec3 normalize_or(const Vec3& v, const Vec3& otherwise) {
  float squared = glm::dot(v, v);
  if (squared > 1e-30f && squared < 1e30f) return v * (1.0f / std::sqrt(squared));
  DVec3 wide(v);
  double length = std::sqrt(glm::dot(wide, wide));
  return length > 0 && std::isfinite(length) ? Vec3(wide / length) : otherwise;
}

/// A right-handed frame around the unit vector `n` (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
struct Frame {
  Vec3 s, t, n;

  explicit Frame(const Vec3& normal) : n(normal) {
    float sign = std::copysign(1.0f, n.z);
    float a = -1.0f / (sign + n.z);
    float b = n.x * n.y * a;
    s = Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    t = Vec3(b, sign + n.y * n.y * a, -n.y);
  }
  Vec3 to_local(const Vec3& v) const { return {glm::dot(v, s), glm::dot(v, t), glm::dot(v, n)}; }
  Vec3 to_world(const Vec3& v) const { return s * v.x + t * v.y + n * v.z; }
};

/// Axis-aligned box; empty until something is added.
struct Box {
  Vec3 low{kInfinity};
  Vec3 high{-kInfinity};

  void add(const Vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Box& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  bool empty() const { return !(low.x <= high.x); }
  Vec3 center() const { return low * 0.5f + high * 0.5f; }
  float radius() const { return empty() ? 0.0f : 0.5f * glm::length(high - low); }
};

} // namespace moonshade::renderer
