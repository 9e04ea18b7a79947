// Makes any bytes safe to show on a terminal: control bytes, invalid UTF-8 and the characters that reorder text are
// written as escapes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace moonshade {

/// How many bytes at the beginning of `text` form one character, and how that is shown. A byte that begins no valid
/// UTF-8 sequence is a character by itself.
struct PrintableCharacter {
  size_t bytes = 0;
  std::string shown;
  /// Columns on a terminal (wide characters are taken for one).
  size_t columns = 0;
};
PrintableCharacter printable_character(std::string_view text);

/// The whole text, made safe. Characters of `kept` stay as they are: line ends and tabs, where a text has lines.
std::string printable(std::string_view text, std::string_view kept = {});

} // namespace moonshade
