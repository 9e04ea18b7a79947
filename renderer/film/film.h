// Sums of the samples of each pixel. A pixel's samples are added in their order, whoever computed them, so that sums
// have the same bits for any split of the work; and what they were is all that a render has to remember.
#pragma once

#include "renderer/integrators/task.h"
#include "renderer/math.h"

#include <cstdint>
#include <string>
#include <vector>

namespace moonshade::renderer {

/// Linear Rec. 709 radiance, row by row from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;

  const Vec3& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
};

/// What a film keeps beside radiance.
struct FilmContents {
  bool squares = false; ///< for variances
  bool first = false;   ///< what camera rays meet first

  friend bool operator==(const FilmContents&, const FilmContents&) = default;
};

class Film {
public:
  /// What camera rays of a pixel met first: means, but for what has none, which is that of the nearest sample.
  struct First {
    DVec3 albedo{0}, normal{0};
    Vec3 position{0};
    float depth = FirstHit::kNoDepth;
    uint32_t object = 0, material = 0;
  };

  Film(int width, int height, FilmContents contents = {});

  int width() const { return width_; }
  int height() const { return height_; }
  size_t pixel_count() const { return sums_.size(); }
  FilmContents contents() const { return contents_; }
  /// Of the pixels that have the most.
  uint32_t samples() const { return samples_; }
  uint32_t samples(size_t pixel) const { return counts_[pixel]; }
  double mean_samples() const;

  /// Adds `count` samples of one pixel, in order: those of `samples` from `first` on.
  void add(size_t pixel, const SampleOutputs& samples, size_t first, size_t count);
  /// Every pixel that is still sampled has got this many samples more.
  void finish_pass(uint32_t samples) { samples_ += samples; }

  Vec3 mean(size_t pixel) const { return counts_[pixel] ? Vec3(sums_[pixel] / double(counts_[pixel])) : Vec3(0); }
  /// Estimated variance of the mean; 0 from one sample.
  Vec3 variance(size_t pixel) const;
  uint32_t faults(size_t pixel) const { return faults_[pixel]; }
  /// With sums divided: means.
  First first(size_t pixel) const;
  Picture picture() const;

  /// The sums as blocks of bytes, in a fixed order: what a checkpoint keeps, beside `samples`.
  std::vector<std::pair<void*, size_t>> blocks();
  void set_samples(uint32_t samples) { samples_ = samples; }

  /// Bytes that a film takes for each pixel.
  static size_t bytes_per_pixel(FilmContents contents);

private:
  int width_, height_;
  FilmContents contents_;
  uint32_t samples_ = 0;
  std::vector<DVec3> sums_, squares_;
  std::vector<uint32_t> counts_, faults_;
  std::vector<First> first_;
};

} // namespace moonshade::renderer
