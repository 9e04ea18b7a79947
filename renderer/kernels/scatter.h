// The vertices of paths, 16 side by side: light samples, and what the BSDF does with them and with the paths.
#pragma once

#include "renderer/kernels/lanes16.h"
#include "renderer/materials/bsdf_lanes.h"

namespace moonshade::renderer::lanes16 {

MS_INLINE U first_dimension(const ScatterBlock& b) { return load(b.segments) * U(kDrawCount) + U(1u); }
MS_INLINE Draws<U> draws_of(const ScatterBlock& b) { return {load(b.key), load(b.sample)}; }

MS_INLINE void draw_lights(ScatterBlock& b, uint32_t light_count) {
  Fours carried = load_fours(b.paths, AT(Path, throughput)), drawn = load_fours(b.paths, AT(Path, sampler));
  store(carried.x, b.throughput[0]), store(carried.y, b.throughput[1]), store(carried.z, b.throughput[2]);
  store(carried.w, b.eta2);
  store(drawn.x, b.key), store(drawn.y, b.sample), store(drawn.z, b.segments), store(drawn.w, b.bounces);
  store(load_fours(b.paths, AT(Path, width)).y, b.spread);
  if (!light_count) return;
  Draws<U> draws = draws_of(b);
  U first = first_dimension(b);
  F u, v, place = draws.one(first + U(uint32_t(kLightChoice))) * F(float(light_count));
  U light = bit_cast<U>(convert<I>(place)), last = U(light_count - 1);
  light = select(stdlib::to_mask<F>(light < last), light, last);
  store(light, b.light), store(place - convert<F>(bit_cast<I>(light)), b.light_w);
  draws.two(first + U(uint32_t(kLightPoint)), u, v);
  store(u, b.light_u), store(v, b.light_v);
}

MS_INLINE void light_samples(ScatterBlock& b, const EnvironmentLight* lights, size_t light_count,
                             float lights_in_scene) {
  F share = F(lights_in_scene);
  Fours first = load_fours(b.triangles, AT(LightTriangle, a)), second = load_fours(b.triangles, AT(LightTriangle, b)),
        third = load_fours(b.triangles, AT(LightTriangle, c)),
        emitted = load_fours(b.triangles, AT(LightTriangle, emission));
  M area = less(F(0.0f), emitted.w), sky = truth(load(b.sky));
  Vector point = load(b.point), zero = {{F(0.0f), F(0.0f), F(0.0f)}};
  Vector direction = load(b.to_light), radiance = load(b.radiance);
  F distance = load(b.light_distance), pdf = load(b.light_pdf);
  if (any(area)) {
    AreaSample<F> s{{{first.x, first.y, first.z}},
                    {{second.x, second.y, second.z}},
                    {{third.x, third.y, third.z}},
                    load(b.light_u),
                    load(b.light_v),
                    first.w,
                    second.w,
                    less(F(0.0f), third.w),
                    zero,
                    F(0.0f),
                    F(0.0f)};
    sample_area(point, s);
    direction = select<3>(area, s.direction, direction);
    distance = select(area, s.distance, distance);
    pdf = select(area, s.pdf / share, pdf);
    radiance = select<3>(area, {{emitted.x, emitted.y, emitted.z}}, radiance);
  }
  if (any(sky)) {
    Vector to = direction_at_height(load(b.height), load(b.light_v)), sum;
    F density;
    surroundings(lights, light_count, to, sum, density);
    direction = select<3>(sky, to, direction);
    distance = select(sky, stdlib::infinity<F>(), distance);
    pdf = select(sky, density / share, pdf);
    radiance = select<3>(sky, sum, radiance);
  }
  store(direction, b.to_light), store(radiance, b.radiance);
  store(distance, b.light_distance), store(pdf, b.light_pdf);
}

/// Where rays in a direction leave the surface.
MS_INLINE Vector origin(const ScatterBlock& b, const Vector& geometric, const Vector& direction) {
  F side = select(less(dot(direction, geometric), F(0.0f)), F(-1.0f), F(1.0f));
  return load(b.point) + geometric * (load(b.offset) * side);
}

/// The lights, seen from here.
MS_INLINE void see_lights(ScatterBlock& b, const lanes::Bsdf<F>& bsdf) {
  F zero = F(0.0f), light_pdf = load(b.light_pdf), distance = load(b.light_distance);
  M asked = less(zero, light_pdf);
  store(bits_of(M{}), b.lit);
  if (!any(asked)) return;
  Vector in = select<3>(asked, load(b.to_light), bsdf.geometric);
  BsdfValue<F> value = bsdf.evaluate(in, kAllLobes, asked);
  F weight = select(truth(load(b.delta)), F(1.0f), power_heuristic(light_pdf, value.pdf)) / light_pdf;
  Vector contribution = times(times(load(b.throughput), value.f_cos), load(b.radiance)) * weight;
  M black = equal(contribution[0], zero) & equal(contribution[1], zero) & equal(contribution[2], zero);
  store(bits_of(asked & !black), b.lit);
  // The end stops short of the light's own surface.
  F far = select(equal(distance, stdlib::infinity<F>()), distance, distance * F(kShadowReach) - load(b.offset));
  Shadow* shadows[kLanes];
  LANES shadows[i] = &b.shadows[i];
  store_fours(fours(origin(b, bsdf.geometric, in), zero), shadows, AT(Shadow, ray.origin));
  store_fours(fours(in, far), shadows, AT(Shadow, ray.direction));
  store_fours(fours(contribution, bit_cast<F>(load(b.owner))), shadows, AT(Shadow, contribution));
}

/// The paths' flags: mirror or not, alive or not, and faulted as before.
MS_INLINE F flags_of(F flags, M mirror, M survives) {
  static_assert(offsetof(Path, alive) == offsetof(Path, mirror) + 1 && offsetof(Path, mirror) % 4 == 0);
  return bit_cast<F>((bit_cast<U>(flags) & U(0xffff0000u)) | bits_of(mirror) | select(survives, U(0x100u), U(0u)));
}

/// Both ways: to the lights, and onwards. What is constant of `surface` costs nothing.
MS_INLINE void scatter(ScatterBlock& b, const lanes::SurfaceValues<F>& surface, bool one_lobe, bool thin,
                       const AlbedoTables& albedos) {
  SurfaceDirections<F> directions{load(b.normal), load(b.geometric), -load_vector(b.paths, AT(Path, ray.direction)),
                                  truth(load(b.backface))};
  lanes::Bsdf<F> bsdf(surface, directions, thin, false, albedos);
  see_lights(b, bsdf);

  // The way on.
  Draws<U> draws = draws_of(b);
  U first = first_dimension(b);
  F u, v, choice = one_lobe ? F(0.0f) : draws.one(first + U(uint32_t(kLobe))), zero = F(0.0f);
  draws.two(first + U(uint32_t(kDirection)), u, v);
  BsdfSample<F> next = bsdf.sample(choice, u, v, kAllLobes);
  Vector onwards = times(load(b.throughput), next.weight);
  F eta2 = load(b.eta2) * next.eta2, brightest = largest(onwards);
  M survives = next.valid & less(zero, brightest);
  // Russian roulette, by what the path can still bring.
  M plays = stdlib::to_mask<F>(load(b.bounces) + U(1u) >= U(kRouletteFrom));
  if (any(plays)) {
    F survival = min(brightest * eta2, F(0.95f));
    survives = survives & (!plays | less(draws.one(first + U(uint32_t(kRoulette))), survival));
    onwards = onwards * select(plays, F(1.0f) / survival, F(1.0f));
  }
  store_fours(fours(onwards, eta2), b.paths, AT(Path, throughput));

  // Those that go straight on keep all the rest.
  M straight = survives & next.straight;
  store(bits_of(straight), b.straight);
  Path kept;
  Path* paths[kLanes];
  LANES paths[i] = b.straight[i] ? &kept : b.paths[i];
  F flags = load_fours(b.paths, AT(Path, width)).w;
  Vector from = origin(b, bsdf.geometric, next.direction);
  store_fours(fours(from, zero), paths, AT(Path, ray.origin));
  store_fours(fours(next.direction, stdlib::infinity<F>()), paths, AT(Path, ray.direction));
  store_fours(fours(from, next.pdf), paths, AT(Path, from));
  store_fours({bit_cast<F>(load(b.key)), bit_cast<F>(load(b.sample)), bit_cast<F>(load(b.segments)),
               bit_cast<F>(U(load(b.bounces) + U(1u)))},
              paths, AT(Path, sampler));
  store_fours({load(b.width), load(b.spread) + next.spread, zero, flags_of(flags, next.mirror, survives)}, paths,
              AT(Path, width));
}

} // namespace moonshade::renderer::lanes16
