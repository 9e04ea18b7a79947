// One instruction set's kernels: MS_KERNELS names the table.
#include "renderer/geometry/triangle_point.h"
#include "renderer/kernels/scatter.h"
#include "renderer/materials/channels.h"

namespace moonshade::renderer {

namespace {

using namespace lanes;
using namespace lanes16;

/// Whole quotients, by a division of doubles, which is exact enough for any two integers of 32 bits.
MS_INLINE U divided(U a, uint32_t b) {
  using D = Double<F>;
  return convert<U>(convert<D>(a) / D(double(b)));
}

/// Paths that have not left the camera yet: all alike.
MS_INLINE void start_paths(const Path& initial, Path* const (&paths)[kLanes]) {
  Four parts[sizeof(Path) / sizeof(Four)];
  __builtin_memcpy(parts, &initial, sizeof parts);
  LANES __builtin_memcpy(paths[i], parts, sizeof parts);
}

void camera_paths(const CameraRays& camera, const Path& initial, uint32_t seed, const uint32_t* pixels, uint32_t width,
                  uint32_t sample, size_t count, Path* paths) {
  uint32_t seed_hash = hash32(seed);
  for (size_t at = 0; at < count; at += kLanes) {
    size_t n = count - at < kLanes ? count - at : kLanes;
    alignas(64) LaneInts pixel;
    Path* starts[kLanes];
    LANES pixel[i] = pixels[at + (i < n ? i : 0)], starts[i] = paths + at + (i < n ? i : 0);
    Draws<U> draws{hash_combine(U(seed_hash), load(pixel)), U(sample)};
    F u, v, lens_u = F(0.5f), lens_v = F(0.5f);
    draws.two(U(0u), u, v);
    if (camera.has_lens()) draws.two(U(kLensDimension), lens_u, lens_v);
    U row = divided(load(pixel), width), column = load(pixel) - row * U(width);
    F x = convert<F>(bit_cast<I>(column)) + F(0.5f) + sample_tent(u);
    F y = convert<F>(bit_cast<I>(row)) + F(0.5f) + sample_tent(v);
    Vector origin, direction;
    camera.rays(x, y, lens_u, lens_v, origin, direction);
    start_paths(initial, starts);
    store_fours(fours(origin, F(0.0f)), starts, AT(Path, ray.origin));
    store_fours(fours(direction, stdlib::infinity<F>()), starts, AT(Path, ray.direction));
    F none = F(0.0f);
    store_fours({bit_cast<F>(draws.key), bit_cast<F>(draws.sample), none, none}, starts, AT(Path, sampler));
  }
}

struct Corners {
  alignas(64) LaneFloats at[3][3];
  MS_INLINE Vector of(int corner) const { return load(at[corner]); }
  MS_INLINE void set(size_t lane, const float* values, const uint32_t* indices) {
    for (int corner = 0; corner < 3; ++corner) {
      const float* v = values + size_t(indices[corner]) * 3;
      at[corner][0][lane] = v[0], at[corner][1][lane] = v[1], at[corner][2][lane] = v[2];
    }
  }
  MS_INLINE void clear(size_t lane) {
    for (int corner = 0; corner < 3; ++corner)
      at[corner][0][lane] = at[corner][1][lane] = at[corner][2][lane] = 0;
  }
};

/// A matrix of every lane's object.
struct Matrices {
  alignas(64) float at[9][kLanes];
  MS_INLINE void set(size_t lane, const float* matrix) {
    for (int k = 0; k < 9; ++k)
      at[k][lane] = matrix[k];
  }
  MS_INLINE static M3<F> of_one(const float* matrix) {
    M3<F> m;
    for (int c = 0; c < 3; ++c)
      m.columns[c] = {{F(matrix[3 * c]), F(matrix[3 * c + 1]), F(matrix[3 * c + 2])}};
    return m;
  }
  MS_INLINE M3<F> all() const {
    M3<F> m;
    for (int c = 0; c < 3; ++c)
      m.columns[c] = {{load(at[3 * c]), load(at[3 * c + 1]), load(at[3 * c + 2])}};
    return m;
  }
};

MS_INLINE void put(const PointArrays& out, Channel channel, size_t at, const Vector& v) {
  for (int c = 0; c < 3; ++c)
    store(v[c], out.inputs[channel + c] + at);
}
MS_INLINE Vector get(const PointArrays& points, Channel channel, size_t at) {
  return {{load(points.inputs[channel] + at), load(points.inputs[channel + 1] + at),
           load(points.inputs[channel + 2] + at)}};
}

void triangle_points(const TriangleSource* sources, const Met* met, size_t count, uint32_t needs, bool bends,
                     const PointArrays& out, size_t at) {
  Corners positions, normals;
  const Ray* rays[kLanes];
  const float* corners[3][kLanes];
  alignas(64) LaneFloats width, spread, uv[3][2];
  bool wants_uv = needs & (channel_mask(kUv, 2) | channel_mask(kDpdu, 6));
  bool wants_local = bends || (needs & channel_mask(kLocal, 3));
  const uint32_t object = met[0].hit.object;
  bool one_object = true, any_placed = false, any_smooth = false;
  for (size_t i = 0; i < count; ++i) {
    const TriangleSource& s = sources[met[i].hit.object];
    one_object &= met[i].hit.object == object;
    any_placed |= !s.identity, any_smooth |= s.normals != nullptr;
  }
  wants_local &= any_placed;
  LANES {
    const Met& m = met[i < count ? i : 0];
    const TriangleSource& s = sources[m.hit.object];
    size_t triangle = size_t(m.hit.primitive) * 3;
    rays[i] = m.ray;
    width[i] = m.width, spread[i] = m.spread;
    for (size_t corner = 0; corner < 3; ++corner)
      corners[corner][i] = s.vertices + size_t(s.triangles[triangle + corner]) * 3;
    if (wants_local) positions.set(i, s.positions, s.triangles + triangle);
    if (!any_smooth) continue;
    if (s.normals)
      normals.set(i, s.normals, s.normal_corners + triangle);
    else
      normals.clear(i);
  }
  if (wants_uv) LANES {
      constexpr float kNone[3][2] = {{0, 0}, {1, 0}, {1, 1}};
      const Met& m = met[i < count ? i : 0];
      const TriangleSource& s = sources[m.hit.object];
      size_t triangle = size_t(m.hit.primitive) * 3;
      bool has = s.uv_corners && s.uv_corners[triangle] != Mesh::kNoIndex;
      for (int corner = 0; corner < 3; ++corner) {
        uint32_t index = has ? s.uv_corners[triangle + size_t(corner)] : Mesh::kNoIndex;
        const float* from = index != Mesh::kNoIndex ? s.uvs + size_t(index) * 2 : kNone[corner];
        uv[corner][0][i] = from[0], uv[corner][1][i] = from[1];
      }
    }
  // Of objects: mostly there is one.
  M mirrored, identity, smooth, none = truth(U(0u));
  M3<F> matrix;
  F scale;
  if (one_object) {
    const TriangleSource& s = sources[object];
    mirrored = s.mirrored ? !none : none, identity = s.identity ? !none : none, smooth = s.normals ? !none : none;
    matrix = Matrices::of_one(s.normal_matrix);
    scale = F(s.scale);
  } else {
    Matrices matrices;
    alignas(64) LaneFloats scales;
    alignas(64) LaneInts flags[3];
    LANES {
      const TriangleSource& s = sources[met[i < count ? i : 0].hit.object];
      matrices.set(i, s.normal_matrix);
      scales[i] = s.scale;
      flags[0][i] = s.mirrored, flags[1][i] = s.identity, flags[2][i] = s.normals != nullptr;
    }
    mirrored = truth(load(flags[0])), identity = truth(load(flags[1])), smooth = truth(load(flags[2]));
    matrix = matrices.all();
    scale = load(scales);
  }
  Vector zero = {{F(0.0f), F(0.0f), F(0.0f)}};
  TriangleHit<F> hit{load_vector(rays, AT(Ray, origin)),
                     load_vector(rays, AT(Ray, direction)),
                     load_vector(corners[0], 0),
                     load_vector(corners[1], 0),
                     load_vector(corners[2], 0),
                     mirrored,
                     identity,
                     zero,
                     zero,
                     zero,
                     matrix,
                     smooth,
                     zero,
                     zero,
                     zero};
  if (wants_local) hit.local_a = positions.of(0), hit.local_b = positions.of(1), hit.local_c = positions.of(2);
  if (any_smooth) hit.normal_a = normals.of(0), hit.normal_b = normals.of(1), hit.normal_c = normals.of(2);
  TrianglePoint<F> p = triangle_point(hit);
  F footprint = load(width) + load(spread) * p.distance;
  store(footprint, out.width + at);
  M back = less(F(0.0f), dot(p.geometric_normal, hit.direction));
  F side = select(back, F(-1.0f), F(1.0f));
  alignas(64) LaneInts backs;
  store(bits_of(back), backs);
  for (size_t i = 0; i < count; ++i)
    out.backface[at + i] = uint8_t(backs[i]), out.id[at + i] = int64_t(met[i].hit.object);
  put(out, kWorld, at, p.world);
  Vector geometric = p.geometric_normal * side, shading = p.shading_normal * side;
  put(out, kGeometric, at, geometric);
  store(p.distance, out.distance + at);
  store(p.offset, out.offset + at);
  if (bends) {
    for (int c = 0; c < 3; ++c)
      store(p.shading_normal[c], out.outward[c] + at);
    put(out, kNormal, at, shading);
  } else {
    put(out, kNormal, at, turned_to_viewer(shading, geometric, -hit.direction));
  }
  if (bends || (needs & channel_mask(kLocal, 3))) put(out, kLocal, at, p.local);
  if (needs & channel_mask(kIncident, 3)) put(out, kIncident, at, hit.direction);
  if (bends || (needs & channel_mask(kFootprint, 1))) store(footprint / scale, out.inputs[kFootprint] + at);
  if (!wants_uv) return;
  F places[3][2];
  for (int corner = 0; corner < 3; ++corner)
    places[corner][0] = load(uv[corner][0]), places[corner][1] = load(uv[corner][1]);
  TexturePoint<F> t = texture_point(p, places);
  store(t.u, out.inputs[kUv] + at), store(t.v, out.inputs[kUv + 1] + at);
  put(out, kDpdu, at, t.dpdu), put(out, kDpdv, at, t.dpdv);
}

void surroundings_of(const EnvironmentLight* lights, size_t light_count, float lights_in_scene, const Vec3* directions,
                     size_t count, Vec3* radiance, float* density) {
  for (size_t at = 0; at < count; at += kLanes) {
    size_t n = count - at < kLanes ? count - at : kLanes;
    alignas(64) LaneFloats d[3], r[3], p;
    LANES {
      const Vec3& from = directions[at + (i < n ? i : 0)];
      d[0][i] = from.x, d[1][i] = from.y, d[2][i] = from.z;
    }
    Vector sum;
    F all;
    surroundings(lights, light_count, load(d), sum, all);
    store(sum, r), store(all / F(lights_in_scene), p);
    for (size_t i = 0; i < n; ++i) {
      radiance[at + i].x = r[0][i], radiance[at + i].y = r[1][i], radiance[at + i].z = r[2][i];
      density[at + i] = p[i];
    }
  }
}

void draw_vertices(ScatterBlock& block, uint32_t light_count) { draw_lights(block, light_count); }

void sample_lights(ScatterBlock& block, const EnvironmentLight* lights, size_t light_count, float lights_in_scene) {
  light_samples(block, lights, light_count, lights_in_scene);
}

void scatter_any(ScatterBlock& b, const AlbedoTables& albedos, bool thin) {
  scatter(b,
          {load(b.color), load(b.reflectance), load(b.roughness), load(b.metallic), load(b.ior), load(b.transmission)},
          false, thin, albedos);
}

void scatter_diffuse(ScatterBlock& b, const AlbedoTables& albedos) {
  F zero = F(0.0f), one = F(1.0f);
  scatter(b, {load(b.color), {{zero, zero, zero}}, one, zero, one, zero}, true, false, albedos);
}

MS_INLINE Vector lane_vectors(const float* const (&arrays)[3], size_t at) {
  return {{load(arrays[0] + at), load(arrays[1] + at), load(arrays[2] + at)}};
}

void bend_normals(const TriangleSource* sources, const Met* met, size_t count, const HeightArrays& heights,
                  const PointArrays& points, size_t at) {
  for (size_t block = 0; block < count; block += kLanes) {
    size_t n = count - block < kLanes ? count - block : kLanes, k = at + block;
    alignas(64) LaneFloats direction[3];
    alignas(64) LaneInts backs, codes;
    const uint32_t object = met[block].hit.object;
    bool one_object = true;
    LANES {
      const Met& m = met[block + (i < n ? i : 0)];
      one_object &= m.hit.object == object;
      direction[0][i] = m.ray->direction.x, direction[1][i] = m.ray->direction.y, direction[2][i] = m.ray->direction.z;
      backs[i] = points.backface[k + (i < n ? i : 0)], codes[i] = heights.codes[block + (i < n ? i : 0)];
    }
    M3<F> normal_matrix = Matrices::of_one(sources[object].normal_matrix);
    M3<F> linear = Matrices::of_one(sources[object].linear);
    if (!one_object) {
      Matrices normal_matrices, linears;
      LANES {
        const TriangleSource& s = sources[met[block + (i < n ? i : 0)].hit.object];
        normal_matrices.set(i, s.normal_matrix), linears.set(i, s.linear);
      }
      normal_matrix = normal_matrices.all(), linear = linears.all();
    }
    Vector zero = {{F(0.0f), F(0.0f), F(0.0f)}}, g = zero;
    // The total derivative by p: P moves as M p, and uv along the surface.
    if (heights.by_local[0]) g = g + lane_vectors(heights.by_local, block);
    if (heights.by_world[0]) g = g + linear.transposed(lane_vectors(heights.by_world, block));
    if (heights.by_uv[0]) {
      // u and v each rise by 1 along their own tangent and stay along the other.
      Vector u = normal_matrix.transposed(get(points, kDpdu, k)), v = normal_matrix.transposed(get(points, kDpdv, k));
      if (heights.unit_tangents) u = normalize_or(u, u), v = normalize_or(v, v);
      Vector across = cross(u, v);
      F inverse = F(1.0f) / dot(across, across);
      g = g + cross(v, across) * (inverse * load(heights.by_uv[0] + block)) +
          cross(across, u) * (inverse * load(heights.by_uv[1] + block));
    }
    Vector outward = lane_vectors(points.outward, k);
    // The surface gradient in object space (Mikkelsen 2010).
    Vector local = normalize_or(linear.transposed(outward), outward);
    Vector bent = normalize_or(local - (g - local * dot(g, local)), local);
    bent = normalize_or(normal_matrix * bent, outward);
    F inf = stdlib::infinity<F>(), none = F(0.0f);
    M finite = less(stdlib::abs(g[0]), inf) & less(stdlib::abs(g[1]), inf) & less(stdlib::abs(g[2]), inf);
    M flat = equal(g[0], none) & equal(g[1], none) & equal(g[2], none);
    M bends = finite & !flat & !truth(load(codes));
    F side = select(truth(load(backs)), F(-1.0f), F(1.0f));
    Vector normal = select<3>(bends, bent, outward) * side;
    put(points, kNormal, k, turned_to_viewer(normal, get(points, kGeometric, k), -load(direction)));
  }
}

} // namespace

extern const Kernels MS_KERNELS;
const Kernels MS_KERNELS = {camera_paths,  triangle_points, bend_normals, surroundings_of,
                            draw_vertices, sample_lights,   scatter_any,  scatter_diffuse};

} // namespace moonshade::renderer
