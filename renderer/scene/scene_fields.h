// Reading the fields of one recorded call, with an error for every field that is unknown or of the wrong kind.
#pragma once

#include "renderer/math.h"
#include "renderer/scene/lua_sandbox.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::renderer {

class SceneFields {
public:
  /// Products of four such numbers (areas squared, scaled sizes) are still finite in float.
  static constexpr double kGreatest = 1e9;

  /// `what` names the call in messages ("sphere"), `place` its file and line.
  SceneFields(const SceneCall& call, std::string what, std::string place)
      : call_(call), what_(std::move(what)), place_(std::move(place)) {}

  bool has(std::string_view name) { return find(name) != nullptr; }
  double number(std::string_view name, double otherwise, double least = -kGreatest, double most = kGreatest);
  int64_t integer(std::string_view name, int64_t otherwise, int64_t least, int64_t most);
  bool boolean(std::string_view name, bool otherwise);
  std::string text(std::string_view name, const std::string& otherwise = "");
  Vec3 vector(std::string_view name, const Vec3& otherwise);
  /// Twelve or sixteen numbers, row by row; the identity where the field is absent.
  Mat4 matrix(std::string_view name);
  /// Three numbers, or one for all of them.
  Vec3 triple(std::string_view name, const Vec3& otherwise);
  /// A triple that is not negative.
  Vec3 color(std::string_view name, const Vec3& otherwise);
  const SceneValue* find(std::string_view name);
  /// One of the words; the first where the field is absent.
  size_t choice(std::string_view name, std::span<const std::string_view> words);
  void require(std::string_view name);

  void fail(const std::string& message);
  /// The first error, or that of a field nobody asked for (or of what has no name, unless it `takes_items`); empty
  /// where all is well.
  std::string finish(bool takes_items = false);

private:
  bool numbers(std::string_view name, const SceneValue& value, size_t count, double* out);

  const SceneCall& call_;
  std::string what_, place_, error_;
  std::vector<std::string_view> known_;
};

} // namespace moonshade::renderer
