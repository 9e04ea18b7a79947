// The hot loops of rendering, over 16 points at a time: written once, compiled for each generation of processors
// (x86-64, -v3 with AVX2, -v4 with AVX-512) and chosen by the one that runs. All give the same bits: every operation is
// one of IEEE 754's, none is contracted.
//
// What is compiled for a newer processor must not become what the linker keeps for all: kernels call nothing but
// functions that are always inlined, and see the rest of the program as plain data.
#pragma once

#include "renderer/camera.h"
#include "renderer/geometry/geometry.h"
#include "renderer/integrators/path.h"
#include "renderer/lights/light_lanes.h"
#include "renderer/materials/albedo.h"

namespace moonshade::renderer {

inline constexpr size_t kLanes = 16;

/// What a ray has met, in order to be shaded.
struct Met {
  uint32_t owner;
  float width, spread; ///< of the footprint: at the ray's origin, growth per distance
  const Ray* ray;
  Hit hit;
};

/// Points as structure of arrays. They have room for kLanes - 1 beyond the last point, which may be overwritten.
struct PointArrays {
  float* inputs[24]; ///< of a ShadingBatch, by Channel
  uint8_t* backface;
  int64_t* id;
  float *distance, *offset, *width; ///< `width`: of the footprint, in world units
  float* outward[3];                ///< the shading normal before it is turned to the viewer
};

/// Derivatives of height by p, P and uv, three arrays each (two by uv), or null where it has none.
struct HeightArrays {
  const float *by_local[3], *by_world[3], *by_uv[2];
  bool unit_tangents; ///< `by_uv` are slopes along tangents of length 1
  const uint8_t* codes;
};

/// One number a lane, or 16 side by side.
using LaneFloats = float[kLanes];
using LaneInts = uint32_t[kLanes];

/// Points that scatter, and all that is drawn and found for them. Lanes that nobody asked for repeat the first.
struct alignas(64) ScatterBlock {
  // Of points and materials, by who fills the block.
  Path* paths[kLanes];
  LaneFloats point[3], normal[3], geometric[3], offset, width;
  LaneFloats color[3], reflectance[3], roughness, metallic, ior, transmission;
  LaneInts owner, backface;
  // Of paths, and drawn for them.
  LaneFloats throughput[3], eta2, spread;
  LaneInts segments, bounces, key, sample;
  LaneInts light;
  LaneFloats light_u, light_v, light_w;
  // Where a light is: on a triangle, or in a direction of the surroundings that are formulas (`sky` not 0); or else
  // found already.
  const LightTriangle* triangles[kLanes];
  LaneInts sky, delta;
  LaneFloats height;
  // What it sends.
  LaneFloats to_light[3], light_distance, radiance[3], light_pdf;
  // Result: rays towards the lights, where `lit` is not 0.
  Shadow shadows[kLanes];
  LaneInts lit;
  // Result: paths that go straight on, of which nothing but the throughput is changed.
  LaneInts straight;
};

struct Kernels {
  /// Paths through the image, of pixels as y * width + x.
  void (*camera_paths)(const CameraRays& camera, const Path& initial, uint32_t seed, const uint32_t* pixels,
                       uint32_t width, uint32_t sample, size_t count, Path* paths);
  /// Points of at most 16 hits, all on triangles of `sources` (by object), into places from `at` on: the inputs of
  /// `needs` (a bit a channel), and what integrators ask for. Normals are final, or (`bends`) yet to be bent.
  void (*triangle_points)(const TriangleSource* sources, const Met* met, size_t count, uint32_t needs, bool bends,
                          const PointArrays& out, size_t at);
  /// Bends `count` outward normals by gradients of height and turns them to the viewer: where `codes` is 0.
  void (*bend_normals)(const TriangleSource* sources, const Met* met, size_t count, const HeightArrays& heights,
                       const PointArrays& points, size_t at);
  /// Radiance from directions that leave the scene, any number of them, and the density by which light samples find
  /// them.
  void (*surroundings)(const EnvironmentLight* lights, size_t light_count, float lights_in_scene,
                       const Vec3* directions, size_t count, Vec3* radiance, float* density);
  /// What the paths of a block are like, and numbers for light samples.
  void (*draw_vertices)(ScatterBlock& block, uint32_t light_count);
  /// What the lights of a block send, of `triangles` and `sky`.
  void (*sample_lights)(ScatterBlock& block, const EnvironmentLight* lights, size_t light_count, float lights_in_scene);
  /// The BSDF of a block, both ways: to the lights, and onwards. Paths that end are not `alive`; of them, nothing but
  /// radiance and faults is kept.
  void (*scatter)(ScatterBlock& block, const AlbedoTables& albedos, bool thin);
  /// The same where all are Lambert's law and nothing else: without reflectance, metal and transmission, with an index
  /// of 1.
  void (*scatter_diffuse)(ScatterBlock& block, const AlbedoTables& albedos);
};

/// Those that this machine runs, the fastest last.
std::vector<const Kernels*> runnable_kernels();
/// The fastest.
const Kernels& kernels();

} // namespace moonshade::renderer
