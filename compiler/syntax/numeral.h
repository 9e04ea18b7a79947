// The value of a numeral, decided exactly as Lua decides it (lobject.c: l_str2int, then l_str2d).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace moonshade::syntax {

/// An integer or a float. Decimal integers that do not fit 64 bits are floats; hexadecimal ones wrap around. Nothing
/// where the text is no numeral. No sign, no blanks.
std::optional<std::variant<int64_t, double>> numeral_value(std::string_view text);

} // namespace moonshade::syntax
