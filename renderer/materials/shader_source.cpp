// Files to shaders through the runtime's front end.
#include "renderer/materials/shader_source.h"

#include "renderer/materials/material_set.h"
#include "renderer/scene/folders.h"
#include "renderer/scene/nearest_name.h"
#include "runtime/frontend.h"
#include "runtime/images/file_images.h"
#include "runtime/interpret.h"

#include <filesystem>
#include <sstream>
#include <utility>

namespace moonshade::renderer {

namespace {

struct ShaderFile {
  std::unique_ptr<CheckedShader> checked;
  /// By the values that are baked into it; without them there is one.
  std::map<std::map<std::string, Constant>, std::shared_ptr<const Program>> programs;
  std::string error, warnings;
};

class RuntimeShaders : public ShaderSource {
public:
  explicit RuntimeShaders(const ShaderOptions& options) : options_(options), store_(allowed(options.folders)) {
    images_ = [this](const std::string& file, const std::string& from, bool raw) {
      OpenedImage opened = store_.open(file, from, raw);
      if (opened.image != nullptr) images_opened_.push_back(opened.path);
      return opened;
    };
  }

  ShaderLoad load(const std::string& file, const std::map<std::string, Constant>& parameters,
                  const std::map<std::string, std::string>& overrides) override;
  OpenedImage open_image(const SlotImage& image, bool raw) override {
    return image.bytes ? store_.decode(image.bytes, raw) : store_.open(image.file, "", raw);
  }

private:
  static AllowedFolders allowed(const std::vector<std::string>& names) {
    AllowedFolders folders;
    for (const std::string& folder : names)
      folders.allow(folder);
    return folders;
  }
  ShaderFile& open(const std::string& file);
  std::shared_ptr<const Program> program(ShaderFile& shader, const std::map<std::string, Constant>& baked);

  ShaderOptions options_;
  ImageStore store_;
  ImageOpener images_;                     ///< of shaders
  std::vector<std::string> images_opened_; ///< by the shader that is being loaded
  std::map<std::string, ShaderFile> files_;
};

ShaderFile& RuntimeShaders::open(const std::string& file) {
  auto [found, is_new] = files_.try_emplace(file);
  ShaderFile& shader = found->second;
  if (!is_new) return shader;
  FileText text = read_file(file, uint64_t(64) << 20);
  if (!text.error.empty()) return shader.error = text.error, shader;
  shader.checked =
      std::make_unique<CheckedShader>(file, text.text, std::vector<std::string>{},
                                      folder_modules({std::filesystem::path(file).parent_path().string()}));
  std::ostringstream messages;
  print_text(shader.checked->diagnostics(), shader.checked->sources(), messages, options_.color_diagnostics);
  if (!shader.checked->ok()) return shader.error = messages.str(), shader;
  shader.warnings = messages.str();
  if (options_.backend == Backend::Jit && !options_.bake) program(shader, {});
  return shader;
}

/// Null with the shader's error set, where it cannot be compiled.
std::shared_ptr<const Program> RuntimeShaders::program(ShaderFile& shader,
                                                       const std::map<std::string, Constant>& baked) {
  const auto [found, is_new] = shader.programs.try_emplace(baked);
  if (!is_new) return found->second;
  CompileOptions compile_options;
  compile_options.precision = options_.precision;
  compile_options.width = options_.width;
  compile_options.uniform_inputs = {"time", "frame"};
  compile_options.color_diagnostics = options_.color_diagnostics;
  compile_options.gradients = {height_gradient()};
  compile_options.images = images_;
  compile_options.bake = options_.bake;
  compile_options.baked = baked;
  compile_options.cache = options_.cache;
  compile_options.background = options_.background;
  Compilation compiled = compile(*shader.checked, compile_options);
  const std::string file(shader.checked->sources().name(FileId{0}));
  if (!compiled.program) shader.error = compiled.diagnostics.empty() ? file + ": not compiled" : compiled.diagnostics;
  return found->second = compiled.program;
}

/// Every given parameter as a value of its type, or an error that names it; those that the shader lacks go to
/// `strange`.
std::string merge(const ShaderInfo& info, const std::map<std::string, Constant>& parameters,
                  const std::map<std::string, std::string>& overrides, std::map<std::string, Constant>& merged,
                  std::map<std::string, std::string>& strange) {
  std::vector<std::string_view> names;
  names.reserve(info.parameters.size());
  for (const ParameterInfo& p : info.parameters)
    names.push_back(p.name);
  auto find = [&](const std::string& name) -> const ParameterInfo* {
    for (const ParameterInfo& p : info.parameters)
      if (p.name == name) return &p;
    return nullptr;
  };
  auto unknown = [&](const std::string& name) {
    return "the shader has no parameter '" + name + "'" + did_you_mean(name, names) +
           (names.empty() ? "" : " (it has: " + join_names(names) + ")");
  };
  for (const auto& [name, value] : parameters) {
    const ParameterInfo* parameter = find(name);
    if (!parameter) {
      strange[name] = unknown(name);
      continue;
    }
    CheckedConstant checked = check_override(*parameter, value);
    if (!checked.error.empty()) return checked.error;
    merged[name] = checked.value;
  }
  for (const auto& [name, text] : overrides) {
    const ParameterInfo* parameter = find(name);
    if (!parameter) {
      strange[name] = unknown(name);
      continue;
    }
    CheckedConstant checked = parse_override(*parameter, text);
    if (!checked.error.empty()) return checked.error;
    merged[name] = checked.value;
  }
  return "";
}

ShaderLoad RuntimeShaders::load(const std::string& file, const std::map<std::string, Constant>& parameters,
                                const std::map<std::string, std::string>& overrides) {
  ShaderFile& shader = open(file);
  ShaderLoad load;
  if (!shader.error.empty()) return load.error = shader.error, load;
  load.warnings = std::exchange(shader.warnings, "");
  load.files = shader.checked->files();
  std::map<std::string, Constant> merged;
  load.error = merge(shader.checked->info(), parameters, overrides, merged, load.unknown);
  if (!load.error.empty()) return load.error = file + ": " + load.error, load;
  // Steps are counted exactly where the shader is compiled; the interpreter's guard against endless loops is enough
  // here.
  Instantiation instance;
  if (options_.backend == Backend::Interp)
    instance = interpret(*shader.checked, merged, {.count_steps = false, .impatient = true, .images = images_});
  else if (const auto compiled = program(shader, options_.bake ? merged : std::map<std::string, Constant>{}))
    instance = compiled->instantiate(options_.bake ? std::map<std::string, Constant>{} : merged);
  else
    return load.error = shader.error, load;
  load.shader = instance.shader;
  load.files.insert(load.files.end(), images_opened_.begin(), images_opened_.end());
  images_opened_.clear();
  if (!load.shader) load.error = file + ": " + instance.error;
  return load;
}

} // namespace

std::unique_ptr<ShaderSource> runtime_shaders(const ShaderOptions& options) {
  return std::make_unique<RuntimeShaders>(options);
}

} // namespace moonshade::renderer
