// Source texts and places in them. A span is a half-open range of byte offsets; lines and columns are worked out only
// when a message is printed. Names and texts stay where they are for as long as the SourceSet lives, so string views
// into them (the AST holds many) stay valid when further files are added.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade {

/// Index of a file in its SourceSet.
using FileId = uint32_t;

/// The file of a span that belongs to no source text (an option of the command line, say).
inline constexpr FileId kNoFile = UINT32_MAX;

/// Bytes [begin, end) of a file.
struct Span {
  FileId file = kNoFile;
  uint32_t begin = 0;
  uint32_t end = 0;

  constexpr bool has_place() const { return file != kNoFile; }
  constexpr uint32_t size() const { return end - begin; }
  friend constexpr bool operator==(const Span&, const Span&) = default;
};

/// The smallest span that holds both; they must be of the same file.
constexpr Span join(Span a, Span b) { return {a.file, std::min(a.begin, b.begin), std::max(a.end, b.end)}; }

/// Line and column, both from 1; columns count bytes.
struct LineColumn {
  uint32_t line = 1;
  uint32_t column = 1;
  friend constexpr bool operator==(const LineColumn&, const LineColumn&) = default;
};

/// All source texts of one compilation.
class SourceSet {
public:
  /// Takes the text over. A text of 4 GiB or more is cut (the parser refuses far smaller ones).
  FileId add(std::string name, std::string text);

  size_t size() const { return files_.size(); }
  std::string_view name(FileId file) const { return files_.at(file).name; }
  std::string_view text(FileId file) const { return files_.at(file).text; }
  std::string_view text(Span span) const { return text(span.file).substr(span.begin, span.end - span.begin); }

  /// The place of a byte; an offset at or beyond the end of the text is the place just after its last byte.
  LineColumn position(FileId file, uint32_t offset) const;
  uint32_t line_of(Span span) const { return position(span.file, span.begin).line; }

  /// Line `line` (from 1) without its line break; empty where there is no such line.
  std::string_view line_text(FileId file, uint32_t line) const;

private:
  struct File {
    std::string name;
    std::string text;
    std::vector<uint32_t> line_starts;
  };
  std::deque<File> files_;
};

} // namespace moonshade
