// Sums of the samples of each pixel. A pixel's samples are added in their order, whoever computed them.
#pragma once

#include "renderer/math.h"

#include <cstdint>
#include <vector>

namespace moonshade::renderer {

/// Linear Rec. 709 radiance, row by row from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;

  const Vec3& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
};

class Film {
public:
  Film(int width, int height) : width_(width), height_(height), sums_(size_t(width) * size_t(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  size_t pixel_count() const { return sums_.size(); }
  uint32_t samples() const { return samples_; }

  /// Adds `count` samples of one pixel, in order.
  void add(size_t pixel, const Vec3* samples, size_t count) {
    for (size_t i = 0; i < count; ++i)
      sums_[pixel] += DVec3(samples[i]);
  }
  /// Every pixel has got this many samples more.
  void finish_pass(uint32_t samples) { samples_ += samples; }

  Picture picture() const {
    Picture picture{width_, height_, {}};
    picture.pixels.reserve(sums_.size());
    for (const DVec3& sum : sums_)
      picture.pixels.push_back(samples_ ? Vec3(sum / double(samples_)) : Vec3(0));
    return picture;
  }

private:
  int width_, height_;
  uint32_t samples_ = 0;
  std::vector<DVec3> sums_;
};

} // namespace moonshade::renderer
