#include "compiler/base/source.h"

#include <gtest/gtest.h>

namespace moonshade {
namespace {

TEST(Source, PositionsCountBytesFromOne) {
  SourceSet sources;
  const FileId file = sources.add("a.lua", "x\n\xC3\xA4y\n");
  EXPECT_EQ(sources.position(file, 0), (LineColumn{1, 1}));
  EXPECT_EQ(sources.position(file, 1), (LineColumn{1, 2}));
  EXPECT_EQ(sources.position(file, 2), (LineColumn{2, 1}));
  EXPECT_EQ(sources.position(file, 4), (LineColumn{2, 3}));
  EXPECT_EQ(sources.position(file, 6), (LineColumn{3, 1}));
  EXPECT_EQ(sources.position(file, 999), (LineColumn{3, 1}));
}

TEST(Source, LinesEndAsInLua) {
  SourceSet sources;
  const FileId file = sources.add("a.lua", "a\r\nb\n\rc\rd\n\ne");
  EXPECT_EQ(sources.line_text(file, 1), "a");
  EXPECT_EQ(sources.line_text(file, 2), "b");
  EXPECT_EQ(sources.line_text(file, 3), "c");
  EXPECT_EQ(sources.line_text(file, 4), "d");
  EXPECT_EQ(sources.line_text(file, 5), "");
  EXPECT_EQ(sources.line_text(file, 6), "e");
  EXPECT_EQ(sources.line_text(file, 7), "");
  EXPECT_EQ(sources.line_text(file, 0), "");
}

TEST(Source, TextsStayWhereTheyAre) {
  SourceSet sources;
  const FileId first = sources.add("first", "s"); // short enough to live inside the string object
  const std::string_view name = sources.name(first), text = sources.text(first);
  for (int i = 0; i < 1000; ++i)
    sources.add("other", "text");
  EXPECT_EQ(sources.name(first).data(), name.data());
  EXPECT_EQ(sources.text(first).data(), text.data());
  EXPECT_EQ(sources.text(Span{first, 0, 1}), "s");
}

TEST(Source, EmptyTextHasOneEmptyLine) {
  SourceSet sources;
  const FileId file = sources.add("e", "");
  EXPECT_EQ(sources.position(file, 0), (LineColumn{1, 1}));
  EXPECT_EQ(sources.line_text(file, 1), "");
}

TEST(Span, JoinTakesBoth) { EXPECT_EQ(join({0, 5, 7}, {0, 2, 6}), (Span{0, 2, 7})); }

} // namespace
} // namespace moonshade
