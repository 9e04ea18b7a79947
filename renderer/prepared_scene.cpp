// Shaders first: their errors are the likeliest, and cheap to find.
#include "renderer/prepared_scene.h"

#include "renderer/scene/nearest_name.h"

#include <algorithm>
#include <chrono>

namespace moonshade::renderer {

static double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

static std::string unknown_material(const Scene& scene, const Overrides& overrides) {
  std::vector<std::string_view> names(scene.materials.size());
  std::transform(scene.materials.begin(), scene.materials.end(), names.begin(),
                 [](const Material& m) { return m.name.c_str(); });
  for (const Light& light : scene.lights)
    if (!light.shader.empty()) names.emplace_back(light.name);
  for (const auto& [name, parameters] : overrides) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    std::string message = "-D: the scene has no material '" + name + "'";
    return message.append(did_you_mean(name, names)).append(" (it has: ").append(join_names(names)).append(")");
  }
  return "";
}

/// Squares and products of what lies farther out leave the range of floats.
static std::string too_far_out(const Scene& scene) {
  for (const Object& object : scene.objects) {
    Box box = bounds_of(object);
    if (max_component(glm::max(glm::abs(box.low), glm::abs(box.high))) <= 1e15f) continue;
    return scene.file + ": the object '" + object.name + "' lies too far out; coordinates reach to 1e15";
  }
  return "";
}

/// Each has a grid of its own, of half a megabyte, filled by millions of points.
static std::string too_many_volumes(const Scene& scene, const MaterialSet& materials) {
  constexpr int64_t kMost = 1000;
  const auto is_volume = [&](const Object& object) { return materials[object.materials[0]].volume.has_value(); };
  if (std::ranges::count_if(scene.objects, is_volume) <= kMost) return "";
  return scene.file + ": more than " + std::to_string(kMost) + " objects are volumes";
}

static std::string load_environments(const Scene& scene, ShaderSource& shaders, const Overrides& overrides,
                                     std::vector<Environment>& environments, std::string& warnings) {
  for (const Light& light : scene.lights) {
    if (light.kind != LightKind::Environment) continue;
    auto found = overrides.find(light.name);
    static const std::map<std::string, std::string> none;
    environments.emplace_back();
    std::string error = Environment::load(light, scene, shaders, found == overrides.end() ? none : found->second,
                                          environments.back(), warnings);
    if (!error.empty()) return error;
  }
  return "";
}

Preparation prepare(Scene scene, ShaderSource& shaders, const Overrides& overrides) {
  Preparation result;
  result.error = unknown_material(scene, overrides);
  if (result.error.empty()) result.error = too_far_out(scene);
  if (!result.error.empty()) return result;
  auto prepared = std::make_unique<PreparedScene>();
  prepared->scene = std::move(scene);
  auto start = std::chrono::steady_clock::now();
  result.error = MaterialSet::build(prepared->scene, shaders, overrides, prepared->materials, result.warnings);
  if (result.error.empty()) result.error = too_many_volumes(prepared->scene, prepared->materials);
  std::vector<Environment> environments;
  if (result.error.empty())
    result.error = load_environments(prepared->scene, shaders, overrides, environments, result.warnings);
  prepared->compile_seconds = seconds_since(start);
  if (!result.error.empty()) return result;
  if (prepared->materials.any_emits())
    std::erase_if(prepared->scene.lights, [](const Light& light) { return light.by_default; });
  start = std::chrono::steady_clock::now();
  prepared->geometry = Geometry::build(prepared->scene, result.error, prepared->materials.passable(),
                                       prepared->materials.any_has_inside());
  prepared->geometry_seconds = seconds_since(start);
  if (!prepared->geometry) return result.machine_at_fault = true, std::move(result);
  prepared->volumes = std::make_unique<VolumeSet>(prepared->scene, *prepared->geometry, prepared->materials);
  prepared->lights = std::make_unique<LightSet>(
      prepared->scene, *prepared->geometry, *prepared->volumes,
      measure_emission(prepared->scene, *prepared->geometry, prepared->materials), std::move(environments));
  result.prepared = std::move(prepared);
  return result;
}

} // namespace moonshade::renderer
