// Vectors of lanes: the renderer's arithmetic where it is written once for one point and for many. Operations are those
// of math.h in the same order, never contracted: both give the same bits, on every instruction set. Nothing here may
// become a function of its own (kernels/kernels.h).
#pragma once

#include "renderer/math.h"
#include "stdlib/vec.h"

#include <cstdint>

namespace moonshade::renderer::lanes {

using stdlib::any;
using stdlib::bit_cast;
using stdlib::convert;
using stdlib::equal;
using stdlib::Int32;
using stdlib::less;
using stdlib::less_equal;
using stdlib::Mask;
using stdlib::select;
using stdlib::UInt32;
using stdlib::Wide;

template <class L> using V3 = stdlib::Vec<3, L>;
template <class L> using Double = Wide<double, stdlib::width_of<L>>;
template <class L> using Float = Wide<float, stdlib::width_of<L>>;

/// One vector in every lane.
template <class L> MS_INLINE V3<L> spread(const Vec3& v) { return {{L(v.x), L(v.y), L(v.z)}}; }

template <class L> MS_INLINE L min(L a, stdlib::NonDeduced<L> b) { return select(less(b, a), b, a); }
template <class L> MS_INLINE L max(L a, stdlib::NonDeduced<L> b) { return select(less(a, b), b, a); }
template <class L> MS_INLINE L clamp(L x, stdlib::NonDeduced<L> low, stdlib::NonDeduced<L> high) {
  return min(max(x, low), high);
}

template <class L> MS_INLINE L dot(const V3<L>& a, const V3<L>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
template <class L> MS_INLINE V3<L> cross(const V3<L>& a, const V3<L>& b) {
  return {{a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]}};
}
template <class L> MS_INLINE V3<L> times(const V3<L>& a, const V3<L>& b) {
  return {{a[0] * b[0], a[1] * b[1], a[2] * b[2]}};
}
template <class L> MS_INLINE L largest(const V3<L>& v) {
  return max(stdlib::abs(v[0]), max(stdlib::abs(v[1]), stdlib::abs(v[2])));
}
template <class L> MS_INLINE L luminance(const V3<L>& c) {
  return L(0.2126f) * c[0] + L(0.7152f) * c[1] + L(0.0722f) * c[2];
}
template <class L> MS_INLINE V3<Double<L>> widened(const V3<L>& v) {
  return {{convert<Double<L>>(v[0]), convert<Double<L>>(v[1]), convert<Double<L>>(v[2])}};
}
template <class L> MS_INLINE V3<Float<L>> narrowed(const V3<L>& v) {
  return {{convert<Float<L>>(v[0]), convert<Float<L>>(v[1]), convert<Float<L>>(v[2])}};
}
template <class L> MS_INLINE V3<L> unit(const V3<L>& v) { return v * (L(1) / stdlib::sqrt(dot(v, v))); }

/// `v` of length one, or `otherwise` where it has no direction.
template <class L> MS_INLINE V3<L> normalize_or(const V3<L>& v, const V3<L>& otherwise) {
  L squared = dot(v, v);
  auto plain = less(L(1e-30f), squared) & less(squared, L(1e30f));
  V3<L> result = v * (L(1) / stdlib::sqrt(squared));
  if (any(!plain)) {
    V3<Double<L>> wide = widened(v);
    Double<L> length = stdlib::sqrt(dot(wide, wide));
    auto good = less(Double<L>(0.0), length) & less(length, stdlib::infinity<Double<L>>());
    V3<L> far = {{convert<L>(wide[0] / length), convert<L>(wide[1] / length), convert<L>(wide[2] / length)}};
    auto goes = stdlib::to_mask<L>(convert<Float<L>>(select(good, Double<L>(1.0), Double<L>(0.0))) != L(0.0f));
    result = select<3>(plain, result, select<3>(goes, far, otherwise));
  }
  return result;
}

/// A right-handed frame around a unit vector (math.h).
template <class L> struct Frame {
  V3<L> s, t, n;

  MS_INLINE explicit Frame(const V3<L>& normal) : n(normal) {
    L sign = stdlib::copy_sign(L(1.0f), n[2]);
    L a = L(-1.0f) / (sign + n[2]);
    L b = n[0] * n[1] * a;
    s = {{L(1.0f) + sign * n[0] * n[0] * a, sign * b, -sign * n[0]}};
    t = {{b, sign + n[1] * n[1] * a, -n[1]}};
  }
  MS_INLINE V3<L> to_local(const V3<L>& v) const { return {{dot(v, s), dot(v, t), dot(v, n)}}; }
  MS_INLINE V3<L> to_world(const V3<L>& v) const { return s * v[0] + t * v[1] + n * v[2]; }
};

/// A matrix of three columns.
template <class L> struct M3 {
  V3<L> columns[3];
  MS_INLINE V3<L> operator*(const V3<L>& v) const { return columns[0] * v[0] + columns[1] * v[1] + columns[2] * v[2]; }
  /// The transposed matrix times `v`.
  MS_INLINE V3<L> transposed(const V3<L>& v) const {
    return {{dot(columns[0], v), dot(columns[1], v), dot(columns[2], v)}};
  }
};

} // namespace moonshade::renderer::lanes
