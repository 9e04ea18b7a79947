// Pictures as files: EXR and HDR hold the linear floats untouched; PNG and JPG (8 bits) and TIFF (16 bits) are exposed,
// tone-mapped, clipped, sRGB-encoded and dithered by a hash of pixel and channel. A file appears whole or not at all.
#pragma once

#include "renderer/film/film.h"
#include "renderer/scene/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace moonshade::renderer {

struct ImageMetadata {
  std::string software, scene;
  uint32_t seed = 0, samples = 0;
  double seconds = 0;
  bool interrupted = false;
  float clamp = 0;
};

struct DisplaySettings {
  float exposure = 0;
  Tonemap tonemap = Tonemap::None;
};

/// A file to be written: checked when it is opened, so that a folder that cannot be written fails before the work.
class ImageFile {
public:
  /// Error where the ending is unknown or the place cannot be written; empty where all is well.
  std::string open(const std::string& path);
  ~ImageFile();
  ImageFile() = default;
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;

  /// Writes and renames into place. Error, or empty.
  std::string write(const Picture& picture, const DisplaySettings& display, const ImageMetadata& metadata);

  /// The file written to until then; to be deleted where the program ends before.
  const std::string& temporary() const { return temporary_; }

  /// "png", "exr", ...; empty for an unknown ending.
  static std::string format_of(const std::string& path);

private:
  std::string path_, temporary_, format_;
};

/// sRGB's transfer function (IEC 61966-2-1).
float srgb_encode(float linear);

/// What an 8- or 16-bit file shows for a linear value, in [0, 1], before encoding.
Vec3 display_value(const Vec3& radiance, const DisplaySettings& display);

} // namespace moonshade::renderer
