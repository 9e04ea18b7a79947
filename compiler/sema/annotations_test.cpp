// Annotations: what is read of a comment, and what differs from the inferred types.
#include "compiler/sema/annotations.h"
#include "compiler/sema/checked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::sema {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string read(const std::string& text) {
  const auto annotation = read_annotation({{FileId{0}, 0, static_cast<uint32_t>(text.size())}, text});
  if (!annotation) return "nothing";
  std::string result(annotation->name);
  for (const AnnotatedType& type : annotation->types) {
    EXPECT_EQ(text.substr(type.span.begin, type.span.size()), type.text);
    result += " <" + std::string(type.text) + ">";
  }
  return result;
}

TEST(Annotations, AreRead) {
  EXPECT_EQ(read("---@param p vec3"), "p <vec3>");
  EXPECT_EQ(read("---@param p? vec3 the point"), "p <vec3>");
  EXPECT_EQ(read("--- @param f fun(x: number, y: vec3): number  a function"), "f <fun(x: number, y: vec3): number>");
  EXPECT_EQ(read("---@param x integer | number # one"), "x <integer | number>");
  EXPECT_EQ(read("---@return number"), " <number>");
  EXPECT_EQ(read("---@return number size, vec3? # a, b"), " <number> <vec3?>");
  EXPECT_EQ(read("---@type vec2, table<string, number>"), " <vec2> <table<string, number>>");
  for (const char* other :
       {"-- @param p vec3", "---@param p", "---@param", "---@class x", "--[[---@type a]]", "---", ""})
    EXPECT_EQ(read(other), "nothing") << other;
}

std::vector<std::string> errors(const std::string& text) { return Checked(text).errors(); }

TEST(Annotations, ThatFitAreRight) {
  EXPECT_THAT(errors("---@param p vec3\n---@return number\nfunction height(p) return p.x end"), IsEmpty());
  EXPECT_THAT(errors("---@param x number\n---@return number\nlocal function f(x) return x end\n"
                     "function height(p) return f(1) + f(p.x) end"),
              IsEmpty());
  EXPECT_THAT(errors("---@type vec3?, boolean\nlocal a, b = vec3(1), true\nfunction color(p) return b and a or p end"),
              IsEmpty());
  EXPECT_THAT(errors("---@param f fun(x: number): number\n---@param m string\nlocal function call(f, m, x)\n"
                     "  return x\nend\n---@return any\nfunction height(p) return call(1, 'a', p.x) end"),
              IsEmpty());
}

TEST(Annotations, ThatDifferAreErrorsAtTheType) {
  EXPECT_THAT(errors("---@param p vec2\nfunction height(p) return p.x end"), ElementsAre("1:13 annotation-mismatch"));
  EXPECT_THAT(errors("---@return vec3\nfunction height(p) return p.x end"), ElementsAre("1:12 annotation-mismatch"));
  EXPECT_THAT(errors("---@return number, number\nfunction height(p) return p.x end"),
              ElementsAre("1:20 annotation-mismatch"));
  EXPECT_THAT(errors("function height(p)\n  ---@type integer\n  local x = p.x\n  return x\nend"),
              ElementsAre("2:12 annotation-mismatch"));
  EXPECT_THAT(
      errors("---@param x integer|boolean\nlocal f = function(x) return x end\nfunction height(p) return f(p.x) end"),
      ElementsAre("1:13 annotation-mismatch"));
  EXPECT_THAT(errors("---@type table\nlocal a = 1\nfunction height(p) return p.x + a end"),
              ElementsAre("1:10 annotation-mismatch"));
}

TEST(Annotations, AreComparedInEverySpecialisation) {
  const Checked checked("---@param v vec3\nlocal function f(v) return v.x end\n"
                        "function height(p, uv) return f(p) + f(uv) end");
  EXPECT_THAT(checked.errors(), ElementsAre("1:13 annotation-mismatch"));
  EXPECT_THAT(checked.text, HasSubstr("'v' is annotated as 'vec3', but is a vec2"));
  EXPECT_THAT(checked.text, HasSubstr("test.lua:3:38: note: in f(vec2), called here"));
}

TEST(Annotations, WithAMisspeltNameAreWarnedOf) {
  EXPECT_THAT(Checked("---@param pp vce3\nfunction height(p) return p.x end").warnings(),
              ElementsAre("1:11 annotated-parameter"));
  EXPECT_THAT(Checked("---@param p vce3\nfunction height(p) return p.x end").warnings(),
              ElementsAre("1:13 annotated-type"));
  EXPECT_THAT(Checked("---@param p Point\nfunction height(p) return p.x end").warnings(), IsEmpty());
}

} // namespace
} // namespace moonshade::sema
