// Calls of compiled entries over slices of a batch. Floats are passed as they lie; for double precision they are
// converted block by block.
#include "renderer/materials/shading_batch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace moonshade::renderer {

static constexpr size_t kMaxInputs = 32; // all inputs of the dialect together have 29 components
static constexpr size_t kWideBlock = 1024;

ShadingBatch::ShadingBatch(size_t capacity, double time, int64_t frame_number) : capacity(capacity) {
  for (auto& channel : inputs)
    channel.resize(capacity + 15); // written by 16 at a time
  for (auto& channel : results)
    channel.resize(capacity);
  for (auto& channel : scratch_inputs)
    channel.resize(capacity);
  for (auto& channel : heights)
    channel.resize(capacity + 15); // and read
  inputs[kTime].assign(capacity, float(time));
  frame.assign(capacity, frame_number);
  id.resize(capacity);
  backface.resize(capacity);
  faulted.resize(capacity);
  scratch_codes.resize(capacity);
  wide_inputs.resize(kMaxInputs * kWideBlock);
  wide_outputs.resize(EntryCall::kMaxResults * kWideBlock);
}

EntryCall::Inputs EntryCall::inputs_of(const ShadingBatch& batch, size_t begin) {
  Inputs inputs;
  for (size_t c = 0; c < kChannelCount; ++c)
    inputs[c] = batch.inputs[c].data() + begin;
  return inputs;
}

static bool channel_of(const std::string& input, uint8_t& channel) {
  static constexpr std::pair<const char*, Channel> kNames[] = {
      {"p", kLocal}, {"P", kWorld},   {"n", kNormal},  {"ng", kGeometric}, {"i", kIncident},
      {"uv", kUv},   {"dpdu", kDpdu}, {"dpdv", kDpdv}, {"fw", kFootprint}, {"time", kTime}};
  for (const auto& [name, value] : kNames)
    if (input == name) return channel = value, true;
  return false;
}

std::string EntryCall::bind(std::shared_ptr<const Shader> shader, const std::string& file, const std::string& entry,
                            unsigned components, std::optional<EntryCall>& call) {
  const std::vector<EntryInfo>& entries = shader->info().entries;
  auto found = std::find_if(entries.begin(), entries.end(), [&](const EntryInfo& e) { return e.name == entry; });
  if (found == entries.end()) return file + ": has no function '" + entry + "'";
  EntryCall bound;
  bound.shader_components_ = found->results.size() == 1 ? component_count(found->results[0]) : 0;
  bool fits = bound.shader_components_ == components || (entry == "reflectance" && bound.shader_components_ == 1);
  if (!fits || (found->results[0] != ValueType::Number && !is_vector(found->results[0])))
    return file + ": '" + entry + "' gives no " + (components == 3 ? "vec3" : "number");
  if (std::string error = bound.bind_inputs(*found); !error.empty()) return file + ": '" + entry + "' " + error;
  bound.entry_ = size_t(found - entries.begin());
  bound.shader_ = std::move(shader);
  bound.file_ = file;
  bound.components_ = components;
  call = std::move(bound);
  return "";
}

std::string EntryCall::bind_all(std::shared_ptr<const Shader> shader, const std::string& file, size_t entry,
                                std::optional<EntryCall>& call) {
  const EntryInfo& info = shader->info().entries[entry];
  EntryCall bound;
  bound.components_ = 0;
  for (const ValueType type : info.results)
    bound.components_ += component_count(type);
  if (bound.components_ > kMaxResults) return file + ": '" + info.name + "' has too many results";
  if (std::string error = bound.bind_inputs(info); !error.empty()) return file + ": '" + info.name + "' " + error;
  bound.shader_components_ = bound.components_;
  bound.entry_ = entry;
  bound.shader_ = std::move(shader);
  bound.file_ = file;
  call = std::move(bound);
  return "";
}

/// What is wrong with the inputs, or nothing.
std::string EntryCall::bind_inputs(const EntryInfo& entry) {
  for (const InputInfo& input : entry.inputs) {
    uint8_t channel = 0;
    if (input.name == "id")
      inputs_.push_back({Input::Id, 0});
    else if (input.name == "frame")
      inputs_.push_back({Input::Frame, 0});
    else if (input.name == "backface")
      inputs_.push_back({Input::Backface, 0});
    else if (channel_of(input.name, channel)) {
      for (unsigned c = 0; c < component_count(input.type); ++c) {
        inputs_.push_back({Input::Float, uint8_t(channel + c)});
        needs_ |= 1u << (channel + c);
      }
    } else {
      return "has the input '" + input.name + "', which surfaces do not have";
    }
  }
  return inputs_.size() > kMaxInputs ? "has too many inputs" : "";
}

/// Marks results that are not finite; a fault's zeros stay.
static void check_finite(float* const* out, unsigned components, size_t count, uint8_t* codes) {
  for (unsigned c = 0; c < components; ++c) {
    const float* values = out[c];
    for (size_t k = 0; k < count; ++k)
      if (!(std::abs(values[k]) < kInfinity)) codes[k] = codes[k] ? codes[k] : kNotFinite;
  }
  for (unsigned c = 0; c < components; ++c)
    for (size_t k = 0; k < count; ++k)
      if (codes[k]) out[c][k] = 0;
}

void EntryCall::run(ShadingBatch& batch, size_t begin, size_t count, const Inputs& inputs, float* const* out,
                    uint8_t* codes, FaultReport& report) const {
  bool wide = shader_->precision() == Precision::F64;
  size_t block = wide ? kWideBlock : count;
  for (size_t at = 0; at < count; at += block) {
    size_t n = std::min(block, count - at);
    const void* in[kMaxInputs];
    for (size_t k = 0; k < inputs_.size(); ++k) {
      const Input& input = inputs_[k];
      switch (input.kind) {
      case Input::Id:
        in[k] = batch.id.data() + begin + at;
        continue;
      case Input::Frame:
        in[k] = batch.frame.data();
        continue;
      case Input::Backface:
        in[k] = batch.backface.data() + begin + at;
        continue;
      case Input::Float:
        break;
      }
      // The time is the same everywhere: the array serves as one value and as many.
      const float* source = input.channel == kTime ? batch.inputs[kTime].data() : inputs[input.channel] + at;
      if (!wide) {
        in[k] = source;
        continue;
      }
      double* converted = batch.wide_inputs.data() + k * kWideBlock;
      for (size_t j = 0; j < n; ++j)
        converted[j] = source[j];
      in[k] = converted;
    }
    void* results[kMaxResults];
    for (unsigned c = 0; c < shader_components_; ++c)
      results[c] = wide ? static_cast<void*>(batch.wide_outputs.data() + c * kWideBlock) : out[c] + at;
    FaultReport block_report;
    Batch call;
    call.count = n;
    call.inputs = in;
    call.outputs = results;
    call.faults = &block_report;
    call.fault_codes = codes + at;
    shader_->run(entry_, call);
    if (wide)
      for (unsigned c = 0; c < shader_components_; ++c)
        for (size_t j = 0; j < n; ++j)
          out[c][at + j] = float(batch.wide_outputs[c * kWideBlock + j]);
    if (block_report.count && !report.count) {
      report = block_report;
      report.first_point += at;
    } else {
      report.count += block_report.count;
    }
  }
  for (unsigned c = shader_components_; c < components_; ++c)
    std::memcpy(out[c], out[0], count * sizeof(float));
  check_finite(out, components_, count, codes);
}

} // namespace moonshade::renderer
