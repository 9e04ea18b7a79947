// The reducer: generated programs have one statement a line, indented by their nesting, so that a line with what stands
// deeper below it is a unit that can be left out. A candidate that no longer compiles has another verdict and is
// dropped.
#include "tests/oracle/compare.h"

#include <sstream>

namespace moonshade::oracle {
namespace {

using Lines = std::vector<std::string>;

Lines split(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

std::string join(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines)
    text += line + "\n";
  return text;
}

size_t indent_of(const std::string& line) { return line.find_first_not_of(' '); }

/// One past the last line of the unit that begins at `first`: the line alone, or the block up to its end.
size_t unit_end(const Lines& lines, size_t first) {
  const size_t indent = indent_of(lines[first]);
  size_t last = first + 1;
  while (last < lines.size() && indent_of(lines[last]) > indent)
    ++last;
  if (last == first + 1) return last;
  // else and elseif go on; end and until close
  while (last < lines.size() && indent_of(lines[last]) == indent && lines[last].compare(indent, 4, "else") == 0) {
    ++last;
    while (last < lines.size() && indent_of(lines[last]) > indent)
      ++last;
  }
  return last < lines.size() ? last + 1 : last;
}

} // namespace

std::string reduce(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed,
                   Verdict verdict) {
  Lines lines = split(text);
  const auto still_fails = [&](const Lines& candidate) {
    return compare(join(candidate), variants, point_seed).verdict == verdict;
  };
  for (bool shrunk = true; shrunk;) {
    shrunk = false;
    for (size_t i = 0; i < lines.size();) {
      const size_t end = unit_end(lines, i);
      Lines without(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(i));
      without.insert(without.end(), lines.begin() + static_cast<std::ptrdiff_t>(end), lines.end());
      Lines unwrapped = without; // the block's inside without its frame
      if (end - i > 2)
        unwrapped.insert(unwrapped.begin() + static_cast<std::ptrdiff_t>(i),
                         lines.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                         lines.begin() + static_cast<std::ptrdiff_t>(end) - 1);
      if (still_fails(without)) {
        lines = std::move(without);
        shrunk = true;
      } else if (end - i > 2 && still_fails(unwrapped)) {
        lines = std::move(unwrapped);
        shrunk = true;
      } else {
        ++i;
      }
    }
  }
  return join(lines);
}

} // namespace moonshade::oracle
