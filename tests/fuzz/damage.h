// Damage to a file that is whole otherwise: what a fuzz target of a format with a hash is given, so that its inputs
// stay of use when the format changes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace moonshade::fuzz {

/// Applies the edits that `edits` describes, six bytes each: what is done, how far from which end, and two bytes to do
/// it with.
inline std::string damaged(std::string bytes, std::string_view edits) {
  for (; edits.size() >= 6; edits.remove_prefix(6)) {
    const auto at = [&](size_t i) { return static_cast<uint8_t>(edits[i]); };
    const uint64_t distance = at(1) | uint64_t{at(2)} << 8 | uint64_t{at(3)} << 16;
    if (bytes.empty()) return bytes;
    const size_t offset = at(0) & 128 ? bytes.size() - 1 - distance % bytes.size() : distance % bytes.size();
    const size_t value = at(4) | size_t{at(5)} << 8;
    switch (at(0) & 7) {
    case 0:
    case 1:
      bytes[offset] = static_cast<char>(bytes[offset] ^ edits[4]);
      break;
    case 2:
      bytes[offset] = edits[4];
      break;
    case 3: // as of a count or a size: small or enormous
      for (size_t i = 0; i < 8 && offset + i < bytes.size(); ++i)
        bytes[offset + i] = i < 2 ? edits[4 + i] : at(0) & 64 ? '\xff' : '\0';
      break;
    case 4:
      bytes.resize(offset);
      break;
    case 5:
      bytes.erase(offset, value % 64);
      break;
    case 6:
      bytes.insert(offset, value % 64, edits[4]);
      break;
    default:
      bytes.append(value % 64, edits[4]);
    }
  }
  return bytes;
}

} // namespace moonshade::fuzz
