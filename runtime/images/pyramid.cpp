// Reading is bounded before anything of a file's claimed size is allocated. Levels halve their sides, rounded down; a
// coarse texel is the mean of the area that it covers in the finer level, in linear light, so that the mean of every
// level is that of the image, whatever its size.
#include "runtime/images/pyramid.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace moonshade {

namespace {

constexpr int64_t kMostPixels = int64_t(1) << 27, kMostBytes = int64_t(1) << 30;
constexpr int kMostSide = 1 << 17, kMostChannels = 64;

struct Format {
  const char *ending, *reader;
};
constexpr Format kFormats[] = {{".png", "png"},     {".jpg", "jpeg"},  {".jpeg", "jpeg"},
                               {".exr", "openexr"}, {".tif", "tiff"},  {".tiff", "tiff"},
                               {".hdr", "hdr"},     {".tga", "targa"}, {".bmp", "bmp"}};

const char* reader_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats)
    if (ending == format.ending) return format.reader;
  return nullptr;
}

/// OpenImageIO's messages have lines and full stops.
std::string first_line(std::string text) {
  text = text.substr(0, text.find('\n'));
  while (!text.empty() && (text.back() == '.' || text.back() == ' '))
    text.pop_back();
  return text.empty() ? "cannot be read" : text;
}

std::string check_size(const OIIO::ImageSpec& spec) {
  const auto fits = [](int64_t side) { return side >= 1 && side <= kMostSide; };
  if (!fits(spec.width) || !fits(spec.height) || spec.depth > 1 || spec.deep) return "its size is none that is read";
  if (spec.nchannels < 1 || spec.nchannels > kMostChannels) return "it has too many channels";
  const int64_t pixels = int64_t(spec.width) * spec.height;
  const int64_t bytes = pixels * spec.nchannels * static_cast<int64_t>(spec.format.size());
  // Readers hold a row of tiles at a time.
  const bool tiles_fit = spec.tile_width <= 0 || (int64_t(spec.tile_width) * spec.tile_height <= (1 << 24));
  if (pixels > kMostPixels || bytes > kMostBytes || !tiles_fit)
    return "it is too large (" + std::to_string(spec.width) + " x " + std::to_string(spec.height) + ", " +
           std::to_string(spec.nchannels) + " channels)";
  return "";
}

/// What a coarse texel takes of a row or column of the finer level: texels from `first` on, with these weights.
struct Cover {
  int first = 0, count = 0;
  std::array<float, 4> weights{};
};

Cover cover_of(int index, int coarse, int fine) {
  const double scale = double(fine) / coarse, begin = index * scale, end = begin + scale;
  Cover cover;
  cover.first = static_cast<int>(begin);
  for (int i = cover.first; i < fine && i < end && cover.count < 4; ++i)
    cover.weights[static_cast<size_t>(cover.count++)] =
        static_cast<float>((std::min<double>(end, i + 1) - std::max<double>(begin, i)) / scale);
  return cover;
}

double srgb_decoded(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

} // namespace

std::string Pyramid::read(const std::string& path, bool raw, uint64_t most_bytes) {
  const char* reader = reader_of(path);
  if (reader == nullptr) return "its name ends as no image that is read (png, jpg, exr, tif, hdr, tga, bmp)";
  return read_with(reader, path, nullptr, raw, most_bytes);
}

std::string Pyramid::decode(const std::string& bytes, bool raw, uint64_t most_bytes) {
  const char* reader = bytes.starts_with("\x89PNG") ? "png" : bytes.starts_with("\xFF\xD8") ? "jpeg" : nullptr;
  if (reader == nullptr) return "it is neither a PNG nor a JPEG";
  return read_with(reader, std::string("memory.") + reader, &bytes, raw, most_bytes);
}

std::string Pyramid::read_with(const char* reader, const std::string& path, const std::string* bytes, bool raw,
                               uint64_t most_bytes) {
  OIIO::Filesystem::IOMemReader memory(bytes != nullptr ? bytes->data() : nullptr,
                                       bytes != nullptr ? bytes->size() : 0);
  const auto input = OIIO::ImageInput::create(reader);
  OIIO::ImageSpec spec, config;
  config["oiio:UnassociatedAlpha"] = 1;
  OIIO::Filesystem::IOProxy* proxy = &memory;
  if (bytes != nullptr) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<const void*>(&proxy));
  if (!input) return "there is no reader for it";
  if (!input->open(path, spec, config)) return first_line(input->geterror());
  if (std::string error = check_size(spec); !error.empty()) return error;
  channels_ = std::min(spec.nchannels, 4);
  const size_t count = size_t(spec.width) * size_t(spec.height) * size_t(channels_);
  const bool is_bytes = spec.format == OIIO::TypeUInt8;
  // The coarser levels come to a third of the texels.
  memory_ = count * (is_bytes ? sizeof(uint8_t) : sizeof(float)) +
            uint64_t(spec.width) * uint64_t(spec.height) / 3 * sizeof(Texel);
  if (memory_ > most_bytes) return "it takes too much memory beside the other images";
  bool done = false;
  if (is_bytes) {
    bytes_.resize(count);
    done = input->read_image(0, 0, 0, channels_, OIIO::TypeUInt8, bytes_.data());
  } else {
    numbers_.resize(count);
    done = input->read_image(0, 0, 0, channels_, OIIO::TypeFloat, numbers_.data());
    for (float& number : numbers_)
      if (!std::isfinite(number)) number = 0;
  }
  const std::string error = input->geterror();
  if (!done || !error.empty()) return first_line(error);
  for (size_t i = 0; i < 256; ++i) {
    const double x = double(i) / 255;
    numbers_of_bytes_[i] = static_cast<float>(x);
    colours_[i] = static_cast<float>(raw ? x : srgb_decoded(x));
  }
  sizes_ = {{spec.width, spec.height}};
  make_levels();
  return "";
}

Texel Pyramid::expand(const std::array<float, 4>& c) const {
  if (channels_ == 1) return {c[0], c[0], c[0], 1};
  if (channels_ == 2) return {c[0], c[0], c[0], c[1]};
  return {c[0], c[1], c[2], channels_ == 3 ? 1 : c[3]};
}

Texel Pyramid::texel(int level, int x, int y) const {
  const size_t at = size_t(y) * size_t(width(level)) + size_t(x);
  if (level > 0) return coarse_[static_cast<size_t>(level) - 1][at];
  std::array<float, 4> channels{};
  const int alpha = channels_ % 2 == 0 ? channels_ - 1 : -1;
  for (int c = 0; c < channels_; ++c) {
    const size_t index = at * size_t(channels_) + size_t(c);
    channels[size_t(c)] = bytes_.empty() ? numbers_[index] : (c == alpha ? numbers_of_bytes_ : colours_)[bytes_[index]];
  }
  return expand(channels);
}

void Pyramid::make_levels() {
  while (sizes_.back().width > 1 || sizes_.back().height > 1) {
    const Size fine = sizes_.back(), size = {std::max(1, fine.width / 2), std::max(1, fine.height / 2)};
    const int level = levels() - 1;
    std::vector<Cover> columns;
    for (int x = 0; x < size.width; ++x)
      columns.push_back(cover_of(x, size.width, fine.width));
    std::vector<Texel> texels(size_t(size.width) * size_t(size.height));
    for (int y = 0; y < size.height; ++y) {
      const Cover row = cover_of(y, size.height, fine.height);
      for (int x = 0; x < size.width; ++x) {
        const Cover& column = columns[size_t(x)];
        Texel sum{};
        for (int j = 0; j < row.count; ++j)
          for (int i = 0; i < column.count; ++i) {
            const Texel part = texel(level, column.first + i, row.first + j);
            const float weight = row.weights[size_t(j)] * column.weights[size_t(i)];
            for (size_t c = 0; c < 4; ++c)
              sum[c] += part[c] * weight;
          }
        texels[size_t(y) * size_t(size.width) + size_t(x)] = sum;
      }
    }
    coarse_.push_back(std::move(texels));
    sizes_.push_back(size);
  }
}

} // namespace moonshade
