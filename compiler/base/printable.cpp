#include "compiler/base/printable.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace moonshade {
namespace {

struct Decoded {
  size_t bytes = 0; // 0: not valid
  uint32_t character = 0;
};

Decoded decode_utf8(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  uint32_t character = lead & (0x7F >> size);
  for (size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    character = character << 6 | (byte(i) & 0x3F);
  }
  constexpr std::array<uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = character >= 0xD800 && character <= 0xDFFF;
  if (character < kLeast[size] || character > 0x10FFFF || is_surrogate) return {};
  return {size, character};
}

/// Control characters, and those that make text read in another order than it has (Unicode's bidirectional controls).
bool is_deceptive(uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) ||
         c == 0x200E || c == 0x200F || c == 0x2028 || c == 0x2029 || c == 0xFEFF;
}

std::string escape(const char* format, uint32_t value) {
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, static_cast<unsigned>(value));
  return buffer.data();
}

} // namespace

PrintableCharacter printable_character(std::string_view text) {
  const Decoded decoded = decode_utf8(text);
  std::string shown;
  if (decoded.bytes == 0)
    shown = escape("\\x%02X", static_cast<unsigned char>(text[0]));
  else if (is_deceptive(decoded.character))
    shown = escape(decoded.character < 0x80 ? "\\x%02X" : "\\u{%X}", decoded.character);
  else
    return {decoded.bytes, std::string(text.substr(0, decoded.bytes)), 1};
  const size_t columns = shown.size();
  return {decoded.bytes == 0 ? 1 : decoded.bytes, std::move(shown), columns};
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string result;
  while (!text.empty()) {
    const PrintableCharacter character = printable_character(text);
    const bool is_kept = kept.find(text[0]) != std::string_view::npos;
    result += is_kept ? std::string(1, text[0]) : character.shown;
    text.remove_prefix(character.bytes);
  }
  return result;
}

} // namespace moonshade
