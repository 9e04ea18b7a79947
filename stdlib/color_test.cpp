// Colour against published values and an integrated black body; shapes, splines and matrices against what defines them.
#include "stdlib/color.h"
#include "stdlib/matrix.h"
#include "stdlib/sdf.h"
#include "stdlib/spline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace moonshade::stdlib {
namespace {

using Vec3 = Vec<3, double>;

void expect_near(const Vec3& found, const Vec3& expected, double tolerance, const char* what) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance) << what << " component " << i;
}

TEST(Color, SrgbIsItsStandard) {
  EXPECT_NEAR(srgb2linear(0.5), 0.21404114, 1e-8);
  EXPECT_NEAR(linear2srgb(0.5), 0.73535698, 1e-8);
  EXPECT_NEAR(srgb2linear(1.0), 1, 1e-15);
  EXPECT_EQ(srgb2linear(0.0), 0);
  EXPECT_NEAR(srgb2linear(0.04045), 0.04045 / 12.92, 1e-7) << "the line meets the curve";
  for (double x = 0; x <= 1; x += 1.0 / 255)
    EXPECT_NEAR(linear2srgb(srgb2linear(x)), x, 1e-6);
}

TEST(Color, OklabHasItsPublishedValues) {
  // Of red, from the author's table of XYZ pairs by way of his code.
  expect_near(rgb2oklab(Vec3{{1, 0, 0}}), Vec3{{0.62796, 0.22486, 0.12585}}, 1e-5, "red");
  expect_near(rgb2oklab(Vec3{{1, 1, 1}}), Vec3{{1, 0, 0}}, 1e-6, "white");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.2, 1.5);
  for (int i = 0; i < 100; ++i) {
    const Vec3 color = {{uniform(random), uniform(random), uniform(random)}};
    expect_near(oklab2rgb(rgb2oklab(color)), color, 2e-6, "there and back");
  }
}

TEST(Color, HsvIsItsHexcone) {
  expect_near(hsv2rgb(Vec3{{0, 1, 1}}), Vec3{{1, 0, 0}}, 1e-12, "red");
  expect_near(hsv2rgb(Vec3{{1.0 / 6, 1, 0.5}}), Vec3{{0.5, 0.5, 0}}, 1e-12, "dark yellow");
  expect_near(hsv2rgb(Vec3{{-1.0 / 3, 0.5, 1}}), Vec3{{0.5, 0.5, 1}}, 1e-12, "pale blue, a turn below");
  expect_near(rgb2hsv(Vec3{{0, 0, 0}}), Vec3{{0, 0, 0}}, 0, "black");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 color = {{uniform(random), uniform(random), uniform(random)}};
    const Vec3 hsv = rgb2hsv(color);
    EXPECT_GE(hsv[0], 0);
    EXPECT_LT(hsv[0], 1);
    expect_near(hsv2rgb(hsv), color, 1e-12, "there and back");
  }
}

/// Planck's law under the CIE 1931 observer, by the multi-lobe fit of Wyman, Sloan and Shirley (2013).
Vec3 planck(double kelvins) {
  const auto lobe = [](double x, double mean, double low, double high) {
    const double t = (x - mean) / (x < mean ? low : high);
    return std::exp(-0.5 * t * t);
  };
  std::array<double, 3> xyz{};
  for (double nm = 360; nm <= 830; nm += 1) {
    const double power = std::pow(nm * 1e-3, -5) / (std::exp(1.438777e7 / (nm * kelvins)) - 1);
    xyz[0] += power * (1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                       0.065 * lobe(nm, 501.1, 20.4, 26.2));
    xyz[1] += power * (0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1));
    xyz[2] += power * (1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8));
  }
  const auto [x, y, z] = xyz;
  const Vec3 rgb = {{std::max(3.2404542 * x - 1.5371385 * y - 0.4985314 * z, 0.0),
                     std::max(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z, 0.0),
                     std::max(0.0556434 * x - 0.2040259 * y + 1.0572252 * z, 0.0)}};
  const double greatest = std::max({rgb[0], rgb[1], rgb[2]});
  return {{rgb[0] / greatest, rgb[1] / greatest, rgb[2] / greatest}};
}

TEST(Color, BlackbodyIsPlancks) {
  for (const double kelvins : {1500.0, 2000.0, 2700.0, 4000.0, 5000.0, 6500.0, 10000.0, 20000.0})
    expect_near(blackbody(kelvins), planck(kelvins), 0.03, std::to_string(kelvins).c_str());
  expect_near(blackbody(0.0), blackbody(1000.0), 0, "clamped below");
  expect_near(blackbody(1e9), blackbody(40000.0), 0, "clamped above");
}

// Shapes --------------------------------------------------------------------------------------------------------------

TEST(Shapes, AreDistances) {
  // The surface's nearest point lies at that distance, along the slope: one step leads to it.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-2, 2);
  const Vec3 half = {{1, 0.5, 0.7}}, a = {{-0.5, 0, 0.2}}, b = {{0.6, 0.4, -0.3}};
  const auto shapes = {+[](Vec3 p, Vec3, Vec3, Vec3) { return sd_sphere(p, 0.8); },
                       +[](Vec3 p, Vec3 h, Vec3, Vec3) { return sd_box(p, h, 0.2); },
                       +[](Vec3 p, Vec3, Vec3, Vec3) { return sd_torus(p, 1.0, 0.3); },
                       +[](Vec3 p, Vec3, Vec3 a, Vec3 b) { return sd_capsule(p, a, b, 0.25); },
                       +[](Vec3 p, Vec3, Vec3, Vec3) { return sd_plane(p, Vec3{{0.6, 0.8, 0}}, 0.5); }};
  int index = 0;
  for (const auto& shape : shapes) {
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = {{uniform(random), uniform(random), uniform(random)}};
      const auto distance = [&](const Vec3& at) { return shape(at, half, a, b); };
      const double d = distance(p), h = 1e-6;
      if (d < 0) continue; // inside, the nearest point may be past a crease
      Vec3 slope;
      for (int k = 0; k < 3; ++k) {
        Vec3 above = p, below = p;
        above[k] += h, below[k] -= h;
        slope[k] = (distance(above) - distance(below)) / (2 * h);
      }
      EXPECT_NEAR(length(slope), 1, 1e-4) << "shape " << index;
      EXPECT_NEAR(distance(madd(slope, -d, p)), 0, 1e-4) << "shape " << index;
    }
    ++index;
  }
  EXPECT_DOUBLE_EQ(sd_box(Vec3{{0, 0, 0}}, half, 0.0), -0.5);
  EXPECT_DOUBLE_EQ(sd_capsule(Vec3{{0, 3, 0}}, a, a, 1.0), length(Vec3{{0.5, 3, -0.2}}) - 1) << "no line";
}

TEST(Shapes, JoinSharplyAndSmoothly) {
  EXPECT_EQ(union_of(1.0, 2.0, 0.0), 1);
  EXPECT_EQ(intersect(1.0, 2.0, 0.0), 2);
  EXPECT_EQ(subtract(1.0, 2.0, 0.0), 1);
  EXPECT_EQ(subtract(-1.0, -2.0, 0.0), 2);
  EXPECT_EQ(union_of(1.0, 2.0, 0.5), 1) << "too far apart to blend";
  EXPECT_DOUBLE_EQ(union_of(1.0, 1.0, 0.4), 0.9);
  EXPECT_DOUBLE_EQ(intersect(1.0, 1.0, 0.4), 1.1);
  for (double x = -1; x < 1; x += 0.01) {
    EXPECT_LE(union_of(x, 0.1, 0.5), std::min(x, 0.1));
    EXPECT_GE(union_of(x, 0.1, 0.5), std::min(x, 0.1) - 0.125);
  }
}

// Splines -------------------------------------------------------------------------------------------------------------

TEST(Splines, PassThroughOrNearTheirValues) {
  EXPECT_EQ(catmullrom(0.0, 1.0, 2.0, 5.0, 9.0), 2);
  EXPECT_DOUBLE_EQ(catmullrom(1.0, 1.0, 2.0, 5.0, 9.0), 5);
  EXPECT_DOUBLE_EQ(catmullrom(0.5, 1.0, 2.0, 3.0, 4.0), 2.5) << "a line stays one";
  EXPECT_DOUBLE_EQ(bspline(0.0, 1.0, 2.0, 3.0, 9.0), 2);
  EXPECT_DOUBLE_EQ(bspline(0.5, 1.0, 2.0, 3.0, 4.0), 2.5);
  EXPECT_DOUBLE_EQ(bspline(1.0, 0.0, 0.0, 6.0, 0.0), 4);
}

TEST(Splines, OfTablesAreContinuousFromSpanToSpan) {
  const double values[] = {0, 1, 0.2, 0.7, 0.1, 0.9};
  const auto value = [&](double i) { return values[int(i)]; };
  EXPECT_EQ(table_linear(0.0, 6, value), 0);
  EXPECT_EQ(table_linear(1.0, 6, value), 0.9);
  EXPECT_DOUBLE_EQ(table_linear(0.3, 6, value), 0.6);
  EXPECT_EQ(table_linear(2.0, 6, value), 0.9) << "clamped";
  EXPECT_EQ(table_catmullrom(0.0, 6, value), 1) << "the second value, as in RenderMan";
  EXPECT_NEAR(table_catmullrom(1.0, 6, value), 0.1, 1e-15);
  for (int i = 1; i < 3; ++i) {
    const double at = i / 3.0, h = 1e-7;
    EXPECT_NEAR(table_catmullrom(at - h, 6, value), table_catmullrom(at + h, 6, value), 1e-5);
    EXPECT_NEAR(table_bspline(at - h, 6, value), table_bspline(at + h, 6, value), 1e-5);
  }
  const auto one = [&](double) { return 4.0; };
  EXPECT_EQ(table_linear(0.5, 1, one), 4);
}

// Matrices ------------------------------------------------------------------------------------------------------------

template <int N> Mat<N, double> some_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-2, 2);
  return matrix_of<double, N>([&](int row, int column) { return uniform(random) + (row == column ? 3 : 0); });
}

template <int N> void expect_identity(const Mat<N, double>& m, double tolerance) {
  for (int column = 0; column < N; ++column)
    for (int row = 0; row < N; ++row)
      EXPECT_NEAR(m[column][row], row == column ? 1 : 0, tolerance) << row << " " << column;
}

TEST(Matrices, InverseTimesMatrixIsTheIdentity) {
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const auto m3 = some_matrix<3>(random);
    const auto m4 = some_matrix<4>(random);
    expect_identity(multiply<double>(inverse<double>(m3), m3), 1e-9);
    expect_identity(multiply<double>(inverse<double>(m4), m4), 1e-9);
    const auto product = multiply<double>(m4, transpose<double>(m4));
    EXPECT_NEAR(determinant<double>(product) / (determinant<double>(m4) * determinant<double>(m4)), 1, 1e-9);
  }
}

TEST(Matrices, RotationsTurnCounterClockwise) {
  expect_near(rotate<double>(Vec3{{1, 0, 0}}, Vec3{{0, 0, 5}}, M_PI / 2), Vec3{{0, 1, 0}}, 1e-15, "x to y about z");
  const Vec3 axis = {{1, -2, 0.5}}, v = {{0.3, 0.7, -1}};
  const auto m = rotate<double>(axis, 0.8);
  expect_near(multiply<double>(m, v), rotate<double>(v, axis, 0.8), 1e-14, "matrix and vector agree");
  expect_near(multiply<double>(m, axis), axis, 1e-14, "the axis stays");
  expect_identity(multiply<double>(m, transpose<double>(m)), 1e-14);
  EXPECT_NEAR(determinant<double>(m), 1, 1e-14);
  const auto flat = rotate<double>(Vec<2, double>{{1, 0}}, M_PI / 6);
  EXPECT_NEAR(flat[0], std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(flat[1], 0.5, 1e-15);
}

} // namespace
} // namespace moonshade::stdlib
