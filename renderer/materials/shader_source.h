// Where materials get their shaders and images from: the runtime's compiler or its interpreter, or a test's own.
#pragma once

#include "renderer/scene/scene.h"
#include "runtime/shader.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace moonshade::renderer {

struct ShaderLoad {
  std::shared_ptr<const Shader> shader; ///< null where `error` is set
  std::string error;                    ///< diagnostics, or what is wrong with a parameter
  std::string warnings;
  /// Given names that are no parameters of this shader, each with a message for where no other shader of the material
  /// has it either.
  std::map<std::string, std::string> unknown = {};
  std::vector<std::string> files = {}; ///< that it was read from: its own, its modules' and its images
};

class ShaderSource {
public:
  virtual ~ShaderSource() = default;
  /// The shader in `file` with these parameters; `overrides` are texts of the command line and win.
  virtual ShaderLoad load(const std::string& file, const std::map<std::string, Constant>& parameters,
                          const std::map<std::string, std::string>& overrides) = 0;
  /// `raw`: its numbers are no colours.
  virtual OpenedImage open_image(const SlotImage& image, bool raw) {
    static_cast<void>(image), static_cast<void>(raw);
    return {nullptr, "there is nobody who opens it"};
  }
};

enum class Backend : uint8_t { Jit, Interp };

struct ShaderOptions {
  Backend backend = Backend::Jit;
  Precision precision = Precision::F32;
  unsigned width = 0; ///< 0: the best
  bool color_diagnostics = false;
  std::vector<std::string> folders = {}; ///< in which, and below, the shaders' images lie
  /// As in CompileOptions; none of them changes a pixel.
  bool bake = false;
  std::shared_ptr<ObjectCache> cache = {};
  std::shared_ptr<BackgroundCompiler> background = {};
};

/// By the runtime. Each file is read and checked once, and compiled once, or with `bake` once for each set of values.
std::unique_ptr<ShaderSource> runtime_shaders(const ShaderOptions& options);

} // namespace moonshade::renderer
