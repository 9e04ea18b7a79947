// The point at which a ray meets a triangle, from its corners: one body for one hit and for many side by side
// (surface.cpp, kernels/). The offset bounds the error of the point and of the next intersection with the same triangle
// (both grow with the size of the coordinates involved).
#pragma once

#include "renderer/lane_math.h"

namespace moonshade::renderer {

inline constexpr float kRelativeError = 7.0f / (1 << 24); // seven roundings

template <class L> struct TriangleHit {
  lanes::V3<L> origin, direction;    ///< of the ray
  lanes::V3<L> a, b, c;              ///< corners in world space
  lanes::Mask<L> mirrored, identity; ///< of the object's matrix
  // Where `identity` is not set.
  lanes::V3<L> local_a, local_b, local_c;
  lanes::M3<L> normal_matrix;
  // Where it has normals.
  lanes::Mask<L> smooth;
  lanes::V3<L> normal_a, normal_b, normal_c;
};

template <class L> struct TrianglePoint {
  L u, v, distance, offset;
  lanes::V3<L> world, local, geometric_normal, shading_normal; ///< normals outward
  lanes::V3<L> e1, e2;
};

template <class L> MS_INLINE TrianglePoint<L> triangle_point(const TriangleHit<L>& hit) {
  using namespace lanes;
  using D = Double<L>;
  TrianglePoint<L> p;
  V3<D> a = widened(hit.a), e1 = widened(hit.b) - a, e2 = widened(hit.c) - a;
  V3<D> o = widened(hit.origin), d = widened(hit.direction);
  // Möller and Trumbore in double; the result is kept on the triangle.
  V3<D> across = cross(d, e2);
  D determinant = dot(e1, across);
  V3<D> to = o - a, q = cross(to, e1);
  D u = clamp(dot(to, across) / determinant, D(0.0), D(1.0)), v = clamp(dot(d, q) / determinant, D(0.0), D(1.0));
  D distance = dot(e2, q) / determinant;
  D sum = u + v, excess = D(1.0) / sum;
  auto beyond = less(D(1.0), sum);
  u = select(beyond, u * excess, u), v = select(beyond, v * excess, v);
  auto flat = equal(determinant, D(0.0));
  if (any(flat)) {
    u = select(flat, D(1.0 / 3), u), v = select(flat, D(1.0 / 3), v);
    V3<D> third = {{(e1[0] + e2[0]) / D(3.0), (e1[1] + e2[1]) / D(3.0), (e1[2] + e2[2]) / D(3.0)}};
    distance = select(flat, dot(a + third - o, d), distance);
  }
  p.distance = convert<L>(distance);
  p.world = narrowed(a + e1 * u + e2 * v);
  p.offset = L(kRelativeError) * max(largest(hit.a), max(largest(hit.b), largest(hit.c)));
  p.local = p.world;
  if (any(!hit.identity)) {
    V3<D> la = widened(hit.local_a);
    V3<D> local = la + (widened(hit.local_b) - la) * u + (widened(hit.local_c) - la) * v;
    p.local = select<3>(hit.identity, p.local, narrowed(local));
  }
  p.geometric_normal = narrowed(unit(cross(e1, e2))) * select(hit.mirrored, L(-1.0f), L(1.0f));
  p.u = convert<L>(u), p.v = convert<L>(v);
  p.e1 = narrowed(e1), p.e2 = narrowed(e2);
  p.shading_normal = p.geometric_normal;
  if (any(hit.smooth)) {
    L w = L(1.0f) - p.u - p.v;
    V3<L> normal = hit.normal_a * w + hit.normal_b * p.u + hit.normal_c * p.v;
    if (any(!hit.identity)) normal = select<3>(hit.identity, normal, hit.normal_matrix * normal);
    normal = normalize_or(normal, p.geometric_normal);
    p.shading_normal = select<3>(hit.smooth, normal, p.shading_normal);
    // The file's normals say which side is outside, whatever the order of the corners.
    auto turned = hit.smooth & less(dot(p.shading_normal, p.geometric_normal), L(0.0f));
    p.geometric_normal = select<3>(turned, -p.geometric_normal, p.geometric_normal);
  }
  return p;
}

/// The place on the texture, and derivatives of P by it.
template <class L> struct TexturePoint {
  L u, v;
  lanes::V3<L> dpdu, dpdv;
};

/// `uv`: of the corners.
template <class L> MS_INLINE TexturePoint<L> texture_point(const TrianglePoint<L>& p, const L (&uv)[3][2]) {
  using namespace lanes;
  TexturePoint<L> t;
  L w = L(1.0f) - p.u - p.v;
  t.u = uv[0][0] * w + uv[1][0] * p.u + uv[2][0] * p.v;
  t.v = uv[0][1] * w + uv[1][1] * p.u + uv[2][1] * p.v;
  L d1x = uv[1][0] - uv[0][0], d1y = uv[1][1] - uv[0][1], d2x = uv[2][0] - uv[0][0], d2y = uv[2][1] - uv[0][1];
  L determinant = d1x * d2y - d1y * d2x, inverse = L(1.0f) / determinant;
  t.dpdu = (p.e1 * d2y - p.e2 * d1y) * inverse;
  t.dpdv = (p.e2 * d1x - p.e1 * d2x) * inverse;
  auto bounded = [](const V3<L>& v) __attribute__((always_inline)) {
    L inf = stdlib::infinity<L>();
    return less(stdlib::abs(v[0]), inf) & less(stdlib::abs(v[1]), inf) & less(stdlib::abs(v[2]), inf);
  };
  V3<L> area = cross(t.dpdu, t.dpdv);
  L zero = L(0.0f);
  auto good = less(L(1e-20f), stdlib::abs(determinant)) & bounded(t.dpdu) & bounded(t.dpdv) &
              !(equal(area[0], zero) & equal(area[1], zero) & equal(area[2], zero));
  if (any(!good)) {
    lanes::Frame<L> frame(p.geometric_normal);
    t.dpdu = select<3>(good, t.dpdu, frame.s), t.dpdv = select<3>(good, t.dpdv, frame.t);
  }
  return t;
}

} // namespace moonshade::renderer
