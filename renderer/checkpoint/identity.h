// What a picture is made of: scene, models, shaders, images, options and build. Two renders with the same identity give
// the same bits (the number of threads is no part of it); a checkpoint goes on only with its own.
#pragma once

#include "renderer/materials/shader_source.h"
#include "renderer/prepared_scene.h"
#include "renderer/render.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace moonshade::renderer {

/// The parts, each as a digest of its files, but for the options, which are text: "seed=0\n...".
struct Identity {
  std::map<std::string, std::string> parts;

  std::string digest() const;
  friend bool operator==(const Identity&, const Identity&) = default;
};

/// Passes everything on to another source, and remembers the files: shaders, their modules and images.
class RecordingShaders : public ShaderSource {
public:
  explicit RecordingShaders(ShaderSource& source) : source_(source) {}
  ShaderLoad load(const std::string& file, const std::map<std::string, Constant>& parameters,
                  const std::map<std::string, std::string>& overrides) override;
  OpenedImage open_image(const SlotImage& image, bool raw) override;
  const std::set<std::string>& files() const { return files_; }

private:
  ShaderSource& source_;
  std::set<std::string> files_;
};

/// `files`: those that shaders use, beside Scene::files.
Identity identify(const Scene& scene, const std::set<std::string>& files, const RenderOptions& options,
                  const ShaderOptions& shaders, const Overrides& overrides);

/// The program, the libraries that it has loaded, and the processor (Embree takes other ways on another).
std::string build_identity();

/// How two identities differ, for a message: "the options (seed=0, now seed=5) and the shaders differ"; empty where
/// they do not.
std::string difference(const Identity& then, const Identity& now);

} // namespace moonshade::renderer
