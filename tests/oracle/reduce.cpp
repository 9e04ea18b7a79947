// The reducer: generated programs have one statement a line, indented by their nesting, so that a line with what stands
// deeper below it is a unit that can be left out. A candidate that no longer compiles has another verdict and is
// dropped.
#include "tests/oracle/compare.h"

#include <cctype>
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

/// The first error, without its place: a refusal is another one where this is another one.
std::string first_error(const std::string& detail) {
  const size_t begin = detail.find(": error: ");
  return begin == detail.npos ? "" : detail.substr(begin, detail.find('\n', begin) - begin);
}

/// The place behind the parenthesis or brace that closes the one at `open`; npos where the line has none.
size_t closing(const std::string& line, size_t open) {
  int depth = 0;
  for (size_t i = open; i < line.size(); ++i) {
    if (line[i] == '(' || line[i] == '{') ++depth;
    if ((line[i] == ')' || line[i] == '}') && --depth == 0) return i + 1;
  }
  return line.npos;
}

/// A line with simpler expressions: each call and parenthesis replaced by a constant where the program still fails.
template <class StillFails> bool simplify_line(Lines& lines, size_t at, const StillFails& still_fails) {
  bool shrunk = false;
  for (size_t i = 0; i < lines[at].size(); ++i) {
    if (lines[at][i] != '(') continue;
    const size_t end = closing(lines[at], i);
    if (end == lines[at].npos) continue;
    size_t begin = i; // with the name of what is called
    while (begin > 0 && (std::isalnum(static_cast<unsigned char>(lines[at][begin - 1])) ||
                         lines[at][begin - 1] == '_' || lines[at][begin - 1] == '.'))
      --begin;
    const std::string whole = lines[at].substr(begin, end - begin);
    for (const char* simple : {"1.5", "2", "true", "p", "uv"}) {
      if (whole.size() <= std::string_view(simple).size() + 2) break;
      Lines candidate = lines;
      candidate[at].replace(begin, end - begin, simple);
      if (!still_fails(candidate)) continue;
      lines = std::move(candidate);
      shrunk = true;
      break;
    }
  }
  return shrunk;
}

} // namespace

std::string reduce(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed,
                   Verdict verdict) {
  Lines lines = split(text);
  const std::string error = verdict == Verdict::Refused ? first_error(compare(text, variants, point_seed).detail) : "";
  const auto still_fails = [&](const Lines& candidate) {
    if (verdict != Verdict::Refused) return verdict_in_child(join(candidate), variants, point_seed) == verdict;
    const Outcome outcome = compare(join(candidate), variants, point_seed);
    return outcome.verdict == verdict && first_error(outcome.detail) == error;
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
    for (size_t i = 0; i < lines.size(); ++i)
      shrunk = simplify_line(lines, i, still_fails) || shrunk;
  }
  return join(lines);
}

} // namespace moonshade::oracle
