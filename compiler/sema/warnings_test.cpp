// Warnings where tests/lang/warnings_*.lua do not reach: names of odd kinds, no warning beside an error.
#include "compiler/sema/checked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::sema {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Warnings, StandBesideNoError) {
  const Checked checked("function height(p) local a = p.x return undefined end");
  EXPECT_THAT(checked.errors(), ElementsAre("1:41 unknown-name"));
  EXPECT_THAT(checked.warnings(), IsEmpty());
}

TEST(Warnings, OfAnUnusedParameterOfTheShader) {
  EXPECT_THAT(Checked("local a = param('a', 1) function height(p) return p.x end").warnings(),
              ElementsAre("1:7 unused-local"));
}

TEST(Warnings, OfOneWriteOnlyVariableOnce) {
  EXPECT_THAT(Checked("function height(p) local a a = 1 a = 2 return p.x end").warnings(),
              ElementsAre("1:26 unused-local"));
}

TEST(Warnings, NotOfANameThatStandsForTheLibrary) {
  EXPECT_THAT(Checked("local noise = noise function height(p) return noise(p) end").warnings(), IsEmpty());
  EXPECT_THAT(Checked("local max <const> = math.max function height(p) return max(p.x, 1) end").warnings(), IsEmpty());
}

TEST(Warnings, OfAnErrorFunctionOfOnesOwn) {
  EXPECT_THAT(Checked("function error(x) return x end function height(p) local _ = error(1) return p.x end").warnings(),
              ElementsAre("1:10 hidden-library-name"));
}

TEST(Warnings, OfTheFirstStatementOfABlockThatIsNotReached) {
  EXPECT_THAT(Checked("function height(p) while true do break; p = p + 1; p = p + 2 end return p.x end").warnings(),
              ElementsAre("1:41 unreachable-code"));
}

TEST(Warnings, NotOfIntegersInLoops) {
  EXPECT_THAT(Checked("function height(p, frame) while frame ~= 3 do frame = frame + 1 end return p.x end").warnings(),
              IsEmpty());
  EXPECT_THAT(
      Checked("function height(p, frame) while frame ~= p.x do frame = frame + 1 end return p.x end").warnings(),
      ElementsAre("1:33 float-equality-loop"));
}

TEST(Warnings, OfALoopAtTheTopLevel) {
  EXPECT_THAT(Checked("local x = 0.0 while x ~= 1 do x = x + 0.1 end function height(p) return p.x end").warnings(),
              ElementsAre("1:21 float-equality-loop"));
}

} // namespace
} // namespace moonshade::sema
