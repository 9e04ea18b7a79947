// Loading: which file gives which slot. Evaluation: slots by constant or by call, kept in range.
#include "renderer/materials/material_set.h"

#include "renderer/materials/image_shader.h"
#include "renderer/scene/folders.h"

#include <algorithm>
#include <set>

namespace moonshade::renderer {

namespace {

/// Everything needed to load one material's shaders.
void keep_in_range(Slot slot, float* values, size_t count) {
  float low = slot == Slot::Ior ? 1.0f : 0.0f;
  float high = slot == Slot::Emission ? std::numeric_limits<float>::max() : slot == Slot::Ior ? 100.0f : 1.0f;
  for (size_t k = 0; k < count; ++k)
    values[k] = std::min(std::max(values[k], low), high);
}

class MaterialLoader {
public:
  MaterialLoader(const Material& material, ShaderSource& source, const std::map<std::string, std::string>& overrides)
      : material_(material), source_(source), overrides_(overrides) {}

  std::string load(CompiledMaterial& compiled, std::string& warnings);
  bool uses_shaders() const { return !loaded_.empty(); }

private:
  std::string shader_of(const std::string& file, std::shared_ptr<const Shader>& shader, std::string& warnings);
  void note_unknown(const std::string& file, const std::map<std::string, std::string>& unknown);
  std::string from_whole_file(CompiledMaterial& compiled, std::string& warnings);
  std::string slot(CompiledMaterial& compiled, Slot slot, const std::string& file, std::string& warnings);
  std::string height(CompiledMaterial& compiled, const std::string& file, std::string& warnings);
  OpenedImage open(const SlotImage& image, bool raw, std::string& warnings);
  std::string image(CompiledMaterial& compiled, Slot slot, std::string& warnings);
  std::string bump_image(CompiledMaterial& compiled, std::string& warnings);
  std::string volume(CompiledMaterial& compiled, std::string& warnings);
  std::string volume_entry(const std::string& file, const char* name, unsigned components, bool required,
                           std::optional<EntryCall>& call, std::string& warnings);

  const Material& material_;
  ShaderSource& source_;
  const std::map<std::string, std::string>& overrides_;
  std::map<std::string, std::shared_ptr<const Shader>> loaded_;
  std::map<std::string, std::string> unknown_; ///< parameters that none of the shaders has so far, each with a message
};

/// One of the material's shaders is enough to know a parameter.
void MaterialLoader::note_unknown(const std::string& file, const std::map<std::string, std::string>& unknown) {
  if (loaded_.size() == 1)
    for (const auto& [name, message] : unknown)
      unknown_[name] = file + ": " + message;
  std::erase_if(unknown_, [&](const auto& known) { return !unknown.contains(known.first); });
}

std::string MaterialLoader::shader_of(const std::string& file, std::shared_ptr<const Shader>& shader,
                                      std::string& warnings) {
  auto& known = loaded_[file];
  if (!known) {
    ShaderLoad load = source_.load(file, material_.parameters, overrides_);
    warnings += load.warnings;
    if (!load.shader) return load.error;
    known = load.shader;
    note_unknown(file, load.unknown);
  }
  shader = known;
  return "";
}

std::string MaterialLoader::slot(CompiledMaterial& compiled, Slot slot, const std::string& file,
                                 std::string& warnings) {
  const SlotInfo& info = slot_infos()[size_t(slot)];
  std::shared_ptr<const Shader> shader;
  std::string error = shader_of(file, shader, warnings);
  return error.empty() ? EntryCall::bind(shader, file, info.name, info.components, compiled.calls[size_t(slot)])
                       : error;
}

/// An image that cannot be read is no error: models travel without theirs.
OpenedImage MaterialLoader::open(const SlotImage& image, bool raw, std::string& warnings) {
  OpenedImage opened = source_.open_image(image, raw);
  if (opened.image) return opened;
  const std::string warning = image.place + ": warning: the image '" + image.name + "' is not shown: ";
  if (warnings.find(warning) == std::string::npos) warnings += warning + opened.error + "\n";
  return opened;
}

std::string MaterialLoader::image(CompiledMaterial& compiled, Slot slot, std::string& warnings) {
  const SlotImage& image = *material_.images[size_t(slot)];
  const SlotInfo& info = slot_infos()[size_t(slot)];
  const bool raw = info.components == 1 && image.part != SlotImage::Part::Alpha; // alpha is never decoded
  OpenedImage opened = open(image, raw, warnings);
  if (!opened.image) {
    if (slot == Slot::Emission) compiled.constants[size_t(slot)] = Vec3(0); // what glows in spots glows nowhere then
    return "";
  }
  return EntryCall::bind(image_shader(slot, image, std::move(opened.image)), image.name, info.name, info.components,
                         compiled.calls[size_t(slot)]);
}

/// The gradient of a height, where the shader has it: only compiled ones do.
std::string bind_gradient(CompiledMaterial& compiled, const std::shared_ptr<const Shader>& shader,
                          const std::string& file) {
  const std::vector<EntryInfo>& entries = shader->info().entries;
  auto found = std::find_if(entries.begin(), entries.end(),
                            [name = gradient_name(height_gradient())](const EntryInfo& e) { return e.name == name; });
  if (found == entries.end()) return "";
  std::optional<EntryCall> call;
  if (std::string error = EntryCall::bind_all(shader, file, size_t(found - entries.begin()), call); !error.empty())
    return error;
  HeightGradient gradient{std::move(*call)};
  unsigned at = 1;
  for (const std::string& name : height_gradient().inputs) {
    auto input = std::find_if(found->inputs.begin(), found->inputs.end(),
                              [&](const InputInfo& candidate) { return candidate.name == name; });
    if (input == found->inputs.end()) continue;
    (name == "p" ? gradient.by_local : name == "P" ? gradient.by_world : gradient.by_uv) = at;
    at += component_count(input->type);
  }
  compiled.gradient = std::move(gradient);
  return "";
}

std::string MaterialLoader::height(CompiledMaterial& compiled, const std::string& file, std::string& warnings) {
  std::shared_ptr<const Shader> shader;
  std::string error = shader_of(file, shader, warnings);
  if (error.empty()) error = EntryCall::bind(shader, file, "height", 1, compiled.height);
  return error.empty() && compiled.bump == BumpMode::Gradient ? bind_gradient(compiled, shader, file) : error;
}

std::string MaterialLoader::bump_image(CompiledMaterial& compiled, std::string& warnings) {
  const BumpImage& bump = *material_.bump_image;
  OpenedImage opened = open(bump.image, true, warnings);
  if (!opened.image) return "";
  std::string error = bind_gradient(compiled, bump_image_shader(bump, std::move(opened.image)), bump.image.name);
  if (error.empty()) compiled.gradient->unit_tangents = true;
  return error;
}

/// Every entry that the material's own file has and the material does not set.
std::string MaterialLoader::from_whole_file(CompiledMaterial& compiled, std::string& warnings) {
  std::shared_ptr<const Shader> shader;
  if (std::string error = shader_of(material_.shader, shader, warnings); !error.empty()) return error;
  bool any = false;
  for (const EntryInfo& entry : shader->info().entries) {
    any |= entry.name == "density" || entry.name == "anisotropy";
    for (size_t s = 0; s < kSlotCount; ++s) {
      if (entry.name != slot_infos()[s].name) continue;
      any = true;
      if (material_.values[s] || material_.images[s] || !material_.shaders[s].empty()) continue;
      if (std::string error = slot(compiled, Slot(s), material_.shader, warnings); !error.empty()) return error;
    }
    if (entry.name != "height") continue;
    any = true;
    if (!material_.height_shader.empty()) continue;
    if (std::string error = height(compiled, material_.shader, warnings); !error.empty()) return error;
  }
  return any ? ""
             : material_.shader + ": has none of the functions that a material uses (color, height, reflectance, ...)";
}

/// An entry evaluated within a volume, where there is no surface.
std::string MaterialLoader::volume_entry(const std::string& file, const char* name, unsigned components, bool required,
                                         std::optional<EntryCall>& call, std::string& warnings) {
  if (file.empty()) return "";
  std::shared_ptr<const Shader> shader;
  if (std::string error = shader_of(file, shader, warnings); !error.empty()) return error;
  const std::vector<EntryInfo>& entries = shader->info().entries;
  auto found = std::find_if(entries.begin(), entries.end(), [&](const EntryInfo& e) { return e.name == name; });
  if (found == entries.end() && !required) return "";
  if (std::string error = EntryCall::bind(shader, file, name, components, call); !error.empty()) return error;
  constexpr uint32_t kKnown = 7u << kLocal | 7u << kWorld | 7u << kIncident | 1u << kFootprint | 1u << kTime;
  bool backface = std::any_of(found->inputs.begin(), found->inputs.end(),
                              [](const InputInfo& input) { return input.name == "backface"; });
  if (!(call->needs() & ~kKnown) && !backface) return "";
  return file + ": '" + name +
         "' has an input that points of a volume do not have (they have: p, P, i, time, frame, id, fw)";
}

/// Nothing where the material has no density.
std::string MaterialLoader::volume(CompiledMaterial& compiled, std::string& warnings) {
  VolumeCalls volume;
  const std::string& file = material_.density_shader.empty() ? material_.shader : material_.density_shader;
  std::string error;
  if (!material_.density)
    error = volume_entry(file, "density", 1, !material_.density_shader.empty(), volume.density, warnings);
  if (!error.empty() || (!volume.density && !material_.density)) return error;
  volume.density_constant = material_.density.value_or(0.0f);
  volume.anisotropy_constant = material_.anisotropy;
  auto slot_of = [&](Slot slot, std::optional<EntryCall>& call, Vec3& constant) {
    size_t s = size_t(slot);
    constant = material_.values[s].value_or(slot_infos()[s].default_value);
    if (material_.values[s]) return std::string();
    const std::string& own = material_.shaders[s];
    return volume_entry(own.empty() ? material_.shader : own, slot_infos()[s].name, 3, !own.empty(), call, warnings);
  };
  error = slot_of(Slot::Color, volume.color, volume.color_constant);
  if (error.empty()) error = slot_of(Slot::Emission, volume.emission, volume.emission_constant);
  if (error.empty()) error = volume_entry(material_.shader, "anisotropy", 1, false, volume.anisotropy, warnings);
  compiled.volume = std::move(volume);
  return error;
}

std::string MaterialLoader::load(CompiledMaterial& compiled, std::string& warnings) {
  compiled.bump = material_.bump;
  compiled.emits_outward_only = material_.emits_outward_only;
  compiled.thin = material_.thin;
  compiled.absorption = material_.absorption;
  compiled.average_emission = material_.average_emission;
  if (std::string error = volume(compiled, warnings); !error.empty() || compiled.volume)
    return error.empty() && !unknown_.empty() ? unknown_.begin()->second : error;
  for (size_t s = 0; s < kSlotCount; ++s) {
    compiled.constants[s] = material_.values[s].value_or(slot_infos()[s].default_value);
    if (material_.images[s] && material_.shaders[s].empty())
      if (std::string error = image(compiled, Slot(s), warnings); !error.empty()) return error;
    if (material_.shaders[s].empty()) continue;
    if (std::string error = slot(compiled, Slot(s), material_.shaders[s], warnings); !error.empty()) return error;
  }
  if (!material_.height_shader.empty())
    if (std::string error = height(compiled, material_.height_shader, warnings); !error.empty()) return error;
  if (!material_.shader.empty())
    if (std::string error = from_whole_file(compiled, warnings); !error.empty()) return error;
  if (material_.bump_image && !compiled.height)
    if (std::string error = bump_image(compiled, warnings); !error.empty()) return error;
  for (const auto& call : compiled.calls)
    if (call) compiled.needs |= call->needs();
  if (compiled.height) compiled.needs |= compiled.height->needs();
  if (compiled.gradient) compiled.needs |= compiled.gradient->call.needs();
  if (compiled.gradient && compiled.gradient->by_uv) compiled.needs |= channel_mask(kDpdu, 6);
  for (size_t s = 0; s < kSlotCount; ++s)
    for (int c = 0; c < 3; ++c)
      keep_in_range(Slot(s), &compiled.constants[s][c], 1);
  return unknown_.empty() ? "" : unknown_.begin()->second;
}

/// The line of `function NAME` in a shader's file, for results that are not finite (which have no place of their own).
uint32_t line_of_function(const std::string& file, const std::string& name) {
  FileText text = read_file(file);
  size_t at = text.text.find("function " + name);
  return at == std::string::npos ? 0 : 1 + uint32_t(std::count(text.text.begin(), text.text.begin() + long(at), '\n'));
}

} // namespace

void note_faults(const EntryCall& call, const uint8_t* codes, size_t count, const FaultReport& report,
                 FaultLog& faults) {
  // A gradient is its function's.
  std::string entry = call.shader().info().entries[call.entry()].name;
  entry.resize(std::min(entry.size(), entry.find('\'')));
  if (report.count) {
    FaultSite site = call.shader().fault_site(report.first_site);
    std::string file = site.file.empty() ? call.file() : site.file;
    faults[{file, entry, uint8_t(report.first_code), site.line, site.message}] += report.count;
  }
  uint64_t not_finite = uint64_t(std::count(codes, codes + count, kNotFinite));
  if (not_finite == 0) return;
  auto same = std::find_if(faults.begin(), faults.end(), [&](const auto& f) {
    return f.first.code == kNotFinite && f.first.file == call.file() && f.first.entry == entry;
  });
  if (same != faults.end())
    same->second += not_finite;
  else
    faults[{call.file(), entry, kNotFinite, line_of_function(call.file(), entry), ""}] += not_finite;
}

namespace {

/// One slot of a run of points by its shader.
void run_slot(const EntryCall& call, ShadingBatch& batch, size_t begin, size_t count, const EntryCall::Inputs& inputs,
              float* const* out, FaultLog& faults) {
  uint8_t* codes = batch.scratch_codes.data();
  std::fill_n(codes, count, uint8_t(0));
  FaultReport report;
  call.run(batch, begin, count, inputs, out, codes, report);
  if (std::all_of(codes, codes + count, [](uint8_t code) { return code == 0; })) return;
  for (size_t k = 0; k < count; ++k)
    batch.faulted[begin + k] |= codes[k] != 0;
  note_faults(call, codes, count, report, faults);
}

} // namespace

std::string MaterialSet::build(const Scene& scene, ShaderSource& source,
                               const std::map<std::string, std::map<std::string, std::string>>& overrides,
                               MaterialSet& materials, std::string& warnings) {
  for (const Material& material : scene.materials) {
    auto found = overrides.find(material.name);
    static const std::map<std::string, std::string> none;
    CompiledMaterial compiled;
    MaterialLoader loader(material, source, found == overrides.end() ? none : found->second);
    if (std::string error = loader.load(compiled, warnings); !error.empty())
      return error + (error.ends_with('\n') ? "" : "\n") + material.place + ": note: the material '" + material.name +
             "' uses this shader\n";
    for (const auto& call : compiled.calls)
      if (call) materials.width_ = std::max(materials.width_, call->shader().width());
    if (compiled.volume && compiled.volume->density)
      materials.width_ = std::max(materials.width_, compiled.volume->density->shader().width());
    if (compiled.height) materials.width_ = std::max(materials.width_, compiled.height->shader().width());
    if (found != overrides.end() && !loader.uses_shaders())
      return "-D: the material '" + material.name + "' has no shader, so no parameter '" +
             found->second.begin()->first + "'";
    materials.any_passable_ |= compiled.passable();
    materials.materials_.push_back(std::move(compiled));
  }
  return "";
}

std::vector<uint8_t> MaterialSet::passable() const {
  std::vector<uint8_t> result;
  for (const CompiledMaterial& m : materials_)
    result.push_back(m.passable());
  return result;
}

void MaterialSet::shade(const CompiledMaterial& material, ShadingBatch& batch, size_t begin, size_t count,
                        FaultLog& faults) const {
  EntryCall::Inputs inputs = EntryCall::inputs_of(batch, begin);
  for (size_t s = 0; s < kSlotCount; ++s) {
    const std::optional<EntryCall>& call = material.calls[s];
    if (!call) continue;
    unsigned components = slot_infos()[s].components;
    float* out[3];
    for (unsigned c = 0; c < components; ++c)
      out[c] = batch.results[kResultOffset[s] + c].data() + begin;
    run_slot(*call, batch, begin, count, inputs, out, faults);
    for (unsigned c = 0; c < components; ++c)
      keep_in_range(Slot(s), out[c], count);
  }
}

} // namespace moonshade::renderer
