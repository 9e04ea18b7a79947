#include "tools/moonrender/messages.h"

#include "compiler/base/printable.h"

namespace moonshade::moonrender {

std::string shown(std::string_view line) {
  constexpr size_t kMost = 4000;
  const bool is_long = line.size() > kMost;
  return printable(line.substr(0, kMost), "\t") + (is_long ? " ..." : "");
}

std::string shown_lines(std::string_view lines) {
  std::string text;
  while (!lines.empty()) {
    const size_t end = std::min(lines.find('\n'), lines.size());
    text += shown(lines.substr(0, end)) + "\n";
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return text;
}

std::string of_kind(const std::string& kind, const std::string& message) {
  size_t colon = message.find(": ");
  if (colon == std::string::npos || message.find(": error: ") != std::string::npos) return message;
  std::string text = message.substr(0, colon);
  return text.append(": ").append(kind).append(message.substr(colon));
}

} // namespace moonshade::moonrender
