// Sums in double: a million samples of one pixel lose nothing that shows.
#include "renderer/film/film.h"

#include <type_traits>

namespace moonshade::renderer {

static_assert(std::is_trivially_copyable_v<Film::First> && std::is_trivially_copyable_v<DVec3>);

Film::Film(int width, int height, FilmContents contents) : width_(width), height_(height), contents_(contents) {
  size_t pixels = size_t(width) * size_t(height);
  sums_.resize(pixels, DVec3(0));
  counts_.resize(pixels);
  faults_.resize(pixels);
  if (contents.squares) squares_.resize(pixels, DVec3(0));
  if (contents.first) first_.resize(pixels);
}

size_t Film::bytes_per_pixel(FilmContents contents) {
  return sizeof(DVec3) + 2 * sizeof(uint32_t) + (contents.squares ? sizeof(DVec3) : 0) +
         (contents.first ? sizeof(First) : 0);
}

void Film::add(size_t pixel, const SampleOutputs& samples, size_t first, size_t count) {
  for (size_t i = first; i < first + count; ++i) {
    DVec3 radiance(samples.radiance[i]);
    sums_[pixel] += radiance;
    if (contents_.squares) squares_[pixel] += radiance * radiance;
    faults_[pixel] += samples.faulted[i];
    if (!contents_.first) continue;
    const FirstHit& hit = samples.first[i];
    First& sum = first_[pixel];
    sum.albedo += DVec3(hit.albedo);
    sum.normal += DVec3(hit.normal);
    if (hit.depth < sum.depth)
      sum.position = hit.position, sum.depth = hit.depth, sum.object = hit.object, sum.material = hit.material;
  }
  counts_[pixel] += uint32_t(count);
}

Vec3 Film::variance(size_t pixel) const {
  double n = counts_[pixel];
  if (n < 2) return Vec3(0);
  DVec3 mean = sums_[pixel] / n;
  return Vec3(glm::max((squares_[pixel] / n - mean * mean) / (n - 1), DVec3(0)));
}

Film::First Film::first(size_t pixel) const {
  First first = first_[pixel];
  if (counts_[pixel] == 0) return first;
  first.albedo /= double(counts_[pixel]);
  first.normal /= double(counts_[pixel]);
  return first;
}

double Film::mean_samples() const {
  double sum = 0;
  for (uint32_t count : counts_)
    sum += count;
  return counts_.empty() ? 0 : sum / double(counts_.size());
}

Picture Film::picture() const {
  Picture picture{width_, height_, {}};
  picture.pixels.reserve(sums_.size());
  for (size_t k = 0; k < sums_.size(); ++k)
    picture.pixels.push_back(mean(k));
  return picture;
}

std::vector<std::pair<void*, size_t>> Film::blocks() {
  std::vector<std::pair<void*, size_t>> blocks;
  auto add = [&](auto& values) {
    if (!values.empty()) blocks.emplace_back(values.data(), values.size() * sizeof values[0]);
  };
  add(sums_);
  add(squares_);
  add(counts_);
  add(faults_);
  add(first_);
  return blocks;
}

} // namespace moonshade::renderer
