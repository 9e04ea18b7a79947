// What all noises promise (noise.h, perlin.h, value_noise.h, worley.h, gabor.h, periodic_noise.h, curl.h, fractal.h):
// range, mean and spread, continuity over the borders of cells, period, what is far away or
// undefined (isotropy and spectrum: noise_spectrum_test.cpp); and each family's own. scripts/exhaustive looks for the
// ranges over 10^9 points.
#include "stdlib/fractal.h"
#include "stdlib/noises_for_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace moonshade::stdlib {
namespace {

using W = Wide<double, 8>;
template <int N> using V = Vec<N, double>;
template <int N> using WV = Vec<N, W>;

template <int N> WV<N> all(double x) { return vector_of<N, W>(x); }
W number(double x) { return constant<W>(x); }

using Points = RandomPoints<W>;

const std::vector<Noise<W>> kNoises = all_noises<W>();

std::string test_name(const testing::TestParamInfo<Noise<W>>& info) {
  std::string name = info.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
}

class NoiseRange : public testing::TestWithParam<Noise<W>> {};

TEST_P(NoiseRange, IsNeverLeftAndHasItsMeanAndSpread) {
  const Noise<W>& noise = GetParam();
  const uint64_t blocks = 20'000;
  W low = number(INFINITY), high = number(-INFINITY), sum = number(0), squares = number(0);
  Points points;
  for (uint64_t i = 0; i < blocks; ++i) {
    const W x = noise.at(points.block(noise.dimensions) * number(noise.dimensions == 1 ? 16 : 1)); // enough cells
    low = min(low, x);
    high = max(high, x);
    sum += x;
    squares += x * x;
  }
  const double least = __builtin_reduce_min(low), most = __builtin_reduce_max(high), count = 8.0 * double(blocks);
  double mean = 0, square = 0;
  for (int lane = 0; lane < 8; ++lane)
    mean += sum[lane] / count, square += squares[lane] / count;
  const double deviation = std::sqrt(square - mean * mean);
  EXPECT_GE(least, noise.low);
  EXPECT_LE(most, noise.high);
  EXPECT_NEAR(mean, noise.mean, 0.02 * noise.deviation + 0.007);
  EXPECT_NEAR(deviation, noise.deviation, 0.03 * noise.deviation);
}

INSTANTIATE_TEST_SUITE_P(Families, NoiseRange, testing::ValuesIn(kNoises), test_name);

/// Along random lines through points on the borders of cells and of simplices.
class NoiseContinuity : public testing::TestWithParam<Noise<W>> {};

TEST_P(NoiseContinuity, HoldsForValueAndSlopeOverBorders) {
  const Noise<W>& noise = GetParam();
  if (!noise.smooth) GTEST_SKIP() << "not differentiable everywhere";
  const double h = 1e-4;
  Points points;
  for (int i = 0; i < 3000; ++i) {
    WV<4> p = points.block(noise.dimensions) * number(0.04), way = points.block(noise.dimensions) * number(0.002);
    if (i % 3 == 0) p[0] = floor(p[0]);
    if (i % 3 == 1 && noise.dimensions > 1) p[1] = p[0] + floor(p[1]);
    if (i % 3 == 1 && noise.dimensions == 1) p[0] = floor(p[0]) + number(0.5);
    const W before = noise.at(madd(way, number(-h), p)), here = noise.at(p), after = noise.at(madd(way, number(h), p));
    const double step = __builtin_reduce_max(abs(after - before)) / (2 * h);
    const double bend = __builtin_reduce_max(abs(after - here - here + before)) / (h * h);
    ASSERT_LT(step, 60) << "point " << i;
    ASSERT_LT(bend, 2500) << "point " << i; // a jump of the slope by 0.25 would do
  }
}

INSTANTIATE_TEST_SUITE_P(Families, NoiseContinuity, testing::ValuesIn(kNoises), test_name);

/// Values at neighbouring points of the lattice know nothing of each other, along whichever axis.
TEST(ValueNoise, HasIndependentNeighbours) {
  constexpr int kPoints = 4000, kLag = 4;
  const auto check = [&](const char* name, auto value_at) {
    double squares = 0, products[kLag + 1] = {};
    double row[kPoints];
    for (int i = 0; i < kPoints; ++i)
      row[i] = value_at(double(i - 100));
    for (int i = kLag; i < kPoints; ++i) {
      squares += row[i] * row[i];
      for (int lag = 1; lag <= kLag; ++lag)
        products[lag] += row[i] * row[i - lag];
    }
    for (int lag = 1; lag <= kLag; ++lag)
      EXPECT_LT(std::abs(products[lag] / squares), 0.1) << name << ", " << lag << " steps apart";
  };
  check("of a number", [](double x) { return valuenoise<double>(x); });
  check("periodic", [](double x) { return pvaluenoise<double>(x, 8192.0); });
  check("one of three", [](double x) { return vvaluenoise<double>(x)[1]; });
  for (int axis = 0; axis < 4; ++axis) {
    const auto along = [&]<int N>(std::integral_constant<int, N>) {
      return [axis](double x) {
        V<N> p = {};
        p[axis] = x;
        return valuenoise<double>(p);
      };
    };
    if (axis < 2) check("of the plane", along(std::integral_constant<int, 2>()));
    if (axis < 3) check("of space", along(std::integral_constant<int, 3>()));
    check("of four coordinates", along(std::integral_constant<int, 4>()));
  }
}

// Periods -------------------------------------------------------------------------------------------------------------

TEST(PeriodicNoise, RepeatsAfterWholePeriodsAndNotBefore) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> range(-9, 9);
  const auto check = [&]<int N>(const char* name, auto noise_at) {
    V<N> period;
    for (int i = 0; i < N; ++i)
      period[i] = 5 + 2 * i;
    double change = 0;
    for (int n = 0; n < 400; ++n) {
      V<N> p, shifted, halfway;
      for (int i = 0; i < N; ++i) {
        p[i] = range(random);
        shifted[i] = p[i] + period[i] * double(int(random() % 7) - 3);
        halfway[i] = p[i] + 2;
      }
      ASSERT_NEAR(noise_at(p, period), noise_at(shifted, period), 1e-9) << name << N;
      change += std::abs(noise_at(p, period) - noise_at(halfway, period)) / 400;
    }
    EXPECT_GT(change, 0.04) << name << N;
  };
  const auto check_all = [&]<int N>(std::integral_constant<int, N>) {
    check.template operator()<N>("pnoise", [](V<N> p, V<N> q) { return pnoise<double>(p, q); });
    check.template operator()<N>("pperlin", [](V<N> p, V<N> q) { return pperlin<double>(p, q); });
    check.template operator()<N>("pvaluenoise", [](V<N> p, V<N> q) { return pvaluenoise<double>(p, q); });
    check.template operator()<N>("pcellnoise", [](V<N> p, V<N> q) { return pcellnoise<double>(p, q); });
    check.template operator()<N>("pworley", [](V<N> p, V<N> q) { return pworley<double>(p, q, 2.0).second; });
    if constexpr (N < 4)
      check.template operator()<N>("pgabor", [](V<N> p, V<N> q) { return pgabor<double>(p, q, 3.0); });
  };
  check_all(std::integral_constant<int, 1>());
  check_all(std::integral_constant<int, 2>());
  check_all(std::integral_constant<int, 3>());
  check_all(std::integral_constant<int, 4>());
}

TEST(PeriodicNoise, TakesWholePeriodsFromOneOn) {
  const V<3> p = {{0.3, -4.7, 2.9}};
  const auto with = [&](double period) { return pvaluenoise<double>(p, V<3>{{period, period, period}}); };
  EXPECT_EQ(with(5.9), with(5));
  EXPECT_EQ(with(-5), with(5));
  for (double one : {0.0, 0.5, -0.9, double(NAN)})
    EXPECT_EQ(with(one), with(1)) << one;
  for (double endless : {0x1p22, 1e300, double(INFINITY)})
    EXPECT_EQ(with(endless), with(0x1p22)) << endless;
  EXPECT_NE(with(0x1p22), valuenoise<double>(p)) << "negative cells are elsewhere";
  const V<3> positive = {{0.3, 4.7, 2.9}};
  EXPECT_EQ(pvaluenoise<double>(positive, V<3>{{64, 64, 64}}), valuenoise<double>(positive));
  EXPECT_NEAR(pperlin<double>(positive, V<3>{{256, 256, 256}}), perlin<double>(positive), 1e-14);
}

TEST(PeriodicNoise, HoldsInFloatToTheEndOfTheRange) {
  for (float x : {0.25f, 7.5f, -3.75f, 65536.25f, -1048576.5f}) {
    const Vec<2, float> p = {{x, 0.5f}}, moved = {{x + 7 * 5, 0.5f}}, period = {{7, 3}};
    EXPECT_EQ(pvaluenoise<float>(p, period), pvaluenoise<float>(moved, period)) << x;
    EXPECT_EQ(pcellnoise<float>(p, period), pcellnoise<float>(moved, period)) << x;
  }
}

/// Sums of coordinates must not round: in the plane they put the point off the slice, where the range is another.
TEST(PeriodicNoise, IsInFloatFarAwayWhatItIsInDouble) {
  std::mt19937 random(5);
  for (int i = 0; i < 20000; ++i) {
    Vec<3, double> p;
    Vec<3, float> q;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = q[axis] = float(random() % (1u << 24)) / 0x1p14f;
    const Vec<3, double> period = vector_of<3, double>(64);
    const Vec<3, float> float_period = vector_of<3, float>(64);
    ASSERT_NEAR((pnoise<float>(q, float_period)), (pnoise<double>(p, period)), 1e-5) << p[0] << " " << p[1];
    ASSERT_NEAR((pnoise<float>(Vec<2, float>{{q[0], q[1]}}, Vec<2, float>{{64, 64}})),
                (pnoise<double>(Vec<2, double>{{p[0], p[1]}}, Vec<2, double>{{64, 64}})), 1e-5)
        << p[0] << " " << p[1];
  }
}

// Vectors -------------------------------------------------------------------------------------------------------------

TEST(VectorNoise, BeginsWithTheNoiseAndItsPartsAreIndependent) {
  Points points;
  double products[3] = {}, squares = 0;
  for (int i = 0; i < 20000; ++i) {
    const V<3> p = {{points.next(), points.next(), points.next()}};
    const Vec<3, double> v = vnoise<double>(p);
    ASSERT_EQ(v[0], noise<double>(p));
    ASSERT_NEAR(vperlin<double>(p)[0], perlin<double>(p), 1e-14);
    ASSERT_EQ(vvaluenoise<double>(p)[0], valuenoise<double>(p));
    ASSERT_EQ(vcellnoise<double>(p)[0], cellnoise<double>(p));
    products[0] += v[0] * v[1], products[1] += v[1] * v[2], products[2] += v[2] * v[0];
    squares += v[0] * v[0];
  }
  for (double product : products)
    EXPECT_LT(std::abs(product / squares), 0.03);
}

// Worley --------------------------------------------------------------------------------------------------------------

/// F1 and F2 over all cells up to three away, each feature point found anew.
template <int N> std::array<double, 2> slow_worley(const V<N>& p, int metric) {
  constexpr double unit = 1.0 / (1u << kFeatureBits<N>);
  std::vector<double> distances;
  int cells = 1;
  for (int i = 0; i < N; ++i)
    cells *= 7;
  for (int n = 0; n < cells; ++n) {
    uint32_t combined = 0;
    V<N> corner;
    for (int i = 0, rest = n; i < N; ++i, rest /= 7) {
      corner[i] = std::floor(p[i]) + rest % 7 - 3;
      combined ^= (uint32_t(int32_t(corner[i])) + 0x4b400000u) * kLatticePrimes[i];
    }
    uint32_t hash = combined * combined;
    hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
    double sum = 0, square = 0, greatest = 0;
    for (int i = 0; i < N; ++i) {
      const double d = std::abs(corner[i] + (feature_bits<N>(hash, i) + 0.5) * unit - p[i]);
      sum += d, square += d * d, greatest = std::max(greatest, d);
    }
    distances.push_back(metric == 0 ? std::sqrt(square) : metric == 1 ? sum : greatest);
  }
  std::ranges::partial_sort(distances, distances.begin() + 2);
  return {distances[0], distances[1]};
}

TEST(Worley, FindsTheNearestTwoOfAllPoints) {
  Points points;
  const auto check = [&]<int N>(int count) {
    for (int n = 0; n < count; ++n) {
      V<N> p;
      for (int i = 0; i < N; ++i)
        p[i] = points.next();
      for (int metric = 0; metric < 3; ++metric) {
        const double exponent = metric == 0 ? 2 : metric == 1 ? 1 : INFINITY;
        const auto expected = slow_worley<N>(p, metric);
        const auto found = worley<double>(p, exponent);
        ASSERT_NEAR(found.first, expected[0], 1e-12) << N << " " << metric;
        ASSERT_NEAR(found.second, expected[1], 1e-12) << N << " " << metric;
      }
      const auto euclidean = worley<double>(p), general = worley<double>(p, 2.0);
      ASSERT_EQ(euclidean.first, general.first);
      ASSERT_EQ(euclidean.second, general.second);
      ASSERT_EQ(euclidean.third, general.third);
    }
  };
  check.operator()<1>(20000);
  check.operator()<2>(10000);
  check.operator()<3>(2000);
  check.operator()<4>(150);
}

/// A distance cannot change by more than the way; the id changes only where F1 = F2.
TEST(Worley, IsContinuousAndChangesIdsOnBorders) {
  Points points;
  const double h = 1e-3;
  int borders = 0;
  for (int n = 0; n < 100000; ++n) {
    V<2> p = {{points.next(), points.next()}};
    if (n % 2) p[0] = std::round(p[0]) - h / 2; // the next point is over the border of a cell
    const V<2> q = {{p[0] + h, p[1]}};
    const auto a = worley<double>(p), b = worley<double>(q);
    ASSERT_LE(std::abs(a.first - b.first), h * 1.0001);
    ASSERT_LE(std::abs(a.second - b.second), h * 1.0001);
    ASSERT_LE(a.first, a.second);
    if (a.third == b.third) continue;
    ++borders;
    ASSERT_LT(a.second - a.first, 2.0001 * h);
  }
  EXPECT_GT(borders, 50);
}

// Curl ----------------------------------------------------------------------------------------------------------------

TEST(Curl, HasNoDivergence) {
  Points points;
  using D = Dual<double, 3>;
  for (int n = 0; n < 2000; ++n) {
    Vec<3, D> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = D::of(points.next());
      p[i].active = 1u << i;
      p[i].d[i] = 1;
    }
    const Vec<3, D> v = curl<D>(p);
    ASSERT_NEAR(v[0].d[0] + v[1].d[1] + v[2].d[2], 0, 1e-10);
    const Vec<2, D> w = curl<D>(Vec<2, D>{{p[0], p[1]}});
    ASSERT_NEAR(w[0].d[0] + w[1].d[1], 0, 1e-10);
    const Vec<3, D> u = curl<D>(Vec<4, D>{{p[0], p[1], p[2], D(0.4)}});
    ASSERT_NEAR(u[0].d[0] + u[1].d[1] + u[2].d[2], 0, 1e-10);
  }
}

TEST(Curl, IsTheCurlOfThePotential) {
  const V<3> p = {{0.31, -2.7, 5.13}};
  const double h = 1e-5;
  const auto slope = [&](int component, int axis) {
    V<3> above = p, below = p;
    above[axis] += h, below[axis] -= h;
    return (vnoise<double>(above)[component] - vnoise<double>(below)[component]) / (2 * h);
  };
  const Vec<3, double> v = curl<double>(p);
  EXPECT_NEAR(v[0], slope(2, 1) - slope(1, 2), 1e-7);
  EXPECT_NEAR(v[1], slope(0, 2) - slope(2, 0), 1e-7);
  EXPECT_NEAR(v[2], slope(1, 0) - slope(0, 1), 1e-7);
  const V<2> q = {{0.31, -2.7}};
  EXPECT_NEAR(curl<double>(q)[0],
              (noise<double>(V<2>{{q[0], q[1] + h}}) - noise<double>(V<2>{{q[0], q[1] - h}})) / (2 * h), 1e-7);
}

// Far away and undefined ----------------------------------------------------------------------------------------------

TEST(NoiseFarAway, HasCellsOfItsOwnToTwoToThe22) {
  for (float x : {1e4f, 1e5f, 1e6f, 4e6f, -4e6f}) {
    EXPECT_NE(cellnoise<float>(x), cellnoise<float>(x + 1)) << x;
    EXPECT_EQ(cellnoise<float>(x), float(cellnoise<double>(double(x)))) << x;
    EXPECT_EQ(worley<float>(x).third, float(worley<double>(double(x)).third)) << x;
  }
  // In float, a coordinate of 2^16 still has steps of 1/128 unit.
  const Vec<3, float> p = {{65536.25f, -65536.5f, 1000.75f}};
  const V<3> q = {{65536.25, -65536.5, 1000.75}};
  EXPECT_NEAR(noise<float>(p), noise<double>(q), 0.1);
  EXPECT_NEAR(perlin<float>(p), perlin<double>(q), 1e-5);
  EXPECT_NEAR(valuenoise<float>(p), valuenoise<double>(q), 1e-5);
  EXPECT_NEAR(worley<float>(p).first, worley<double>(q).first, 1e-5);
  EXPECT_NEAR((noise<double>(V<3>{{1e9 + 0.3, 0.5, 0.25}})), (noise<double>(V<3>{{1e9 + 0.3 + 1e-6, 0.5, 0.25}})),
              1e-4);
}

TEST(NoiseFarAway, IsWithinItsRangeOrNaN) {
  for (double far : {0x1p23, 1e9, -1e15, 1e30, 1e300})
    for (const Noise<W>& noise : kNoises) {
      WV<4> p = all<4>(0.3);
      p[0] = number(far);
      const double x = noise.at(p)[0];
      EXPECT_TRUE(std::isnan(x) || (x >= noise.low - 1 && x <= noise.high + 1)) << noise.name << " " << far << " " << x;
    }
}

TEST(NoiseFarAway, IsNaNForNaNAndInfinity) {
  for (double undefined : {double(NAN), double(INFINITY), -double(INFINITY)})
    for (const Noise<W>& noise : kNoises) {
      const std::string name = noise.name;
      if (name.find("cell") != std::string::npos) continue; // cells like others
      for (int axis = 0; axis < noise.dimensions; ++axis) {
        WV<4> p = all<4>(0.3);
        p[axis] = number(undefined);
        EXPECT_TRUE(std::isnan(noise.at(p)[0])) << name << " " << undefined;
      }
    }
}

// Sums ----------------------------------------------------------------------------------------------------------------

const V<3> kPlace = {{0.3, -1.7, 2.9}};

TEST(Fractal, SumsNothingThatThePixelCannotSee) {
  // An eighth of a unit: two octaves are seen whole, the third not at all.
  EXPECT_EQ((fbm<double>(kPlace, 6.0, 2.0, 0.5, 0.125)), (fbm<double>(kPlace, 2.0, 2.0, 0.5, 0.0)));
  EXPECT_EQ((fbm<double>(kPlace, 6.0, 2.0, 0.5, 1e-9)), (fbm<double>(kPlace, 6.0, 2.0, 0.5, 0.0)));
  for (double much : {0.5, 3.0, 1e30, double(INFINITY)}) {
    EXPECT_EQ((fbm<double>(kPlace, 6.0, 2.0, 0.5, much)), 0) << much;
    EXPECT_NEAR((turbulence<double>(kPlace, 3.0, 2.0, 0.5, much)), 1.75 * kMeanMagnitude<3>, 1e-12) << much;
    EXPECT_EQ((warp<double>(kPlace, 6.0, 2.0, 0.5, much, 1.0)), 0) << much;
    EXPECT_NEAR((ridged<double>(kPlace, 1.0, 2.0, 0.5, much)), kMeanRidge<3>, 1e-12) << much;
    EXPECT_NEAR((hybrid<double>(kPlace, 1.0, 2.0, 0.5, much, 0.7)), 0.7, 1e-12) << much;
  }
  for (double none : {0.0, -1.0, double(NAN)})
    EXPECT_EQ((ridged<double>(kPlace, 6.0, 2.0, 0.5, none)), (ridged<double>(kPlace, 6.0, 2.0, 0.5, 0.0))) << none;
}

TEST(Fractal, FadesWithTheWidthAndTheOctavesWithoutSteps) {
  const auto at = [](double octaves, double width, int which) {
    return which == 0   ? fbm<double>(kPlace, octaves, 2.0, 0.5, width)
           : which == 1 ? turbulence<double>(kPlace, octaves, 2.0, 0.5, width)
           : which == 2 ? ridged<double>(kPlace, octaves, 2.0, 0.5, width)
           : which == 3 ? hybrid<double>(kPlace, octaves, 2.0, 0.5, width, 0.7)
                        : warp<double>(kPlace, octaves, 2.0, 0.5, width, 0.5);
  };
  for (int which = 0; which < 5; ++which)
    for (double t = 0.01; t < 1; t += 0.0005) {
      EXPECT_NEAR(at(6, t * 0.6, which), at(6, (t + 0.0005) * 0.6, which), 0.15) << which << " width " << t;
      EXPECT_NEAR(at(6 * t, 0, which), at(6 * t + 0.001, 0, which), 0.02) << which << " octaves " << 6 * t;
    }
}

/// Over every pixel's extent, what the footprint leaves is near the mean of what it left out.
TEST(Fractal, TheFadedSumIsNearThePixelsMean) {
  double error = 0, unfiltered = 0;
  const double width = 0.3;
  Points points;
  for (int n = 0; n < 300; ++n) {
    const V<2> p = {{points.next(), points.next()}};
    double mean = 0;
    for (int i = 0; i < 64; ++i)
      mean += turbulence<double>(V<2>{{p[0] + width * (i % 8 - 3.5) / 8, p[1] + width * (i / 8 - 3.5) / 8}}, 6.0, 2.0,
                                 0.5, 0.0) /
              64;
    error += std::abs(turbulence<double>(p, 6.0, 2.0, 0.5, width) - mean);
    unfiltered += std::abs(turbulence<double>(p, 6.0, 2.0, 0.5, 0.0) - mean);
  }
  EXPECT_LT(error, 0.8 * unfiltered);
}

TEST(Fractal, RidgesAndHybridsFollowTheirFormulas) {
  double before = 1, sum = 0;
  for (int i = 0; i < 4; ++i) {
    const double n = 1 - std::abs(noise<double>(kPlace * double(1 << i))), signal = n * n * before;
    sum += signal * std::ldexp(1, -i);
    before = std::min(2 * signal, 1.0);
  }
  EXPECT_DOUBLE_EQ((ridged<double>(kPlace, 4.0, 2.0, 0.5, 0.0)), sum);
  before = 1, sum = 0;
  for (int i = 0; i < 4; ++i) {
    before = (noise<double>(kPlace * double(1 << i)) + 0.7) * std::ldexp(1, -i) * std::min(before, 1.0);
    sum += before;
  }
  EXPECT_DOUBLE_EQ((hybrid<double>(kPlace, 4.0, 2.0, 0.5, 0.0, 0.7)), sum);
  EXPECT_EQ((warp<double>(kPlace, 5.0, 2.0, 0.5, 0.0, 0.0)), (fbm<double>(kPlace, 5.0, 2.0, 0.5, 0.0)));
}

} // namespace
} // namespace moonshade::stdlib
