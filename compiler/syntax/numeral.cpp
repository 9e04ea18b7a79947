// Floats are read by the C library's strtod in the "C" locale, as Lua reads them, whatever the locale of the process.
#include "compiler/syntax/numeral.h"

#include "compiler/syntax/characters.h"

#include <clocale>
#include <cstdlib>
#include <string>

namespace moonshade::syntax {
namespace {

bool is_hexadecimal(std::string_view text) {
  return text.size() >= 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
}

std::optional<int64_t> hexadecimal_integer(std::string_view digits) {
  uint64_t value = 0;
  for (const char c : digits) {
    if (!is_hex_digit(c)) return {};
    value = value * 16 + hex_digit_value(c);
  }
  if (digits.empty()) return {};
  return static_cast<int64_t>(value);
}

std::optional<int64_t> decimal_integer(std::string_view digits) {
  uint64_t value = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return {};
    const auto digit = static_cast<uint64_t>(c - '0');
    if (value > (INT64_MAX - digit) / 10) return {}; // does not fit: a float
    value = value * 10 + digit;
  }
  if (digits.empty()) return {};
  return static_cast<int64_t>(value);
}

std::optional<double> floating(std::string_view text) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  if (text.find_first_of("nN") != std::string_view::npos) return {}; // neither "inf" nor "nan"
  const std::string terminated(text);
  char* end = nullptr;
  const double value = strtod_l(terminated.c_str(), &end, c_locale);
  if (terminated.empty() || end != terminated.c_str() + terminated.size()) return {};
  return value;
}

} // namespace

std::optional<std::variant<int64_t, double>> numeral_value(std::string_view text) {
  const auto integer = is_hexadecimal(text) ? hexadecimal_integer(text.substr(2)) : decimal_integer(text);
  if (integer) return *integer;
  if (const auto number = floating(text)) return *number;
  return {};
}

} // namespace moonshade::syntax
