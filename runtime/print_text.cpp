// As luaL_tolstring does (tostringbuff of lobject.c): "%.14g", and ".0" where that looks like an integer.
#include "runtime/print_text.h"

#include "compiler/ir/ir.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace moonshade {

std::string lua_number_text(double number) {
  if (std::isnan(number)) return "nan";
  char text[40];
  std::snprintf(text, sizeof text, "%.14g", number);
  if (text[std::strspn(text, "-0123456789")] == '\0') std::strcat(text, ".0");
  return text;
}

std::string value_text(ValueType type, std::span<const uint64_t> components) {
  if (type == ValueType::Boolean) return components[0] != 0 ? "true" : "false";
  if (type == ValueType::Integer) return std::to_string(static_cast<int64_t>(components[0]));
  if (type == ValueType::Number) return lua_number_text(std::bit_cast<double>(components[0]));
  std::string text(name_of(type));
  for (size_t i = 0; i < components.size(); ++i)
    text += (i == 0 ? "(" : ", ") + lua_number_text(std::bit_cast<double>(components[i]));
  return text + ")";
}

std::string print_line(std::string_view text, std::span<const ValueType> types, const uint64_t* components) {
  std::string line;
  size_t value = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ir::kPrintEscape && i + 1 < text.size()) {
      line += text[++i];
    } else if (text[i] == ir::kPrintValue) {
      const unsigned count = component_count(types[value]);
      line += value_text(types[value++], {components, count});
      components += count;
    } else {
      line += text[i];
    }
  }
  return line;
}

} // namespace moonshade
