// Light from all around, given by an image (latitude and longitude) or by a shader's `environment`, and a table over
// its directions by which it is sampled. The shader itself says what arrives; the table only where to look.
#pragma once

#include "renderer/materials/material_set.h"
#include "renderer/scene/scene.h"

#include <array>
#include <string>
#include <vector>

namespace moonshade::renderer {

class Environment {
public:
  /// Error: an image that cannot be read, a shader that does not compile or has no `environment`.
  static std::string load(const Light& light, const Scene& scene, ShaderSource& shaders,
                          const std::map<std::string, std::string>& overrides, Environment& environment,
                          std::string& warnings);

  bool by_shader() const { return call_.has_value(); }
  /// Of an image; black where a shader gives it.
  Vec3 radiance(const Vec3& direction) const;
  /// Adds what the shader gives for `count` directions; `faulted` becomes 1 where it fails.
  void shade(ShadingBatch& batch, const Vec3* directions, const float* spreads, size_t count, Vec3* radiance,
             uint8_t* faulted, FaultLog& faults) const;

  Vec3 sample(const Vec2& u) const;
  /// Per solid angle.
  float pdf(const Vec3& direction) const;
  bool is_black() const { return cumulative_.empty(); }
  /// On a surface with this normal, without what stands before it: by spherical harmonics.
  Vec3 irradiance(const Vec3& normal) const;
  /// Over all directions.
  Vec3 mean() const { return mean_; }

private:
  std::string read_image(const std::string& file);
  void make_table(const std::vector<Vec3>& cells, int width, int height);
  Vec3 to_local(const Vec3& d) const { return {d.x * cos_ + d.z * sin_, d.y, d.z * cos_ - d.x * sin_}; }
  Vec3 to_world(const Vec3& d) const { return {d.x * cos_ - d.z * sin_, d.y, d.z * cos_ + d.x * sin_}; }
  Vec3 pixel(int x, int y) const;

  Vec3 scale_{1};
  float cos_ = 1, sin_ = 0;
  std::optional<EntryCall> call_;
  int width_ = 0, height_ = 0; ///< of the image
  std::vector<Vec3> pixels_;
  int columns_ = 0, rows_ = 0; ///< of the table
  std::vector<float> cumulative_rows_, cumulative_;
  Vec3 mean_{0};
  std::array<Vec3, 9> harmonics_{};
};

} // namespace moonshade::renderer
