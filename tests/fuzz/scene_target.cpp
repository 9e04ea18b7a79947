// The reader of Lua scenes: a scene whose parts refer to each other within bounds, or an error with a place.
#include "renderer/scene/lua_sandbox.h"
#include "renderer/scene/lua_scene.h"
#include "renderer/scene/scene_reference.h"
#include "tests/fuzz/target.h"

namespace moonshade::renderer {
namespace {

using fuzz::require;

/// Would this run for long? The reader's own limits suit people, not a fuzzer that runs it thousands of times a second.
bool is_short(std::string_view text) {
  SandboxLimits limits;
  limits.instructions = 20'000;
  limits.memory_bytes = size_t(8) << 20;
  limits.calls = 1000;
  const SandboxRun run = run_scene_file("fuzz.lua", text, scene_function_names(), {{"time", 0}, {"frame", 0}}, limits);
  return run.error.find("limit") == std::string::npos && run.error.find("memory") == std::string::npos &&
         run.error.find("too many") == std::string::npos;
}

void check_scene(const Scene& scene) {
  require(!scene.materials.empty(), "a scene without materials");
  for (const Object& object : scene.objects) {
    for (uint32_t material : object.materials)
      require(material < scene.materials.size(), "an object's material out of range");
    require(object.shape == Shape::Sphere || object.mesh, "an object without a mesh");
    for (int column = 0; column < 4; ++column)
      require(is_finite(Vec3(object.to_world[column])), "a transformation that is not finite");
  }
  require(is_finite(scene.camera.from) && is_finite(scene.camera.to) && is_finite(scene.camera.up),
          "a camera that is not finite");
  require(scene.settings.width > 0 && scene.settings.height > 0 && scene.settings.samples > 0, "an empty picture");
}

} // namespace
} // namespace moonshade::renderer

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  if (size > fuzz::kMaxInput || !renderer::is_short(fuzz::text_of(data, size))) return 0;
  const renderer::SceneReading reading =
      renderer::parse_lua_scene("fuzz.lua", fuzz::text_of(data, size), renderer::Folders());
  fuzz::require(reading.scene.has_value() == reading.error.empty(), "either a scene or an error");
  if (reading.scene)
    renderer::check_scene(*reading.scene);
  else
    fuzz::require(reading.error.starts_with("fuzz.lua:"), "an error without its place: " + reading.error);
  return 0;
}
