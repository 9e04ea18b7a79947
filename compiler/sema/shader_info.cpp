// The inputs of entry points, and values that hosts give to parameters.
#include "compiler/sema/shader_info.h"

#include "compiler/syntax/numeral.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace moonshade {

std::optional<ValueType> input_type(std::string_view name) {
  struct Input {
    std::string_view name;
    ValueType type;
  };
  static constexpr Input kInputs[] = {
      {"p", ValueType::Vec3},      {"P", ValueType::Vec3},        {"n", ValueType::Vec3},
      {"ng", ValueType::Vec3},     {"i", ValueType::Vec3},        {"backface", ValueType::Boolean},
      {"uv", ValueType::Vec2},     {"dpdu", ValueType::Vec3},     {"dpdv", ValueType::Vec3},
      {"time", ValueType::Number}, {"frame", ValueType::Integer}, {"id", ValueType::Integer},
      {"fw", ValueType::Number},
  };
  for (const Input& input : kInputs)
    if (input.name == name) return input.type;
  return std::nullopt;
}

namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string type_text(const ParameterInfo& parameter) {
  if (!parameter.type) return "a string";
  return (*parameter.type == ValueType::Integer ? "an " : "a ") + std::string(name_of(*parameter.type));
}

std::string given_text(const Constant& value) {
  if (std::holds_alternative<bool>(value)) return "a boolean";
  if (std::holds_alternative<int64_t>(value)) return "an integer";
  if (std::holds_alternative<double>(value)) return "a number";
  if (const auto* vector = std::get_if<std::vector<double>>(&value))
    return "a vector of " + std::to_string(vector->size()) + " components";
  return "a string";
}

/// The value as the parameter's type, or nothing.
std::optional<Constant> convert(const ParameterInfo& parameter, const Constant& value) {
  if (!parameter.type) return std::holds_alternative<std::string>(value) ? std::optional(value) : std::nullopt;
  switch (*parameter.type) {
  case ValueType::Boolean:
    return std::holds_alternative<bool>(value) ? std::optional(value) : std::nullopt;
  case ValueType::Integer:
    return std::holds_alternative<int64_t>(value) ? std::optional(value) : std::nullopt;
  case ValueType::Number:
    if (const auto* integer = std::get_if<int64_t>(&value)) return Constant(static_cast<double>(*integer));
    return std::holds_alternative<double>(value) ? std::optional(value) : std::nullopt;
  default:
    if (const auto* vector = std::get_if<std::vector<double>>(&value))
      if (vector->size() == component_count(*parameter.type)) return value;
    return std::nullopt;
  }
}

std::string range_text(const ParameterInfo& parameter) {
  if (parameter.min && parameter.max)
    return "outside " + number_text(*parameter.min) + ".." + number_text(*parameter.max);
  if (parameter.min) return "less than " + number_text(*parameter.min);
  return "greater than " + number_text(parameter.max.value_or(0));
}

/// The first component outside the parameter's range; NaN is outside any.
std::optional<double> outside_range(const ParameterInfo& parameter, const Constant& value) {
  std::vector<double> components;
  if (const auto* vector = std::get_if<std::vector<double>>(&value)) components = *vector;
  if (const auto* number = std::get_if<double>(&value)) components = {*number};
  if (const auto* integer = std::get_if<int64_t>(&value)) components = {static_cast<double>(*integer)};
  for (const double component : components) {
    if (parameter.min && !(component >= *parameter.min)) return component;
    if (parameter.max && !(component <= *parameter.max)) return component;
  }
  return std::nullopt;
}

/// Any numeral of Lua's, with a sign.
std::optional<std::variant<int64_t, double>> read_numeral(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  auto value = syntax::numeral_value(text);
  if (!value || !negative) return value;
  if (const auto* integer = std::get_if<int64_t>(&*value))
    return static_cast<int64_t>(0 - static_cast<uint64_t>(*integer)); // 0x8000000000000000 wraps
  return -std::get<double>(*value);
}

/// Beside numerals "inf" and "nan", as results are printed.
std::optional<double> read_number(std::string_view text) {
  if (const auto value = read_numeral(text)) {
    const auto* integer = std::get_if<int64_t>(&*value);
    return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(*value);
  }
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int64_t> read_integer(std::string_view text) {
  if (text == "-9223372036854775808") return INT64_MIN; // its digits alone are a float
  const auto value = read_numeral(text);
  if (!value || !std::holds_alternative<int64_t>(*value)) return std::nullopt;
  return std::get<int64_t>(*value);
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

std::optional<Constant> read_value(const ParameterInfo& parameter, std::string_view text) {
  if (!parameter.type) return std::string(text);
  text = trim(text);
  switch (*parameter.type) {
  case ValueType::Boolean:
    if (text == "true") return true;
    if (text == "false") return false;
    return std::nullopt;
  case ValueType::Integer:
    if (const auto integer = read_integer(text)) return *integer;
    return std::nullopt;
  case ValueType::Number:
    if (const auto number = read_number(text)) return *number;
    return std::nullopt;
  default:
    break;
  }
  std::vector<double> components;
  while (true) {
    const size_t comma = text.find(',');
    const auto component = read_number(trim(text.substr(0, comma)));
    if (!component) return std::nullopt;
    components.push_back(*component);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  if (components.size() != component_count(*parameter.type)) return std::nullopt;
  return components;
}

} // namespace

CheckedConstant check_override(const ParameterInfo& parameter, const Constant& value) {
  const std::string name = "parameter '" + parameter.name + "'";
  const auto converted = convert(parameter, value);
  if (!converted) return {value, name + " is " + type_text(parameter) + ", not " + given_text(value)};
  if (const auto outside = outside_range(parameter, *converted))
    return {value, name + ": " + number_text(*outside) + " is " + range_text(parameter)};
  if (!parameter.choices.empty() && std::ranges::find(parameter.choices, *converted) == parameter.choices.end())
    return {value, name + ": the value is none of its choices"};
  return {*converted, ""};
}

int64_t compared_index(const ParameterInfo& parameter, std::string_view value) {
  const auto found = std::ranges::find(parameter.compared, value);
  return found == parameter.compared.end() ? kNoneCompared : found - parameter.compared.begin();
}

CheckedConstant parse_override(const ParameterInfo& parameter, std::string_view text) {
  if (const auto value = read_value(parameter, text)) return check_override(parameter, *value);
  return {std::string(text),
          "parameter '" + parameter.name + "' is " + type_text(parameter) + ", not '" + std::string(text) + "'"};
}

} // namespace moonshade
