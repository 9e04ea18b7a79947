#include "compiler/base/arena.h"

#include <gtest/gtest.h>

namespace moonshade {
namespace {

TEST(Arena, AlignsAndKeepsValues) {
  Arena arena;
  std::vector<std::pair<char*, double*>> made;
  for (int i = 0; i < 20000; ++i)
    made.emplace_back(arena.make<char>(char(i)), arena.make<double>(double(i)));
  for (int i = 0; i < 20000; ++i) {
    EXPECT_EQ(*made[i].first, char(i));
    EXPECT_EQ(*made[i].second, i);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(made[i].second) % alignof(double), 0u);
  }
  EXPECT_GE(arena.bytes_used(), 20000 * (sizeof(char) + sizeof(double)));
}

TEST(Arena, CopiesTextAndArrays) {
  Arena arena;
  std::string text = "some text";
  const std::string_view copy = arena.copy(std::string_view(text));
  text.assign("other!!!!");
  EXPECT_EQ(copy, "some text");
  std::vector<int> numbers = {1, 2, 3};
  const std::span<int> copied = arena.copy(numbers);
  numbers[0] = 9;
  EXPECT_EQ(copied[0], 1);
  EXPECT_EQ(copied.size(), 3u);
  EXPECT_TRUE(arena.copy(std::vector<int>{}).empty());
  EXPECT_TRUE(arena.copy(std::string_view()).empty());
}

TEST(Arena, TakesBlocksLargerThanItsOwn) {
  Arena arena;
  const std::string large(1 << 20, 'x');
  EXPECT_EQ(arena.copy(std::string_view(large)), large);
  EXPECT_EQ(*arena.make<int>(7), 7);
  for (int value : arena.make_array<int>(100000))
    ASSERT_EQ(value, 0);
}

} // namespace
} // namespace moonshade
