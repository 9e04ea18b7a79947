// The definitions name everything that the library has, and are Lua.
#include "compiler/sema/luals.h"

#include "compiler/sema/checked.h"
#include "compiler/sema/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::sema {
namespace {

using ::testing::HasSubstr;

TEST(Luals, DefinesEveryFunction) {
  const std::string text = luals_definitions();
  for (const std::string_view name : library_names("")) {
    const std::string function(name);
    if (function == "math" || function == "assert" || function == "error" || function == "print" ||
        function == "require")
      continue;
    EXPECT_THAT(text, HasSubstr("\nfunction " + function + "(")) << function;
  }
}

TEST(Luals, IsLua) {
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  syntax::parse(sources, sources.add("moonshade.lua", luals_definitions()), arena, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(Luals, HasOverloadsDocumentationAndMethods) {
  const std::string text = luals_definitions();
  EXPECT_THAT(text,
              HasSubstr("---From a at t = 0 to b at t = 1, along a line.\n---@param a number\n---@param b number\n"
                        "---@param t number\n---@return number\n"
                        "---@overload fun(a: vec2|number, b: vec2|number, t: vec2|number): vec2\n"));
  EXPECT_THAT(text, HasSubstr("---@operator add(vec3): vec3\n---@operator add(number): vec3\n"));
  EXPECT_THAT(text, HasSubstr("---@operator mul(vec4): vec4\n---@operator unm: mat4\n"));
  EXPECT_THAT(text, HasSubstr("---@field length (fun(self: vec3): number)\n"));
  EXPECT_THAT(text, HasSubstr("---@field zyx vec3\n"));
}

} // namespace
} // namespace moonshade::sema
