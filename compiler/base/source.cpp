// Line tables. A line ends where Lua's lexer ends it: at LF, CR, CR LF or LF CR.
#include "compiler/base/source.h"

namespace moonshade {
namespace {

bool is_line_break(char c) { return c == '\n' || c == '\r'; }

std::vector<uint32_t> find_line_starts(std::string_view text) {
  std::vector<uint32_t> starts = {0};
  for (size_t i = 0; i < text.size();) {
    const char c = text[i++];
    if (!is_line_break(c)) continue;
    if (i < text.size() && is_line_break(text[i]) && text[i] != c) ++i;
    starts.push_back(static_cast<uint32_t>(i));
  }
  return starts;
}

} // namespace

FileId SourceSet::add(std::string name, std::string text) {
  if (text.size() >= UINT32_MAX) text.resize(UINT32_MAX - 1);
  File& file = files_.emplace_back(File{std::move(name), std::move(text), {}});
  file.line_starts = find_line_starts(file.text);
  return static_cast<FileId>(files_.size() - 1);
}

LineColumn SourceSet::position(FileId id, uint32_t offset) const {
  const File& file = files_.at(id);
  offset = std::min(offset, static_cast<uint32_t>(file.text.size()));
  const auto next = std::upper_bound(file.line_starts.begin(), file.line_starts.end(), offset);
  const auto line = static_cast<uint32_t>(next - file.line_starts.begin());
  return {line, offset - file.line_starts[line - 1] + 1};
}

std::string_view SourceSet::line_text(FileId id, uint32_t line) const {
  const File& file = files_.at(id);
  if (line == 0 || line > file.line_starts.size()) return {};
  const uint32_t begin = file.line_starts[line - 1];
  std::string_view text = std::string_view(file.text).substr(begin);
  return text.substr(0, text.find_first_of("\n\r"));
}

} // namespace moonshade
