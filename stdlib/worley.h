// Worley's cellular noise ("A cellular texture basis function", SIGGRAPH 1996), with one feature point a cell of the
// integer lattice, anywhere in it: F1 and F2, the distances to the nearest and the second nearest feature point, and a
// number in 0..1 drawn for the nearest one, its cell's id. F2 - F1 is 0 on the borders between cells.
//
// Metrics by the exponent of their norm: 2 Euclidean, 1 Manhattan, math.huge Chebyshev (others count as the nearest of
// these: below 1.5, below 3, above). F1 and F2 are continuous, with kinks where the nearest point changes.
//
// The search: the 3^N cells around the point in rows along x, leaving out rows that are further away than F2 (F1, where
// nobody asks for F2) on every lane; then, where F2 reaches beyond those cells, the next layer around them, with which
// Euclidean and Chebyshev distances are exact (Manhattan's are but for a chance below 1e-7). Ranges in N dimensions: F1
// in 0..sqrt(N), N, 1 for the three metrics; the id does not depend on the metric's search order.
//
// Coordinates to about 2^22 (float) or 2^50 (double) have their own cells. NaN and infinity give NaN.
#pragma once

#include "stdlib/value_noise.h"

namespace moonshade::stdlib {

// Metrics: `measure` orders distances, `distance` is one for its measure --------------------------------------------

struct EuclideanMetric {
  template <class L, int N> MS_INLINE L measure(const Vec<N, L>& d) const {
    L sum = d[0] * d[0];
#pragma clang loop unroll(full)
    for (int i = 1; i < N; ++i)
      sum = madd(d[i], d[i], sum);
    return sum;
  }
  template <class L> MS_INLINE L distance(L measure) const { return sqrt(measure); }
};

/// Which of the three may differ by lane.
template <class P> struct AnyMetric {
  Mask<P> manhattan, chebyshev;

  MS_INLINE explicit AnyMetric(P exponent)
      : manhattan(less(exponent, constant<P>(1.5))), chebyshev(less_equal(constant<P>(3), exponent)) {}
  template <class L, int N> MS_INLINE L measure(const Vec<N, L>& d) const {
    L square = EuclideanMetric().measure(d), sum = abs(d[0]), greatest = sum;
#pragma clang loop unroll(full)
    for (int i = 1; i < N; ++i) {
      L size = abs(d[i]);
      sum = sum + size;
      greatest = max(greatest, size);
    }
    return select(manhattan, sum, select(chebyshev, greatest, square));
  }
  template <class L> MS_INLINE L distance(L measure) const {
    return select(manhattan | chebyshev, measure, sqrt(measure));
  }
};

// The search ----------------------------------------------------------------------------------------------------------

/// The nearest two of the points added; the ways to them where Tracked.
template <class L, int N, bool Tracked> struct NearestTwo {
  L first = infinity<L>(), second = infinity<L>();
  UInt32<L> cell = UInt32<L>(0u);
  Vec<N, L> first_way = {}, second_way = {};

  MS_INLINE void add(L measure, UInt32<L> hash, const Vec<N, L>& way) {
    auto is_first = less(measure, first), is_second = less(measure, second);
    if constexpr (Tracked) {
      second_way = select<N, L>(is_first, first_way, select<N, L>(is_second, way, second_way));
      first_way = select<N, L>(is_first, way, first_way);
    }
    second = select(is_first, first, select(is_second, measure, second));
    cell = select(is_first, hash, cell);
    first = select(is_first, measure, first);
  }
};

/// Where in its cell a feature point lies: `bits` of the hash for each component, as a number of 2^-bits.
template <int N> inline constexpr int kFeatureBits = N == 1 ? 24 : N == 2 ? 16 : N == 3 ? 10 : 8;
template <int N, class U> MS_INLINE U feature_bits(U hash, int component) {
  constexpr uint32_t bits = kFeatureBits<N>, mask = (1u << bits) - 1;
  uint32_t shift = 32 - bits * uint32_t(component + 1);
  return component == 0 ? hash >> shift : (hash >> shift) & mask;
}

/// The cells of the rows of a layer: the other axes' steps, the innermost first, nearest rows first.
template <int N, int Reach> struct WorleyRows {
  static constexpr int side = 2 * Reach + 1;
  static constexpr int count = N == 1 ? 1 : N == 2 ? side : N == 3 ? side * side : side * side * side;
  int8_t step[count][3] = {};

  constexpr WorleyRows() {
    int next = 0;
    for (int square = 0; square <= 3 * Reach * Reach; ++square)
      for (int w = -Reach; w <= Reach; ++w)
        for (int z = -Reach; z <= Reach; ++z)
          for (int y = -Reach; y <= Reach; ++y)
            if (x_row(y, z, w) && y * y + z * z + w * w == square) {
              step[next][0] = int8_t(y);
              step[next][1] = int8_t(z);
              step[next++][2] = int8_t(w);
            }
  }
  static constexpr bool x_row(int y, int z, int w) {
    return (N > 1 || y == 0) && (N > 2 || z == 0) && (N > 3 || w == 0);
  }
};
template <int N, int Reach> static constexpr WorleyRows<N, Reach> kWorleyRows;

template <class L, int N, class Lattice, class Metric, bool Tracked> class WorleySearch {
public:
  /// `both`: not F1 alone. The nearest point is the same, but the search for it ends sooner.
  MS_INLINE WorleySearch(const Vec<N, L>& p, const Lattice& lattice, const Metric& metric, bool both)
      : lattice_(lattice), metric_(metric), both_(both),
        cell_(map<N, L>([](L x) __attribute__((always_inline)) { return floor(x); }, p)), place_(p - cell_) {}

  MS_INLINE NearestTwo<L, N, Tracked> run() {
    for (int r = 0; r < kWorleyRows<N, 1>.count; ++r)
      row(kWorleyRows<N, 1>.step[r], 1, 0);
    // Beyond these cells the nearest place is along an axis.
    Vec<N, L> along = {};
    along[0] = constant<L>(1) + nearest_side(0);
#pragma clang loop unroll(full)
    for (int i = 1; i < N; ++i)
      along[0] = min(along[0], constant<L>(1) + nearest_side(i));
    if (any(less(metric_.measure(along), horizon())))
      for (int r = 0; r < kWorleyRows<N, 2>.count; ++r) {
        const int8_t(&step)[3] = kWorleyRows<N, 2>.step[r];
        const bool inner = step[0] * step[0] < 4 && step[1] * step[1] < 4 && step[2] * step[2] < 4;
        row(step, 2, inner ? 2 : 0);
      }
    return found_;
  }

private:
  /// What is further away does not count.
  MS_INLINE L horizon() const { return both_ ? found_.second : found_.first; }
  MS_INLINE L nearest_side(int axis) const { return min(place_[axis], constant<L>(1) - place_[axis]); }

  /// The cells from..reach away, both ways, along x of a row, if it is near enough on any lane.
  MS_INLINE void row(const int8_t (&step)[3], int reach, int from) {
    Vec<N, L> least = {};
    UInt32<L> hash = UInt32<L>(0u);
    Vec<N, L> corner = -place_;
#pragma clang loop unroll(full)
    for (int i = 1; i < N; ++i) {
      corner[i] = constant<L>(step[i - 1]) - place_[i];
      least[i] = max(max(corner[i], -(corner[i] + constant<L>(1))), constant<L>(0));
      hash ^= lattice_.at(cell_[i], i, step[i - 1]);
    }
    if (N > 1 && !any(less(metric_.measure(least), horizon()))) return;
    if (from == 0) cell(hash, corner, 0);
    for (int x = from == 0 ? 1 : from; x <= reach; ++x) {
      cell(hash, corner, x);
      cell(hash, corner, -x);
    }
  }

  MS_INLINE void cell(UInt32<L> row_hash, const Vec<N, L>& corner, int x) {
    constexpr double unit = 1.0 / (1u << kFeatureBits<N>);
    UInt32<L> square = lattice_hash(row_hash ^ lattice_.at(cell_[0], 0, x));
    UInt32<L> hash = (square ^ (square >> 15u)) * 0x2c1b3c6du;
    Vec<N, L> way;
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      L base = corner[i] + constant<L>((i == 0 ? x : 0) + 0.5 * unit);
      way[i] = madd(convert<L>(bit_cast<Int32<L>>(feature_bits<N>(hash, i))), unit, base);
    }
    found_.add(metric_.measure(way), hash, way);
  }

  const Lattice& lattice_;
  const Metric& metric_;
  const bool both_;
  const Vec<N, L> cell_, place_;
  NearestTwo<L, N, Tracked> found_;
};

// The noise -----------------------------------------------------------------------------------------------------------

template <class L, int N, class Lattice, class Metric>
MS_INLINE Results<L, L, L> worley_noise(const Vec<N, L>& p, const Lattice& lattice, const Metric& metric,
                                        Wanted wanted) {
  using P = ValueOf<L>;
  const auto found = WorleySearch<P, N, Lattice, Metric, is_dual<L>>(value_of(p), lattice, metric, wanted[1]).run();
  // Infinity less its floor is NaN too.
  P place = value_of(p)[0] - floor(value_of(p)[0]);
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    place = place + (value_of(p)[i] - floor(value_of(p)[i]));
  auto undefined = is_nan(place);
  const auto result = [&](P measure, const Vec<N, P>& way) __attribute__((always_inline)) {
    L nan = constant<L>(__builtin_nan(""));
    if constexpr (is_dual<L>)
      return select(undefined, nan, metric.distance(metric.measure(way_from(p, way))));
    else
      return select(undefined, nan, metric.distance(measure));
  };
  return {result(found.first, found.first_way), result(found.second, found.second_way),
          select(undefined, constant<L>(__builtin_nan("")), convert<L>(unit_number<P>(mix_bits(found.cell))))};
}

template <class L, class P> MS_INLINE Results<L, L, L> worley(Wanted wanted, const P& p) {
  return worley_noise<L>(as_vector(p), Endless(), EuclideanMetric(), wanted);
}
template <class L, class P> MS_INLINE Results<L, L, L> worley(Wanted wanted, const P& p, const L& metric) {
  return worley_noise<L>(as_vector(p), Endless(), AnyMetric<ValueOf<L>>(value_of(metric)), wanted);
}
template <class L, class P>
MS_INLINE Results<L, L, L> pworley(Wanted wanted, const P& p, const P& period, const L& metric) {
  return worley_noise<L>(as_vector(p), periodic<L>(period), AnyMetric<ValueOf<L>>(value_of(metric)), wanted);
}
template <class L, class P> MS_INLINE Results<L, L, L> worley(const P& p) { return worley<L>(Wanted::all(), p); }
template <class L, class P> MS_INLINE Results<L, L, L> worley(const P& p, const L& metric) {
  return worley<L>(Wanted::all(), p, metric);
}
template <class L, class P> MS_INLINE Results<L, L, L> pworley(const P& p, const P& period, const L& metric) {
  return pworley<L>(Wanted::all(), p, period, metric);
}

} // namespace moonshade::stdlib
