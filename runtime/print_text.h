// The text of `print`, as stock Lua writes it beside the module `moonshade`.
#pragma once

#include "stdlib/value_type.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace moonshade {

/// A number as Lua writes a float: "0.1", "3.0", "1e+20", "inf"; every NaN as "nan".
std::string lua_number_text(double number);

/// A value of its components: numbers as the bits of a double, integers, booleans as 0 or 1. "vec3(1.0, 2.5, 0.0)".
std::string value_text(ValueType type, std::span<const uint64_t> components);

/// The line of a Print instruction: its text, with the values in the places that it keeps for them (ir.h).
std::string print_line(std::string_view text, std::span<const ValueType> types, const uint64_t* components);

} // namespace moonshade
