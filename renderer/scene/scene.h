// The description of a scene as plain data: what the readers (Lua, OBJ with MTL) produce and the renderer consumes.
// Nothing here is prepared for rendering; files named by materials are already resolved to paths that may be opened.
#pragma once

#include "compiler/sema/shader_info.h"
#include "renderer/math.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::renderer {

/// Triangles in object space. Positions, normals and texture coordinates have indices of their own, as in OBJ.
struct Mesh {
  using Corners = std::array<uint32_t, 3>;

  std::string name;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals; ///< unit length
  std::vector<Vec2> uvs;
  std::vector<Corners> triangles;       ///< indices of positions
  std::vector<Corners> normal_corners;  ///< per triangle, or empty: flat
  std::vector<Corners> uv_corners;      ///< per triangle, or empty: no texture coordinates; kNoIndex: none here
  std::vector<uint32_t> material_slots; ///< per triangle, an index into Object::materials, or empty: all 0

  static constexpr uint32_t kNoIndex = UINT32_MAX;
};

/// What a material takes from a shader entry or a constant.
enum class Slot : uint8_t { Color, Reflectance, Roughness, Metallic, Emission, Ior, Transmission, Opacity };
inline constexpr size_t kSlotCount = 8;

struct SlotInfo {
  const char* name;    ///< entry of a shader, field of a scene's material
  unsigned components; ///< 1 or 3
  Vec3 default_value;
};
/// Facts of each slot, in the order of the enumeration.
inline const std::array<SlotInfo, kSlotCount>& slot_infos() {
  static const std::array<SlotInfo, kSlotCount> infos = {{{"color", 3, Vec3(0.8f)},
                                                          {"reflectance", 3, Vec3(0)},
                                                          {"roughness", 1, Vec3(0.5f)},
                                                          {"metallic", 1, Vec3(0)},
                                                          {"emission", 3, Vec3(0)},
                                                          {"ior", 1, Vec3(1.5f)},
                                                          {"transmission", 1, Vec3(0)},
                                                          {"opacity", 1, Vec3(1)}}};
  return infos;
}

/// An image that a model's material names for a slot, which becomes `factor` times what the image has there.
struct SlotImage {
  /// What of the image gives a slot of one number. Mask: alpha where the image has any, else red.
  enum class Part : uint8_t { Red, Green, Blue, Alpha, Mask };

  std::string file;                         ///< a path that may be opened; or
  std::shared_ptr<const std::string> bytes; ///< of a PNG or JPEG within the model's file
  std::string name, place;                  ///< for messages: "wood.png", "table.mtl:7"
  Part part = Part::Red;
  Vec3 factor{1};
  Vec2 scale{1}, offset{0};    ///< it is looked up at uv · scale + offset
  std::optional<float> cutoff; ///< the slot is 1 from here on, and 0 below
};

/// An image that a model's material names to bend the normal.
struct BumpImage {
  /// Heights: red, of which white stands out by `factor.x` times kBumpDepth of the image's width on the surface,
  /// whatever size it has there. Normals: in tangent space, red, green and blue from -1 to 1, the first two times
  /// `factor.x`. By looks: normals where the image is mostly blue, as only those are.
  enum class Kind : uint8_t { Heights, Normals, ByLooks };

  SlotImage image;
  Kind kind = Kind::Heights;
};
inline constexpr float kBumpDepth = 0.02f;

/// How `height` bends the normal: by its exact gradient, by differences over the footprint, by the paper's formula.
enum class BumpMode : uint8_t { Gradient, Differences, Paper };

struct Material {
  std::string name;
  std::string place; ///< "scene.lua:12", for messages
  /// Constants; nothing where the file or the default decides.
  std::array<std::optional<Vec3>, kSlotCount> values;
  /// Win over constants, which stand in where an image cannot be read.
  std::array<std::optional<SlotImage>, kSlotCount> images;
  /// A shader file for one entry alone; wins over `shader` and images.
  std::array<std::string, kSlotCount> shaders;
  std::string height_shader;
  std::optional<BumpImage> bump_image; ///< where no shader gives `height`
  /// Gives every entry that is not set above.
  std::string shader;
  std::map<std::string, Constant> parameters;
  BumpMode bump = BumpMode::Gradient;
  /// A volume within a closed object, where one of these or the shader's `density` is given. Then `color` is the
  /// scattering albedo, and `emission` is per unit of length.
  std::string density_shader;
  std::optional<float> density;
  float anisotropy = 0;
  bool emits_outward_only = false; ///< an area light's
  bool thin = false;               ///< a sheet: what is transmitted goes on unbent
  Vec3 absorption{0};              ///< of a solid that transmits, per unit of length in world space
  /// What a light whose emission a shader gives is sampled by; nothing: measured.
  std::optional<Vec3> average_emission;
};

enum class Shape : uint8_t { Mesh, Sphere };

struct Object {
  std::string name;
  Shape shape = Shape::Mesh;
  std::shared_ptr<const Mesh> mesh; ///< Shape::Mesh
  float radius = 1;                 ///< Shape::Sphere: around the origin of object space
  Mat4 to_world{1.0f};
  std::vector<uint32_t> materials; ///< indices into Scene::materials
};

enum class LightKind : uint8_t { Point, Sun, Sky, Spot, Environment };

/// Lights that are no objects. (Area lights are objects whose material emits.)
struct Light {
  LightKind kind = LightKind::Point;
  bool by_default = false; ///< the scene says nothing of light: goes where a shader turns out to emit
  Vec3 position{0};        ///< Point, Spot
  Vec3 direction{0, 1, 0}; ///< Sun: unit vector towards it; Spot: the way it shines
  /// Point, Spot: intensity (per steradian), of a spot along its axis; Sun: irradiance on a surface that faces it;
  /// Environment: what the image or the shader is multiplied by
  Vec3 color{1};
  float angle = 0.53f;                   ///< Sun: apparent diameter in degrees; Spot: of its cone
  float blend = 0.2f;                    ///< Spot: share of the cone's half angle over which it fades
  Vec3 zenith{1}, horizon{1}, ground{1}; ///< Sky: radiance overhead, at the horizon and below it
  // Environment
  std::string name, place;   ///< for messages
  std::string image, shader; ///< one of them: a file
  std::map<std::string, Constant> parameters;
  float rotate = 0; ///< around y, in degrees
};

enum class CameraKind : uint8_t { Perspective, Orthographic };
inline constexpr std::string_view kCameraNames[] = {"perspective", "orthographic"};

struct Camera {
  CameraKind kind = CameraKind::Perspective;
  Vec3 from{0, 1, 5};
  Vec3 to{0};
  Vec3 up{0, 1, 0};
  float fov = 40;     ///< Perspective: vertical, degrees
  float height = 2;   ///< Orthographic: of what is seen, in world space
  float aperture = 0; ///< Perspective: diameter of the lens in world space; 0: a pinhole
  float focus = 0;    ///< distance of the plane in focus, along the axis; 0: that of `to`
};

enum class IntegratorKind : uint8_t { Path, Whitted, Sppm, Irradiance };
enum class Tonemap : uint8_t { None, Filmic };
/// Their names in scenes and on the command line, in the order of the enumerations.
inline constexpr std::string_view kIntegratorNames[] = {"path", "whitted", "sppm", "irradiance"};
inline constexpr std::string_view kTonemapNames[] = {"none", "filmic"};

struct Settings {
  int width = 1280, height = 720;
  uint32_t samples = 64;
  uint32_t seed = 0;
  uint32_t depth = 8;
  uint32_t photons = 200000; ///< of each pass, for integrators that send them out
  IntegratorKind integrator = IntegratorKind::Path;
  Tonemap tonemap = Tonemap::None;
  float exposure = 0; ///< stops
  float clamp = 0;    ///< 0: none
  double time = 0;    ///< seconds, the shaders' `time`
  int64_t frame = 0;
};

struct Scene {
  std::string file;
  std::vector<std::string> files; ///< all that it names: models, shaders, images
  Camera camera;
  std::vector<Object> objects;
  std::vector<Material> materials; ///< never empty: [0] is the default
  std::vector<Light> lights;
  Settings settings;
};

/// A scene, or why there is none; warnings in either case. Messages begin "FILE:LINE: ".
struct SceneReading {
  std::optional<Scene> scene;
  std::string error;
  std::vector<std::string> warnings;
};

/// World-space bounds of an object.
Box bounds_of(const Object& object);
Box bounds_of(const Scene& scene);

} // namespace moonshade::renderer
