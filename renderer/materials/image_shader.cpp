// Looked up unfiltered, between the four texels around the point: a footprint in uv is not known here (that of `fw` is
// in the object's units), and the samples of a pixel are averaged anyway.
#include "renderer/materials/image_shader.h"

#include "renderer/materials/material_set.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace moonshade::renderer {

namespace {

constexpr uint32_t kBlock = 256;

/// The place in the image's endless repetition; coordinates that are no numbers count as 0, as in models.
float in_unit(double x) { return std::isfinite(x) ? static_cast<float>(x - std::floor(x)) : 0.0f; }

/// The mean of all texels.
std::array<float, 4> mean_of(const Image& image) {
  const float middle = 0.5f, all = 1;
  std::array<float, 4> mean{};
  ImageLookup lookup{.count = 1, .u = &middle, .v = &middle, .width = &all};
  for (size_t c = 0; c < 4; ++c)
    lookup.values[c] = &mean[c];
  image.look_up(lookup);
  return mean;
}

/// Whether any texel lets something through.
bool has_alpha(const Image& image) { return mean_of(image)[3] < 1 - 1e-5f; }

/// A block of look-ups and the texels that they give.
struct Block {
  std::array<float, kBlock> u, v, width{};
  std::array<std::array<float, kBlock>, 4> texels;

  void look_up(const Image& image, uint32_t count) {
    ImageLookup lookup{.count = count, .u = u.data(), .v = v.data(), .width = width.data()};
    for (size_t c = 0; c < 4; ++c)
      lookup.values[c] = texels[c].data();
    image.look_up(lookup);
  }
};

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
    Block block;
    for (uint64_t begin = 0; begin < batch.count; begin += kBlock) {
      const auto count = static_cast<uint32_t>(std::min<uint64_t>(kBlock, batch.count - begin));
      for (uint32_t k = 0; k < count; ++k) {
        block.u[k] = in_unit(double(u[begin + k]) * double(how_.scale.x) + double(how_.offset.x));
        block.v[k] = in_unit(double(v[begin + k]) * double(how_.scale.y) + double(how_.offset.y));
      }
      block.look_up(*image_, count);
      for (unsigned c = 0; c < components_; ++c) {
        const auto& part = block.texels[components_ == 3 ? c : size_t(how_.part)];
        auto* out = static_cast<float*>(batch.outputs[c]) + begin;
        for (uint32_t k = 0; k < count; ++k)
          out[k] = how_.factor[int(c)] * part[k];
        if (how_.cutoff)
          for (uint32_t k = 0; k < count; ++k)
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

/// A texel of normals points outwards by at least this much.
constexpr float kLeastUp = 1.0f / 64;

bool shows_normals(const BumpImage& how, const Image& image) {
  if (how.kind != BumpImage::Kind::ByLooks) return how.kind == BumpImage::Kind::Normals;
  const std::array<float, 4> mean = mean_of(image);
  return mean[2] > std::max(mean[0], mean[1]) + 0.2f;
}

class BumpImageShader final : public Shader {
public:
  BumpImageShader(const BumpImage& how, std::shared_ptr<const Image> image)
      : how_(how.image), image_(std::move(image)), normals_(shows_normals(how, *image_)) {
    const auto [across, down] = image_->size();
    texel_ = Vec2(1) / Vec2(float(std::max(across, 1u)), float(std::max(down, 1u)));
    info_.entries.push_back(
        {gradient_name(height_gradient()), {{"uv", ValueType::Vec2}}, {ValueType::Number, ValueType::Vec2}});
  }

  const ShaderInfo& info() const override { return info_; }
  Precision precision() const override { return Precision::F32; }
  unsigned width() const override { return 1; }
  FaultSite fault_site(uint32_t) const override { return {}; }

  void run(size_t, const Batch& batch) const override {
    Block block;
    for (uint64_t begin = 0; begin < batch.count; begin += kBlock) {
      const auto count = static_cast<uint32_t>(std::min<uint64_t>(kBlock, batch.count - begin));
      float* slopes[2];
      for (size_t axis = 0; axis < 2; ++axis)
        slopes[axis] = static_cast<float*>(batch.outputs[1 + axis]) + begin;
      std::fill_n(static_cast<float*>(batch.outputs[0]) + begin, count, 0.0f); // nobody asks how high it is
      if (normals_) {
        look_up(block, batch, begin, count, Vec2(0));
        for (size_t axis = 0; axis < 2; ++axis)
          slopes_of_normals(block, count, axis, slopes[axis]);
      } else {
        for (int axis = 0; axis < 2; ++axis)
          slopes_of_heights(block, batch, begin, count, axis, slopes[axis]);
      }
    }
  }

private:
  void look_up(Block& block, const Batch& batch, uint64_t begin, uint32_t count, const Vec2& beside) const {
    const auto *u = static_cast<const float*>(batch.inputs[0]), *v = static_cast<const float*>(batch.inputs[1]);
    for (uint32_t k = 0; k < count; ++k) {
      block.u[k] = in_unit(double(u[begin + k]) * double(how_.scale.x) + double(how_.offset.x) + double(beside.x));
      block.v[k] = in_unit(double(v[begin + k]) * double(how_.scale.y) + double(how_.offset.y) + double(beside.y));
    }
    block.look_up(*image_, count);
  }

  /// Where the image is mirrored, so are its slopes.
  float strength(int axis) const { return how_.scale[axis] < 0 ? -how_.factor.x : how_.factor.x; }

  void slopes_of_normals(const Block& block, uint32_t count, size_t axis, float* slopes) const {
    for (uint32_t k = 0; k < count; ++k) {
      const float up = std::max(2 * block.texels[2][k] - 1, kLeastUp);
      slopes[k] = strength(int(axis)) * (1 - 2 * block.texels[axis][k]) / up;
    }
  }

  /// Over one texel, so that the slope does not jump where the image's own does, from texel to texel. Texels are taken
  /// to be square on the surface.
  void slopes_of_heights(Block& block, const Batch& batch, uint64_t begin, uint32_t count, int axis,
                         float* slopes) const {
    Vec2 beside(0);
    beside[axis] = 0.5f * texel_[axis];
    look_up(block, batch, begin, count, -beside);
    const std::array<float, kBlock> before = block.texels[0];
    look_up(block, batch, begin, count, beside);
    const float rise = strength(axis) * kBumpDepth / texel_.x;
    for (uint32_t k = 0; k < count; ++k)
      slopes[k] = rise * (block.texels[0][k] - before[k]);
  }

  SlotImage how_;
  std::shared_ptr<const Image> image_;
  bool normals_;
  Vec2 texel_{1};
  ShaderInfo info_;
};

} // namespace

std::shared_ptr<const Shader> bump_image_shader(const BumpImage& how, std::shared_ptr<const Image> image) {
  return std::make_shared<BumpImageShader>(how, std::move(image));
}

std::shared_ptr<const Shader> image_shader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image) {
  return std::make_shared<ImageShader>(slot, how, std::move(image));
}

} // namespace moonshade::renderer
