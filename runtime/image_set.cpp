// Lanes to points: what nobody looks at is left out, coordinates are brought into the unit square in double (the same
// for every precision), and what is not finite gives NaN.
#include "runtime/image_set.h"

#include "compiler/codegen/images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace moonshade {

namespace {

constexpr uint32_t kMostLanes = 32;

/// The lanes of a block that are looked up, side by side.
struct Points {
  uint32_t count = 0;
  std::array<uint32_t, kMostLanes> lanes;
  std::array<float, kMostLanes> u, v, width;
  std::array<std::array<float, kMostLanes>, codegen::kTextureSlopes> results;
};

float in_unit(double x) { return static_cast<float>(x - std::floor(x)); }

} // namespace

std::string describe_image_error(const ImageInfo& image, const std::string& file, const std::string& error) {
  return image.from + ":" + std::to_string(image.line) + ":" + std::to_string(image.column) + ": the image '" + file +
         "' cannot be used: " + error;
}

std::shared_ptr<const ImageSet> ImageSet::open(const ShaderInfo& info, const std::vector<Constant>& parameters,
                                               const ImageOpener& opener, std::string& error) {
  auto set = std::make_shared<ImageSet>();
  for (const ImageInfo& image : info.images) {
    const std::string file = image.parameter ? std::get<std::string>(parameters[*image.parameter]) : image.file;
    const OpenedImage opened =
        opener ? opener(file, image.from, image.raw) : OpenedImage{nullptr, "this host opens no images"};
    if (opened.image == nullptr) {
      error = describe_image_error(image, file, opened.error);
      return nullptr;
    }
    set->images_.push_back({opened.image, file, image.from, image.raw});
  }
  return set;
}

size_t ImageSet::find(std::string_view file, std::string_view from, bool raw) const {
  const auto found = std::ranges::find_if(
      images_, [&](const Named& named) { return named.file == file && named.from == from && named.raw == raw; });
  return static_cast<size_t>(found - images_.begin());
}

template <class T>
void ImageSet::look_up(size_t image, uint32_t count, uint32_t results, const uint8_t* active, const T* at,
                       T* gives) const {
  Points points;
  for (uint32_t lane = 0; lane < count; ++lane) {
    const bool is_active = active == nullptr || active[lane] != 0;
    const double u = at[lane], v = at[count + lane], width = at[2 * count + lane];
    if (is_active && std::isfinite(u) && std::isfinite(v)) {
      const uint32_t i = points.count++;
      points.lanes[i] = lane;
      points.u[i] = in_unit(u);
      points.v[i] = in_unit(v);
      points.width[i] = width > 0 ? static_cast<float>(std::min(width, 1.0)) : 0.0f;
    } else {
      for (uint32_t r = 0; r < results; ++r)
        gives[r * count + lane] = is_active ? std::numeric_limits<T>::quiet_NaN() : T(0);
    }
  }
  if (points.count == 0) return;
  ImageLookup lookup;
  lookup.count = points.count;
  lookup.u = points.u.data();
  lookup.v = points.v.data();
  lookup.width = points.width.data();
  for (uint32_t c = 0; c < 4; ++c) {
    lookup.values[c] = points.results[c].data();
    if (results != codegen::kTextureSlopes) continue;
    lookup.by_u[c] = points.results[4 + c].data();
    lookup.by_v[c] = points.results[8 + c].data();
  }
  images_[image].image->look_up(lookup);
  for (uint32_t r = 0; r < results; ++r)
    for (uint32_t i = 0; i < points.count; ++i)
      gives[r * count + points.lanes[i]] = static_cast<T>(points.results[r][i]);
}

template void ImageSet::look_up(size_t, uint32_t, uint32_t, const uint8_t*, const float*, float*) const;
template void ImageSet::look_up(size_t, uint32_t, uint32_t, const uint8_t*, const double*, double*) const;

extern "C" void codegen::moonshade_texture_f32(const void* images, int64_t image, uint32_t count, uint32_t results,
                                               const uint8_t* active, const float* at, float* gives) {
  static_cast<const ImageSet*>(images)->look_up(static_cast<size_t>(image), count, results, active, at, gives);
}

extern "C" void codegen::moonshade_texture_f64(const void* images, int64_t image, uint32_t count, uint32_t results,
                                               const uint8_t* active, const double* at, double* gives) {
  static_cast<const ImageSet*>(images)->look_up(static_cast<size_t>(image), count, results, active, at, gives);
}

} // namespace moonshade
