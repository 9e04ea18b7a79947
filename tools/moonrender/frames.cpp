// Names are read by hand: a format that a user gives is nothing for printf.
#include "tools/moonrender/frames.h"

#include <charconv>
#include <optional>

namespace moonshade::moonrender {

namespace {

constexpr int64_t kGreatest = 1'000'000'000;

/// An integer at the beginning of the text, which it takes away.
std::optional<int64_t> take_integer(std::string_view& text) {
  int64_t value = 0;
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value > kGreatest || value < -kGreatest) return std::nullopt;
  text.remove_prefix(size_t(end - text.data()));
  return value;
}

/// "%", digits, "d" at `at`: its length and the digits asked for; 0 where there is none.
struct Place {
  size_t length = 0;
  size_t width = 0;
  bool zeros = false;
};
Place place_at(std::string_view name, size_t at) {
  Place place;
  size_t k = at + 1;
  if (k < name.size() && name[k] == '0') place.zeros = true, ++k;
  for (; k < name.size() && name[k] >= '0' && name[k] <= '9' && place.width <= 100; ++k)
    place.width = place.width * 10 + size_t(name[k] - '0');
  if (k < name.size() && name[k] == 'd' && place.width <= 100) place.length = k + 1 - at;
  return place;
}

} // namespace

std::string parse_frames(std::string_view text, Frames& frames) {
  std::string error = "--frames: expected A or A-B, as in 1-240, not '" + std::string(text) + "'";
  std::optional<int64_t> first = take_integer(text);
  if (!first) return error;
  std::optional<int64_t> last = first;
  if (!text.empty()) {
    if (text[0] != '-') return error;
    text.remove_prefix(1);
    last = take_integer(text);
  }
  if (!last || !text.empty()) return error;
  if (*last < *first) return "--frames: the last frame comes before the first";
  frames.first = *first, frames.last = *last;
  return "";
}

bool has_frame_number(std::string_view name) {
  for (size_t at = 0; (at = name.find('%', at)) != std::string_view::npos; ++at) {
    if (place_at(name, at).length > 0) return true;
    if (at + 1 < name.size() && name[at + 1] == '%') ++at;
  }
  return false;
}

std::string frame_name(std::string_view name, int64_t frame) {
  std::string out;
  for (size_t at = 0; at < name.size();) {
    if (name[at] != '%') {
      out += name[at++];
    } else if (at + 1 < name.size() && name[at + 1] == '%') {
      out += '%', at += 2;
    } else if (Place place = place_at(name, at); place.length > 0) {
      std::string digits = std::to_string(frame);
      // Zeros stand behind the sign, blanks before it.
      size_t sign = place.zeros && frame < 0 ? 1 : 0, used = digits.size();
      digits.insert(sign, place.width > used ? place.width - used : 0, place.zeros ? '0' : ' ');
      out += digits;
      at += place.length;
    } else {
      out += name[at++];
    }
  }
  return out;
}

} // namespace moonshade::moonrender
