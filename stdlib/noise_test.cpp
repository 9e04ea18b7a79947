// Noise: Perlin's against a transcription of the reference, simplex noise by its properties, sums and hashes.
#include "stdlib/fractal.h"
#include "stdlib/noise.h"
#include "stdlib/perlin.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace moonshade::stdlib {
namespace {

using V2 = Vec<2, double>;
using V3 = Vec<3, double>;

// Perlin 2002, line by line from the published Java ------------------------------------------------------------------

double reference_fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double reference_lerp(double t, double a, double b) { return a + t * (b - a); }
double reference_grad(int hash, double x, double y, double z) {
  int h = hash & 15;
  double u = h < 8 ? x : y, v = h < 4 ? y : h == 12 || h == 14 ? x : z;
  return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
}
double reference_noise(double x, double y, double z) {
  auto p = [](int i) { return int(kPerlinPermutation[i & 255]); };
  int X = int(std::floor(x)) & 255, Y = int(std::floor(y)) & 255, Z = int(std::floor(z)) & 255;
  x -= std::floor(x);
  y -= std::floor(y);
  z -= std::floor(z);
  double u = reference_fade(x), v = reference_fade(y), w = reference_fade(z);
  int A = p(X) + Y, AA = p(A) + Z, AB = p(A + 1) + Z, B = p(X + 1) + Y, BA = p(B) + Z, BB = p(B + 1) + Z;
  return reference_lerp(
      w,
      reference_lerp(v, reference_lerp(u, reference_grad(p(AA), x, y, z), reference_grad(p(BA), x - 1, y, z)),
                     reference_lerp(u, reference_grad(p(AB), x, y - 1, z), reference_grad(p(BB), x - 1, y - 1, z))),
      reference_lerp(
          v, reference_lerp(u, reference_grad(p(AA + 1), x, y, z - 1), reference_grad(p(BA + 1), x - 1, y, z - 1)),
          reference_lerp(u, reference_grad(p(AB + 1), x, y - 1, z - 1),
                         reference_grad(p(BB + 1), x - 1, y - 1, z - 1))));
}

TEST(Perlin, IsTheReferenceBitForBit) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> near(-3, 3), far(-1000, 1000);
  for (int i = 0; i < 200000; ++i) {
    auto& range = i % 2 ? near : far;
    double x = range(random), y = range(random), z = range(random);
    ASSERT_EQ(perlin<double>(V3{{x, y, z}}), reference_noise(x, y, z)) << x << " " << y << " " << z;
    ASSERT_EQ(perlin<double>(V2{{x, y}}), reference_noise(x, y, 0)) << x << " " << y;
    ASSERT_EQ(perlin<double>(x), reference_noise(x, 0, 0)) << x;
  }
}

TEST(Perlin, HasPublishedValuesAndPeriod) {
  // The value that implementations of the 2002 reference are commonly checked with.
  EXPECT_NEAR(perlin<double>(V3{{3.14, 42, 7}}), 0.13691995878400012, 1e-15);
  for (int i = -3; i < 3; ++i)
    EXPECT_EQ(perlin<double>(V3{{double(i), i * 7.0, 5.0 - i}}), 0);
  EXPECT_EQ(perlin<double>(V3{{0.25, 0.5, -0.75}}), perlin<double>(V3{{256.25, 512.5, -256.75}}));
  EXPECT_TRUE(std::isnan(perlin<double>(V3{{0, INFINITY, 0}})));
  EXPECT_TRUE(std::isnan(perlin<float>(Vec<3, float>{{0, 0, NAN}})));
}

// Simplex noise -------------------------------------------------------------------------------------------------------

struct Statistics {
  double low = 0, high = 0, mean = 0, square = 0;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
    mean += x;
    square += x * x;
  }
};

template <class F> Statistics sample(F f, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> range(-500, 500);
  Statistics s;
  for (int i = 0; i < count; ++i)
    s.add(f(range(random), range(random), range(random)));
  s.mean /= count;
  s.square /= count;
  return s;
}

void expect_full_range(const Statistics& s) {
  EXPECT_GE(s.low, -1);
  EXPECT_LE(s.high, 1);
  EXPECT_LT(s.low, -0.8);
  EXPECT_GT(s.high, 0.8);
  EXPECT_NEAR(s.mean, 0, 0.005);
  EXPECT_GT(s.square, 0.03);
}

TEST(Simplex, FillsTheRangeAndNoMore) {
  expect_full_range(sample([](double x, double, double) { return noise<double>(x); }, 1000000));
  expect_full_range(sample([](double x, double y, double) { return noise<double>(V2{{x, y}}); }, 1000000));
  expect_full_range(sample([](double x, double y, double z) { return noise<double>(V3{{x, y, z}}); }, 1000000));
  expect_full_range(sample([](float x, float y, float z) { return noise<float>(Vec<3, float>{{x, y, z}}); }, 1000000));
}

/// The greatest of |f(p + h) - f(p)| / h along random lines: bounded for a function without jumps.
TEST(Simplex, IsContinuous) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> range(-20, 20), way(-1, 1);
  const double h = 1e-6;
  double steepest[3] = {};
  for (int i = 0; i < 400000; ++i) {
    double x = range(random), y = range(random), z = range(random), a = way(random), b = way(random), c = way(random);
    // Every other point lies on a face of a simplex, where two of the skewed coordinates are equal.
    if (i % 2) y = x;
    double e[3] = {noise<double>(x + h * a) - noise<double>(x),
                   noise<double>(V2{{x + h * a, y + h * b}}) - noise<double>(V2{{x, y}}),
                   noise<double>(V3{{x + h * a, y + h * b, z + h * c}}) - noise<double>(V3{{x, y, z}})};
    for (int d = 0; d < 3; ++d)
      steepest[d] = std::max(steepest[d], std::abs(e[d]) / h);
  }
  for (double s : steepest) {
    EXPECT_LT(s, 12);
    EXPECT_GT(s, 1);
  }
}

/// Noise has no slope that its second derivative does not explain: no kinks on the faces of the simplices.
TEST(Simplex, HasAContinuousDerivative) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> range(-20, 20), way(-1, 1);
  const double h = 1e-4;
  for (int i = 0; i < 100000; ++i) {
    double x = range(random), y = i % 2 ? x : range(random), z = range(random);
    double a = way(random), b = way(random), c = way(random);
    auto at = [&](double s) { return noise<double>(V3{{x + s * a, y + s * b, z + s * c}}); };
    ASSERT_LT(std::abs(at(h) - 2 * at(0) + at(-h)) / h, 200 * h) << x << " " << y << " " << z;
  }
}

TEST(Simplex, IsTheSameInBothPrecisionsButForRounding) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<float> range(-100, 100);
  for (int i = 0; i < 100000; ++i) {
    float x = range(random), y = range(random), z = range(random);
    ASSERT_NEAR((noise<float>(Vec<3, float>{{x, y, z}})), (noise<double>(V3{{x, y, z}})), 4e-4);
    ASSERT_NEAR((noise<float>(Vec<2, float>{{x, y}})), (noise<double>(V2{{x, y}})), 4e-4);
    ASSERT_NEAR(noise<float>(x), noise<double>(double(x)), 4e-4);
    ASSERT_NEAR((perlin<float>(Vec<3, float>{{x, y, z}})), (perlin<double>(V3{{x, y, z}})), 1e-5);
  }
}

TEST(Simplex, IsDefinedFarAway) {
  for (double x : {1e9, -1e15, 1e30, 1e300})
    for (double y : {0.0, -1e18, 1e37}) {
      double n = noise<double>(V3{{x, y, 0.5}});
      EXPECT_TRUE(std::isnan(n) || std::abs(n) <= 1) << x << " " << y << " " << n;
    }
  EXPECT_TRUE(std::isnan(noise<double>(V3{{INFINITY, 0, 0}})));
  EXPECT_TRUE(std::isnan(noise<float>(Vec<2, float>{{0, NAN}})));
  EXPECT_TRUE(std::isnan(noise<float>(-INFINITY)));
}

// Hashes --------------------------------------------------------------------------------------------------------------

/// Pearson's statistic of three lattice points in a row, over 16 classes each of their hashes' upper bits: 4095 is
/// expected of independent hashes, with a standard deviation of 90.
template <class F> double row_statistic(F hash_at) {
  std::vector<int> count(4096);
  int total = 0;
  for (int z = -4; z < 4; ++z)
    for (int y = -64; y < 64; ++y)
      for (int x = -512; x < 512; ++x, ++total)
        ++count[hash_at(x - 1, y, z) >> 28 << 8 | hash_at(x, y, z) >> 28 << 4 | hash_at(x + 1, y, z) >> 28];
  double expected = total / 4096.0, sum = 0;
  for (int n : count)
    sum += (n - expected) * (n - expected) / expected;
  return sum;
}

uint32_t hash_at(int x, int y, int z) {
  auto u = [](int i) { return lattice<float>(float(i)); };
  return lattice_hash(u(x) * kLatticePrimes[0] ^ u(y) * kLatticePrimes[1] ^ u(z) * kLatticePrimes[2]);
}

TEST(Hash, NeighboursOnTheLatticeDoNotCorrelate) {
  EXPECT_LT(row_statistic([](int x, int y, int z) { return hash_at(x, y, z); }), 4095 + 5 * 90);
  EXPECT_LT(row_statistic([](int x, int y, int z) { return hash_at(y, x, z); }), 4095 + 5 * 90);
  EXPECT_LT(row_statistic([](int x, int y, int z) { return hash_at(y, z, x); }), 4095 + 5 * 90);
  EXPECT_LT(row_statistic([](int x, int y, int z) { return hash_at(x, x + y, z); }), 4095 + 5 * 90);
  EXPECT_LT(row_statistic([](int x, int y, int z) { return hash_at(x + z, x + y, x); }), 4095 + 5 * 90);
  EXPECT_GT(row_statistic([](int x, int y, int z) { return uint32_t(x + y + z) * kLatticePrimes[0]; }), 10000)
      << "the statistic tells a bad hash";
}

TEST(Lattice, IsTheSameInBothPrecisions) {
  for (double i : {0.0, 1.0, -1.0, 4194303.0, -4194304.0}) {
    EXPECT_EQ(lattice<float>(float(i)), lattice<double>(i)) << i;
    EXPECT_EQ(lattice<double>(i), uint32_t(int32_t(i)) + 0x4b400000u) << i;
  }
}

TEST(Hash, DrawsTheSameForEqualNumbers) {
  EXPECT_EQ(hash<double>(0.0), hash<double>(-0.0));
  EXPECT_EQ(hash<double>(0.1), hash<float>(0.1f));
  EXPECT_EQ(hash<double>(std::nan("1")), hash<float>(-std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(hash<double>(16777217.0), hash<double>(16777216.0)) << "rounded to float";
  for (int64_t k : {0, 1, -1, 7, -12345, 1 << 24})
    EXPECT_EQ(hash_of_integer<double>(k), hash<double>(double(k))) << k;
  EXPECT_EQ(hash_of_integer<float>(INT64_MIN), hash<float>(-0x1p63f));
  EXPECT_NE(hash_of_integer<double>(16777217), hash_of_integer<double>(16777216));
  EXPECT_NE(hash_of_integer<double>(INT64_MAX), hash_of_integer<double>(INT64_MAX - 1));
  EXPECT_NE((hash<double>(V2{{1, 2}})), (hash<double>(V2{{2, 1}})));
}

TEST(Hash, IsEvenlySpread) {
  std::array<int, 64> count = {};
  for (int i = 0; i < 64000; ++i) {
    double h = hash<double>(V3{{double(i % 40), double(i / 40 % 40), double(i / 1600)}});
    ASSERT_GE(h, 0);
    ASSERT_LT(h, 1);
    ++count[size_t(h * 64)];
  }
  double statistic = 0;
  for (int n : count)
    statistic += (n - 1000.0) * (n - 1000.0) / 1000;
  EXPECT_LT(statistic, 120); // 63 expected, standard deviation 11
}

// Sums ----------------------------------------------------------------------------------------------------------------

TEST(Fractal, SumsOctaves) {
  V3 p = {{0.3, -1.7, 2.9}};
  double sum = 0, magnitudes = 0;
  for (int i = 0; i < 5; ++i) {
    double n = noise<double>(p * double(1 << i));
    sum += n * std::ldexp(1, -i);
    magnitudes += std::abs(n) * std::ldexp(1, -i);
  }
  EXPECT_DOUBLE_EQ((fbm<double>(p, 5.0, 2.0, 0.5, 0.0)), sum);
  EXPECT_DOUBLE_EQ((turbulence<double>(p, 5.0, 2.0, 0.5, 0.0)), magnitudes);
  const double last = std::abs(noise<double>(p * 16.0)) / 16;
  EXPECT_DOUBLE_EQ((turbulence<double>(p, 4.25, 2.0, 0.5, 0.0)), magnitudes - 0.75 * last) << "a fraction of the last";
}

TEST(Fractal, CapsTheOctaves) {
  V2 p = {{0.3, -1.7}};
  double most = fbm<double>(p, 32.0, 1.9, 0.5, 0.0);
  EXPECT_EQ((fbm<double>(p, 1e9, 1.9, 0.5, 0.0)), most);
  EXPECT_EQ((fbm<double>(p, double(INFINITY), 1.9, 0.5, 0.0)), most);
  for (double none : {0.0, -3.0, double(-INFINITY), double(NAN)})
    EXPECT_EQ((fbm<double>(p, none, 2.0, 0.5, 0.0)), 0) << none;
}

} // namespace
} // namespace moonshade::stdlib
