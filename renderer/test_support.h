// For the renderer's tests: folders that vanish, scenes from a string, and shaders written in C++.
#pragma once

#include "renderer/materials/shader_source.h"
#include "renderer/prepared_scene.h"
#include "renderer/render.h"
#include "renderer/scene/folders.h"
#include "renderer/scene/lua_scene.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

namespace moonshade::renderer::testing {

/// A folder with some files, deleted at the end of the test.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "moonshade-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, error);
    std::filesystem::remove_all(path_, error);
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::path file = std::filesystem::path(path_) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  Folders folders() const {
    Folders folders;
    folders.allow_folder_of(path_ + "/x");
    return folders;
  }

private:
  std::string path_;
};

/// As data URIs have it.
inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t k = 0; k < bytes.size(); k += 3) {
    uint32_t group = 0;
    for (size_t i = 0; i < 3; ++i)
      group = group << 8 | (k + i < bytes.size() ? uint8_t(bytes[k + i]) : 0);
    for (size_t i = 0; i < 4; ++i)
      text += k + i > bytes.size() ? '=' : digits[group >> (18 - 6 * i) & 63];
  }
  return text;
}

/// A shader whose entries are C++ functions from the inputs' components to the results', in double.
class CppShader : public Shader {
public:
  using Function = std::function<FaultCode(const double* inputs, double* results)>;
  CppShader& add(const std::string& entry, std::vector<InputInfo> inputs, ValueType result, Function function) {
    info_.entries.push_back({entry, std::move(inputs), {result}});
    functions_.push_back(std::move(function));
    return *this;
  }
  const ShaderInfo& info() const override { return info_; }
  Precision precision() const override { return precision_; }
  unsigned width() const override { return 1; }
  FaultSite fault_site(uint32_t site) const override { return {"fake.lua", site, 1, ""}; }

  void run(size_t entry, const Batch& batch) const override {
    unsigned results = component_count(info_.entries[entry].results[0]);
    for (uint64_t k = 0; k < batch.count; ++k) {
      double in[40], out[4] = {};
      size_t at = 0;
      for (const InputInfo& input : info_.entries[entry].inputs)
        for (unsigned c = 0; c < component_count(input.type); ++c, ++at)
          in[at] = read(batch.inputs[at], input.type, k);
      FaultCode code = functions_[entry](in, out);
      for (unsigned c = 0; c < results; ++c)
        write(batch.outputs[c], k, code == FaultCode::None ? out[c] : 0);
      if (code == FaultCode::None) continue;
      batch.fault_codes[k] = uint8_t(code);
      if (batch.faults->count++ == 0)
        batch.faults->first_point = k, batch.faults->first_code = code, batch.faults->first_site = 7;
    }
  }
  Precision precision_ = Precision::F32;

private:
  double read(const void* array, ValueType type, uint64_t k) const {
    if (type == ValueType::Integer) return double(static_cast<const int64_t*>(array)[k]);
    if (type == ValueType::Boolean) return static_cast<const uint8_t*>(array)[k];
    return precision_ == Precision::F32 ? double(static_cast<const float*>(array)[k])
                                        : static_cast<const double*>(array)[k];
  }
  void write(void* array, uint64_t k, double value) const {
    if (precision_ == Precision::F32)
      static_cast<float*>(array)[k] = float(value);
    else
      static_cast<double*>(array)[k] = value;
  }
  ShaderInfo info_;
  std::vector<Function> functions_;
};

/// Gives the same shader for every file.
class FixedShaders : public ShaderSource {
public:
  explicit FixedShaders(std::shared_ptr<const Shader> shader = nullptr) : shader_(std::move(shader)) {}
  ShaderLoad load(const std::string& file, const std::map<std::string, Constant>&,
                  const std::map<std::string, std::string>&) override {
    if (!shader_) return {nullptr, file + ":1:1: error: broken", ""};
    return {shader_, "", ""};
  }

private:
  std::shared_ptr<const Shader> shader_;
};

/// Renders a Lua scene given as text, in a folder where the file `fake.lua` exists.
struct Rendering {
  RenderResult result;
  std::string error;
};
inline Rendering render_text(const std::string& text, std::shared_ptr<const Shader> shader = nullptr,
                             const RenderOptions& options = {}) {
  TemporaryFolder folder;
  folder.write("fake.lua", "-- a shader in C++ stands in\nfunction color(p) end\n");
  Folders folders = folder.folders();
  SceneReading reading = parse_lua_scene(folder / "scene.lua", text, folders);
  if (!reading.scene) return {{}, reading.error};
  FixedShaders shaders(std::move(shader));
  Preparation preparation = prepare(std::move(*reading.scene), shaders);
  if (!preparation.prepared) return {{}, preparation.error};
  RenderProgress progress;
  return {render(*preparation.prepared, options, progress), ""};
}

} // namespace moonshade::renderer::testing
