// Only the film is asked, in a fixed order.
#include "renderer/film/adaptive.h"

namespace moonshade::renderer {

Adaptive::Adaptive(int width, int height, double level)
    : across_((width + kBlock - 1) / kBlock), down_((height + kBlock - 1) / kBlock), level_(level),
      active_(size_t(across_) * size_t(down_), 1) {}

double Adaptive::error(const Film& film, int x0, int y0) {
  constexpr double kDarkest = 1e-4; // below it, error counts as in a picture this bright
  double variance = 0, brightness = 0, count = 0;
  for (int y = y0; y < std::min(y0 + kBlock, film.height()); ++y)
    for (int x = x0; x < std::min(x0 + kBlock, film.width()); ++x) {
      size_t pixel = size_t(y) * size_t(film.width()) + size_t(x);
      Vec3 v = film.variance(pixel);
      // As if the channels went up and down together, which they nearly do.
      double deviation = luminance(Vec3(std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)));
      variance += deviation * deviation;
      brightness += luminance(film.mean(pixel));
      ++count;
    }
  return std::sqrt(variance / count) / (2 * std::sqrt(std::max(brightness / count, kDarkest)));
}

void Adaptive::decide(const Film& film) {
  std::vector<uint8_t> noisy(active_.size());
  for (int y = 0; y < down_; ++y)
    for (int x = 0; x < across_; ++x) {
      size_t block = size_t(y) * size_t(across_) + size_t(x);
      // What is not a number is no reason to go on for ever.
      noisy[block] = active_[block] && error(film, x * kBlock, y * kBlock) > level_;
    }
  for (int y = 0; y < down_; ++y)
    for (int x = 0; x < across_; ++x) {
      bool near_noise = false;
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, down_ - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, across_ - 1); ++nx)
          near_noise |= noisy[size_t(ny) * size_t(across_) + size_t(nx)] != 0;
      active_[size_t(y) * size_t(across_) + size_t(x)] &= uint8_t(near_noise);
    }
}

bool Adaptive::any() const {
  for (uint8_t active : active_)
    if (active) return true;
  return false;
}

} // namespace moonshade::renderer
