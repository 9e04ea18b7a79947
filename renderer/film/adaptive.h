// Where to stop sampling (--noise): blocks of pixels stop together, at fixed numbers of samples and between two passes,
// so that which samples a pixel gets depends on nothing but the samples before.
//
// A block's error is the standard error of its pixels' means, as root mean square, in a picture encoded by a square
// root (nearly sRGB's curve): sqrt(mean variance) / (2 sqrt(mean luminance)); 0.01 is one hundredth of white. A block
// goes on as long as it or one of its eight neighbours is above the level. Because 256 pixels decide together, and with
// their neighbours, the bias that stopping brings is far below the error asked for.
#pragma once

#include "renderer/checkpoint/archive.h"
#include "renderer/film/film.h"

namespace moonshade::renderer {

class Adaptive {
public:
  static constexpr int kBlock = 16;         ///< pixels a side
  static constexpr uint32_t kInterval = 16; ///< samples between two decisions
  static constexpr uint32_t kFirst = 32;    ///< samples before the first one

  Adaptive(int width, int height, double level);

  /// Samples from `done` to the next decision.
  static uint32_t to_next_decision(uint32_t done) {
    return done < kFirst ? kFirst - done : kInterval - done % kInterval;
  }
  static bool is_decision(uint32_t done) { return done >= kFirst && done % kInterval == 0; }

  /// Stops what may stop.
  void decide(const Film& film);
  /// Is the block of this pixel still sampled?
  bool active(int x, int y) const { return active_[block_at(x, y)] != 0; }
  bool any() const;
  void exchange(Archive& archive) { archive.bytes(active_.data(), active_.size()); }

  /// Of the block with this corner.
  static double error(const Film& film, int x, int y);

private:
  size_t block_at(int x, int y) const { return size_t(y / kBlock) * size_t(across_) + size_t(x / kBlock); }

  int across_, down_;
  double level_;
  std::vector<uint8_t> active_;
};

} // namespace moonshade::renderer
