// Files are read into pyramids (pyramid.h), of which the texture system sees tiles of floats, through a reader of our
// own: it filters in linear light, and nothing of an image is read again.
#include "runtime/images/file_images.h"

#include "runtime/images/pyramid.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <utility>

#include <unistd.h>

namespace moonshade {

namespace {

constexpr int kTile = 64;
constexpr const char* kPyramid = "moonshade:pyramid";

/// Shows a pyramid to the texture system as a tiled file with levels.
class PyramidInput final : public OIIO::ImageInput {
public:
  const char* format_name() const override { return "moonshade"; }
  bool open(const std::string&, OIIO::ImageSpec&) override { return false; } // never without the pyramid
  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    const auto* attribute = config.find_attribute(kPyramid, OIIO::TypeDesc::PTR);
    if (attribute == nullptr) return false;
    pyramid_ = *static_cast<const Pyramid* const*>(attribute->data());
    seek_subimage(0, 0);
    spec = m_spec;
    return true;
  }
  bool close() override { return true; }
  int current_subimage() const override { return 0; }
  int current_miplevel() const override { return level_; }
  bool seek_subimage(int subimage, int level) override {
    if (subimage != 0 || level < 0 || level >= pyramid_->levels()) return false;
    level_ = level;
    m_spec = OIIO::ImageSpec(pyramid_->width(level), pyramid_->height(level), 4, OIIO::TypeFloat);
    m_spec.tile_width = m_spec.tile_height = kTile;
    m_spec.tile_depth = 1;
    return true;
  }
  bool read_native_scanline(int, int, int, int, void*) override { return false; }
  bool read_native_tile(int, int level, int x_begin, int y_begin, int, void* data) override {
    auto* texels = static_cast<Texel*>(data);
    const int width = pyramid_->width(level), height = pyramid_->height(level);
    for (int y = y_begin; y < y_begin + kTile; ++y)
      for (int x = x_begin; x < x_begin + kTile; ++x)
        *texels++ = pyramid_->texel(level, std::min(x, width - 1), std::min(y, height - 1));
    return true;
  }

private:
  const Pyramid* pyramid_ = nullptr;
  int level_ = 0;
};

OIIO::ImageInput* make_input() { return new PyramidInput; }

/// A texture system of our own, and its cache of tiles.
class Textures {
public:
  Textures() : cache_(OIIO::ImageCache::create(false)), system_(OIIO::TextureSystem::create(false, cache_)) {
    cache_->attribute("max_memory_MB", 256.0f);
    cache_->attribute("forcefloat", 1);
    cache_->attribute("deduplicate", 0);
    cache_->attribute("statistics:level", 0);
  }
  ~Textures() {
    OIIO::TextureSystem::destroy(system_);
    OIIO::ImageCache::destroy(cache_);
  }
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;

  OIIO::TextureSystem& system() const { return *system_; }

  OIIO::ustring add(const Pyramid* pyramid) {
    OIIO::ImageSpec config;
    config.attribute(kPyramid, OIIO::TypeDesc::PTR, static_cast<const void*>(&pyramid));
    const OIIO::ustring name("moonshade:image:" + std::to_string(count_++));
    cache_->add_file(name, make_input, &config, true);
    return name;
  }
  void remove(const OIIO::ustring& name) { cache_->invalidate(name, true); }

  std::atomic<uint64_t> bytes_in_use = 0; ///< by pyramids

private:
  OIIO::ImageCache* cache_;
  OIIO::TextureSystem* system_;
  std::atomic<uint64_t> count_ = 0;
};

class FileImage final : public Image {
public:
  /// `source` lives as long as the image does.
  FileImage(std::shared_ptr<Textures> textures, std::unique_ptr<Pyramid> pyramid,
            std::shared_ptr<const std::string> source = nullptr)
      : textures_(std::move(textures)), pyramid_(std::move(pyramid)), source_(std::move(source)),
        name_(textures_->add(pyramid_.get())), handle_(textures_->system().get_texture_handle(name_)) {
    textures_->bytes_in_use += pyramid_->bytes();
  }
  ~FileImage() override {
    textures_->bytes_in_use -= pyramid_->bytes();
    textures_->remove(name_);
  }

  bool is_good() const { return textures_->system().good(handle_); }
  std::string error() const { return textures_->system().geterror(); }

  void look_up(const ImageLookup& lookup) const override {
    constexpr uint32_t kBatch = OIIO::Tex::BatchWidth;
    OIIO::TextureSystem::Perthread* thread = textures_->system().get_perthread_info();
    OIIO::TextureOptBatch options;
    options.swrap = options.twrap = OIIO::Tex::Wrap::Periodic;
    options.mipmode = OIIO::Tex::MipMode::Trilinear;
    options.interpmode = OIIO::Tex::InterpMode::Bilinear;
    for (uint32_t i = 0; i < kBatch; ++i) {
      options.sblur[i] = options.tblur[i] = options.rblur[i] = 0;
      options.swidth[i] = options.twidth[i] = options.rwidth[i] = 1;
    }
    for (uint32_t first = 0; first < lookup.count; first += kBatch) {
      const uint32_t count = std::min(kBatch, lookup.count - first);
      alignas(64) float s[kBatch] = {}, t[kBatch] = {}, width[kBatch] = {}, zero[kBatch] = {};
      alignas(64) float values[4 * kBatch], by_s[4 * kBatch], by_t[4 * kBatch];
      for (uint32_t i = 0; i < count; ++i) {
        s[i] = lookup.u[first + i];
        t[i] = 1 - lookup.v[first + i]; // rows go downwards
        width[i] = lookup.width[first + i];
      }
      const bool slopes = lookup.by_u[0] != nullptr;
      textures_->system().texture(handle_, thread, options, (OIIO::Tex::RunMask(1) << count) - 1, s, t, width, zero,
                                  zero, width, 4, values, slopes ? by_s : nullptr, slopes ? by_t : nullptr);
      for (uint32_t c = 0; c < 4; ++c)
        for (uint32_t i = 0; i < count; ++i) {
          lookup.values[c][first + i] = values[c * kBatch + i];
          if (!slopes) continue;
          lookup.by_u[c][first + i] = by_s[c * kBatch + i];
          lookup.by_v[c][first + i] = -by_t[c * kBatch + i];
        }
    }
  }

  std::array<uint32_t, 2> size() const override {
    return {static_cast<uint32_t>(pyramid_->width(0)), static_cast<uint32_t>(pyramid_->height(0))};
  }

private:
  std::shared_ptr<Textures> textures_;
  std::unique_ptr<Pyramid> pyramid_;
  std::shared_ptr<const std::string> source_;
  OIIO::ustring name_;
  OIIO::TextureSystem::TextureHandle* handle_;
};

/// The files that are open: one that several shaders look up is read once.
class Files {
public:
  explicit Files(uint64_t most_bytes) : most_bytes_(most_bytes) {}

  OpenedImage open(const std::string& path, bool raw) {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const FileImage>& known = open_[{path, raw}];
    if (auto image = known.lock()) return {std::move(image), "", path};
    auto pyramid = std::make_unique<Pyramid>();
    if (std::string error = pyramid->read(path, raw, bytes_left()); !error.empty()) return {nullptr, error};
    return show(std::move(pyramid), nullptr, known, path);
  }

  OpenedImage decode(const std::shared_ptr<const std::string>& bytes, bool raw) {
    const std::lock_guard lock(mutex_);
    // An image keeps its bytes, so that no others can have their address while it lives.
    std::weak_ptr<const FileImage>& known = decoded_[{bytes.get(), raw}];
    if (auto image = known.lock()) return {std::move(image), ""};
    auto pyramid = std::make_unique<Pyramid>();
    if (std::string error = pyramid->decode(*bytes, raw, bytes_left()); !error.empty()) return {nullptr, error};
    return show(std::move(pyramid), bytes, known, "");
  }

private:
  uint64_t bytes_left() const { return most_bytes_ - std::min<uint64_t>(most_bytes_, textures_->bytes_in_use); }

  OpenedImage show(std::unique_ptr<Pyramid> pyramid, std::shared_ptr<const std::string> source,
                   std::weak_ptr<const FileImage>& known, const std::string& path) {
    auto image = std::make_shared<const FileImage>(textures_, std::move(pyramid), std::move(source));
    if (!image->is_good()) return {nullptr, image->error()};
    known = image;
    return {std::move(image), "", path};
  }

  const uint64_t most_bytes_;
  std::shared_ptr<Textures> textures_ = std::make_shared<Textures>();
  std::mutex mutex_;
  std::map<std::pair<std::string, bool>, std::weak_ptr<const FileImage>> open_;
  std::map<std::pair<const std::string*, bool>, std::weak_ptr<const FileImage>> decoded_;
};

uint64_t half_of_the_memory() {
  return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) / 2;
}

} // namespace

struct ImageStore::State {
  AllowedFolders folders;
  Files files;

  State(AllowedFolders allowed, uint64_t most_bytes) : folders(std::move(allowed)), files(most_bytes) {}
};

ImageStore::ImageStore(AllowedFolders folders, uint64_t most_bytes)
    : state_(std::make_shared<State>(std::move(folders), most_bytes != 0 ? most_bytes : half_of_the_memory())) {}

OpenedImage ImageStore::open(const std::string& file, const std::string& from, bool raw) const {
  const ResolvedPath resolved = state_->folders.resolve(folder_of(from), file);
  return resolved.error.empty() ? state_->files.open(resolved.path, raw) : OpenedImage{nullptr, resolved.error};
}

OpenedImage ImageStore::decode(const std::shared_ptr<const std::string>& bytes, bool raw) const {
  return state_->files.decode(bytes, raw);
}

ImageOpener file_images(AllowedFolders folders) {
  return [store = ImageStore(std::move(folders))](const std::string& file, const std::string& from, bool raw) {
    return store.open(file, from, raw);
  };
}

} // namespace moonshade
