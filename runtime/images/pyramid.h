// An image in memory: as its file has it, and ever coarser levels of it, down to one texel.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace moonshade {

/// Red, green, blue, alpha.
using Texel = std::array<float, 4>;

class Pyramid {
public:
  /// Reads a file whole; gives the error. `raw`: 8-bit numbers are not decoded from sRGB. What would take more than
  /// `most_bytes` of memory is an error before it does.
  std::string read(const std::string& path, bool raw, uint64_t most_bytes = UINT64_MAX);
  /// The same for the bytes of a PNG or JPEG file.
  std::string decode(const std::string& bytes, bool raw, uint64_t most_bytes = UINT64_MAX);
  /// What it takes of memory.
  uint64_t bytes() const { return memory_; }

  int levels() const { return static_cast<int>(sizes_.size()); }
  int width(int level) const { return sizes_[static_cast<size_t>(level)].width; }
  int height(int level) const { return sizes_[static_cast<size_t>(level)].height; }
  /// Rows go downwards.
  Texel texel(int level, int x, int y) const;

private:
  struct Size {
    int width, height;
  };
  std::string read_with(const char* reader, const std::string& path, const std::string* bytes, bool raw,
                        uint64_t most_bytes);
  void make_levels();
  Texel expand(const std::array<float, 4>& channels) const;

  std::vector<Size> sizes_;
  // The finest level is kept in its file's form.
  int channels_ = 0;
  uint64_t memory_ = 0;
  std::vector<uint8_t> bytes_; ///< of 8-bit files; else
  std::vector<float> numbers_;
  std::array<float, 256> colours_{}, numbers_of_bytes_{}; ///< a byte as a colour's component, and as alpha
  std::vector<std::vector<Texel>> coarse_;                ///< the levels from the second on
};

} // namespace moonshade
