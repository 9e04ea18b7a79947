// SHA-256 (FIPS 180-4), for telling whether two renders are made of the same things.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace moonshade::renderer {

class Sha256 {
public:
  void add(const void* data, size_t size);
  void add(std::string_view text) { add(text.data(), text.size()); }
  /// Of all that was added, as 64 hexadecimal digits. Nothing can be added afterwards.
  std::string finish();

private:
  void block(const uint8_t* bytes);

  std::array<uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                    0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<uint8_t, 64> rest_{};
  size_t rest_size_ = 0;
  uint64_t total_ = 0;
};

std::string sha256(std::string_view text);

} // namespace moonshade::renderer
