// The BSDF's formulas (bsdf.h says which), written once over the lane L: Bsdf is it for one point, a kernel for 16.
//
// What only some lanes have (metal, a coat, glass, rough or ideal facets, bent normals) is left out where none has it,
// and changes no other lane where one does: a point's numbers do not depend on who is beside it.
#pragma once

#include "renderer/materials/albedo.h"
#include "renderer/materials/diffuse.h"
#include "renderer/materials/ggx.h"

namespace moonshade::renderer {

/// Which part of a BSDF is meant.
enum LobeSet : uint8_t { kDiffuseLobe = 1, kFacetLobe = 2, kMirrorLobe = 4, kAllLobes = 7 };

inline constexpr float kSmoothAlpha = 1e-3f;

} // namespace moonshade::renderer

namespace moonshade::renderer::lanes {

/// Rough interfaces of (nearly) equal indices bend light by nothing, and half vectors vanish.
inline constexpr float kLeastIndexStep = 1e-3f;
/// Below this cosine between both normals, facets' directions are folded back.
inline constexpr float kFacetNormalsAgree = 0.99999f;

/// Of a point's slots.
template <class L> struct SurfaceValues {
  V3<L> color, reflectance;
  L roughness, metallic, ior, transmission;
};

/// Both normals to the viewer `out`; the shading normal, too, sees it from its front.
template <class L> struct SurfaceDirections {
  V3<L> shading_normal, geometric_normal, out;
  Mask<L> backface; ///< within a solid, looking out
};

template <class L> struct BsdfValue {
  V3<L> f_cos;
  L pdf;
};

/// As the scalar one, of the lanes that are `valid`.
template <class L> struct BsdfSample {
  V3<L> direction, weight;
  L pdf, spread, eta2;
  Mask<L> valid, mirror, straight;
};

template <class L> struct Bsdf {
  using V = V3<L>;
  using M = Mask<L>;
  using Value = BsdfValue<L>;
  using Sample = BsdfSample<L>;

  /// Chances, or weights of them.
  struct Lobes {
    L mirror, diffuse, facet;
  };
  /// By how much facets are scaled.
  struct Scales {
    V metal;
    L coat, glass;
  };
  /// What facets met at some cosine do with light, and how often those that are sampled reflect.
  struct Split {
    V reflected, transmitted;
    L share;
  };

  V geometric, out;
  Frame<L> frame; ///< around the shading normal
  V local_out, color, reflectance, keep, diffuse, tint;
  L n_dot_v, between; ///< cosines of the shading normal: with `out`, with the geometric normal
  L alpha, ior, eta, metal, coat, glass;
  L fade_scale;                                     ///< what fading towards the horizon takes on average is given back
  L coat_at_view;                                   ///< what the coat reflects
  L masked_view{}, over_view{}, over_masked_view{}; ///< 1 + Lambda(out), 1 / (4 n_dot_v), and that masked
  M smooth;
  Scales scales;
  Lobes weights;
  CoatAlbedo<L> coat_albedo{};
  AlbedoTables tables;
  bool thin, photons, any_metal, any_coat, any_glass, any_facet;

  MS_INLINE Bsdf(const SurfaceValues<L>& s, const SurfaceDirections<L>& d, bool is_thin, bool of_photons,
                 const AlbedoTables& albedos)
      : geometric(d.geometric_normal), out(d.out), frame(d.shading_normal), local_out(frame.to_local(d.out)),
        color(s.color), reflectance(s.reflectance), keep(white() - s.reflectance), ior(s.ior), tables(albedos),
        thin(is_thin), photons(of_photons) {
    metal = s.metallic;
    glass = (one() - metal) * s.transmission;
    coat = (one() - metal) * (one() - s.transmission);
    diffuse = color * coat;
    n_dot_v = max(local_out[2], L(1e-4f));
    alpha = square(s.roughness);
    smooth = less(alpha, L(kSmoothAlpha));
    between = dot(geometric, frame.n);
    fade_scale = one();
    M bent = less(between, L(kNormalsAgree));
    if (any(bent)) fade_scale = select(bent, one() / horizon_albedo(tables, between), one());
    M coated = less(zero(), coat) & less(one(), ior), clear = less(zero(), glass);
    any_metal = any(less(zero(), metal)), any_coat = any(coated), any_glass = any(clear);
    any_facet = any_metal || any_coat || any_glass;
    set_interface(d.backface, clear);
    coat_at_view = zero();
    if (any_coat) {
      coat_albedo = CoatAlbedo<L>(tables, alpha, ior);
      L at_view = select(smooth, fresnel_dielectric(n_dot_v, ior), coat_albedo.at(n_dot_v));
      coat_at_view = select(coated, at_view, zero());
    }
    scales = scales_at(n_dot_v, eta);
    set_weights();
    if (!any_facet) return;
    masked_view = one() + ggx_lambda(local_out, alpha);
    over_view = L(0.25f) / n_dot_v;
    over_masked_view = over_view / masked_view;
  }

  /// f times the cosine, and the density of `sample` from the same lobes, without those that have no extent; 0 in lanes
  /// that are not `asked` for, whose `in` is any unit vector.
  MS_INLINE Value evaluate(const V& in, uint8_t lobes, M asked) const {
    Value value{black(), zero()};
    L side = dot(in, geometric);
    M above = asked & less(zero(), side), below = asked & less(side, zero());
    Lobes p = probabilities(lobes);
    M diffuses = above & less(zero(), p.diffuse);
    if (any(diffuses)) {
      Value lobe = diffuse_lobe(in, side);
      value.f_cos = select<3>(diffuses, lobe.f_cos, value.f_cos);
      value.pdf = select(diffuses, lobe.pdf * p.diffuse, value.pdf);
    }
    M rough = less(zero(), p.facet) & !smooth;
    if (any_facet && any(rough)) {
      Value facets = facet_lobes(in, above & rough, below & rough & less(zero(), glass));
      value.f_cos = value.f_cos + facets.f_cos;
      value.pdf += p.facet * facets.pdf;
    }
    value.f_cos = times(value.f_cos, keep);
    return value;
  }

  MS_INLINE Sample sample(L choice, L u, L v, uint8_t lobes) const {
    Lobes p = probabilities(lobes);
    M mirrors = less(choice, p.mirror);
    M diffuses = !mirrors & less(choice, p.mirror + p.diffuse);
    M facets = !mirrors & !diffuses & less(zero(), p.facet);
    M rough = facets & !smooth, ideal = facets & smooth, extent = diffuses, none = M{};
    Sample s{geometric, black(), zero(), zero(), one(), none, none, none};
    L within = clamp((choice - p.mirror - p.diffuse) / p.facet, zero(), L(0x1.fffffep-1f));
    V direction = geometric;
    if (any(diffuses)) {
      V local;
      sample_cosine_hemisphere(u, v, local[0], local[1], local[2]);
      V d = frame.to_world(local);
      direction = select<3>(diffuses, folded_where(less(dot(d, geometric), zero()), d), direction);
      s.spread = select(diffuses, L(kDiffuseSpread), s.spread);
    }
    if (any_facet && any(rough)) {
      V d;
      rough = rough & facet_direction(within, u, v, d);
      extent = extent | rough;
      direction = select<3>(rough, d, direction);
      s.spread = select(rough, L(0.3f) * alpha, s.spread);
    }
    if (any(extent)) {
      s.direction = select<3>(extent, normalize_or(direction, geometric), s.direction);
      Value value = evaluate(s.direction, lobes, extent);
      s.valid = extent & less(zero(), value.pdf);
      s.weight = select<3>(s.valid, value.f_cos * (one() / value.pdf), s.weight);
      s.pdf = select(s.valid, value.pdf, zero());
      if (any_glass && !photons && !thin)
        s.eta2 = select(s.valid & less(dot(s.direction, geometric), zero()), eta * eta, one());
    }
    if (any_facet && any(ideal)) sample_ideal(ideal, p.facet, within, s);
    if (any(mirrors)) {
      s.direction = select<3>(mirrors, mirror_direction(), s.direction);
      s.weight = select<3>(mirrors, reflectance * (one() / p.mirror), s.weight);
      s.mirror = s.mirror | mirrors, s.valid = s.valid | mirrors;
    }
    return s;
  }

  MS_INLINE Lobes probabilities(uint8_t lobes) const {
    Lobes p{lobes & kMirrorLobe ? weights.mirror : zero(), lobes & kDiffuseLobe ? weights.diffuse : zero(),
            lobes & kFacetLobe ? weights.facet : zero()};
    L sum = p.mirror + p.diffuse + p.facet;
    sum = select(less(zero(), sum), sum, one());
    return {p.mirror / sum, p.diffuse / sum, p.facet / sum};
  }

  MS_INLINE V mirror_direction() const {
    V direction = frame.n * (L(2.0f) * dot(out, frame.n)) - out;
    return normalize_or(folded_where(less(dot(direction, geometric), zero()), direction), geometric);
  }

  /// Share of light that facets met at this cosine reflect, all lobes together; `of_glass`: those of glass.
  MS_INLINE V reflected(L cosine, const Scales& s, L of_glass) const {
    V sum = black();
    if (any_metal) {
      L white_share = schlick_power(cosine);
      sum = times(s.metal, color * (one() - white_share) + white() * white_share);
    }
    if (any_coat) sum = sum + white() * select(less(one(), ior), s.coat * fresnel_dielectric(cosine, ior), zero());
    if (any_glass) sum = sum + white() * (s.glass * of_glass);
    return sum;
  }

  /// Share that they let through; an interface's change of radiance is not in it.
  MS_INLINE V transmitted(L glass_scale, L of_glass) const { return tint * (glass_scale * (one() - of_glass)); }

  MS_INLINE L glass_reflectance(L cosine) const {
    L f = fresnel_dielectric(cosine, eta);
    return thin ? L(2.0f) * f / (one() + f) : f; // two interfaces, and all that bounces between them (Stokes)
  }

  MS_INLINE Split split(L cosine) const {
    if (!any_glass) return {reflected(cosine, scales, zero()), black(), one()};
    L f = glass_reflectance(cosine);
    Split split{reflected(cosine, scales, f), transmitted(scales.glass, f), one()};
    L r = luminance(split.reflected), sum = r + luminance(split.transmitted);
    split.share = select(less(zero(), glass) & less(zero(), sum), r / sum, one());
    return split;
  }

private:
  MS_INLINE static L zero() { return L(0.0f); }
  MS_INLINE static L one() { return L(1.0f); }
  MS_INLINE static V black() { return {{zero(), zero(), zero()}}; }
  MS_INLINE static V white() { return {{one(), one(), one()}}; }
  MS_INLINE static V up() { return {{zero(), zero(), one()}}; }

  MS_INLINE V folded(const V& direction) const { return direction - geometric * (L(2.0f) * dot(direction, geometric)); }
  MS_INLINE V folded_where(M mask, const V& direction) const {
    return any(mask) ? select<3>(mask, folded(direction), direction) : direction;
  }

  MS_INLINE void set_interface(M backface, M clear) {
    eta = ior, tint = white();
    if (!any_glass) return;
    eta = select(clear & !smooth, max(eta, L(1 + kLeastIndexStep)), eta);
    if (!thin) eta = select(clear & backface, one() / eta, eta);
    tint = thin ? color : V{{stdlib::sqrt(color[0]), stdlib::sqrt(color[1]), stdlib::sqrt(color[2])}};
  }

  MS_INLINE void set_weights() {
    L mirror = luminance(reflectance), rest = one() - mirror;
    M mirrors = less(zero(), max(reflectance[0], max(reflectance[1], reflectance[2])));
    weights.mirror = select(mirrors, max(mirror, L(0.05f)), zero());
    weights.diffuse = rest * luminance(diffuse) * (one() - coat_at_view);
    L facet = zero();
    if (any_metal) {
      L white_share = schlick_power(n_dot_v);
      facet = metal * luminance(V(color * (one() - white_share) + white() * white_share));
    }
    if (any_coat) facet = facet + coat * coat_at_view;
    if (any_glass) facet = facet + glass * max(luminance(tint), L(0.1f));
    weights.facet = rest * facet;
  }

  /// For light from this cosine that bounces more than once.
  MS_INLINE Scales scales_at(L cosine, L eta_of_glass) const {
    Scales s{white() * metal, coat, glass};
    if (!any_facet || !any(!smooth)) return s;
    if (any_metal || any_coat || thin) {
      L albedo = facet_albedo(tables, cosine, alpha), lost = select(smooth, zero(), (one() - albedo) / albedo);
      if (any_metal) s.metal = times(s.metal, white() + color * lost);
      if (any_coat) s.coat = s.coat * (one() + square(L((ior - one()) / (ior + one()))) * lost);
      if (thin) s.glass = select(smooth, s.glass, s.glass / albedo);
    }
    if (any_glass && !thin)
      s.glass = select(smooth, s.glass, s.glass / glass_albedo(tables, cosine, alpha, eta_of_glass));
    return s;
  }

  /// Veach's correction for shading normals, of what photons carry ("Robust Monte Carlo Methods", 5.3): `cosine` is
  /// that of `in` with the shading normal, which the value has been multiplied by.
  MS_INLINE L photon_factor(const V& in, L cosine) const {
    return n_dot_v * stdlib::abs(dot(in, geometric)) / (max(dot(out, geometric), L(1e-4f)) * max(cosine, L(1e-4f)));
  }

  /// `side`: the cosine with the geometric normal.
  MS_INLINE Value diffuse_lobe(const V& in, L side) const {
    L cosine = dot(in, frame.n);
    L pdf = (max(cosine, zero()) + max(dot(folded(in), frame.n), zero())) * L(kInvPi);
    M lit = less(zero(), cosine);
    L fade, projected; // towards the light, which for photons is behind `out`
    if (photons) {
      L out_side = max(dot(out, geometric), L(1e-4f));
      fade = horizon_fade(out_side, n_dot_v, between);
      projected = n_dot_v * side / out_side;
      cosine = select(lit, cosine, L(1e-4f)); // seen from where the normal would be turned to the viewer
      lit = M{} | !M{};
    } else {
      fade = horizon_fade(side, cosine, between);
      projected = cosine;
    }
    L share = L(kInvPi) * projected * fade * fade_scale;
    if (any_coat) {
      L through = (one() - coat_at_view) * (one() - coat_albedo.at(cosine)) / (one() - coat_albedo.mean);
      share = select(less(zero(), coat_at_view), share * through, share);
    }
    return {select<3>(lit, diffuse * share, black()), pdf};
  }

  /// Of light from above and from below the geometric surface; with what the bent normal would send to the wrong side.
  MS_INLINE Value facet_lobes(const V& in, M above, M below) const {
    Value value{black(), zero()};
    V direction = in;
    M bent = less(between, L(kFacetNormalsAgree));
#pragma clang loop unroll(disable)
    for (int fold = 0; fold < 2; ++fold) {
      if (fold == 1) {
        above = above & bent, below = below & bent;
        if (!any(above | below)) break;
        direction = folded(in);
      }
      facet_lobe(direction, above, below, value);
    }
    return value;
  }

  /// One direction: light that is reflected, or (`below`) let through. A sheet scatters forward as it reflects.
  MS_INLINE void facet_lobe(const V& in, M above, M below, Value& value) const {
    V l = frame.to_local(in);
    if (thin) l[2] = select(below, -l[2], l[2]);
    M reflects = (thin ? above | below : above) & less(zero(), l[2]);
    if (any(reflects)) {
      V h = normalize_or(l + local_out, up());
      L c = max(dot(local_out, h), zero());
      Split s = split(c);
      V f = s.reflected;
      L factor = one(), share = s.share;
      if (photons) {
        L of_glass = glass_reflectance(c);
        Scales to_light = scales_at(l[2], eta);
        f = reflected(c, to_light, of_glass);
        s.transmitted = transmitted(to_light.glass, of_glass);
        factor = photon_factor(in, l[2]);
      }
      if (thin && any_glass) {
        f = select<3>(below, s.transmitted, f);
        share = select(below, one() - share, share);
      }
      add(value, reflects, f, h, l, over_view * factor, over_masked_view * share);
    }
    M refracts = below & less(l[2], zero());
    if (!thin && any_glass && any(refracts)) solid_lobe(in, l, refracts, value);
  }

  /// Walter et al. 2007, equation 21.
  MS_INLINE void solid_lobe(const V& in, const V& l, M refracts, Value& value) const {
    V h = normalize_or(local_out + l * eta, up());
    h = h * select(less(h[2], zero()), -one(), one());
    L c = dot(local_out, h), d = dot(l, h);
    refracts = refracts & less(zero(), c) & less(d, zero());
    if (!any(refracts)) return;
    Split s = split(c);
    // Radiance shrinks by eta^2 across the interface; what photons carry does not.
    L eta2 = eta * eta, jacobian = L(4.0f) * c * -d / square(L(c + eta * d)), factor = one();
    if (photons) {
      s.transmitted = transmitted(scales_at(-l[2], one() / eta).glass, glass_reflectance(c));
      factor = eta2 * photon_factor(in, -l[2]);
    }
    add(value, refracts, s.transmitted, h, l, over_view * jacobian * factor,
        over_masked_view * jacobian * eta2 * (one() - s.share));
  }

  /// What facets with normal `h` send from `l`; both scales without their density and without what `l` is masked by.
  MS_INLINE void add(Value& value, M mask, const V& f, const V& h, const V& l, L scale, L pdf_scale) const {
    L density = ggx_density(h, alpha), masked = masked_view + ggx_lambda(l, alpha);
    value.f_cos = select<3>(mask, value.f_cos + f * (density * scale / masked), value.f_cos);
    value.pdf = select(mask, value.pdf + density * pdf_scale, value.pdf);
  }

  /// Where a facet chosen by `u` and `v` sends light; false where it would have to bounce again.
  MS_INLINE M facet_direction(L choice, L u, L v, V& direction) const {
    L a, b;
    sample_disk_by_angle(u, v, a, b);
    V h = ggx_visible_normal(local_out, alpha, a, b);
    L c = dot(local_out, h);
    V l = h * (L(2.0f) * c) - local_out;
    M leaves = less(zero(), l[2]), reflects = M{} | !M{};
    if (any_glass) {
      reflects = less(choice, split(c).share);
      if (thin) {
        l[2] = select(reflects, l[2], -l[2]);
      } else if (any(!reflects)) {
        V through = refracted(local_out, h, c, eta);
        leaves = (reflects & leaves) | (!reflects & less(through[2], zero()));
        l = select<3>(reflects, l, through);
      }
    }
    V d = frame.to_world(l);
    M below = less(dot(d, geometric), zero());
    direction = folded_where((reflects & below) | (!reflects & !below), d);
    return leaves;
  }

  /// An ideal mirror or interface: what facets would do whose normals are all alike.
  MS_INLINE void sample_ideal(M ideal, L probability, L choice, Sample& s) const {
    Split facets = split(n_dot_v);
    M reflects = ideal & less(choice, facets.share), passes = ideal & !reflects;
    s.valid = s.valid | ideal, s.mirror = s.mirror | ideal;
    s.direction = select<3>(reflects, mirror_direction(), s.direction);
    s.weight = select<3>(reflects, times(keep, facets.reflected) * (one() / (probability * facets.share)), s.weight);
    if (!any_glass || !any(passes)) return;
    V weight = times(keep, facets.transmitted) * (one() / (probability * (one() - facets.share)));
    V direction = -out;
    if (thin) {
      s.straight = passes;
    } else {
      V d = refracted(out, frame.n, n_dot_v, eta);
      direction = normalize_or(folded_where(less(zero(), dot(d, geometric)), d), -geometric);
    }
    s.direction = select<3>(passes, direction, s.direction);
    if (!thin && !photons) {
      s.eta2 = select(passes, eta * eta, s.eta2);
      weight = weight * (one() / s.eta2);
    }
    s.weight = select<3>(passes, weight, s.weight);
  }
};

} // namespace moonshade::renderer::lanes
