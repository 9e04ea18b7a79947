// The images of one instance of a shader.
#pragma once

#include "runtime/shader.h"

#include <memory>
#include <string>
#include <vector>

namespace moonshade {

class ImageSet {
public:
  /// Opens all images of a shader whose parameters have these values; null with the error, which names the place,
  /// where one cannot be opened.
  static std::shared_ptr<const ImageSet> open(const ShaderInfo& info, const std::vector<Constant>& parameters,
                                              const ImageOpener& opener, std::string& error);

  /// For `count` lanes, as moonshade_texture_f32 and f64 (compiler/codegen/images.h).
  template <class T>
  void look_up(size_t image, uint32_t count, uint32_t results, const uint8_t* active, const T* at, T* gives) const;

  /// The number of the image that is named so in a source file; the count of images where there is none.
  size_t find(std::string_view file, std::string_view from, bool raw) const;
  size_t size() const { return images_.size(); }

private:
  struct Named {
    std::shared_ptr<const Image> image;
    std::string file, from;
    bool raw;
  };
  std::vector<Named> images_;
};

/// "the image 'rock.png' cannot be used: ..." at its place in the source.
std::string describe_image_error(const ImageInfo& image, const std::string& file, const std::string& error);

} // namespace moonshade
