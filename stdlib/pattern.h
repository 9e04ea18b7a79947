// Patterns of cells. Each takes the width of the pixel's footprint, in the units of its coordinates, and gives what a
// square box filter of that width sees: at width 0 the pattern itself, its mean where the width is great. checker,
// stripes, tiles, brick, dots and hexagons are filtered exactly (brick in raking bonds where the footprint is no wider
// than a row; beyond, rows of even and of odd number stand for all), but for a blend where a wide footprint's
// integral takes over from a narrow one's edges; voronoi by its nearest three borders, in the plane quarter by quarter.
// How near that comes, pattern_test.cpp measures. How a square lies in space its width does not tell: solids give what
// squares turned all ways see, on the average (checker what a cube sees).
// Where a pattern has cells, it gives three numbers: the value, a random number in [0, 1) that is the cell's own (not
// filtered), and the distance to the cell's edge, positive inside. NaN coordinates give NaN; beyond 2^22 floats leave
// no room for a fraction.
//
// Sources: the filtered pulse after A. Apodaca and L. Gritz, "Advanced RenderMan" (1999), ch. 11; distances to edges of
// hexagons and voronoi cells after I. Quilez, "Voronoi edges" (2013).
#pragma once

#include "stdlib/geometry.h"
#include "stdlib/hash.h"
#include "stdlib/periodic.h"

namespace moonshade::stdlib {

template <class L> using Cell = Results<L, L, L>;

/// 0 where the sum of the coordinates' integral parts is even, 1 where it is odd.
template <class L, int N> MS_INLINE L checker(Vec<N, L> p, L width) {
  L half = constant<L>(0.5), product = half;
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i) {
    L pulse = pulse_of(madd(p[i], 0.5, -0.25), half, constant<L>(0), width * half);
    product = product * nmadd(pulse, 2.0, constant<L>(1));
  }
  return half - product;
}

/// 1 from each integer on over `duty`, 0 over the rest of the unit.
template <class L> MS_INLINE L stripes(L x, L width, L duty, L ramp) {
  return pulse_of(x + nmadd(duty, 0.5, constant<L>(0.5)), duty, ramp, width);
}

/// Distance to the nearer edge of a pulse of width `duty` in the middle of the unit.
template <class L> MS_INLINE L pulse_edge(L x, L duty) {
  L half = constant<L>(0.5);
  return duty * half - abs(fract(x) - half);
}

/// Square tiles of side 1 with a gap between.
template <class L> MS_INLINE Cell<L> tiles(Vec<2, L> p, L width, L gap, L bevel) {
  L duty = constant<L>(1) - gap;
  L value = pulse_of(p[0], duty, bevel, width) * pulse_of(p[1], duty, bevel, width);
  return {value, hash(Vec<2, L>{{floor(p[0]), floor(p[1])}}), min(pulse_edge(p[0], duty), pulse_edge(p[1], duty))};
}

// Bricks --------------------------------------------------------------------------------------------------------------

/// One course of bricks: where its joints are.
template <class L> struct Course {
  L x;      ///< in periods, a joint at each integer
  L period; ///< in rows
};
template <class L> MS_INLINE Course<L> course(L x, L row, L bond, L length) {
  L half = constant<L>(0.5), odd = constant<L>(2) * fract(row * half); // 0 or 1
  auto english = equal(bond, constant<L>(1)), flemish = less_equal(constant<L>(2), bond);
  L header = select(english, odd * half, constant<L>(0));
  L period = length * (constant<L>(1) - header) * select(flemish, constant<L>(1.5), constant<L>(1));
  L shift = select(flemish, odd * half, select(english, header, fract(bond * row)));
  return {x / period + shift, period};
}

/// How much of a course is brick. A Flemish course has a second joint in each period, behind the stretcher.
template <class L> MS_INLINE L filtered_course(Course<L> c, L mortar, L bevel, L bond, L width) {
  L one = constant<L>(1), scale = one / c.period;
  L duty = nmadd(mortar, scale, one), ramp = bevel * scale, filter = width * scale;
  L value = pulse_of(c.x, duty, ramp, filter);
  auto flemish = less_equal(constant<L>(2), bond);
  L header = joined(one, c.x, duty, ramp, filter);
  if (any(flemish)) header = joined(pulse_of(c.x - constant<L>(2.0 / 3), duty, ramp, filter), header);
  return select(flemish, value + header - one, value);
}

/// Bricks of height 1 and some length, in courses of a bond: below 1 the shift from course to course (0 stacked, 1/2
/// running, 1/3 raking), 1 English, 2 Flemish.
template <class L> MS_INLINE Cell<L> brick(Vec<2, L> p, L width, L mortar, L bevel, L bond, L length) {
  L one = constant<L>(1), half = constant<L>(0.5), duty = one - mortar;
  width = abs(width);
  // The two courses beside the nearest boundary, one of even and one of odd number. Each stands for all of its kind, so
  // that of a bond that repeats after two courses no width sees but what is there.
  L boundary = floor(p[1] + half), below = boundary - one;
  L row = floor(p[1]), from_middle = p[1] - boundary;
  auto seen = [&](L from_row) __attribute__((always_inline)) {
    return pulse_of(madd(from_row, 0.5, 0.25), duty * half, bevel * half, width * half);
  };
  L weight_below = seen(from_middle + one), weight_above = seen(from_middle);
  Course<L> lower = course(p[0], below, bond, length), upper = course(p[0], boundary, bond, length);
  L value = madd(weight_below, filtered_course(lower, mortar, bevel, bond, width),
                 weight_above * filtered_course(upper, mortar, bevel, bond, width));
  // The brick at the point.
  auto is_lower = less(row, boundary);
  Course<L> own = {select(is_lower, lower.x, upper.x), select(is_lower, lower.period, upper.period)};
  L number = floor(own.x), place = own.x - number, second = constant<L>(2.0 / 3);
  auto flemish = less_equal(constant<L>(2), bond), is_header = flemish & less_equal(second, place);
  L begin = select(is_header, second, constant<L>(0)), end = select(flemish & !is_header, second, one);
  L along = min(place - begin, end - place) * own.period - mortar * half;
  L id = hash(Vec<2, L>{{select(is_header, number + half, number), row}});
  return {value, id, min(along, pulse_edge(p[1], duty))};
}

// Cells that are no products of pulses --------------------------------------------------------------------------------

/// From `near` where the footprint is narrower than `from` to `mean` where it is wider than `to`.
template <class L> MS_INLINE L toward_mean(L near, L mean, L width, double from, double to) {
  return mix(near, mean, smoothstep(constant<L>(from), constant<L>(to), width));
}

/// Of discs at the integers, how much lies between the axes and a point, as an integral: in the nearest disc, between
/// its middle and the point, plus the halves and quarters of discs before.
template <class L> struct DiscSegment {
  L nearest, within, area; ///< the integral place before; the way from there, at most the radius; the area beside it
};
template <class L> MS_INLINE DiscSegment<L> disc_segment(L x, L radius) {
  L nearest = floor(x + constant<L>(0.5)), rest = x - nearest;
  L within = min(abs(rest), radius);
  L area = (within * sqrt(max(nmadd(within, within, radius * radius), constant<L>(0))) +
            radius * radius * asin(min(within / radius, constant<L>(1)))) *
           constant<L>(0.5);
  auto negative = less(rest, constant<L>(0));
  return {nearest, select(negative, -within, within), select(negative, -area, area)};
}
template <class L> MS_INLINE L disc_integral(const DiscSegment<L>& x, const DiscSegment<L>& y, L radius) {
  L quarter = radius * radius * constant<L>(0.7853981633974483), two = constant<L>(2);
  // Of the quarter of a disc: a rectangle, or what both segments leave of it.
  L square = madd(x.within, x.within, y.within * y.within);
  L inside = x.within * y.within, a = abs(x.area), b = abs(y.area);
  L outside = copy_sign(max(a + b - quarter, constant<L>(0)), inside);
  L own = select(less_equal(square, radius * radius), inside, outside);
  return madd(madd(two * y.nearest, quarter, y.area) * two, x.nearest, madd(two * y.nearest, x.area, own));
}

/// Discs in the middle of each unit square.
template <class L> MS_INLINE Cell<L> dots(Vec<2, L> p, L width, L radius) {
  L half = constant<L>(0.5), zero = constant<L>(0), one = constant<L>(1);
  width = min(abs(width), constant<L>(4096)); // a whole number of periods: the mean
  radius = clamp(radius, zero, half);
  Vec<2, L> cell = {{floor(p[0]), floor(p[1])}};
  L x = p[0] - cell[0] - half, y = p[1] - cell[1] - half, edge = radius - stdlib::length(Vec<2, L>{{x, y}});
  // Narrow: of this disc and the next, the edge as a line across the square. Times the distance from the middle, which
  // spares dividing by it.
  auto disc = [&](L x, L y) __attribute__((always_inline)) {
    L away = stdlib::length(Vec<2, L>{{x, y}});
    return filtered_step((radius - away) * away, abs(x) * width, abs(y) * width);
  };
  auto flat = less(abs(y), abs(x));
  L narrow = disc(x, y) + disc(select(flat, abs(x) - one, x), select(flat, y, abs(y) - one));
  // Wide: exactly, by the integral's values at the square's corners.
  L value = joined(narrow, p, width, radius);
  L blend = smoothstep(constant<L>(0.01), constant<L>(0.03), width);
  auto wide = less(zero, blend);
  if (any(wide)) {
    L reach = max(width, constant<L>(0.01)) * half, solid = max(radius, constant<L>(1e-6));
    DiscSegment<L> left = disc_segment(x - reach, solid), right = disc_segment(x + reach, solid);
    DiscSegment<L> low = disc_segment(y - reach, solid), high = disc_segment(y + reach, solid);
    L sum = (disc_integral(right, high, solid) - disc_integral(left, high, solid)) -
            (disc_integral(right, low, solid) - disc_integral(left, low, solid));
    L seen = select(less_equal(radius, zero), zero, sum / (constant<L>(4) * reach * reach));
    value = select(wide, mix(value, seen, blend), value);
  }
  return {value, hash(cell), edge};
}

/// Of a quarter of a hexagon about the origin, two sides parallel to y at the distance `a`: its area below x and y.
template <class L> MS_INLINE L hexagon_quarter(L x, L y, L a) {
  constexpr double kRoot = 1.7320508075688772;
  x = min(x, a);
  // From the top: where the slanted side begins to cut, and how far below the top y is.
  L top = a * constant<L>(2 / kRoot), cut = x * constant<L>(1 / kRoot), below = top - min(y, top);
  L slanted = max(nmadd(below, below, cut * cut), constant<L>(0)) * constant<L>(kRoot / 2);
  return madd(x, min(top - below, top - cut), slanted);
}

/// The integral from the origin to a point over hexagons at (i, sqrt(3) j).
template <class L> MS_INLINE L hexagon_integral(L x, L y, L a) {
  constexpr double kRoot = 1.7320508075688772;
  L half = constant<L>(0.5), two = constant<L>(2), zero = constant<L>(0), all = constant<L>(2);
  L column = floor(x + half), row = floor(madd(y, 1 / kRoot, half));
  L rest_x = x - column, rest_y = nmadd(row, kRoot, y);
  auto left = less(rest_x, zero), below = less(rest_y, zero);
  L u = abs(rest_x), v = abs(rest_y);
  L side = hexagon_quarter(u, all, a), top = hexagon_quarter(all, v, a), own = hexagon_quarter(u, v, a);
  side = select(left, -side, side), top = select(below, -top, top), own = select(left, -own, own);
  own = select(below, -own, own);
  L quarter = a * a * constant<L>(kRoot / 2);
  return madd(madd(two * row, quarter, top) * two, column, madd(two * row, side, own));
}

/// Of all hexagons of a honeycomb with a gap, as seen from the middle of one, what a square sees; ramps by Gauss's
/// three points. Exact but for them.
template <class L> MS_INLINE L hexagons_seen(Vec<2, L> from, L width, L foot, L ramp) {
  constexpr double kPoint[3] = {0.5, 0.1127016653792583, 0.8872983346207417},
                   kWeight[3] = {8.0 / 18, 5.0 / 18, 5.0 / 18};
  L reach = width * constant<L>(0.5), sum = joined(constant<L>(0), from, width, foot, ramp);
  auto ramped = less(constant<L>(0), ramp);
  const int points = any(ramped) ? 3 : 1;
#pragma clang loop unroll(disable)
  for (int i = 0; i < points; ++i) {
    L a = nmadd(ramp, kPoint[i], foot * constant<L>(0.5));
    L seen = joined(constant<L>(0), from, width, foot, ramp);
    // The corners of the square, of one grid of middles and of the other.
#pragma clang loop unroll(disable)
    for (int corner = 0; corner < 8; ++corner) {
      L x = from[0] + (corner & 1 ? reach : -reach), y = from[1] + (corner & 2 ? reach : -reach);
      L other = L(Scalar<L>(corner >> 2));
      L part = hexagon_integral(nmadd(other, 0.5, x), nmadd(other, 0.8660254037844386, y), a);
      seen = (corner & 1) == (corner >> 1 & 1) ? seen + part : seen - part;
    }
    L weighted = madd(seen, L(Scalar<L>(kWeight[i])), sum);
    sum = i == 0 ? select(ramped, weighted, seen) : select(ramped, weighted, sum);
  }
  return sum / (width * width);
}

/// Hexagons in a honeycomb, their middles 1 apart, two sides parallel to y.
template <class L> MS_INLINE Cell<L> hexagons(Vec<2, L> p, L width, L gap, L bevel) {
  L half = constant<L>(0.5), one = constant<L>(1), zero = constant<L>(0), third = constant<L>(1.7320508075688772);
  width = min(abs(width), constant<L>(2340)); // nearly a whole number of periods both ways: the mean
  // The middles are two rectangular grids; the nearer one's middle is the cell's.
  L x0 = floor(p[0]), y0 = floor(p[1] / third), x1 = floor(p[0] + half), y1 = floor(p[1] / third + half);
  Vec<2, L> a = {{p[0] - x0 - half, nmadd(y0 + half, third, p[1])}}, b = {{p[0] - x1, nmadd(y1, third, p[1])}};
  auto is_a = less(dot(a, a), dot(b, b));
  Vec<2, L> from = select<2, L>(is_a, a, b);
  Vec<2, L> cell = select<2, L>(is_a, Vec<2, L>{{x0 + half, y0 + half}}, Vec<2, L>{{x1, y1}});
  // Along the three normals: this cell's side, and the neighbour's behind it. A line across the square is blurred by
  // two boxes, by the normal's components; the lesser of one of them and the ramp is left out.
  gap = saturate(gap);
  L foot = one - gap, ramp = clamp(bevel, zero, foot * half), inset = (gap + ramp) * half;
  L narrow = one, neighbours = zero, edge = half;
  auto side = [&](L along, double shorter, double longer) __attribute__((always_inline)) {
    L distance = half - abs(along), first = max(ramp, width * constant<L>(shorter)),
      second = width * constant<L>(longer);
    narrow = min(narrow, filtered_step(distance - inset, first, second));
    neighbours = neighbours + filtered_step(-distance - inset, first, second);
    edge = min(edge, distance);
  };
  L slanted = from[1] * (third * half);
  side(from[0], 0, 1);
  side(madd(from[0], 0.5, slanted), 0.5, 0.8660254037844386);
  side(madd(from[0], 0.5, -slanted), 0.5, 0.8660254037844386);
  L value = joined(narrow + neighbours, p, width, gap, bevel);
  // Where the square is wide beside the ramp.
  L blend = smoothstep(max(constant<L>(0.01), ramp * constant<L>(0.35)),
                       max(constant<L>(0.03), ramp * constant<L>(0.8)), width);
  auto wide = less(zero, blend);
  if (any(wide)) {
    L seen = hexagons_seen(from, max(width, constant<L>(0.01)), foot, ramp);
    value = select(wide, mix(value, seen, blend), value);
  }
  return {value, hash(cell), edge - gap * half};
}

/// The site of a voronoi cell: a random point of its unit square or cube, drawn to the middle by 1 - jitter.
template <class L, int N> MS_INLINE Vec<N, L> cell_site(const Vec<N, L>& cell, L jitter) {
  L half = constant<L>(0.5);
  UInt32<L> bits = UInt32<L>(0u);
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i)
    bits ^= lattice(cell[i]) * kLatticePrimes[i];
  bits = mix_bits(bits);
  Vec<N, L> site;
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i) {
    site[i] = madd(without_slope<L>(unit_number<ValueLane<L>>(bits)) - half, jitter, cell[i] + half);
    bits = mix_bits(bits + 0x9e3779b9u);
  }
  return site;
}

/// The steps from a cell to all others at most `Reach` away along each axis, the nearest first.
template <int N, int Reach> struct CellSteps {
  static constexpr int side = 2 * Reach + 1;
  static constexpr int count = (N == 2 ? side * side : side * side * side) - 1;
  int8_t step[count][N] = {};

  constexpr CellSteps() {
    for (int square = 1, next = 0; square <= N * Reach * Reach; ++square)
      for (int i = 0; i <= count; ++i) {
        int step_of[N] = {}, sum = 0;
        for (int k = 0, rest = i; k < N; ++k, rest /= side) {
          step_of[k] = rest % side - Reach;
          sum += step_of[k] * step_of[k];
        }
        if (sum != square) continue;
        for (int k = 0; k < N; ++k)
          step[next][k] = int8_t(step_of[k]);
        ++next;
      }
  }
};
template <int N, int Reach> static constexpr CellSteps<N, Reach> kCellSteps;

/// Comparisons that leave cells out: by more than distances round, as on no lane it may matter what others need.
inline constexpr double kWithRoom = 1 + 0x1p-10;

/// The nearest site, as a vector from the point, and the cell that it belongs to.
template <class L, int N> struct NearestSite {
  Vec<N, L> way, cell;
};
template <class L, int N> MS_INLINE NearestSite<L, N> nearest_site(const Vec<N, L>& p, L jitter) {
  using P = ValueLane<L>;
  const P half = constant<P>(0.5), one = constant<P>(1);
  Vec<N, L> home = map<N, L>([](L x) __attribute__((always_inline)) { return floor(x); }, p);
  L nearest = joined(constant<L>(1e30), p, jitter);
  NearestSite<L, N> found = {joined(home * constant<L>(0), p, jitter), home};
  const auto look = [&](const Vec<N, L>& cell) __attribute__((always_inline)) {
    Vec<N, L> to = cell_site(cell, jitter) - p;
    L square = dot(to, to);
    auto nearer = less(square, nearest);
    nearest = select(nearer, square, nearest);
    found = {select<N, L>(nearer, to, found.way), select<N, L>(nearer, cell, found.cell)};
  };
  // Along each axis home, the neighbour on the side where the point lies, and the other one.
  P places[N][3], other_side = one;
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i) {
    P at = value_lane(home[i]), place = value_lane(p[i]) - at, side = select(less(place, half), -one, one);
    places[i][0] = at, places[i][1] = at + side, places[i][2] = at - side;
    other_side = min(other_side, max(place, one - place));
  }
  const auto look_at = [&](const int(&side)[N]) __attribute__((always_inline)) {
    Vec<N, L> cell;
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i)
      cell[i] = without_slope<L>(places[i][side[i]]);
    look(cell);
  };
#pragma clang loop unroll(disable)
  for (int n = 0; n < 1 << N; ++n) {
    int side[N];
    for (int i = 0; i < N; ++i)
      side[i] = n >> i & 1;
    look_at(side);
  }
  if (any(less(other_side * other_side, value_lane(nearest) * constant<P>(kWithRoom)))) {
#pragma clang loop unroll(disable)
    for (int n = 0; n < (N == 2 ? 9 : 27); ++n) {
      int side[N];
      bool is_other = false;
      for (int i = 0, rest = n; i < N; ++i, rest /= 3) {
        side[i] = rest % 3;
        is_other |= side[i] == 2;
      }
      if (is_other) look_at(side);
    }
  }
  return found;
}

/// A border between two cells: how far away, and the direction there.
template <class L, int N> struct Border {
  L distance;
  Vec<N, L> direction;
};

/// How much of a square lies on the positive side of a border moved by `offset`. Of space the square's plane is not
/// known: on the average over all, the border is blurred by this much.
template <class L, int N> MS_INLINE L beyond_border(const Border<L, N>& border, L offset, L width) {
  L c = border.distance + offset;
  if constexpr (N == 2) {
    return filtered_step(c, abs(border.direction[0]) * width, abs(border.direction[1]) * width);
  } else {
    L box = width * constant<L>(0.55);
    return filtered_step(c, box, box);
  }
}

/// The cell at a point: what a narrow square sees of it, its number and the distance to its nearest border.
template <class L, int N> MS_INLINE Cell<L> voronoi_cell(const Vec<N, L>& p, L width, L border, L jitter) {
  L zero = constant<L>(0), half = constant<L>(0.5), one = constant<L>(1);
  const NearestSite<L, N> nearest = nearest_site<L, N>(p, jitter);
  // The nearest border, and where there is anything to filter the next one: half way to another site, across the line
  // between the two.
  const bool filtered = is_dual<L> || any(!less_equal(width, zero));
  L far = joined(constant<L>(1e30), p, jitter);
  Vec<N, L> nowhere = joined(nearest.way * zero, p, jitter);
  Border<L, N> first = {far, nowhere}, second = first;
  Vec<N, L> first_site = nowhere, second_site = nowhere;
  // A cell's distance along each axis, squared. Its border is at least half as far as it is further than the nearest
  // site.
  using P = ValueLane<L>;
  constexpr int kReach = 2;
  P away[N][2 * kReach + 1], own = constant<P>(0);
#pragma clang loop unroll(full)
  for (int i = 0; i < N; ++i) {
    P begin = value_lane(nearest.cell[i]) - value_lane(p[i]), way = value_lane(nearest.way[i]);
    own = madd(way, way, own);
    for (int step = -kReach; step <= kReach; ++step) {
      P low = begin + constant<P>(step), least = max(max(low, -(low + constant<P>(1))), constant<P>(0));
      away[i][step + kReach] = least * least;
    }
  }
  own = sqrt(own);
#pragma clang loop unroll(disable)
  for (const auto& step : kCellSteps<N, kReach>.step) {
    Vec<N, L> cell;
    P square = constant<P>(0);
#pragma clang loop unroll(full)
    for (int i = 0; i < N; ++i) {
      cell[i] = nearest.cell[i] + L(Scalar<L>(step[i]));
      square = square + away[i][step[i] + kReach];
    }
    P horizon = madd(value_lane(filtered ? second.distance : first.distance), 2.0, own);
    if (!any(less(square, horizon * horizon * constant<P>(kWithRoom)))) continue;
    Vec<N, L> to = cell_site(cell, jitter) - p, across = to - nearest.way;
    L inverse = one / sqrt(dot(across, across));
    Border<L, N> here = {dot(to + nearest.way, across) * half * inverse, across * inverse};
    auto nearer = less(here.distance, first.distance);
    if (filtered) {
      auto next = less(here.distance, second.distance);
      second.distance = select(nearer, first.distance, select(next, here.distance, second.distance));
      second.direction = select<N, L>(nearer, first.direction, select<N, L>(next, here.direction, second.direction));
      second_site = select<N, L>(nearer, first_site, select<N, L>(next, to, second_site));
      first.direction = select<N, L>(nearer, here.direction, first.direction);
      first_site = select<N, L>(nearer, to, first_site);
    }
    first.distance = select(nearer, here.distance, first.distance);
  }
  L side = border * half, edge = first.distance - side, value = filtered_step(edge, zero, zero);
  value = joined(value, p, width, border, jitter);
  if (filtered) {
    // Three cells meet here. Each border between two is a strip, as far as the third cell leaves it.
    Vec<N, L> across = second_site - first_site;
    L inverse = one / sqrt(dot(across, across) + constant<L>(1e-20));
    Border<L, N> third = {dot(first_site + second_site, across) * half * inverse, across * inverse};
    auto strip = [&](const Border<L, N>& b) __attribute__((always_inline)) {
      return beyond_border(b, side, width) - beyond_border(b, -side, width);
    };
    L h1 = beyond_border(first, zero, width), h2 = beyond_border(second, zero, width);
    L seen = (one - strip(first) * h2) * (one - strip(second) * h1) * (one - strip(third) * nmadd(h1 + h2, 0.5, one));
    value = select(less_equal(width, zero), value, seen);
  }
  return {value, hash(nearest.cell), edge};
}

/// The nearest of random points, one in each unit square or cube, and the distance to the border with the next. In the
/// plane a wide square is the mean of its quarters; where it sees several cells, their mean.
template <class L, int N> MS_INLINE Cell<L> voronoi(Vec<N, L> p, L width, L border, L jitter) {
  L zero = constant<L>(0), one = constant<L>(1);
  width = min(abs(width), constant<L>(4096));
  jitter = saturate(jitter); // beyond, sites would leave their cells, by which the search finds them
  L near = joined(zero, p, width, border, jitter), id = zero, edge = joined(zero, p, border, jitter), sum = near;
  // The square itself, and its quarters where they are wanted.
  auto wide = less(constant<L>(0.06), width);
  const int squares = N == 2 && any(wide) ? 5 : 1;
#pragma clang loop unroll(disable)
  for (int i = 0; i < squares; ++i) {
    L reach = i == 0 ? zero : width * constant<L>(0.25), side = i == 0 ? width : width * constant<L>(0.5);
    Vec<N, L> middle = joined(p, width);
    middle[0] = middle[0] + (i & 1 ? reach : -reach);
    middle[1] = middle[1] + (i & 2 ? reach : -reach);
    Cell<L> cell = voronoi_cell<L, N>(middle, side, border, jitter);
    if (i == 0)
      near = cell.first, id = cell.second, edge = cell.third;
    else
      sum = sum + cell.first;
  }
  if (squares > 1) near = select(wide, sum * constant<L>(0.25), near);
  // The share of the cells' inside: as of squares or cubes, whatever the jitter, but for what samples show of space.
  L open = one - saturate(border), mean = open * open;
  if constexpr (N == 3) mean = mean * open * madd(border * saturate(jitter * constant<L>(3)), 0.16, one);
  L value;
  if constexpr (N == 2) {
    value = toward_mean(near, mean, width, 0.9, 2.4);
  } else {
    // Three borders are fewer than a wide footprint sees: it is lighter than it should be by this much, by samples.
    L missed = (one - mean) * clamp(madd(width, 0.43, constant<L>(-0.43 * 0.5)), zero, constant<L>(0.45));
    value = max(toward_mean(near - missed, mean, width, 1.2, 2.4), zero);
  }
  return {value + nothing_of(p), id, edge};
}

} // namespace moonshade::stdlib
