// A scene made ready: rays can meet it, its shaders are compiled, its lights can be sampled.
#pragma once

#include "renderer/geometry/geometry.h"
#include "renderer/lights/light_set.h"
#include "renderer/materials/material_set.h"
#include "renderer/scene/scene.h"
#include "renderer/volumes/volume_set.h"

#include <map>
#include <memory>
#include <string>

namespace moonshade::renderer {

struct PreparedScene {
  Scene scene;
  std::unique_ptr<Geometry> geometry;
  MaterialSet materials;
  std::unique_ptr<LightSet> lights;
  std::unique_ptr<VolumeSet> volumes;
  double compile_seconds = 0;  ///< reading, checking and compiling shaders
  double geometry_seconds = 0; ///< building Embree's hierarchy
};

struct Preparation {
  std::unique_ptr<PreparedScene> prepared; ///< null where `error` is set
  std::string error;
  std::string warnings;
  bool machine_at_fault = false; ///< no memory, say
};

/// Parameters of the command line: material, then parameter, then text.
using Overrides = std::map<std::string, std::map<std::string, std::string>>;

Preparation prepare(Scene scene, ShaderSource& shaders, const Overrides& overrides = {});

} // namespace moonshade::renderer
