// What files make the program say, in a form that a terminal may show.
#pragma once

#include <string>
#include <string_view>

namespace moonshade::moonrender {

/// One line: control characters are shown as escapes (but for tabs), and what is very long is cut.
std::string shown(std::string_view line);
/// Several, each with an end.
std::string shown_lines(std::string_view lines);

/// "FILE:LINE: message" as "FILE:LINE: error: message"; what the compiler has worded stays.
std::string of_kind(const std::string& kind, const std::string& message);

} // namespace moonshade::moonrender
