// What a scene can say: every function with its fields, their kinds, defaults and ranges, one table. The reader checks
// by it, and docs/scene-reference.md is printed from it (`moonrender --help-scene`), so that the two cannot differ.
#pragma once

#include "renderer/math.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::renderer {

enum class FieldKind : uint8_t {
  Number,
  Integer,
  Boolean,
  Text,
  File,
  Vector,        ///< three numbers
  Triple,        ///< three numbers, or one for all of them
  Color,         ///< a triple that is not negative
  ColorOrShader, ///< or a shader's file
  NumberOrShader,
  Matrix,
  Choice,
  Material,
  Object,
  Parameters
};

struct FieldInfo {
  std::string_view name;
  std::string_view doc;
  double least = -1e9, most = 1e9;              ///< of numbers
  std::span<const std::string_view> words = {}; ///< of choices; the first is the default
  std::string_view only = {};                   ///< the words of `type` that have it, where not all do
  std::string_view shown = {};                  ///< the default, where it is no constant
  /// Of an absent field: numbers, vectors, booleans.
  std::optional<std::array<double, 3>> otherwise = std::nullopt;
  FieldKind kind = FieldKind::Number;
  bool required = false;
};

enum class SceneFunction : uint8_t {
  Camera,
  Render,
  Material,
  Sphere,
  Rectangle,
  Plane,
  Box,
  Obj,
  Ply,
  Gltf,
  Light,
  Group,
  Instance
};
inline constexpr size_t kSceneFunctionCount = 13;

struct FunctionInfo {
  std::string_view name;
  std::string_view doc;
  std::span<const FieldInfo> fields;
  bool is_object = false;   ///< has those of every object, too
  bool has_material = true; ///< of an object
};

/// In the order of the enumeration.
std::span<const FunctionInfo> scene_functions();
inline const FunctionInfo& scene_function(SceneFunction function) { return scene_functions()[size_t(function)]; }
std::span<const std::string_view> scene_function_names();

/// The row of a function's field, those of every object included, for the `type` that the call has; null where there is
/// none.
const FieldInfo* find_field(const FunctionInfo& function, std::string_view name, std::string_view type = {});

/// The names of a function's fields, those of every object included, that a call of this `type` has; without a type
/// those of all types.
std::vector<std::string_view> field_names(const FunctionInfo& function, std::string_view type);

/// The reference as Markdown.
std::string scene_reference();

} // namespace moonshade::renderer
