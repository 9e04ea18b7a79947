// Files count by what they hold, in order of their names.
#include "renderer/checkpoint/identity.h"

#include "renderer/checkpoint/sha256.h"
#include "renderer/scene/folders.h"

#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <link.h>
#include <sstream>

namespace moonshade::renderer {

namespace fs = std::filesystem;

ShaderLoad RecordingShaders::load(const std::string& file, const std::map<std::string, Constant>& parameters,
                                  const std::map<std::string, std::string>& overrides) {
  ShaderLoad load = source_.load(file, parameters, overrides);
  files_.insert(file);
  if (!load.shader) return load;
  files_.insert(load.files.begin(), load.files.end());
  return load;
}

OpenedImage RecordingShaders::open_image(const SlotImage& image, bool raw) {
  OpenedImage opened = source_.open_image(image, raw);
  if (!opened.path.empty()) files_.insert(opened.path);
  return opened;
}

namespace {

/// Which part a file belongs to, by its ending.
const char* part_of(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  for (char& c : ending)
    c = char(std::tolower((unsigned char)c));
  if (ending == ".lua") return "shaders";
  for (const char* model : {".obj", ".mtl", ".ply", ".gltf", ".glb", ".bin"})
    if (ending == model) return "models";
  return "images";
}

/// A file that cannot be read any more counts as empty: whoever needs it says so.
void add_file(Sha256& hash, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(size_t(1) << 20);
  uint64_t size = 0;
  while (file.read(block.data(), std::streamsize(block.size())), file.gcount() > 0) {
    hash.add(block.data(), size_t(file.gcount()));
    size += uint64_t(file.gcount());
  }
  hash.add(&size, sizeof size); // where one file ends and the next begins
}

/// Digits that give the very number back.
std::string exact(double value) {
  char text[40];
  auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return std::string(text, end);
}

std::string options_text(const Settings& s, const RenderOptions& options, const ShaderOptions& shaders,
                         const Overrides& overrides) {
  // All of them by name: a setting that is added does not compile here until it is part of the digest.
  const auto& [width, height, samples, seed, depth, photons, integrator, tonemap, exposure, clamp, time, frame] = s;
  (void)tonemap, (void)exposure; // concern the encoding alone
  std::ostringstream text;
  text << "size=" << width << "x" << height << "\n";
  if (const auto& crop = options.crop)
    text << "crop=" << crop->x << "," << crop->y << "," << crop->width << "," << crop->height << "\n";
  text << "spp=" << samples << "\nseed=" << seed << "\ndepth=" << depth << "\nphotons=" << photons << "\n";
  text << "integrator=" << kIntegratorNames[size_t(integrator)] << "\nclamp=" << exact(double(clamp)) << "\n";
  text << "time=" << exact(time) << "\nframe=" << frame << "\nnoise=" << exact(options.noise) << "\n";
  text << "squares=" << options.contents.squares << "\nfirst=" << options.contents.first << "\n";
  text << "backend=" << int(shaders.backend) << "\nprecision=" << int(shaders.precision) << "\nwidth=" << shaders.width
       << "\n";
  for (const auto& [material, values] : overrides)
    for (const auto& [name, value] : values)
      text << "-D " << material << "." << name << "=" << value << "\n";
  return text.str();
}

int add_build_id(dl_phdr_info* object, size_t, void* user) {
  auto& hash = *static_cast<Sha256*>(user);
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const auto& header = object->dlpi_phdr[k];
    if (header.p_type != PT_NOTE) continue;
    // Notes hold the linker's build id, and nothing that differs from run to run.
    const char* base = nullptr;
    std::memcpy(&base, &object->dlpi_addr, sizeof base);
    hash.add(base + header.p_vaddr, header.p_filesz);
  }
  return 0;
}

/// Lines of one text that the other lacks.
std::string lines_without(const std::string& text, const std::string& other) {
  std::string found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (("\n" + other).find("\n" + line + "\n") == std::string::npos) found += (found.empty() ? "" : ", ") + line;
  return found;
}

} // namespace

std::string Identity::digest() const {
  Sha256 hash;
  for (const auto& [name, value] : parts)
    hash.add(name), hash.add("\n"), hash.add(value), hash.add("\n");
  return hash.finish();
}

std::string build_identity() {
  Sha256 hash;
  hash.add(version());
  dl_iterate_phdr(add_build_id, &hash);
  std::ifstream processor("/proc/cpuinfo");
  for (std::string line; std::getline(processor, line) && !line.empty();)
    if (line.starts_with("model name") || line.starts_with("flags") || line.starts_with("Features")) hash.add(line);
  return hash.finish();
}

Identity identify(const Scene& scene, const std::set<std::string>& files, const RenderOptions& options,
                  const ShaderOptions& shaders, const Overrides& overrides) {
  Identity identity;
  std::map<std::string, Sha256> parts;
  for (const char* name : {"scene", "models", "shaders", "images"})
    parts[name];
  add_file(parts["scene"], scene.file);
  std::set<std::string> all = files;
  all.insert(scene.files.begin(), scene.files.end());
  all.erase(scene.file);
  for (const std::string& file : all)
    add_file(parts[part_of(file)], file);
  for (auto& [name, hash] : parts)
    identity.parts[name] = hash.finish();
  identity.parts["options"] = options_text(scene.settings, options, shaders, overrides);
  identity.parts["build"] = build_identity();
  return identity;
}

std::string difference(const Identity& then, const Identity& now) {
  std::vector<std::string> names;
  for (const auto& [name, value] : now.parts) {
    auto found = then.parts.find(name);
    if (found != then.parts.end() && found->second == value) continue;
    std::string text = "the " + name;
    if (name == "options" && found != then.parts.end()) {
      std::string before = lines_without(found->second, value), after = lines_without(value, found->second);
      text += " (" + (before.empty() ? "" : "then " + before) + (before.empty() || after.empty() ? "" : "; ") +
              (after.empty() ? "" : "now " + after) + ")";
    }
    names.push_back(text);
  }
  std::string text;
  for (size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

} // namespace moonshade::renderer
