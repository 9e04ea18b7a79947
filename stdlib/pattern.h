// Patterns of cells. Each takes the width of the pixel's footprint, in the units of its coordinates, and gives what a
// square box filter of that width sees: at width 0 the pattern itself, its mean where the width is great. checker,
// stripes, tiles and brick are filtered exactly (brick where the footprint is no wider than a row; beyond, rows are
// averaged in pairs); dots, hexagons and voronoi by the distance to the nearest edge, blending into the mean, within a
// few tenths of the exact value at single points, a few hundredths in the mean square (pattern_test.cpp measures).
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
  // The two courses beside the nearest boundary, and how much of each the filter sees.
  L boundary = floor(p[1] + half), below = boundary - one;
  L row = floor(p[1]), from_middle = p[1] - boundary;
  L ramp = clamp(bevel, constant<L>(0), duty * half), side = (duty - ramp) * half;
  auto seen = [&](L s) __attribute__((always_inline)) {
    return filtered_step(s + side, ramp, width) - filtered_step(s - side, ramp, width);
  };
  L whole = pulse_of(p[1], duty, bevel, width) * half;
  auto wide = !less(width + ramp, one);
  L weight_below = select(wide, whole, seen(from_middle + half)),
    weight_above = select(wide, whole, seen(from_middle - half));
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

// Cells that are no products of pulses: by the distance to the edge
// ------------------------------------------------------

/// From `near` where the footprint is narrower than `from` to `mean` where it is wider than `to`.
template <class L> MS_INLINE L toward_mean(L near, L mean, L width, double from, double to) {
  return mix(near, mean, smoothstep(constant<L>(from), constant<L>(to), width));
}

/// Discs in the middle of each unit square.
template <class L> MS_INLINE Cell<L> dots(Vec<2, L> p, L width, L radius) {
  L half = constant<L>(0.5), zero = constant<L>(0), one = constant<L>(1);
  width = abs(width);
  radius = clamp(radius, zero, half);
  Vec<2, L> cell = {{floor(p[0]), floor(p[1])}};
  L x = p[0] - cell[0] - half, y = p[1] - cell[1] - half, edge = radius - stdlib::length(Vec<2, L>{{x, y}});
  // This disc and the next three, on the point's side of it.
  L x1 = abs(x) - one, y1 = abs(y) - one;
  auto disc = [&](L x, L y) __attribute__((always_inline)) {
    return filtered_step(radius - stdlib::length(Vec<2, L>{{x, y}}), zero, width);
  };
  L discs = filtered_step(edge, zero, width) + disc(x1, y) + disc(x, y1) + disc(x1, y1);
  // Where the footprint is wide: the square of the same area.
  L side = radius * constant<L>(1.7724538509055159);
  L square = pulse_of(p[0], side, zero, width) * pulse_of(p[1], side, zero, width);
  return {mix(discs, square, smoothstep(radius * constant<L>(0.4), radius * constant<L>(1.6), width)), hash(cell),
          edge};
}

/// Hexagons in a honeycomb, their middles 1 apart, two sides parallel to y.
template <class L> MS_INLINE Cell<L> hexagons(Vec<2, L> p, L width, L gap, L bevel) {
  L half = constant<L>(0.5), one = constant<L>(1), zero = constant<L>(0), third = constant<L>(1.7320508075688772);
  width = abs(width);
  // The middles are two rectangular grids; the nearer one's middle is the cell's.
  L x0 = floor(p[0]), y0 = floor(p[1] / third), x1 = floor(p[0] + half), y1 = floor(p[1] / third + half);
  Vec<2, L> a = {{p[0] - x0 - half, nmadd(y0 + half, third, p[1])}}, b = {{p[0] - x1, nmadd(y1, third, p[1])}};
  auto is_a = less(dot(a, a), dot(b, b));
  Vec<2, L> from = select<2, L>(is_a, a, b);
  Vec<2, L> cell = select<2, L>(is_a, Vec<2, L>{{x0 + half, y0 + half}}, Vec<2, L>{{x1, y1}});
  // Along the three normals: this cell's side, and the neighbour's behind it.
  L ramp = clamp(bevel, zero, (one - gap) * half), inset = (gap + ramp) * half;
  L value = one, neighbours = zero, edge = half;
  auto side = [&](L along) __attribute__((always_inline)) {
    L distance = half - abs(along);
    value = value * filtered_step(distance - inset, ramp, width);
    neighbours = neighbours + filtered_step(-distance - inset, ramp, width);
    edge = min(edge, distance);
  };
  L slanted = from[1] * (third * half);
  side(from[0]);
  side(madd(from[0], 0.5, slanted));
  side(madd(from[0], 0.5, -slanted));
  // Of a frustum: by the areas at its foot and at its top.
  L foot = one - gap, top = foot - ramp * constant<L>(2);
  L mean = nmadd(ramp * ramp, 0.67, (foot * foot + top * top + foot * top) * constant<L>(1.0 / 3));
  L near = min(value + neighbours, one);
  return {toward_mean(near, mean, width, 0.35, 1.1), hash(cell), edge - gap * half};
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

/// Calls f(offset) for the cells around a cell, `reach` in each direction.
template <class L, int N, class F> MS_INLINE void for_each_neighbour(int reach, F f) {
  const int side = 2 * reach + 1, count = N == 2 ? side * side : side * side * side;
#pragma clang loop unroll(disable)
  for (int i = 0; i < count; ++i) {
    Vec<N, L> offset;
    int rest = i;
#pragma clang loop unroll(full)
    for (int k = 0; k < N; ++k, rest /= side)
      offset[k] = L(Scalar<L>(rest % side - reach));
    f(offset);
  }
}

/// The nearest of random points, one in each unit square or cube, and the distance to the border with the next: of the
/// plane exact, of space to the border between the two nearest points.
template <class L, int N> MS_INLINE Cell<L> voronoi(Vec<N, L> p, L width, L border, L jitter) {
  L zero = constant<L>(0), half = constant<L>(0.5);
  width = abs(width);
  Vec<N, L> home = map<N, L>([](L x) __attribute__((always_inline)) { return floor(x); }, p);
  // The nearest site, as a vector from the point, and the cell that it belongs to.
  L nearest = joined(constant<L>(1e30), p, jitter);
  Vec<N, L> to_nearest = joined(home * zero, p, jitter), nearest_cell = home;
  for_each_neighbour<L, N>(1, [&](const Vec<N, L>& offset) __attribute__((always_inline)) {
    Vec<N, L> cell = home + offset, to = cell_site(cell, jitter) - p;
    L square = dot(to, to);
    auto nearer = less(square, nearest);
    nearest = select(nearer, square, nearest);
    to_nearest = select<N, L>(nearer, to, to_nearest);
    nearest_cell = select<N, L>(nearer, cell, nearest_cell);
  });
  // The nearest border: half way to another site, across the line between the two.
  L distance = joined(constant<L>(1e30), p, jitter);
  for_each_neighbour<L, N>(N == 2 ? 2 : 1, [&](const Vec<N, L>& offset) __attribute__((always_inline)) {
    Vec<N, L> to = cell_site(nearest_cell + offset, jitter) - p, across = to - to_nearest;
    L square = dot(across, across);
    L here = dot(to + to_nearest, across) * half / sqrt(square);
    auto is_border = less(constant<L>(1e-12), square) & less(here, distance);
    distance = select(is_border, here, distance);
  });
  L edge = nmadd(border, 0.5, distance);
  // Both sides of the border line.
  L near = filtered_step(edge, zero, width) + filtered_step(-distance - border * half, zero, width);
  // The share of borders: fitted to samples (pattern_test.cpp).
  L mean = exp(-(border * madd(border, N == 2 ? 1.3 : 1.85, constant<L>(N == 2 ? 2.0 : 2.87))));
  L value = toward_mean(near, mean, width, 0.3, 1.0);
  ValueLane<L> nothing = value_lane(p[0]) - value_lane(p[0]); // 0, or NaN
#pragma clang loop unroll(full)
  for (int i = 1; i < N; ++i)
    nothing = nothing + (value_lane(p[i]) - value_lane(p[i]));
  value = value + without_slope<L>(nothing);
  return {value, hash(nearest_cell), edge};
}

} // namespace moonshade::stdlib
