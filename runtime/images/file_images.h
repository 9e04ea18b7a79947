// Images from files, looked up by OpenImageIO's texture system: an ImageOpener (runtime/image.h).
#pragma once

#include "runtime/allowed_folders.h"
#include "runtime/image.h"

namespace moonshade {

/// Opens PNG, JPEG, OpenEXR, TIFF, Radiance, Targa and BMP files that lie in these folders. A file is read whole when
/// it is opened, so that whatever is wrong with it shows then, and what becomes of it afterwards does not.
///
/// A look-up repeats the image endlessly, v upwards. Without a width it interpolates between the four texels around the
/// point; with one it does so in two levels of a pyramid of means, between which it interpolates (trilinear). Of more
/// than four channels the first four count, one or three have alpha 1, one or two are grey; alpha is not multiplied in.
/// Numbers that are not finite count as 0.
ImageOpener file_images(AllowedFolders folders);

/// The same for a host that has images of its own beside those of shaders: what is open already is read once.
/// Any number of threads may open images at once.
class ImageStore {
public:
  /// Images that are in use at once take at most `most_bytes` of memory; 0: half of what the machine has.
  explicit ImageStore(AllowedFolders folders, uint64_t most_bytes = 0);
  /// As an ImageOpener.
  OpenedImage open(const std::string& file, const std::string& from, bool raw) const;
  /// The bytes of a PNG or JPEG file.
  OpenedImage decode(const std::shared_ptr<const std::string>& bytes, bool raw) const;

private:
  struct State;
  std::shared_ptr<State> state_;
};

} // namespace moonshade
