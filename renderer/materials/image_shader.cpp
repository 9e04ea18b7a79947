// Looked up unfiltered, between the four texels around the point: a footprint in uv is not known here (that of `fw` is
// in the object's units), and the samples of a pixel are averaged anyway.
#include "renderer/materials/image_shader.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace moonshade::renderer {

namespace {

constexpr uint32_t kBlock = 256;

/// The place in the image's endless repetition; coordinates that are no numbers count as 0, as in models.
float in_unit(double x) { return std::isfinite(x) ? static_cast<float>(x - std::floor(x)) : 0.0f; }

/// Whether any texel lets something through: by the mean of all.
bool has_alpha(const Image& image) {
  const float middle = 0.5f, all = 1;
  std::array<float, 4> mean{};
  ImageLookup lookup{.count = 1, .u = &middle, .v = &middle, .width = &all};
  for (size_t c = 0; c < 4; ++c)
    lookup.values[c] = &mean[c];
  image.look_up(lookup);
  return mean[3] < 1 - 1e-5f;
}

class ImageShader final : public Shader {
public:
  ImageShader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image)
      : components_(slot_infos()[size_t(slot)].components), how_(how), image_(std::move(image)) {
    const ValueType result = components_ == 3 ? ValueType::Vec3 : ValueType::Number;
    info_.entries.push_back({slot_infos()[size_t(slot)].name, {{"uv", ValueType::Vec2}}, {result}});
    if (how_.part == SlotImage::Part::Mask)
      how_.part = has_alpha(*image_) ? SlotImage::Part::Alpha : SlotImage::Part::Red;
  }

  const ShaderInfo& info() const override { return info_; }
  Precision precision() const override { return Precision::F32; }
  unsigned width() const override { return 1; }
  FaultSite fault_site(uint32_t) const override { return {}; }

  void run(size_t, const Batch& batch) const override {
    const auto *u = static_cast<const float*>(batch.inputs[0]), *v = static_cast<const float*>(batch.inputs[1]);
    std::array<float, kBlock> at_u, at_v, width{};
    std::array<std::array<float, kBlock>, 4> texels;
    for (uint64_t begin = 0; begin < batch.count; begin += kBlock) {
      ImageLookup lookup;
      lookup.count = static_cast<uint32_t>(std::min<uint64_t>(kBlock, batch.count - begin));
      for (uint32_t k = 0; k < lookup.count; ++k) {
        at_u[k] = in_unit(double(u[begin + k]) * double(how_.scale.x) + double(how_.offset.x));
        at_v[k] = in_unit(double(v[begin + k]) * double(how_.scale.y) + double(how_.offset.y));
      }
      lookup.u = at_u.data(), lookup.v = at_v.data(), lookup.width = width.data();
      for (size_t c = 0; c < 4; ++c)
        lookup.values[c] = texels[c].data();
      image_->look_up(lookup);
      for (unsigned c = 0; c < components_; ++c) {
        const auto& part = texels[components_ == 3 ? c : size_t(how_.part)];
        auto* out = static_cast<float*>(batch.outputs[c]) + begin;
        for (uint32_t k = 0; k < lookup.count; ++k)
          out[k] = how_.factor[int(c)] * part[k];
        if (how_.cutoff)
          for (uint32_t k = 0; k < lookup.count; ++k)
            out[k] = out[k] >= *how_.cutoff ? 1.0f : 0.0f;
      }
    }
  }

private:
  unsigned components_;
  SlotImage how_;
  std::shared_ptr<const Image> image_;
  ShaderInfo info_;
};

} // namespace

std::shared_ptr<const Shader> image_shader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image) {
  return std::make_shared<ImageShader>(slot, how, std::move(image));
}

} // namespace moonshade::renderer
