// Writes libFuzzer's dictionary for Lua and the dialect: every token, every name of the library, inputs, entries.
#include "compiler/syntax/token.h"
#include "stdlib/library.h"

#include <cctype>
#include <cstdio>
#include <set>
#include <string>

namespace {

constexpr const char* kOthers[] = {
    // entries and inputs
    "color", "height", "reflectance", "roughness", "metallic", "transmission", "opacity", "ior", "emission", "density",
    "environment", "p", "P", "n", "ng", "backface", "i", "uv", "dpdu", "dpdv", "time", "frame", "id", "fw",
    // names that sema knows without the library
    "param(\"", "min = ", "max = ", "doc = ", "choices = ", "require", "assert(", "error(\"", "print(", "ipairs(",
    "pairs(", "gradient(", "texture(", "math.", "math.tointeger", "math.type", "math.pi", "math.huge",
    "math.maxinteger", "math.mininteger", "_ENV", "_G", "self", "<const>", "<close>", ".x", ".xyz", ".rgba", "[1]",
    "---@param ", "---@return ", "---@type ",
    // numerals and strings
    "0x7fffffffffffffff", "0x1p-1074", "1e308", "9223372036854775808", "0.1", "1e", "0x", "\"", "'", "[[", "]]", "[==[",
    "]==]", "--", "--[[", "\\x41", "\\u{7FFFFFFF}", "\\z", "\\065", "\r\n", "\xEF\xBB\xBF", "#!"};

void print_entry(const std::string& text) {
  std::printf("\"");
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      std::printf("\\%c", c);
    else if (std::isprint(byte))
      std::printf("%c", c);
    else
      std::printf("\\x%02X", byte);
  }
  std::printf("\"\n");
}

} // namespace

int main() {
  std::set<std::string> entries(std::begin(kOthers), std::end(kOthers));
#define MOONSHADE_TOKEN(name, spelling) entries.insert(spelling);
#include "compiler/syntax/tokens.def"
  for (const moonshade::LibraryFunction& function : moonshade::library())
    if (!function.name.starts_with("op.")) entries.insert(std::string(function.name) + "(");
  for (const std::string& entry : entries)
    print_entry(entry);
}
