// Points to be shaded, as structure of arrays: what shaders read (their inputs) and what they give. One batch belongs
// to one thread and is reused; nothing is allocated while rendering.
#pragma once

#include "renderer/materials/channels.h"
#include "renderer/scene/scene.h"
#include "runtime/shader.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace moonshade::renderer {

/// Float arrays of a batch's results, by slot; the components of a colour follow each other.
inline constexpr std::array<uint8_t, kSlotCount> kResultOffset = {0, 3, 6, 7, 8, 11, 12, 13};
inline constexpr size_t kResultCount = 14;

struct ShadingBatch {
  explicit ShadingBatch(size_t capacity, double time, int64_t frame);

  size_t capacity;
  std::array<std::vector<float>, kChannelCount> inputs;
  std::vector<int64_t> id, frame;
  std::vector<uint8_t> backface;
  std::array<std::vector<float>, kResultCount> results;
  std::vector<uint8_t> faulted; ///< 1: an entry faulted here or gave a value that is not finite
  std::vector<uint8_t> scratch_codes;
  std::vector<float> scratch_inputs[6];          ///< displaced p and P, for bump mapping
  std::array<std::vector<float>, 9> heights;     ///< at p ± ε along each axis; or height and its derivatives
  std::vector<double> wide_inputs, wide_outputs; ///< conversion for f64: blocks of `capacity`
};

/// One entry of one shader, bound to channels.
class EntryCall {
public:
  /// Error where the shader's entry does not give `components` numbers.
  static std::string bind(std::shared_ptr<const Shader> shader, const std::string& file, const std::string& entry,
                          unsigned components, std::optional<EntryCall>& call);

  /// The entry whatever its results are (numbers and vectors, at most kMaxResults components), all of which it gives.
  static std::string bind_all(std::shared_ptr<const Shader> shader, const std::string& file, size_t entry,
                              std::optional<EntryCall>& call);

  /// Where inputs are read: the batch's own arrays, or others in their place.
  using Inputs = std::array<const float*, kChannelCount>;
  static Inputs inputs_of(const ShadingBatch& batch, size_t begin);

  /// Evaluates points [begin, begin + count) with `inputs` (already advanced to `begin`) into `out`, one array per
  /// component. Points that fault, or whose result is not finite, get code != 0 in `codes` and zeros.
  void run(ShadingBatch& batch, size_t begin, size_t count, const Inputs& inputs, float* const* out, uint8_t* codes,
           FaultReport& report) const;

  uint32_t needs() const { return needs_; } ///< channels read, a bit each
  unsigned components() const { return components_; }
  const Shader& shader() const { return *shader_; }
  size_t entry() const { return entry_; }
  const std::string& file() const { return file_; }

  static constexpr unsigned kMaxResults = 9;

private:
  std::string bind_inputs(const EntryInfo& entry);

  struct Input {
    enum Kind : uint8_t { Float, Id, Frame, Backface } kind;
    uint8_t channel;
  };
  std::shared_ptr<const Shader> shader_;
  size_t entry_ = 0;
  std::string file_;
  std::vector<Input> inputs_; ///< one per component
  unsigned components_ = 1, shader_components_ = 1;
  uint32_t needs_ = 0;
};

/// The code of a result that is not finite, beside those of FaultCode.
inline constexpr uint8_t kNotFinite = 255;

} // namespace moonshade::renderer
