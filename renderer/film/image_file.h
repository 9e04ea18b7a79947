// Pictures as files: EXR and HDR hold the linear floats untouched; PNG and JPG (8 bits) and TIFF (16 bits) are exposed,
// tone-mapped, clipped, sRGB-encoded and dithered by a hash of pixel and channel. A file appears whole or not at all.
#pragma once

#include "renderer/film/aov.h"
#include "renderer/film/film.h"
#include "renderer/scene/scene.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace moonshade::renderer {

/// Facts that a file carries, as "Software" and, each by its name, "moonshade:NAME".
struct ImageMetadata {
  std::string software;
  std::vector<std::pair<std::string, std::string>> facts;
};

/// Beside radiance, in EXR.
struct Layers {
  const Film* film = nullptr;
  AovList aovs = {};
};

/// The part of a whole image that a picture is; EXR keeps it as its data window.
struct Window {
  int x = 0, y = 0, full_width = 0, full_height = 0; ///< 0: the picture is the whole
};

struct DisplaySettings {
  float exposure = 0;
  Tonemap tonemap = Tonemap::None;
};

/// A file to be written: checked when it is opened, so that a folder that cannot be written or a full disk fails before
/// the work. Nothing of it lies on the disk until it is written.
class ImageFile {
public:
  /// Error where the ending is unknown or the place cannot be written; empty where all is well.
  std::string open(const std::string& path);

  /// Writes and renames into place; may be called again. Error, or empty. `on_temporary` hears of the file to delete
  /// where the program ends before, and of null when there is none any more.
  std::string write(const Picture& picture, const DisplaySettings& display, const ImageMetadata& metadata,
                    const Layers& layers = {}, const Window& window = {},
                    const std::function<void(const char*)>& on_temporary = nullptr);

  /// "png", "exr", ...; empty for an unknown ending.
  static std::string format_of(const std::string& path);

private:
  std::string try_folder(const std::vector<unsigned char>& bytes) const;
  std::string create_temporary(std::string& temporary) const;
  std::string encode_file(const std::string& file, std::vector<unsigned char>& bytes, const Picture& picture,
                          const DisplaySettings& display, const ImageMetadata& metadata, const Layers& layers,
                          const Window& window) const;

  std::string path_, format_;
};

/// A fact that an image file carries; empty where there is none, or no such file.
std::string read_fact(const std::string& path, const std::string& name);

/// sRGB's transfer function (IEC 61966-2-1).
float srgb_encode(float linear);

/// What an 8- or 16-bit file shows for a linear value, in [0, 1], before encoding.
Vec3 display_value(const Vec3& radiance, const DisplaySettings& display);

} // namespace moonshade::renderer
