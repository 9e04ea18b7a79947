// Worley's cellular noise ("A cellular texture basis function", SIGGRAPH 1996), with one feature point a cell of the
// integer lattice, anywhere in it: F1 and F2, the distances to the nearest and the second nearest feature point, and a
// number in 0..1 drawn for the nearest one, its cell's id. F2 - F1 is 0 on the borders between cells.
//
// Metrics by the exponent of their norm: 2 Euclidean, 1 Manhattan, math.huge Chebyshev (others count as the nearest of
// these: below 1.5, below 3, above). F1 and F2 are continuous, with kinks where the nearest point changes.
//
// The search: the cell of the point and its neighbours on the sides where the point lies nearer, 2^N cells; then, where
// F2 (F1, where nobody asks for F2) reaches further on any lane, the rest of the 3^N cells around it, in rows along x,
// of which those are left out that it reaches on no lane; then likewise the next layer, with which Euclidean and
// Chebyshev distances are exact (Manhattan's are but for a chance below 1e-7). Ranges in N dimensions: F1 in
// 0..sqrt(N), N, 1 for the three metrics; the id does not depend on the metric's search order.
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

/// The steps away from a row of cells along x, of the rows of a layer.
template <int N, int Side> struct WorleyRows {
  static constexpr int count = N == 1 ? 1 : N == 2 ? Side : N == 3 ? Side * Side : Side * Side * Side;
  int8_t step[count][3] = {};

  constexpr WorleyRows() {
    for (int row = 0; row < count; ++row)
      for (int axis = 0, rest = row; axis < 3; ++axis, rest /= Side)
        step[row][axis] = int8_t(rest % Side);
  }
};
template <int N, int Side> static constexpr WorleyRows<N, Side> kWorleyRows;

template <class L, int N, class Lattice, class Metric, bool Tracked> class WorleySearch {
public:
  /// `both`: not F1 alone. The nearest point is the same, but the search for it ends sooner.
  MS_INLINE WorleySearch(const Vec<N, L>& p, const Lattice& lattice, const Metric& metric, bool both)
      : lattice_(lattice), metric_(metric), both_(both),
        cell_(map<N, L>([](L x) __attribute__((always_inline)) { return floor(x); }, p)), place_(p - cell_) {}

  MS_INLINE NearestTwo<L, N, Tracked> run() {
    nearest_cells();
    if (reaches_beyond(0)) {
      other_cells();
      if (reaches_beyond(1)) next_layer();
    }
    return found_;
  }

private:
  /// Cells at one place along an axis: their part of the hash, where features begin, and how far away they are.
  struct Side {
    UInt32<L> hash;
    L begin, least;
  };

  /// What is further away does not count, by more than distances round: on no lane may it matter what others need.
  MS_INLINE L horizon() const { return (both_ ? found_.second : found_.first) * constant<L>(1 + 0x1p-12); }
  MS_INLINE static constexpr double unit() { return 1.0 / (1u << kFeatureBits<N>); }

  /// The horizon is further than the nearest place beyond all cells that have been looked at: the `cells` around the
  /// point's, and at 0 its neighbours on the nearer sides.
  MS_INLINE bool reaches_beyond(int cells) const {
    Vec<N, L> along = {};
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      L side = cells == 0 ? sides_[i][2].least : constant<L>(1) + sides_[i][1].least;
      along[0] = i == 0 ? side : min(along[0], side);
    }
    return any(less(metric_.measure(along), horizon()));
  }

  /// The cell of the point and, on the side where it lies, its neighbours.
  MS_INLINE void nearest_cells() {
    const L one = constant<L>(1), half = constant<L>(0.5), first = constant<L>(0.5 * unit());
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      auto below = less(place_[i], half);
      UInt32<L> before = lattice_.at(cell_[i], i, -1), after = lattice_.at(cell_[i], i, 1);
      L from_begin = place_[i], from_end = one - place_[i];
      L begin_before = constant<L>(0.5 * unit() - 1) - place_[i],
        begin_after = constant<L>(0.5 * unit() + 1) - place_[i];
      sides_[i][0] = {lattice_.at(cell_[i], i, 0), first - place_[i], constant<L>(0)};
      sides_[i][1] = {select(below, before, after), select(below, begin_before, begin_after),
                      min(from_begin, from_end)};
      sides_[i][2] = {select(below, after, before), select(below, begin_after, begin_before),
                      max(from_begin, from_end)};
    }
#pragma clang loop unroll_count(N < 4 ? 1 << N : 1)
    for (int n = 0; n < 1 << N; ++n) {
      const Side* sides[N];
      for (int i = 0; i < N; ++i)
        sides[i] = &sides_[i][n >> i & 1];
      cell(sides);
    }
  }

  /// The rest of the 3^N cells around the point.
  MS_INLINE void other_cells() {
#pragma clang loop unroll(disable)
    for (int r = 0; r < kWorleyRows<N, 3>.count; ++r) {
      const int8_t(&step)[3] = kWorleyRows<N, 3>.step[r];
      // Of a row beside the point the nearer two are done.
      const bool nearer = step[0] < 2 && step[1] < 2 && step[2] < 2;
      const Side* sides[N];
      Vec<N, L> least = {};
      for (int i = 1; i < N; ++i) {
        sides[i] = &sides_[i][step[i - 1]];
        least[i] = sides[i]->least;
      }
      least[0] = nearer ? sides_[0][2].least : constant<L>(0);
      if (!any(less(metric_.measure(least), horizon()))) continue;
      for (int x = nearer ? 2 : 0; x < 3; ++x) {
        sides[0] = &sides_[0][x];
        cell(sides);
      }
    }
  }

  /// The cells two steps away.
  MS_INLINE void next_layer() {
#pragma clang loop unroll(disable)
    for (int r = 0; r < kWorleyRows<N, 5>.count; ++r) {
      const int8_t(&step)[3] = kWorleyRows<N, 5>.step[r];
      Side row[N];
      const Side* sides[N];
      Vec<N, L> least = {};
      bool inner = true;
      for (int i = 1; i < N; ++i) {
        row[i] = side(i, step[i - 1] - 2);
        sides[i] = &row[i];
        least[i] = row[i].least;
        inner &= step[i - 1] > 0 && step[i - 1] < 4;
      }
      least[0] = inner ? constant<L>(1) + sides_[0][1].least : constant<L>(0);
      if (!any(less(metric_.measure(least), horizon()))) continue;
      for (int x = -2; x <= 2; x += inner ? 4 : 1) {
        row[0] = side(0, x);
        sides[0] = &row[0];
        cell(sides);
      }
    }
  }
  MS_INLINE Side side(int axis, int step) const {
    L corner = constant<L>(step) - place_[axis];
    return {lattice_.at(cell_[axis], axis, step), constant<L>(step + 0.5 * unit()) - place_[axis],
            max(max(corner, -(corner + constant<L>(1))), constant<L>(0))};
  }

  MS_INLINE void cell(const Side* const (&sides)[N]) {
    UInt32<L> hash = sides[0]->hash;
#pragma clang loop unroll(full)
    for (int i = 1; i < N; ++i)
      hash ^= sides[i]->hash;
    UInt32<L> square = lattice_hash(hash);
    hash = (square ^ (square >> 15u)) * 0x2c1b3c6du;
    Vec<N, L> way;
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i)
      way[i] = madd(convert<L>(bit_cast<Int32<L>>(feature_bits<N>(hash, i))), unit(), sides[i]->begin);
    found_.add(metric_.measure(way), hash, way);
  }

  const Lattice& lattice_;
  const Metric& metric_;
  const bool both_;
  const Vec<N, L> cell_, place_;
  Side sides_[N][3]; ///< at home, the nearer neighbour, the farther one
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
