// The reader of images: a pyramid of levels whose texels are finite, or an error. The first byte chooses the kind of
// file; what follows is the file.
#include "runtime/images/pyramid.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

#include <array>
#include <cmath>

namespace moonshade {
namespace {

using fuzz::require;

constexpr uint64_t kMostBytes = uint64_t(64) << 20;
constexpr std::array<const char*, 7> kEndings = {".png", ".jpg", ".exr", ".tif", ".hdr", ".tga", ".bmp"};

void check_texel(const Pyramid& image, int level, int x, int y) {
  for (const float number : image.texel(level, x, y))
    require(std::isfinite(number), "a texel that is not finite");
}

void check_image(const Pyramid& image) {
  require(image.levels() > 0 && image.bytes() <= kMostBytes, "no level, or too many");
  for (int level = 0; level < image.levels(); ++level) {
    const int width = image.width(level), height = image.height(level);
    require(width > 0 && height > 0, "a level without texels");
    for (const int x : {0, width / 2, width - 1})
      for (const int y : {0, height / 2, height - 1})
        check_texel(image, level, x, y);
  }
  require(image.width(image.levels() - 1) == 1 && image.height(image.levels() - 1) == 1, "the last level is one texel");
}

} // namespace
} // namespace moonshade

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  if (size == 0) return 0;
  const size_t kind = data[0] % (kEndings.size() + 1);
  const bool raw = (data[0] & 0x80) != 0;
  const std::string_view bytes = fuzz::text_of(data + 1, size - 1);
  Pyramid image;
  std::string error;
  if (kind == kEndings.size()) {
    error = image.decode(std::string(bytes), raw, kMostBytes);
  } else {
    const fuzz::Scratch scratch(kEndings[kind]);
    error = image.read(scratch.write(bytes), raw, kMostBytes);
  }
  if (error.empty()) check_image(image);
  return 0;
}
