// Values as the command line reads and prints them. Relies on the "C" locale, which no program of ours changes.
#include "tools/support/values.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace moonshade::tools {

namespace {

std::string_view trim(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::optional<double> parse_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

std::optional<int64_t> parse_integer(const std::string& text) {
  char* end = nullptr;
  errno = 0;
  const bool hexadecimal = text.find_first_of("xX") != std::string::npos;
  const long long value = std::strtoll(text.c_str(), &end, hexadecimal ? 16 : 10);
  if (errno != 0 || end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

} // namespace

std::optional<Scalar> parse_scalar(ValueType type, std::string_view text) {
  const std::string trimmed(trim(text));
  if (trimmed.empty()) return std::nullopt;
  Scalar scalar{};
  if (type == ValueType::Boolean) {
    if (trimmed == "true" || trimmed == "1")
      scalar.boolean = true;
    else if (trimmed == "false" || trimmed == "0")
      scalar.boolean = false;
    else
      return std::nullopt;
  } else if (type == ValueType::Integer) {
    const auto value = parse_integer(trimmed);
    if (!value) return std::nullopt;
    scalar.integer = *value;
  } else {
    const auto value = parse_number(trimmed);
    if (!value) return std::nullopt;
    scalar.number = *value;
  }
  return scalar;
}

std::optional<std::vector<Scalar>> parse_value(ValueType type, std::string_view text) {
  std::vector<Scalar> components;
  for (;;) {
    const size_t comma = text.find(',');
    const auto scalar = parse_scalar(type, text.substr(0, comma));
    if (!scalar || components.size() == component_count(type)) return std::nullopt;
    components.push_back(*scalar);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (components.size() != component_count(type)) return std::nullopt;
  return components;
}

void append_scalar(std::string& out, ValueType type, Scalar value, Precision precision) {
  char buffer[40];
  if (type == ValueType::Boolean) {
    out += value.boolean ? "true" : "false";
  } else if (type == ValueType::Integer) {
    out += std::to_string(value.integer);
  } else if (std::isnan(value.number)) {
    out += "nan"; // printf would show its sign
  } else {
    std::snprintf(buffer, sizeof buffer, precision == Precision::F32 ? "%.9g" : "%.17g", value.number);
    out += buffer;
  }
}

std::string component_name(const std::string& name, ValueType type, unsigned component) {
  if (!is_vector(type)) return name;
  return name + "." + "xyzw"[component];
}

} // namespace moonshade::tools
