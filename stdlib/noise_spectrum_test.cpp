// No direction, no line and no lattice stands out of simplex noise: slopes and power by direction, power by frequency,
// likeness of points whole units apart.
#include "stdlib/noises_for_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>
#include <vector>

namespace moonshade::stdlib {
namespace {

using W = Wide<double, 8>;
template <int N> using WV = Vec<N, W>;
using Points = RandomPoints<W>;

template <int N> WV<N> all(double x) { return vector_of<N, W>(x); }
W number(double x) { return constant<W>(x); }

// Directions -----------------------------------------------------------------------------------------------

/// The mean square of the noise's slope in directions of the plane, by differences.
std::array<double, 8> slopes(W (*noise_at)(const WV<4>&), int dimensions) {
  std::array<double, 8> result = {};
  Points points;
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi * k / 8, h = 1e-3;
    for (int n = 0; n < 6000; ++n) {
      WV<4> p = points.block(dimensions), q = p;
      q[0] += number(h * std::cos(angle));
      q[1] += number(h * std::sin(angle));
      const W slope = (noise_at(q) - noise_at(p)) / number(h), square = slope * slope;
      result[size_t(k)] += __builtin_reduce_max(square) > 1e6 ? 0 : square[0] + square[3] + square[5];
    }
  }
  return result;
}
double unevenness(const std::array<double, 8>& values) {
  return *std::ranges::max_element(values) / *std::ranges::min_element(values);
}

W simplex2(const WV<4>& p) { return noise<W>(first_of<2, W>(p)); }
W simplex3(const WV<4>& p) { return noise<W>(first_of<3, W>(p)); }
W simplex4(const WV<4>& p) { return noise<W>(p); }
W periodic2(const WV<4>& p) { return pnoise<W>(first_of<2, W>(p), all<2>(113)); }
W periodic3(const WV<4>& p) { return pnoise<W>(first_of<3, W>(p), all<3>(113)); }
W gabor2(const WV<4>& p) { return gabor<W>(first_of<2, W>(p), number(4)); }
W wave2(const WV<4>& p) { return gabor<W>(first_of<2, W>(p), WV<2>{{number(4), number(0)}}); }

TEST(Isotropy, SlopesAreAlikeInAllDirections) {
  EXPECT_LT(unevenness(slopes(simplex2, 2)), 1.12);
  EXPECT_LT(unevenness(slopes(simplex3, 3)), 1.12);
  EXPECT_LT(unevenness(slopes(simplex4, 4)), 1.12);
  EXPECT_LT(unevenness(slopes(periodic2, 2)), 1.12);
  EXPECT_LT(unevenness(slopes(periodic3, 3)), 1.12);
  EXPECT_LT(unevenness(slopes(gabor2, 2)), 1.12);
  EXPECT_GT(unevenness(slopes(wave2, 2)), 5) << "the measure tells a direction";
}

/// Power by frequency along x, in units of the mean over all: 256 samples, 8 to the unit, under a Hann window.
std::vector<double> spectrum(W (*noise_at)(const WV<4>&), int dimensions) {
  constexpr int count = 256;
  std::vector<double> power(count / 2);
  Points points;
  for (int line = 0; line < 40; ++line) {
    const WV<4> start = points.block(dimensions);
    std::vector<double> samples;
    for (int i = 0; i < count; ++i) {
      WV<4> p = start;
      p[0] += number(i / 8.0);
      samples.push_back(noise_at(p)[0] * (1 - std::cos(2 * std::numbers::pi * i / count)));
    }
    for (int f = 0; f < count / 2; ++f) {
      double re = 0, im = 0;
      for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * f * i / count;
        re += samples[size_t(i)] * std::cos(angle), im += samples[size_t(i)] * std::sin(angle);
      }
      power[size_t(f)] += re * re + im * im;
    }
  }
  double total = 0;
  for (double p : power)
    total += p;
  for (double& p : power)
    p /= total;
  return power;
}

/// The part of the power between two frequencies, in waves to the unit.
double band(const std::vector<double>& power, double low, double high) {
  double sum = 0;
  for (size_t f = 0; f < power.size(); ++f)
    if (double(f) / 32 >= low && double(f) / 32 < high) sum += power[f];
  return sum;
}

TEST(Spectrum, SimplexIsABandBelowTwoWavesAndGaborWhereItIsPut) {
  for (auto simplex : {simplex2, simplex3, simplex4, periodic2, periodic3}) {
    const auto power = spectrum(simplex, simplex == simplex4 ? 4 : simplex == simplex2 || simplex == periodic2 ? 2 : 3);
    EXPECT_GT(band(power, 0, 2), 0.98);
    EXPECT_LT(band(power, 3, 4), 0.001);
    EXPECT_LT(*std::ranges::max_element(power), 0.06) << "no line stands out";
  }
  EXPECT_GT(band(spectrum(wave2, 2), 3, 4), 0.3);
  EXPECT_GT(
      band(spectrum([](const WV<4>& p) { return gabor<W>(first_of<2, W>(p), WV<2>{{number(2.5), number(0)}}); }, 2),
           1.5, 3.5),
      0.98);
}

/// Lattice artefacts would show as likeness of points whole units apart.
TEST(Spectrum, PointsUnitsApartAreNotAlike) {
  for (auto noise_at : {simplex2, simplex3, simplex4, periodic3}) {
    for (int axis = 0; axis < 2; ++axis)
      for (int units = 2; units < 6; ++units) {
        Points points;
        double product = 0, square = 0;
        for (int n = 0; n < 10000; ++n) {
          WV<4> p = points.block(4), q = p;
          q[axis] += number(units);
          const W a = noise_at(p), b = noise_at(q);
          for (int lane = 0; lane < 8; ++lane)
            product += a[lane] * b[lane], square += a[lane] * a[lane];
        }
        EXPECT_LT(std::abs(product / square), 0.025) << axis << " " << units;
      }
  }
}

// The power of planes
// ---------------------------------------------------------------------------------------------------

constexpr int kSide = 32, kPerUnit = 4, kSectors = 8;

/// Power by two frequencies, 1/8 wave to the unit apart, the first not negative, of squares of 8 units at random
/// places, under a Hann window.
std::vector<double> power_of_plane(const Noise<W>& noise) {
  using Complex = std::complex<double>;
  std::array<Complex, kSide> wave;
  std::array<double, kSide> window;
  for (int i = 0; i < kSide; ++i) {
    wave[size_t(i)] = std::polar(1.0, -2 * std::numbers::pi * i / kSide);
    window[size_t(i)] = 1 - std::cos(2 * std::numbers::pi * i / kSide);
  }
  std::vector<double> power(kSide * kSide);
  std::vector<Complex> rows(kSide * kSide);
  std::array<double, kSide> samples;
  Points points;
  for (int patch = 0; patch < 300; ++patch) {
    const WV<4> corner = points.block(noise.dimensions);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; x += 8) {
        WV<4> p;
        for (int i = 0; i < 4; ++i)
          p[i] = number(corner[i][0]);
        for (int lane = 0; lane < 8; ++lane)
          p[0][lane] += (x + lane) / double(kPerUnit);
        p[1] += number(y / double(kPerUnit));
        const W value = noise.at(p);
        for (int lane = 0; lane < 8; ++lane)
          samples[size_t(x + lane)] = (value[lane] - noise.mean) * window[size_t(x + lane)] * window[size_t(y)];
      }
      for (int f = 0; f < kSide / 2; ++f) {
        Complex sum = 0;
        for (int x = 0; x < kSide; ++x)
          sum += samples[size_t(x)] * wave[size_t(f * x % kSide)];
        rows[size_t(f * kSide + y)] = sum;
      }
    }
    for (int f = 0; f < kSide / 2; ++f)
      for (int g = 0; g < kSide; ++g) {
        double re = 0, im = 0;
        for (int y = 0; y < kSide; ++y) {
          const Complex a = rows[size_t(f * kSide + y)], b = wave[size_t(g * y % kSide)];
          re += a.real() * b.real() - a.imag() * b.imag();
          im += a.real() * b.imag() + a.imag() * b.real();
        }
        power[size_t(f * kSide + g)] += re * re + im * im;
      }
  }
  return power;
}

/// The mean power of a ring of frequencies in sectors of its half turn, the greatest over the least.
double unevenness_of_ring(const std::vector<double>& power, double low, double high) {
  std::array<double, kSectors> sums = {}, counts = {};
  for (int f = 0; f < kSide / 2; ++f)
    for (int g = 0; g < kSide; ++g) {
      const auto frequency = [](int k) { return (k < kSide / 2 ? k : k - kSide) * double(kPerUnit) / kSide; };
      const double x = frequency(f), y = frequency(g), length = std::hypot(x, y);
      if (length < low || length >= high) continue;
      const double turn = std::atan2(y, x) / std::numbers::pi + 1;
      const auto sector = size_t(std::lround(turn * kSectors)) % kSectors;
      sums[sector] += power[size_t(f * kSide + g)];
      ++counts[sector];
    }
  for (size_t i = 0; i < kSectors; ++i)
    sums[i] /= counts[i];
  return *std::ranges::max_element(sums) / *std::ranges::min_element(sums);
}

const Noise<W>& named(const std::vector<Noise<W>>& noises, std::string_view name) {
  return *std::ranges::find(noises, name, [](const Noise<W>& noise) { return std::string_view(noise.name); });
}

TEST(PowerOfPlanes, HasNoDirectionAndNoLine) {
  const auto noises = all_noises<W>();
  for (const char* name : {"noise2", "noise3", "noise4", "pnoise2", "pnoise3", "pnoise4", "vnoise3 y", "vnoise4 z"}) {
    const std::vector<double> power = power_of_plane(named(noises, name));
    double total = 0;
    for (const double p : power)
      total += p;
    EXPECT_LT(*std::ranges::max_element(power) / total, 0.015) << name;
    for (const double low : {0.4, 0.8, 1.2})
      EXPECT_LT(unevenness_of_ring(power, low, low + 0.4), 1.3) << name << " from " << low << " waves to the unit";
  }
  EXPECT_GT(unevenness_of_ring(power_of_plane(named(noises, "valuenoise2")), 1.2, 1.6), 10)
      << "the measure tells a lattice";
  EXPECT_GT(unevenness_of_ring(power_of_plane(named(noises, "perlin3")), 1.2, 1.6), 2);
}

} // namespace
} // namespace moonshade::stdlib
