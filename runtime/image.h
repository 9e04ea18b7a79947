// Images that shaders look up (`texture`), as a host supplies them. The runtime reads no image itself: it asks an
// ImageOpener for each image of a shader when the shader is instantiated, and calls what that gives for blocks of
// points. runtime/images has an opener that reads files, by OpenImageIO.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace moonshade {

/// A block of look-ups, as structure-of-arrays of `count` elements each.
struct ImageLookup {
  uint32_t count = 0;
  /// Where: within 0..1 (of the endless repetition of the image), v upwards.
  const float *u = nullptr, *v = nullptr;
  /// Width of the footprint to filter over, in the units of u and v, within 0..1; 0: unfiltered.
  const float* width = nullptr;
  /// The result's components, red, green, blue and alpha; and how they change by u and by v, where somebody asks for
  /// that (null otherwise).
  float* values[4] = {};
  float* by_u[4] = {};
  float* by_v[4] = {};
};

/// An open image. One look-up gives the same bits in whatever block it stands, on whatever thread.
class Image {
public:
  virtual ~Image() = default;
  /// Called from any number of threads at once.
  virtual void look_up(const ImageLookup& lookup) const = 0;
  /// Texels across and down; 0 where the host does not say.
  virtual std::array<uint32_t, 2> size() const { return {0, 0}; }
};

struct OpenedImage {
  std::shared_ptr<const Image> image; ///< null where `error` is set
  std::string error;                  ///< what is wrong, without the name
  std::string path = {};              ///< of the file that was read, if any
};

/// Opens the image `file`, as the source file `from` names it. `raw`: its numbers are no colours, so that 8-bit ones
/// are not decoded from sRGB.
using ImageOpener = std::function<OpenedImage(const std::string& file, const std::string& from, bool raw)>;

} // namespace moonshade
