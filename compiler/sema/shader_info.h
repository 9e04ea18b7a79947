// What a host may know of a checked shader: its entry points, parameters, modules and images. The same facts serve the
// compiled shader, the interpreted one and `shaderc --describe`.
#pragma once

#include "compiler/base/source.h"
#include "stdlib/value_type.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace moonshade {

/// A constant value of the dialect as hosts give and get it. Vectors as 2 to 4 numbers.
using Constant = std::variant<bool, int64_t, double, std::vector<double>, std::string>;

struct InputInfo {
  std::string name; ///< as in the manual's table of inputs: "p", "uv", ...
  ValueType type;
};

struct EntryInfo {
  std::string name;
  std::vector<InputInfo> inputs;  ///< those that the function declares, in its order
  std::vector<ValueType> results; ///< booleans, integers, numbers and vectors
};

/// `param(name, default, meta)`.
struct ParameterInfo {
  std::string name;
  Span span{};                   ///< of the call
  std::optional<ValueType> type; ///< nothing for a string parameter
  Constant default_value;
  std::optional<double> min, max, step;
  std::string doc, label;
  std::vector<Constant> choices;
  /// Of a string parameter: the constants that the shader compares it with. Compiled code knows its value as an index
  /// here, or kNoneCompared.
  std::vector<std::string> compared;
};
inline constexpr int64_t kNoneCompared = -1;
/// The index of a string parameter's value in `compared`.
int64_t compared_index(const ParameterInfo& parameter, std::string_view value);

/// An image that `texture` names.
struct ImageInfo {
  std::string file;                     ///< as written; of a parameter its default
  std::optional<size_t> parameter = {}; ///< the string parameter that names it: index in ShaderInfo::parameters
  bool raw = false;                     ///< numbers, not colours: 8-bit files are not decoded from sRGB
  Span span{};                          ///< of the argument
  std::string from = {};                ///< the source file in which it stands; relative names begin in its folder
  uint32_t line = 0, column = 0;        ///< there
};

struct ShaderInfo {
  std::vector<EntryInfo> entries;
  std::vector<ParameterInfo> parameters;
  std::vector<std::string> modules; ///< files loaded by `require`
  std::vector<ImageInfo> images;    ///< that `texture` looks up

  const EntryInfo* find_entry(std::string_view name) const {
    for (const EntryInfo& entry : entries)
      if (entry.name == name) return &entry;
    return nullptr;
  }
};

/// Type of the input `name`, or nothing where the dialect has no such input.
std::optional<ValueType> input_type(std::string_view name);

/// The value of an override, checked against the parameter: the converted value, or an error that names it.
struct CheckedConstant {
  Constant value;
  std::string error; ///< empty where the value fits
};
CheckedConstant check_override(const ParameterInfo& parameter, const Constant& value);

/// Reads "2", "0.2,0.4,1", "true" or text as a value of the parameter's type; as check_override.
CheckedConstant parse_override(const ParameterInfo& parameter, std::string_view text);

} // namespace moonshade
