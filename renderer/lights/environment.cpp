// The middle of an image lies towards -z, its top is +y.
#include "renderer/lights/environment.h"

#include "renderer/lights/endless.h"
#include "renderer/sampling/sampler.h"
#include "runtime/images/pyramid.h"

#include <algorithm>

namespace moonshade::renderer {

namespace {

constexpr int kShaderColumns = 512, kShaderRows = 256, kMostColumns = 1024;

Vec2 place_of(const Vec3& d) {
  float u = std::atan2(d.x, -d.z) / (2 * kPi) + 0.5f;
  return {u, std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi};
}

Vec3 direction_at(float u, float v) {
  float phi = (u - 0.5f) * 2 * kPi, theta = v * kPi, r = std::sin(theta);
  return {r * std::sin(phi), std::cos(theta), -r * std::cos(phi)};
}

/// The first nine real spherical harmonics.
std::array<float, 9> harmonics_at(const Vec3& d) {
  return {0.282095f,
          0.488603f * d.y,
          0.488603f * d.z,
          0.488603f * d.x,
          1.092548f * d.x * d.y,
          1.092548f * d.y * d.z,
          0.315392f * (3 * d.z * d.z - 1),
          1.092548f * d.x * d.z,
          0.546274f * (d.x * d.x - d.y * d.y)};
}

} // namespace

std::string Environment::read_image(const std::string& file) {
  Pyramid image;
  if (std::string error = image.read(file, false); !error.empty()) return file + ": " + error;
  width_ = image.width(0), height_ = image.height(0);
  pixels_.reserve(size_t(width_) * size_t(height_));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const Texel texel = image.texel(0, x, y);
      Vec3& pixel = pixels_.emplace_back(0.0f);
      for (int c = 0; c < 3; ++c) {
        const float number = texel[size_t(c)];
        pixel[c] = (number > 0 && number < 1e30f ? number : 0) * scale_[c];
      }
    }
  return "";
}

std::string Environment::load(const Light& light, const Scene& scene, ShaderSource& shaders,
                              const std::map<std::string, std::string>& overrides, Environment& e,
                              std::string& warnings) {
  e.scale_ = light.color;
  e.cos_ = std::cos(light.rotate * kPi / 180), e.sin_ = -std::sin(light.rotate * kPi / 180);
  if (light.shader.empty()) {
    if (std::string error = e.read_image(light.image); !error.empty()) return light.place + ": " + error;
    int shrink = std::max(1, (e.width_ + kMostColumns - 1) / kMostColumns);
    int columns = std::max(1, e.width_ / shrink), rows = std::max(1, e.height_ / shrink);
    std::vector<Vec3> cells(size_t(columns) * size_t(rows), Vec3(0));
    for (int y = 0; y < e.height_; ++y)
      for (int x = 0; x < e.width_; ++x)
        cells[size_t(std::min(y / shrink, rows - 1)) * size_t(columns) + size_t(std::min(x / shrink, columns - 1))] +=
            e.pixels_[size_t(y) * size_t(e.width_) + size_t(x)] / float(shrink * shrink);
    e.make_table(cells, columns, rows);
    return "";
  }
  ShaderLoad load = shaders.load(light.shader, light.parameters, overrides);
  warnings += load.warnings;
  if (!load.shader)
    return load.error + (load.error.ends_with('\n') ? "" : "\n") + light.place +
           ": note: this light uses this shader\n";
  if (!load.unknown.empty()) return light.shader + ": " + load.unknown.begin()->second;
  std::string error = EntryCall::bind(load.shader, light.shader, "environment", 3, e.call_);
  if (!error.empty() || !e.call_) return error;
  constexpr uint32_t kKnown = 7u << kIncident | 1u << kFootprint | 1u << kTime;
  if (e.call_->needs() & ~kKnown)
    return light.shader +
           ": 'environment' has an input that the surroundings do not have (they have: i, fw, time, frame)";
  // The table: each cell's mean over a few directions.
  ShadingBatch batch(kShaderColumns, scene.settings.time, scene.settings.frame);
  std::vector<Vec3> cells(size_t(kShaderColumns) * kShaderRows, Vec3(0)), directions(kShaderColumns),
      row(kShaderColumns);
  std::vector<float> spreads(kShaderColumns, kPi / kShaderRows);
  std::vector<uint8_t> faulted(kShaderColumns);
  FaultLog ignored; // those that matter are met again
  constexpr int kEach = 4;
  for (int y = 0; y < kShaderRows && endless_points(ignored) < kMostEndless; ++y)
    for (int part = 0; part < kEach; ++part) {
      for (int x = 0; x < kShaderColumns; ++x) {
        Vec2 at = Sampler(3, uint32_t(y * kShaderColumns + x), uint32_t(part)).two(0);
        directions[size_t(x)] =
            e.to_world(direction_at((float(x) + at.x) / kShaderColumns, (float(y) + at.y) / kShaderRows));
      }
      std::fill(row.begin(), row.end(), Vec3(0));
      e.shade(batch, directions.data(), spreads.data(), kShaderColumns, row.data(), faulted.data(), ignored);
      for (int x = 0; x < kShaderColumns; ++x)
        cells[size_t(y) * kShaderColumns + size_t(x)] += row[size_t(x)] / float(kEach);
    }
  e.make_table(cells, kShaderColumns, kShaderRows);
  return "";
}

void Environment::make_table(const std::vector<Vec3>& cells, int width, int height) {
  columns_ = width, rows_ = height;
  double total = 0, weights = 0;
  DVec3 mean(0);
  std::array<DVec3, 9> harmonics{};
  for (int y = 0; y < height; ++y) {
    float sine = std::sin((float(y) + 0.5f) / float(height) * kPi);
    for (int x = 0; x < width; ++x) {
      const Vec3& cell = cells[size_t(y) * size_t(width) + size_t(x)];
      total += double(luminance(cell) * sine), weights += double(sine);
      mean += DVec3(cell * sine);
      auto basis =
          harmonics_at(to_world(direction_at((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height))));
      for (size_t b = 0; b < 9; ++b)
        harmonics[b] += DVec3(cell * (sine * basis[b]));
    }
  }
  if (!(total > 0)) return;
  mean_ = Vec3(mean / weights);
  for (size_t b = 0; b < 9; ++b)
    harmonics_[b] = Vec3(harmonics[b] * (4 * M_PI / weights));
  // No direction is left out: what a cell holds may be brighter than what was seen of it, the more so beside
  // brightness.
  const float least = 0.02f * float(total / weights);
  cumulative_.resize(cells.size());
  cumulative_rows_.resize(size_t(height));
  double all = 0;
  std::vector<double> row_sums(size_t(height), 0.0);
  for (int y = 0; y < height; ++y) {
    double sum = 0;
    float sine = std::sin((float(y) + 0.5f) / float(height) * kPi);
    for (int x = 0; x < width; ++x) {
      size_t at = size_t(y) * size_t(width) + size_t(x);
      float beside = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          beside = std::max(
              beside,
              luminance(
                  cells[size_t(std::clamp(y + dy, 0, height - 1)) * size_t(width) + size_t((x + dx + width) % width)]));
      sum += double((luminance(cells[at]) + 0.1f * beside + least) * sine);
      cumulative_[at] = float(sum);
    }
    for (int x = 0; x < width; ++x)
      cumulative_[size_t(y) * size_t(width) + size_t(x)] /= float(sum);
    all += sum;
    cumulative_rows_[size_t(y)] = float(all);
  }
  for (float& c : cumulative_rows_)
    c /= float(all);
}

/// Index of the first cumulative share above `u`, and `u` made uniform again within it.
static int choose(const float* cumulative, int size, float& u, float& share) {
  int index = int(std::upper_bound(cumulative, cumulative + size - 1, u) - cumulative);
  float low = index ? cumulative[index - 1] : 0;
  share = cumulative[index] - low;
  u = share > 0 ? std::clamp((u - low) / share, 0.0f, 0x1.fffffep-1f) : 0.5f;
  return index;
}

Vec3 Environment::sample(const Vec2& u) const {
  Vec2 within = u;
  float share = 0;
  int y = choose(cumulative_rows_.data(), rows_, within.y, share);
  int x = choose(cumulative_.data() + size_t(y) * size_t(columns_), columns_, within.x, share);
  return to_world(direction_at((float(x) + within.x) / float(columns_), (float(y) + within.y) / float(rows_)));
}

float Environment::pdf(const Vec3& direction) const {
  Vec2 at = place_of(to_local(direction));
  int x = std::clamp(int(at.x * float(columns_)), 0, columns_ - 1),
      y = std::clamp(int(at.y * float(rows_)), 0, rows_ - 1);
  const float* row = cumulative_.data() + size_t(y) * size_t(columns_);
  float share = row[x] - (x ? row[x - 1] : 0.0f);
  share *= cumulative_rows_[size_t(y)] - (y ? cumulative_rows_[size_t(y) - 1] : 0.0f);
  float sine = std::sqrt(std::max(1 - direction.y * direction.y, 1e-8f));
  return share * float(columns_) * float(rows_) / (2 * kPi * kPi * sine);
}

Vec3 Environment::pixel(int x, int y) const {
  x = (x % width_ + width_) % width_;
  return pixels_[size_t(std::clamp(y, 0, height_ - 1)) * size_t(width_) + size_t(x)];
}

Vec3 Environment::radiance(const Vec3& direction) const {
  if (pixels_.empty()) return Vec3(0);
  Vec2 at = place_of(to_local(direction));
  float x = at.x * float(width_) - 0.5f, y = at.y * float(height_) - 0.5f;
  int left = int(std::floor(x)), top = int(std::floor(y));
  float s = x - float(left), t = y - float(top);
  return glm::mix(glm::mix(pixel(left, top), pixel(left + 1, top), s),
                  glm::mix(pixel(left, top + 1), pixel(left + 1, top + 1), s), t);
}

void Environment::shade(ShadingBatch& batch, const Vec3* directions, const float* spreads, size_t count, Vec3* radiance,
                        uint8_t* faulted, FaultLog& faults) const {
  if (!call_) return; // of an image
  for (size_t k = 0; k < count; ++k) {
    Vec3 d = to_local(directions[k]);
    for (int c = 0; c < 3; ++c)
      batch.inputs[size_t(kIncident) + size_t(c)][k] = d[c];
    batch.inputs[kFootprint][k] = spreads[k];
  }
  std::fill_n(batch.scratch_codes.data(), count, uint8_t(0));
  float* out[3] = {batch.results[0].data(), batch.results[1].data(), batch.results[2].data()};
  FaultReport report;
  call_->run(batch, 0, count, EntryCall::inputs_of(batch, 0), out, batch.scratch_codes.data(), report);
  note_faults(*call_, batch.scratch_codes.data(), count, report, faults);
  for (size_t k = 0; k < count; ++k) {
    faulted[k] = batch.scratch_codes[k] != 0;
    radiance[k] += glm::max(Vec3(out[0][k], out[1][k], out[2][k]), Vec3(0)) * scale_;
  }
}

/// Ramamoorthi and Hanrahan 2001.
Vec3 Environment::irradiance(const Vec3& normal) const {
  constexpr float kBands[] = {kPi, 2 * kPi / 3, kPi / 4};
  auto basis = harmonics_at(normal);
  Vec3 sum(0);
  for (size_t b = 0; b < 9; ++b)
    sum += harmonics_[b] * (basis[b] * kBands[b == 0 ? 0 : b < 4 ? 1 : 2]);
  return glm::max(sum, Vec3(0));
}

} // namespace moonshade::renderer
