// Encoding, and atomic files by a temporary file in the same folder.
#include "renderer/film/image_file.h"

#include "renderer/sampling/sampler.h"

#include <OpenImageIO/imageio.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace moonshade::renderer {

namespace fs = std::filesystem;

float srgb_encode(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Narkowicz's fit (2015) of the ACES filmic curve.
static float filmic(float x) { return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f); }

Vec3 display_value(const Vec3& radiance, const DisplaySettings& display) {
  Vec3 v = glm::max(radiance, Vec3(0)) * std::exp2(display.exposure);
  if (display.tonemap == Tonemap::Filmic)
    for (int c = 0; c < 3; ++c)
      v[c] = v[c] > 1e4f ? 1.0f : filmic(v[c]);
  return glm::min(v, Vec3(1));
}

std::string ImageFile::format_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  for (char& c : ending)
    c = char(std::tolower((unsigned char)c));
  if (ending == ".png" || ending == ".exr" || ending == ".jpg" || ending == ".tif" || ending == ".hdr")
    return ending.substr(1);
  if (ending == ".jpeg") return "jpg";
  if (ending == ".tiff") return "tif";
  return "";
}

std::string ImageFile::open(const std::string& name) {
  format_ = format_of(name);
  if (format_.empty()) return name + ": the ending is none of png, exr, jpg, tif, hdr";
  std::error_code error;
  std::string path = name;
  if (fs::is_symlink(name, error)) // the link stays, what it names is replaced
    if (fs::path target = fs::weakly_canonical(name, error); !error) path = target.string();
  if (fs::is_directory(path, error)) return path + ": is a folder";
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return path + ": is no regular file";
  if (fs::exists(path, error) && ::access(path.c_str(), W_OK) != 0) return path + ": " + std::strerror(errno);
  std::string pattern = path + ".XXXXXX." + format_;
  int file = ::mkstemps(pattern.data(), int(format_.size() + 1));
  if (file < 0) return path + ": " + std::strerror(errno);
  mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(file, 0666 & ~mask);
  ::close(file);
  path_ = path;
  temporary_ = pattern;
  return "";
}

ImageFile::~ImageFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

namespace {

void describe(OIIO::ImageSpec& spec, const ImageMetadata& metadata) {
  spec.attribute("Software", metadata.software);
  spec.attribute("moonshade:scene", metadata.scene);
  spec.attribute("moonshade:seed", std::to_string(metadata.seed));
  spec.attribute("moonshade:samples", std::to_string(metadata.samples));
  spec.attribute("moonshade:seconds", std::to_string(metadata.seconds));
  spec.attribute("moonshade:interrupted", metadata.interrupted ? "yes" : "no");
  spec.attribute("moonshade:clamp", metadata.clamp > 0 ? std::to_string(metadata.clamp) : std::string("none"));
  // Formats without fields of their own keep this one.
  spec.attribute("ImageDescription",
                 metadata.software + "; scene " + metadata.scene + "; seed " + std::to_string(metadata.seed) +
                     "; samples " + std::to_string(metadata.samples) + "; seconds " + std::to_string(metadata.seconds) +
                     (metadata.interrupted ? "; interrupted" : "") +
                     (metadata.clamp > 0 ? "; clamped at " + std::to_string(metadata.clamp) : "; not clamped"));
}

/// Quantised with half a step of noise on average zero, which turns bands into grain of one level.
template <typename T> std::vector<T> encode(const Picture& picture, const DisplaySettings& display) {
  constexpr float kTop = float(std::numeric_limits<T>::max());
  std::vector<T> out;
  out.reserve(picture.pixels.size() * 3);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    Vec3 v = display_value(picture.pixels[i], display);
    for (int c = 0; c < 3; ++c) {
      float dither = unit_float(hash_combine(uint32_t(c), uint32_t(i)));
      float level = srgb_encode(v[c]) * kTop;
      // Black and white stay exactly that.
      float rounded = level <= 0 || level >= kTop ? level : std::floor(level + dither);
      out.push_back(T(std::clamp(rounded, 0.0f, kTop)));
    }
  }
  return out;
}

} // namespace

std::string ImageFile::write(const Picture& picture, const DisplaySettings& display, const ImageMetadata& metadata) {
  auto output = OIIO::ImageOutput::create(format_);
  if (!output) return path_ + ": " + OIIO::geterror();
  bool linear = format_ == "exr" || format_ == "hdr";
  OIIO::TypeDesc type = linear             ? OIIO::TypeDesc::FLOAT
                        : format_ == "tif" ? OIIO::TypeDesc::UINT16
                                           : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(picture.width, picture.height, 3, type);
  spec.attribute("oiio:ColorSpace", linear ? "linear" : "sRGB");
  if (format_ == "exr") spec.attribute("compression", "zip");
  if (format_ == "jpg") spec.attribute("CompressionQuality", 95);
  describe(spec, metadata);
  bool ok = output->open(temporary_, spec);
  if (ok && linear)
    ok = output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels.data());
  else if (ok && format_ == "tif")
    ok = output->write_image(type, encode<uint16_t>(picture, display).data());
  else if (ok)
    ok = output->write_image(type, encode<uint8_t>(picture, display).data());
  ok = ok && output->close();
  if (!ok) return path_ + ": " + output->geterror();
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) return path_ + ": " + std::strerror(errno);
  temporary_.clear();
  return "";
}

} // namespace moonshade::renderer
