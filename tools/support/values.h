// Values as the command line reads and prints them.
#pragma once

#include "stdlib/library.h"
#include "stdlib/value_type.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::tools {

/// One component of a value: which member counts follows from the value's type.
union Scalar {
  double number;
  int64_t integer;
  bool boolean;
};

/// Reads one component of a value of this type: a number (decimal, hexadecimal, nan, inf), an integer or a boolean
/// (true, false, 1, 0). Blanks around it do not count.
std::optional<Scalar> parse_scalar(ValueType type, std::string_view text);

/// Reads "1", "true" or "0.5, 1, 2": exactly as many components as the type has.
std::optional<std::vector<Scalar>> parse_value(ValueType type, std::string_view text);

/// Appends one component: %.9g or %.17g for numbers (nan, inf, -inf), plain integers, true and false.
void append_scalar(std::string& out, ValueType type, Scalar value, Precision precision);

/// "p.x" for component 0 of a vector "p"; the name itself for plain values.
std::string component_name(const std::string& name, ValueType type, unsigned component);

} // namespace moonshade::tools
