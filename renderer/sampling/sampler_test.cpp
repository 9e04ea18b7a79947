#include "renderer/sampling/sampler.h"

#include "renderer/sampling/warp.h"

#include <gtest/gtest.h>
#include <set>

namespace moonshade::renderer {
namespace {

TEST(Sampler, FillsEveryElementaryInterval) {
  // 16 samples of a (0, 2)-sequence: one in each of 16 strips either way, and in each cell of 4 x 4, 2 x 8 and 8 x 2.
  for (uint32_t pixel : {0u, 1u, 77777u})
    for (uint32_t dimension : {0u, 5u, 1234u})
      for (auto [across, down] : {std::pair{16, 1}, {8, 2}, {4, 4}, {2, 8}, {1, 16}}) {
        std::set<std::pair<int, int>> cells;
        for (uint32_t s = 0; s < 16; ++s) {
          Vec2 u = Sampler(9, pixel, s).two(dimension);
          ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
          cells.emplace(int(u.x * float(across)), int(u.y * float(down)));
        }
        EXPECT_EQ(cells.size(), 16u) << across << " x " << down;
      }
}

TEST(Sampler, StratifiesSingleNumbers) {
  std::set<int> strips;
  for (uint32_t s = 0; s < 64; ++s)
    strips.insert(int(Sampler(1, 2, s).one(3) * 64));
  EXPECT_EQ(strips.size(), 64u);
}

TEST(Sampler, DimensionsPixelsAndSeedsAreUnrelated) {
  double products[3] = {};
  constexpr int kCount = 4096;
  for (uint32_t k = 0; k < kCount; ++k) {
    double a = Sampler(1, k, 0).one(3) - 0.5;
    products[0] += a * (Sampler(1, k, 0).one(4) - 0.5);
    products[1] += a * (Sampler(1, k + 1, 0).one(3) - 0.5);
    products[2] += a * (Sampler(2, k, 0).one(3) - 0.5);
  }
  // The mean of kCount products has the standard deviation 1/12 / sqrt(kCount) = 0.0013.
  for (double p : products)
    EXPECT_LT(std::abs(p / kCount), 5 * 0.0013);
}

TEST(Warp, TentHasItsVariance) {
  double sum = 0, squares = 0;
  for (int k = 0; k < 10000; ++k) {
    double x = sample_tent((float(k) + 0.5f) / 10000);
    sum += x, squares += x * x;
  }
  EXPECT_NEAR(sum / 10000, 0, 1e-4);
  EXPECT_NEAR(squares / 10000, 1.0 / 6, 1e-3);
}

} // namespace
} // namespace moonshade::renderer
