// Reading the fields of one recorded call, with an error for every field that is unknown or of the wrong kind.
#pragma once

#include "renderer/math.h"
#include "renderer/scene/lua_sandbox.h"
#include "renderer/scene/scene_reference.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::renderer {

class SceneFields {
public:
  /// `place` names file and line of the call. Names that the function does not know, for the call's `type` where it has
  /// types, come first of all errors: a misspelt field is also a missing one.
  SceneFields(const SceneCall& call, const FunctionInfo& function, std::string place);

  // Each field has a row in the scene's reference, which gives its range, and the default where `otherwise` is not
  // given.
  bool has(std::string_view name) const { return find(name) != nullptr; }
  double number(std::string_view name, std::optional<double> otherwise = std::nullopt);
  int64_t integer(std::string_view name);
  bool boolean(std::string_view name);
  std::string text(std::string_view name, const std::string& otherwise = "");
  Vec3 vector(std::string_view name);
  Mat4 matrix(std::string_view name);
  /// Three numbers, or one for all of them.
  Vec3 triple(std::string_view name, std::optional<Vec3> otherwise = std::nullopt);
  /// A triple that is not negative.
  Vec3 color(std::string_view name, std::optional<Vec3> otherwise = std::nullopt);
  const SceneValue* find(std::string_view name) const;
  /// The index of one of the field's words; 0 where the field is absent.
  size_t choice(std::string_view name);
  void require(std::string_view name);

  void fail(const std::string& message);
  /// The first error, or that of what has no name, unless it `takes_items`; empty where all is well.
  std::string finish(bool takes_items = false);

private:
  const FieldInfo& row(std::string_view name);
  Vec3 constant(std::string_view name);
  bool numbers(std::string_view name, const SceneValue& value, size_t count, double* out);

  const SceneCall& call_;
  const FunctionInfo& function_;
  std::string place_, error_;
  std::string_view type_;               ///< the call's; empty where it has none, or an unknown one
  std::vector<std::string_view> known_; ///< fields of that type
};

} // namespace moonshade::renderer
