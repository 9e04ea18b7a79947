// Chooses the reader by the file's ending, and supplies what a bare model lacks.
#include "renderer/scene/read_scene.h"

#include "renderer/scene/folders.h"
#include "renderer/scene/gltf_reader.h"
#include "renderer/scene/lua_scene.h"
#include "renderer/scene/obj_reader.h"
#include "renderer/scene/ply_reader.h"

#include <filesystem>

namespace moonshade::renderer {

Camera framing_camera(const Box& box) {
  constexpr float kMargin = 1.12f, kAspect = 1.2f; // pictures are usually wider than this
  Camera camera;
  float radius = std::max(box.radius(), 1e-6f);
  camera.to = box.center();
  Vec3 back = glm::normalize(Vec3(0.45f, 0.35f, 1.0f));
  Vec3 right = glm::normalize(glm::cross(camera.up, back)), up = glm::cross(back, right);
  float slope = std::tan(0.5f * camera.fov * kPi / 180);
  float distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
           corner & 4 ? box.high.z : box.low.z);
    p -= camera.to;
    float reach = std::max(std::abs(glm::dot(p, up)), std::abs(glm::dot(p, right)) / kAspect);
    distance = std::max(distance, glm::dot(p, back) + kMargin * reach / slope);
  }
  camera.from = camera.to + back * std::max(distance, 1.01f * radius);
  return camera;
}

void add_daylight(Scene& scene) {
  Light sky;
  sky.by_default = true;
  sky.kind = LightKind::Sky;
  sky.zenith = Vec3(0.14f, 0.25f, 0.50f);
  sky.horizon = Vec3(0.45f, 0.52f, 0.62f);
  sky.ground = Vec3(0.13f, 0.12f, 0.11f);
  scene.lights.push_back(sky);
  Light sun;
  sun.by_default = true;
  sun.kind = LightKind::Sun;
  sun.direction = glm::normalize(Vec3(-0.55f, 0.75f, 0.6f));
  sun.color = Vec3(2.1f, 1.95f, 1.7f);
  scene.lights.push_back(sun);
}

static SceneReading scene_of_model(const std::string& path, Model model) {
  SceneReading reading;
  reading.warnings = std::move(model.warnings);
  reading.error = std::move(model.error);
  if (!reading.error.empty()) return reading;
  Scene scene;
  scene.file = path;
  scene.materials = std::move(model.materials);
  scene.objects = std::move(model.objects);
  Box bounds = bounds_of(scene);
  if (bounds.radius() < 1e-6f) {
    reading.error = path + ": the model is smaller than a millionth; place it in a scene with a 'scale'";
    return reading;
  }
  scene.camera = framing_camera(bounds);
  add_daylight(scene);
  reading.scene = std::move(scene);
  return reading;
}

static SceneReading read_any(const std::string& path, const Animation& animation, const Folders& folders) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    c = char(std::tolower((unsigned char)c));
  if (ending == ".obj") return scene_of_model(path, model_of_obj(path, folders));
  if (ending == ".ply") return scene_of_model(path, read_ply(path));
  if (ending == ".gltf" || ending == ".glb") return scene_of_model(path, read_gltf(path, folders));
  if (ending != ".lua")
    return {std::nullopt, path + ": neither a Lua scene (.lua) nor a model (.obj, .ply, .gltf, .glb)", {}};
  FileText file = read_file(path, uint64_t(64) << 20);
  if (!file.error.empty()) return {std::nullopt, file.error, {}};
  return parse_lua_scene(path, file.text, folders, animation);
}

SceneReading read_scene(const std::string& path, const Animation& animation) {
  Folders folders;
  folders.allow_folder_of(path);
  SceneReading reading = read_any(path, animation, folders);
  if (!reading.scene) return reading;
  reading.scene->files.assign(folders.used().begin(), folders.used().end());
  if (!animation.frame) return reading;
  reading.scene->settings.frame = *animation.frame;
  reading.scene->settings.time = animation.time;
  return reading;
}

} // namespace moonshade::renderer
