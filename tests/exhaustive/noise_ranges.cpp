// What each noise reaches over random points, on 16 lanes of floats and 8 of doubles: never beyond the range that it
// states, with its mean and spread.
#include "stdlib/noises_for_test.h"
#include "tests/exhaustive/exhaustive.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace moonshade::exhaustive {
namespace {

using namespace stdlib;

/// Points all over a line of length 2^15 or a square, cube or tesseract of side 1024, by a counter: in units of 2^-14
/// and below, which floats have there.
template <class W> struct Points {
  using U = UInt<W>;
  U state;

  explicit Points(uint64_t seed) {
    for (int lane = 0; lane < width_of<W>; ++lane)
      state[lane] = (seed * width_of<W> + uint64_t(lane)) << 40;
  }
  W next(double reach) {
    state += U(0x9e3779b97f4a7c15u);
    U x = (state ^ (state >> uint64_t(30))) * U(0xbf58476d1ce4e5b9u);
    x = (x ^ (x >> uint64_t(27))) * U(0x94d049bb133111ebu);
    using D = Wide<double, width_of<W>>;
    const D in_unit = convert<D>(bit_cast<Int<W>>(x ^ (x >> uint64_t(31)))) * D(0x1p-63);
    return convert<W>(in_unit) * constant<W>(reach);
  }
  Vec<4, W> block(int dimensions) {
    Vec<4, W> p = vector_of<4, W>(0);
    for (int i = 0; i < dimensions; ++i)
      p[i] = next(dimensions == 1 ? 16384 : 512);
    return p;
  }
};

struct Found {
  double low = INFINITY, high = -INFINITY, sum = 0, squares = 0;
};

template <class W> Found look(const Noise<W>& noise, uint64_t blocks, uint64_t seed) {
  using D = Wide<double, width_of<W>>;
  W low = constant<W>(INFINITY), high = constant<W>(-INFINITY);
  D sum = D(0.0), squares = D(0.0);
  Points<W> points(seed);
  for (uint64_t i = 0; i < blocks; ++i) {
    const W x = noise.at(points.block(noise.dimensions));
    low = min(low, x);
    high = max(high, x);
    const D wide = convert<D>(x);
    sum += wide;
    squares += wide * wide;
  }
  Found found{double(__builtin_reduce_min(low)), double(__builtin_reduce_max(high)), 0, 0};
  for (int lane = 0; lane < width_of<W>; ++lane)
    found.sum += sum[lane], found.squares += squares[lane];
  return found;
}

template <class W> bool check(const Options& options, const Noise<W>& noise, const char* precision, uint64_t samples) {
  const uint64_t blocks = samples / width_of<W> / options.threads;
  std::vector<Found> parts(options.threads);
  on_threads(options.threads, [&](unsigned thread) { parts[thread] = look(noise, blocks, thread); });
  Found all;
  for (const Found& part : parts) {
    all.low = std::min(all.low, part.low);
    all.high = std::max(all.high, part.high);
    all.sum += part.sum;
    all.squares += part.squares;
  }
  const double count = double(blocks) * width_of<W> * options.threads, mean = all.sum / count;
  const double deviation = std::sqrt(all.squares / count - mean * mean);
  const bool in_range = all.low >= noise.low && all.high <= noise.high;
  const bool spread = std::abs(mean - noise.mean) < 0.02 * noise.deviation + 0.002 &&
                      std::abs(deviation - noise.deviation) < 0.03 * noise.deviation;
  std::printf("%s %s: %.7f to %.7f of %g to %g, mean %.5f, deviation %.5f%s%s\n", noise.name, precision, all.low,
              all.high, noise.low, noise.high, mean, deviation, in_range ? "" : ", which leaves the range",
              spread ? "" : ", which is not the mean and deviation stated");
  std::fflush(stdout);
  return in_range && spread;
}

} // namespace

bool check_ranges(const Options& options) {
  bool holds = true;
  for (const auto& noise : all_noises<Wide<float, 16>>())
    if (options.wants(noise.name)) holds &= check(options, noise, "f32", options.samples);
  // The same bodies without the rounding of floats: a tenth of the points.
  for (const auto& noise : all_noises<Wide<double, 8>>())
    if (options.wants(noise.name)) holds &= check(options, noise, "f64", options.samples / 10);
  return holds;
}

} // namespace moonshade::exhaustive
