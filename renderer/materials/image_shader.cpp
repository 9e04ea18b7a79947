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
  uint64_t begin = 0; ///< of its points in the batch
  uint32_t count = 0;
  std::array<float, kBlock> u, v, width{};
  std::array<std::array<float, kBlock>, 4> texels;
};

/// What shaders made of an image have in common: one entry, which reads `uv`.
class OfImage : public Shader {
public:
  const ShaderInfo& info() const final { return info_; }
  Precision precision() const final { return Precision::F32; }
  unsigned width() const final { return 1; }
  FaultSite fault_site(uint32_t) const final { return {}; }

  void run(size_t, const Batch& batch) const final {
    Block block;
    for (; block.begin < batch.count; block.begin += kBlock) {
      block.count = static_cast<uint32_t>(std::min<uint64_t>(kBlock, batch.count - block.begin));
      give(batch, block);
    }
  }

protected:
  OfImage(const SlotImage& how, std::shared_ptr<const Image> image, std::string entry, std::vector<ValueType> results)
      : how_(how), image_(std::move(image)) {
    info_.entries.push_back({std::move(entry), {{"uv", ValueType::Vec2}}, std::move(results)});
  }

  /// The results of the block's points.
  virtual void give(const Batch& batch, Block& block) const = 0;

  /// Texels of the block's points, or of the places `beside` them in the image.
  void look_up(const Batch& batch, Block& block, const Vec2& beside = Vec2(0)) const {
    for (int axis = 0; axis < 2; ++axis) {
      const float* from = static_cast<const float*>(batch.inputs[axis]) + block.begin;
      auto& to = axis == 0 ? block.u : block.v;
      for (uint32_t k = 0; k < block.count; ++k)
        to[k] = in_unit(double(from[k]) * double(how_.scale[axis]) + double(how_.offset[axis]) + double(beside[axis]));
    }
    ImageLookup lookup{.count = block.count, .u = block.u.data(), .v = block.v.data(), .width = block.width.data()};
    for (size_t c = 0; c < 4; ++c)
      lookup.values[c] = block.texels[c].data();
    image_->look_up(lookup);
  }

  static float* results(const Batch& batch, size_t component, const Block& block) {
    return static_cast<float*>(batch.outputs[component]) + block.begin;
  }

  SlotImage how_;
  std::shared_ptr<const Image> image_;

private:
  ShaderInfo info_;
};

class ImageShader final : public OfImage {
public:
  ImageShader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image)
      : OfImage(how, std::move(image), slot_infos()[size_t(slot)].name,
                {slot_infos()[size_t(slot)].components == 3 ? ValueType::Vec3 : ValueType::Number}),
        components_(slot_infos()[size_t(slot)].components) {
    if (how_.part == SlotImage::Part::Mask)
      how_.part = has_alpha(*image_) ? SlotImage::Part::Alpha : SlotImage::Part::Red;
  }

private:
  void give(const Batch& batch, Block& block) const override {
    look_up(batch, block);
    for (unsigned c = 0; c < components_; ++c) {
      const auto& part = block.texels[components_ == 3 ? c : size_t(how_.part)];
      float* out = results(batch, c, block);
      for (uint32_t k = 0; k < block.count; ++k)
        out[k] = how_.factor[int(c)] * part[k];
      if (how_.cutoff)
        for (uint32_t k = 0; k < block.count; ++k)
          out[k] = out[k] >= *how_.cutoff ? 1.0f : 0.0f;
    }
  }

  unsigned components_;
};

/// A texel of normals points outwards by at least this much.
constexpr float kLeastUp = 1.0f / 64;

bool shows_normals(const BumpImage& how, const Image& image) {
  if (how.kind != BumpImage::Kind::ByLooks) return how.kind == BumpImage::Kind::Normals;
  const std::array<float, 4> mean = mean_of(image);
  return mean[2] > std::max(mean[0], mean[1]) + 0.2f;
}

class BumpImageShader final : public OfImage {
public:
  BumpImageShader(const BumpImage& how, std::shared_ptr<const Image> image)
      : OfImage(how.image, std::move(image), gradient_name(height_gradient()), {ValueType::Number, ValueType::Vec2}),
        normals_(shows_normals(how, *image_)) {
    const auto [across, down] = image_->size();
    texel_ = Vec2(1) / Vec2(float(std::max(across, 1u)), float(std::max(down, 1u)));
  }

private:
  void give(const Batch& batch, Block& block) const override {
    std::fill_n(results(batch, 0, block), block.count, 0.0f); // nobody asks how high it is
    if (normals_) look_up(batch, block);
    for (int axis = 0; axis < 2; ++axis) {
      float* slopes = results(batch, 1 + size_t(axis), block);
      normals_ ? slopes_of_normals(block, axis, slopes) : slopes_of_heights(batch, block, axis, slopes);
    }
  }

  /// Where the image is mirrored, so are its slopes.
  float strength(int axis) const { return how_.scale[axis] < 0 ? -how_.factor.x : how_.factor.x; }

  void slopes_of_normals(const Block& block, int axis, float* slopes) const {
    for (uint32_t k = 0; k < block.count; ++k) {
      const float up = std::max(2 * block.texels[2][k] - 1, kLeastUp);
      slopes[k] = strength(axis) * (1 - 2 * block.texels[size_t(axis)][k]) / up;
    }
  }

  /// Over one texel, so that the slope does not jump where the image's own does, from texel to texel. Texels are taken
  /// to be square on the surface.
  void slopes_of_heights(const Batch& batch, Block& block, int axis, float* slopes) const {
    Vec2 beside(0);
    beside[axis] = 0.5f * texel_[axis];
    look_up(batch, block, -beside);
    const std::array<float, kBlock> before = block.texels[0];
    look_up(batch, block, beside);
    const float rise = strength(axis) * kBumpDepth / texel_.x;
    for (uint32_t k = 0; k < block.count; ++k)
      slopes[k] = rise * (block.texels[0][k] - before[k]);
  }

  bool normals_;
  Vec2 texel_{1};
};

} // namespace

std::shared_ptr<const Shader> bump_image_shader(const BumpImage& how, std::shared_ptr<const Image> image) {
  return std::make_shared<BumpImageShader>(how, std::move(image));
}

std::shared_ptr<const Shader> image_shader(Slot slot, const SlotImage& how, std::shared_ptr<const Image> image) {
  return std::make_shared<ImageShader>(slot, how, std::move(image));
}

} // namespace moonshade::renderer
