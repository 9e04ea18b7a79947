// The command line of moonrender.
#pragma once

#include "renderer/film/aov.h"
#include "renderer/materials/shader_source.h"
#include "renderer/prepared_scene.h"
#include "renderer/render.h"
#include "tools/moonrender/frames.h"

#include <optional>
#include <string>

namespace moonshade::moonrender {

struct Options {
  std::string scene, output, stats, preview;
  std::optional<std::string> tev; ///< HOST:PORT, or empty for the usual place
  std::optional<int> width, height;
  std::optional<uint32_t> samples, seed, depth;
  std::optional<renderer::IntegratorKind> integrator;
  std::optional<renderer::Tonemap> tonemap;
  std::optional<float> exposure, clamp;
  std::optional<Frames> frames;
  std::optional<double> checkpoint; ///< seconds between two of them
  bool resume = false;
  renderer::AovList aovs;
  renderer::RenderOptions render;
  renderer::ShaderOptions shaders;
  renderer::Overrides overrides;
};

struct ParsedOptions {
  std::optional<Options> options; ///< nothing: the program ends with `exit_code`
  int exit_code = 0;
};

/// Prints help, version, or what is wrong with the call.
ParsedOptions parse_options(int argc, char** argv);

/// The scene's settings with those of the command line in their place; a message where they do not go together.
std::string apply(const Options& options, renderer::Settings& settings);

} // namespace moonshade::moonrender
