// The frames of an animation, and the names of their files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace moonshade::moonrender {

struct Frames {
  int64_t first = 0, last = 0;
  double per_second = 24;

  double time_of(int64_t frame) const { return double(frame) / per_second; }
};

/// "A" or "A-B", both integers, B not before A; an error, or empty.
std::string parse_frames(std::string_view text, Frames& frames);

/// Is there a place for the frame's number: %d, %4d or %04d?
bool has_frame_number(std::string_view name);

/// The name with the number in its place; "%%" is a per cent sign.
std::string frame_name(std::string_view name, int64_t frame);

} // namespace moonshade::moonrender
