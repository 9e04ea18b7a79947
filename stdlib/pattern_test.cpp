// The patterns: exact at width 0, the mean where the footprint is wide, and in between what supersampling sees; cells
// have one number each, and distances are distances.
#include "stdlib/geometry.h"
#include "stdlib/grain.h"
#include "stdlib/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace moonshade::stdlib {
namespace {

using Vec2 = Vec<2, double>;
using Vec3 = Vec<3, double>;

struct Sampler {
  std::mt19937_64 random{3};
  double uniform(double low, double high) { return low + (high - low) * double(random() >> 11) * 0x1p-53; }
  Vec2 point() { return {{uniform(-60, 60), uniform(-60, 60)}}; }
};

/// A pattern of the plane, and how far it may be from the truth: at worst, and as the root of the mean square.
struct Pattern {
  const char* name;
  std::function<double(Vec2, double)> value;
  double worst, mean_square;

  friend void PrintTo(const Pattern& pattern, std::ostream* out) { *out << pattern.name; }
};

/// A plane through a solid, along none of its axes.
Vec3 oblique(Vec2 p) { return {{0.8 * p[0] - 0.36 * p[1] + 0.3, 0.8 * p[1] - 0.2, 0.6 * p[0] + 0.48 * p[1]}}; }
Vec3 level(Vec2 p) { return {{p[0], 0.3, p[1]}}; }

/// Exact ones lie within the noise of the samples; that of 32 x 32 stratified ones grows with the width. Solids do not
/// know the footprint's plane: what is right on the average over planes (see Solids) is that far from one of them.
const Pattern kPatterns[] = {
    {"checker", [](Vec2 p, double w) { return checker<double>(p, w); }, 0.03, 0.008},
    {"stripes", [](Vec2 p, double w) { return stripes<double>(p[0], w, 0.3, 0.1); }, 0.03, 0.008},
    {"tiles", [](Vec2 p, double w) { return tiles<double>(p, w, 0.1, 0.1).first; }, 0.03, 0.008},
    {"brick stacked", [](Vec2 p, double w) { return brick<double>(p, w, 0.1, 0.0, 0, 2).first; }, 0.03, 0.008},
    {"brick running", [](Vec2 p, double w) { return brick<double>(p, w, 0.1, 0.1, 0.5, 2).first; }, 0.03, 0.008},
    {"brick raking", [](Vec2 p, double w) { return brick<double>(p, w, 0.1, 0.1, 1.0 / 3, 2).first; }, 0.035, 0.015},
    {"brick English", [](Vec2 p, double w) { return brick<double>(p, w, 0.1, 0.05, 1, 2).first; }, 0.03, 0.008},
    {"brick Flemish", [](Vec2 p, double w) { return brick<double>(p, w, 0.1, 0.05, 2, 2).first; }, 0.03, 0.008},
    {"dots", [](Vec2 p, double w) { return dots<double>(p, w, 0.3).first; }, 0.03, 0.008},
    {"dots that touch", [](Vec2 p, double w) { return dots<double>(p, w, 0.5).first; }, 0.03, 0.008},
    {"hexagons", [](Vec2 p, double w) { return hexagons<double>(p, w, 0.1, 0.0).first; }, 0.04, 0.009},
    {"hexagons bevelled", [](Vec2 p, double w) { return hexagons<double>(p, w, 0.1, 0.15).first; }, 0.045, 0.009},
    {"voronoi", [](Vec2 p, double w) { return voronoi<double, 2>(p, w, 0.05, 1).first; }, 0.06, 0.013},
    {"voronoi wide borders", [](Vec2 p, double w) { return voronoi<double, 2>(p, w, 0.15, 1).first; }, 0.12, 0.026},
    {"voronoi of space", [](Vec2 p, double w) { return voronoi<double, 3>(level(p), w, 0.05, 1).first; }, 0.4, 0.065},
    {"voronoi of space oblique", [](Vec2 p, double w) { return voronoi<double, 3>(oblique(p), w, 0.05, 1).first; }, 0.4,
     0.07},
    {"wood", [](Vec2 p, double w) { return wood<double>(level(p), w, 0.4, 0.2); }, 0.11, 0.04},
    {"wood oblique", [](Vec2 p, double w) { return wood<double>(oblique(p), w, 0.4, 0.2); }, 0.13, 0.045},
    {"marble", [](Vec2 p, double w) { return marble<double>(level(p), w, 0.5); }, 0.25, 0.08},
    {"marble oblique", [](Vec2 p, double w) { return marble<double>(oblique(p), w, 0.5); }, 0.2, 0.065},
    {"marble distorted", [](Vec2 p, double w) { return marble<double>(level(p), w, 1); }, 0.25, 0.08},
};

class Patterns : public testing::TestWithParam<Pattern> {};

TEST_P(Patterns, AreWhatSupersamplingSees) {
  constexpr int kSide = 32;
  Sampler sampler;
  for (const double width : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.2, 2.7}) {
    double worst = 0, squares = 0;
    constexpr int kPoints = 120;
    for (int i = 0; i < kPoints; ++i) {
      const Vec2 p = sampler.point();
      double sum = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const auto offset = [&](int k) { return width * ((k + sampler.uniform(0, 1)) / kSide - 0.5); };
          sum += GetParam().value(Vec2{{p[0] + offset(x), p[1] + offset(y)}}, 0);
        }
      const double error = GetParam().value(p, width) - sum / (kSide * kSide);
      worst = std::max(worst, std::abs(error));
      squares += error * error;
    }
    EXPECT_LT(worst, GetParam().worst) << GetParam().name << " at width " << width;
    EXPECT_LT(std::sqrt(squares / kPoints), GetParam().mean_square) << GetParam().name << " at width " << width;
  }
}

/// A pattern of space, and how far it may be from what squares see that are turned all ways, on the average.
struct Solid {
  const char* name;
  std::function<double(Vec3, double)> value;
  double mean_square;
  double extent = 60; ///< of x and z

  Vec3 point(Sampler& sampler) const {
    return {{sampler.uniform(-extent, extent), sampler.uniform(-60, 60), sampler.uniform(-extent, extent)}};
  }
  friend void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.name; }
};
const Solid kSolids[] = {
    {"voronoi", [](Vec3 p, double w) { return voronoi<double, 3>(p, w, 0.05, 1).first; }, 0.025},
    {"voronoi wide borders", [](Vec3 p, double w) { return voronoi<double, 3>(p, w, 0.15, 1).first; }, 0.05},
    {"voronoi of cubes", [](Vec3 p, double w) { return voronoi<double, 3>(p, w, 0.05, 0).first; }, 0.03},
    {"wood", [](Vec3 p, double w) { return wood<double>(p, w, 0.4, 0.2); }, 0.03},
    {"wood near the axis", [](Vec3 p, double w) { return wood<double>(p, w, 0.4, 0.2); }, 0.033, 1},
    {"marble", [](Vec3 p, double w) { return marble<double>(p, w, 0.5); }, 0.042},
    {"marble distorted", [](Vec3 p, double w) { return marble<double>(p, w, 1); }, 0.052},
};

class Solids : public testing::TestWithParam<Solid> {};

TEST_P(Solids, AreWhatSquaresSeeThatAreTurnedAllWays) {
  constexpr int kSide = 32, kPoints = 120;
  Sampler sampler;
  for (const double width : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.2, 2.7}) {
    double squares = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 p = GetParam().point(sampler);
      double sum = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          // A point of the square, and any direction for it: both ways.
          const auto offset = [&](int k) { return width * ((k + sampler.uniform(0, 1)) / kSide - 0.5); };
          const double away = std::hypot(offset(x), offset(y)), z = sampler.uniform(-1, 1), r = std::sqrt(1 - z * z),
                       turn = sampler.uniform(0, 2 * M_PI);
          const Vec3 way = {{away * r * std::cos(turn), away * r * std::sin(turn), away * z}};
          sum += GetParam().value(p + way, 0) + GetParam().value(p - way, 0);
        }
      const double error = GetParam().value(p, width) - sum / (2 * kSide * kSide);
      squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / kPoints), GetParam().mean_square) << GetParam().name << " at width " << width;
  }
}

/// Nothing comes back as the footprint grows.
TEST_P(Solids, LoseContrastAsTheFootprintGrows) {
  double before = INFINITY;
  for (const double width : {0.0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.3, 1.7, 2.2, 3.0, 5.0}) {
    Sampler sampler;
    constexpr int kPoints = 4000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 p = GetParam().point(sampler);
      const double value = GetParam().value(p, width);
      sum += value, squares += value * value;
    }
    const double deviation = std::sqrt(std::max(0.0, squares / kPoints - sum / kPoints * (sum / kPoints)));
    EXPECT_LE(deviation, before + 1e-6) << GetParam().name << " at width " << width;
    before = deviation;
  }
  EXPECT_LT(before, 1e-5) << GetParam().name;
}

INSTANTIATE_TEST_SUITE_P(All, Solids, testing::ValuesIn(kSolids), [](const auto& info) {
  std::string name = info.param.name;
  std::erase(name, ' ');
  return name;
});

TEST_P(Patterns, StayInRangeAndEndInTheirMean) {
  Sampler sampler;
  double sum = 0;
  constexpr int kPoints = 200000;
  for (int i = 0; i < kPoints; ++i) {
    const double value = GetParam().value(sampler.point(), 0);
    ASSERT_GE(value, 0) << GetParam().name;
    ASSERT_LE(value, 1) << GetParam().name;
    sum += value;
  }
  for (const double width : {200.0, 1e6, 1e30, double(INFINITY)}) {
    const double mean = GetParam().value(sampler.point(), width);
    EXPECT_NEAR(mean, sum / kPoints, 0.004) << GetParam().name << " at width " << width;
  }
  for (int i = 0; i < 2000; ++i) {
    const double value = GetParam().value(sampler.point(), std::exp2(sampler.uniform(-20, 8)));
    ASSERT_GE(value, -1e-9) << GetParam().name;
    ASSERT_LE(value, 1 + 1e-9) << GetParam().name;
  }
}

/// A narrow footprint changes nothing away from edges, in floats too: no noise from cancellation.
TEST_P(Patterns, AreThemselvesThroughAVeryNarrowFootprint) {
  Sampler sampler;
  int changed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p = sampler.point();
    changed += std::abs(GetParam().value(p, 1e-6) - GetParam().value(p, 0)) > 1e-4;
  }
  EXPECT_LE(changed, 2) << GetParam().name;
}

TEST_P(Patterns, GiveNanForNan) {
  EXPECT_TRUE(std::isnan(GetParam().value(Vec2{{NAN, 0.3}}, 0.1))) << GetParam().name;
  EXPECT_TRUE(std::isnan(GetParam().value(Vec2{{INFINITY, 0.3}}, 0.1))) << GetParam().name;
}

INSTANTIATE_TEST_SUITE_P(All, Patterns, testing::ValuesIn(kPatterns), [](const auto& info) {
  std::string name = info.param.name;
  std::erase(name, ' ');
  return name;
});

TEST(Cells, OfBricksAreOneNumberEach) {
  // By rows and columns of running bond: the number changes where a joint lies between, and nowhere else.
  Sampler sampler;
  for (int i = 0; i < 500; ++i) {
    const Vec2 p = sampler.point();
    const auto here = brick<double>(p, 0, 0.1, 0, 0.5, 2);
    const double shift = std::floor(p[1]) - 2 * std::floor(std::floor(p[1]) / 2); // 0 or 1
    const double column = std::floor((p[0] + shift) / 2), x = column * 2 - shift + 1;
    const auto middle = brick<double>(Vec2{{x, std::floor(p[1]) + 0.5}}, 0, 0.1, 0, 0.5, 2);
    EXPECT_EQ(here.second, middle.second);
    EXPECT_NEAR(middle.third, 0.45, 1e-12);
    EXPECT_EQ(here.first, here.third > 0 ? 1 : 0) << p[0] << " " << p[1];
  }
}

TEST(Cells, OfEveryBondLieWhereTheValueSays) {
  Sampler sampler;
  for (const double bond : {0.0, 0.25, 0.5, 1.0, 2.0}) {
    std::map<double, int> seen;
    for (int i = 0; i < 4000; ++i) {
      const auto at = brick<double>(sampler.point(), 0, 0.1, 0, bond, 2);
      if (std::abs(at.third) > 1e-9) EXPECT_EQ(at.first, at.third > 0 ? 1 : 0) << "bond " << bond;
      EXPECT_LE(at.third, 0.45 + 1e-12);
      ++seen[at.second];
    }
    EXPECT_GT(seen.size(), 2000u) << "bond " << bond; // of 7200 bricks and more
  }
}

TEST(Cells, DistancesAreZeroOnTheEdge) {
  Sampler sampler;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = sampler.point();
    const auto h = hexagons<double>(p, 0, 0.1, 0);
    if (std::abs(h.third) > 1e-9) EXPECT_EQ(h.first, h.third > 0 ? 1 : 0);
    const auto d = dots<double>(p, 0, 0.3);
    EXPECT_EQ(d.first, d.third >= 0 ? 1 : 0);
    const auto v = voronoi<double, 2>(p, 0, 0.1, 1);
    if (std::abs(v.third) > 1e-9) EXPECT_EQ(v.first, v.third > 0 ? 1 : 0);
    const auto t = tiles<double>(p, 0, 0.1, 0);
    if (std::abs(t.third) > 1e-9) EXPECT_EQ(t.first, t.third > 0 ? 1 : 0);
  }
}

/// The nearest border, by going there: nowhere nearer is another cell, and just beyond it is one.
template <int N, class Direction> void expect_nearest_borders(int points, int directions, Direction direction) {
  Sampler sampler;
  for (int i = 0; i < points; ++i) {
    Vec<N, double> p;
    for (int axis = 0; axis < N; ++axis)
      p[axis] = sampler.uniform(-60, 60);
    const auto at = voronoi<double, N>(p, 0, 0, 1);
    bool beyond = false;
    for (int k = 0; k < directions; ++k) {
      const Vec<N, double> way = direction(k);
      const auto cell_at = [&](double r) {
        Vec<N, double> q = p;
        for (int axis = 0; axis < N; ++axis)
          q[axis] += r * way[axis];
        return voronoi<double, N>(q, 0, 0, 1).second;
      };
      EXPECT_EQ(cell_at(at.third * 0.99), at.second);
      beyond |= cell_at(at.third * 1.05 + 1e-9) != at.second;
    }
    EXPECT_TRUE(beyond);
  }
}
TEST(Cells, BordersOfVoronoiAreTheNearest) {
  expect_nearest_borders<2>(300, 64,
                            [](int k) { return Vec2{{std::cos(k * 2 * M_PI / 64), std::sin(k * 2 * M_PI / 64)}}; });
}
/// Those of space, too, where two cells with a border may lie two steps apart.
TEST(Cells, BordersOfVoronoiOfSpaceAreTheNearest) {
  constexpr int kDirections = 500;
  expect_nearest_borders<3>(400, kDirections, [](int k) { // a spiral over the sphere
    const double z = 1 - (2.0 * k + 1) / kDirections, r = std::sqrt(1 - z * z), turn = k * 2.399963229728653;
    return Vec3{{r * std::cos(turn), r * std::sin(turn), z}};
  });
}
/// Sites stay in their cells, whatever is asked.
TEST(Cells, JitterOfVoronoiIsClamped) {
  Sampler sampler;
  for (int i = 0; i < 100; ++i) {
    const Vec2 p = sampler.point();
    EXPECT_EQ((voronoi<double, 2>(p, 0, 0, 3).third), (voronoi<double, 2>(p, 0, 0, 1).third));
    EXPECT_EQ((voronoi<double, 2>(p, 0, 0, -1).third), (voronoi<double, 2>(p, 0, 0, 0).third));
  }
}

TEST(Checker, IsTheParityOfTheFloors) {
  for (const double x : {-2.0, -1.5, -1.0, 0.0, 0.25, 1.0, 1.5, 2.0})
    for (const double y : {-1.0, 0.0, 0.5, 1.0, 3.0}) {
      const double sum = std::floor(x) + std::floor(y);
      EXPECT_EQ(checker<double>(Vec2{{x, y}}, 0.0), std::abs(std::fmod(sum, 2))) << x << " " << y;
    }
}

TEST(FilteredStep, IsTheStepItsRampAndTheirFilter) {
  EXPECT_EQ(filtered_step(0.0, 0.0, 0.0), 1);
  EXPECT_EQ(filtered_step(-1e-300, 0.0, 0.0), 0);
  EXPECT_DOUBLE_EQ(filtered_step(0.1, 1.0, 0.0), 0.6);
  EXPECT_DOUBLE_EQ(filtered_step(0.1, 0.0, 1.0), 0.6);
  EXPECT_DOUBLE_EQ(filtered_step(0.0, 0.3, 0.7), 0.5);
  EXPECT_DOUBLE_EQ(filtered_step(-0.25, 0.5, 0.5), 0.125); // two boxes alike: a triangle's integral
  EXPECT_EQ(filtered_step(2.0, 1.0, 1.0), 1);
}

} // namespace
} // namespace moonshade::stdlib
