// Encoding, and atomic files by a temporary file in the same folder.
#include "renderer/film/image_file.h"

#include "renderer/sampling/sampler.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <bit>
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

/// Writes to an open file, all the way to the disk, and closes it. Error, or empty.
static std::string write_and_close(int file, const std::vector<unsigned char>& bytes) {
  int error = 0;
  for (size_t done = 0; done < bytes.size() && error == 0;) {
    ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) error = errno;
    done += count > 0 ? size_t(count) : 0;
  }
  if (error == 0 && ::fsync(file) != 0 && errno != EINVAL) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error ? std::strerror(error) : "";
}

/// Replaces what the file holds.
static std::string write_bytes(const std::string& path, const std::vector<unsigned char>& bytes) {
  int file = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  return file < 0 ? std::strerror(errno) : write_and_close(file, bytes);
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
  path_ = path;
  // A full disk gives a name, but no block.
  return try_folder(std::vector<unsigned char>(4096));
}

/// Error where the folder cannot take a file of these bytes: one without a name, where the file system has such: a
/// process that is killed meanwhile leaves nothing.
std::string ImageFile::try_folder(const std::vector<unsigned char>& bytes) const {
  std::string folder = fs::path(path_).parent_path().string();
  int nameless = ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  std::string temporary, message;
  if (nameless >= 0) {
    message = write_and_close(nameless, bytes);
  } else {
    if (message = create_temporary(temporary); !message.empty()) return message;
    message = write_bytes(temporary, bytes);
    ::unlink(temporary.c_str());
  }
  return message.empty() ? "" : path_ + ": " + message;
}

std::string ImageFile::create_temporary(std::string& temporary) const {
  temporary = path_ + ".XXXXXX." + format_;
  int file = ::mkstemps(temporary.data(), int(format_.size() + 1));
  if (file < 0) return path_ + ": " + std::strerror(errno);
  mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(file, 0666 & ~mask);
  ::close(file);
  return "";
}

namespace {

void describe(OIIO::ImageSpec& spec, const ImageMetadata& metadata) {
  spec.attribute("Software", metadata.software);
  std::string all = metadata.software;
  for (const auto& [name, value] : metadata.facts) {
    spec.attribute("moonshade:" + name, value);
    all.append("; ").append(name).append(" ").append(value);
  }
  // Formats without fields of their own keep this one.
  spec.attribute("ImageDescription", all);
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

void add_channels(OIIO::ImageSpec& spec, const AovList& aovs) {
  spec.channelformats.assign(3, OIIO::TypeDesc::FLOAT);
  for (Aov aov : aovs)
    for (const char* name : aov_info(aov).channels) {
      if (std::string_view(name) == "Z") spec.z_channel = spec.nchannels;
      spec.channelnames.emplace_back(name);
      spec.channelformats.push_back(aov_info(aov).integers ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
      ++spec.nchannels;
    }
}

/// Radiance and layers, a few rows at a time: a picture with all its channels side by side is large.
bool write_layers(OIIO::ImageOutput& output, const Picture& picture, const Layers& layers) {
  const OIIO::ImageSpec& spec = output.spec();
  constexpr int kRows = 16; // what EXR compresses at once
  std::vector<uint32_t> rows(size_t(kRows) * size_t(picture.width) * size_t(spec.nchannels));
  for (int y = 0; y < picture.height; y += kRows) {
    uint32_t* out = rows.data();
    int end = std::min(y + kRows, picture.height);
    for (size_t pixel = size_t(y) * size_t(picture.width); pixel < size_t(end) * size_t(picture.width); ++pixel) {
      for (int c = 0; c < 3; ++c)
        *out++ = std::bit_cast<uint32_t>(picture.pixels[pixel][c]);
      for (Aov aov : layers.aovs)
        out = put_aov(aov, *layers.film, pixel, out);
    }
    if (!output.write_scanlines(spec.y + y, spec.y + end, 0, OIIO::TypeDesc::UNKNOWN, rows.data())) return false;
  }
  return true;
}

} // namespace

std::string ImageFile::write(const Picture& picture, const DisplaySettings& display, const ImageMetadata& metadata,
                             const Layers& layers, const Window& window,
                             const std::function<void(const char*)>& on_temporary) {
  std::string temporary;
  std::string error = create_temporary(temporary);
  if (!error.empty()) return error;
  if (on_temporary) on_temporary(temporary.c_str());
  // Encoded in memory first: the libraries for some formats do not notice that the disk is full, or end the program.
  std::vector<unsigned char> bytes;
  error = encode_file(temporary, bytes, picture, display, metadata, layers, window);
  if (error.empty() && !bytes.empty()) error = write_bytes(temporary, bytes);
  if (!error.empty()) error = path_ + ": " + error;
  if (error.empty() && std::rename(temporary.c_str(), path_.c_str()) != 0) error = path_ + ": " + std::strerror(errno);
  if (!error.empty()) ::unlink(temporary.c_str());
  if (on_temporary) on_temporary(nullptr);
  return error;
}

/// Into `bytes`, or, where the format's library does that alone, into `file`.
std::string ImageFile::encode_file(const std::string& file, std::vector<unsigned char>& bytes, const Picture& picture,
                                   const DisplaySettings& display, const ImageMetadata& metadata, const Layers& layers,
                                   const Window& window) const {
  auto output = OIIO::ImageOutput::create(format_);
  if (!output) return OIIO::geterror();
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (format_ != "tif" && !output->set_ioproxy(&memory)) return format_ + " cannot be encoded in memory";
  bool linear = format_ == "exr" || format_ == "hdr";
  bool with_layers = format_ == "exr" && !layers.aovs.empty();
  OIIO::TypeDesc type = linear             ? OIIO::TypeDesc::FLOAT
                        : format_ == "tif" ? OIIO::TypeDesc::UINT16
                                           : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(picture.width, picture.height, 3, type);
  spec.attribute("oiio:ColorSpace", linear ? "linear" : "sRGB");
  if (format_ == "exr") spec.attribute("compression", "zip");
  if (format_ == "exr" && window.full_width > 0) {
    spec.x = window.x, spec.y = window.y;
    spec.full_width = window.full_width, spec.full_height = window.full_height;
  }
  if (format_ == "jpg") spec.attribute("CompressionQuality", 95);
  describe(spec, metadata);
  if (with_layers) add_channels(spec, layers.aovs);
  bool ok = output->open(file, spec);
  if (ok && with_layers)
    ok = write_layers(*output, picture, layers);
  else if (ok && linear)
    ok = output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels.data());
  else if (ok && format_ == "tif")
    ok = output->write_image(type, encode<uint16_t>(picture, display).data());
  else if (ok)
    ok = output->write_image(type, encode<uint8_t>(picture, display).data());
  ok = ok && output->close();
  return ok ? "" : output->geterror();
}

std::string read_fact(const std::string& path, const std::string& name) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";
  auto input = OIIO::ImageInput::open(path);
  if (!input) return OIIO::geterror(), "";
  std::string value = input->spec().get_string_attribute("moonshade:" + name);
  if (!value.empty()) return value;
  std::string all = input->spec().get_string_attribute("ImageDescription");
  size_t at = all.find("; " + name + " ");
  if (at == std::string::npos) return "";
  at += name.size() + 3;
  return all.substr(at, all.find(';', at) - at);
}

} // namespace moonshade::renderer
