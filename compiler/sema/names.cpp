// The names that are left out stand here once, each with its refusal; the names that exist come from the library's
// table.
#include "compiler/sema/names.h"

#include "stdlib/library.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numbers>

namespace moonshade::sema {

namespace {

using Code = DiagnosticCode;

constexpr std::string_view kConstantStrings = "strings are constants, written whole";
constexpr std::string_view kNoFiles = "a shader touches no files; use 'texture' for images and 'param' for settings";

constexpr RefusedName kRefusedNames[] = {
    {"pcall", Code::ProtectedCalls, ""},
    {"xpcall", Code::ProtectedCalls, ""},
    {"load", Code::LoadingCode, ""},
    {"loadstring", Code::LoadingCode, ""},
    {"loadfile", Code::LoadingCode, ""},
    {"dofile", Code::LoadingCode, ""},
    {"setmetatable", Code::Metatables, ""},
    {"getmetatable", Code::Metatables, ""},
    {"rawget", Code::Metatables, ""},
    {"rawset", Code::Metatables, ""},
    {"rawequal", Code::Metatables, ""},
    {"rawlen", Code::Metatables, ""},
    {"coroutine", Code::Coroutines, ""},
    {"pairs", Code::PairsLoop, ""},
    {"next", Code::PairsLoop, ""},
    {"select", Code::Varargs, ""},
    {"tostring", Code::StringBuilding, "'tostring'"},
    {"string", Code::LibraryLeftOut, kConstantStrings},
    {"utf8", Code::LibraryLeftOut, kConstantStrings},
    {"io", Code::LibraryLeftOut, kNoFiles},
    {"os", Code::LibraryLeftOut, "for animation take the input 'time'"},
    {"table", Code::LibraryLeftOut, "write the elements of an array in its constructor"},
    {"debug", Code::LibraryLeftOut, "to look at values use 'print'"},
    {"package", Code::LibraryLeftOut, "modules are loaded by 'require' alone"},
    {"collectgarbage", Code::LibraryLeftOut, "a shader makes no garbage"},
    {"tonumber", Code::LibraryLeftOut, "types are known while compiling; write the number itself"},
    {"type", Code::LibraryLeftOut, "types are known while compiling, so there is nothing to ask"},
    {"warn", Code::LibraryLeftOut, "use 'print'"},
    {"_G", Code::EnvironmentTable, ""},
    {"_ENV", Code::EnvironmentTable, ""},
    {"_VERSION", Code::LibraryLeftOut, "it is Lua 5.4"},
    {"math.random", Code::RandomNumbers, ""},
    {"math.randomseed", Code::RandomNumbers, ""},
    {"ipairs", Code::LibraryLeftOut, "it stands in 'for i, v in ipairs(array)' alone"},
};

/// Functions that the manual promises; those that the table does not have yet are refused as such, not as unknown.
constexpr std::string_view kPlannedFunctions[] = {
    "abs",         "sign",      "floor",     "ceil",        "fract",       "round",      "trunc",      "mod",
    "min",         "max",       "clamp",     "saturate",    "mix",         "step",       "smoothstep", "smootherstep",
    "linearstep",  "pulse",     "bias",      "gain",        "pow",         "exp",        "log",        "sqrt",
    "inversesqrt", "sin",       "cos",       "tan",         "asin",        "acos",       "atan",       "radians",
    "degrees",     "dot",       "cross",     "length",      "distance",    "normalize",  "reflect",    "refract",
    "faceforward", "transpose", "inverse",   "determinant", "rotate",      "noise",      "perlin",     "valuenoise",
    "cellnoise",   "worley",    "gabor",     "curl",        "turbulence",  "fbm",        "ridged",     "hybrid",
    "warp",        "checker",   "brick",     "tiles",       "hexagons",    "stripes",    "dots",       "wood",
    "marble",      "voronoi",   "hash",      "luminance",   "hsv2rgb",     "rgb2hsv",    "oklab2rgb",  "rgb2oklab",
    "blackbody",   "ramp",      "palette",   "srgb2linear", "linear2srgb", "sd_sphere",  "sd_box",     "sd_torus",
    "sd_capsule",  "sd_plane",  "union",     "intersect",   "subtract",    "math.abs",   "math.acos",  "math.asin",
    "math.atan",   "math.ceil", "math.cos",  "math.deg",    "math.exp",    "math.floor", "math.fmod",  "math.log",
    "math.max",    "math.min",  "math.modf", "math.rad",    "math.sin",    "math.sqrt",  "math.tan",   "math.tointeger",
    "math.type",   "math.ult",
};

constexpr std::array<std::string_view, 20> kBuiltIn = {
    "vec2",     "vec3",   "vec4",  "rgb",        "mat3",      "mat4",           "param",
    "require",  "assert", "error", "math.floor", "math.ceil", "math.tointeger", "math.type",
    "gradient", "fwidth", "ramp",  "print",      "math.modf", "texture"};

constexpr LibraryConstant kConstants[] = {
    {"math.pi", false, std::numbers::pi, 0},
    {"math.huge", false, std::numeric_limits<double>::infinity(), 0},
    {"math.maxinteger", true, 0, std::numeric_limits<int64_t>::max()},
    {"math.mininteger", true, 0, std::numeric_limits<int64_t>::min()},
};

/// Edits between two short names: insertions, deletions, replacements and swaps of neighbours.
unsigned edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<unsigned>> rows(a.size() + 1, std::vector<unsigned>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i)
    rows[i][0] = static_cast<unsigned>(i);
  for (size_t j = 0; j <= b.size(); ++j)
    rows[0][j] = static_cast<unsigned>(j);
  for (size_t i = 1; i <= a.size(); ++i)
    for (size_t j = 1; j <= b.size(); ++j) {
      rows[i][j] = std::min({rows[i - 1][j] + 1, rows[i][j - 1] + 1, rows[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
    }
  return rows[a.size()][b.size()];
}

} // namespace

const RefusedName* find_refused_name(std::string_view name) {
  for (const RefusedName& refused : kRefusedNames)
    if (refused.name == name) return &refused;
  static constexpr RefusedName kPlanned = {"", Code::NotAvailableYet, ""};
  if (is_library_function(name)) return nullptr;
  return std::ranges::find(kPlannedFunctions, name) != std::end(kPlannedFunctions) ? &kPlanned : nullptr;
}

bool is_built_in(std::string_view name) { return std::ranges::find(kBuiltIn, name) != kBuiltIn.end(); }

bool is_library_function(std::string_view name) {
  if (name.starts_with("op.")) return false;
  return is_built_in(name) || !library_overloads(name).empty();
}

std::string_view permanent_library_name(std::string_view name) {
  const auto built_in = std::ranges::find(kBuiltIn, name);
  return built_in != kBuiltIn.end() ? *built_in : library_overloads(name).front().name;
}

const LibraryConstant* find_library_constant(std::string_view name) {
  for (const LibraryConstant& constant : kConstants)
    if (constant.name == name) return &constant;
  return nullptr;
}

std::vector<std::string_view> library_names(std::string_view prefix) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (!name.starts_with(prefix) || name.starts_with("op.")) return;
    const std::string_view rest = name.substr(prefix.size());
    if (rest.find('.') == std::string_view::npos && (names.empty() || names.back() != rest)) names.push_back(rest);
  };
  for (const LibraryFunction& function : library())
    add(function.name);
  for (const std::string_view name : kBuiltIn)
    add(name);
  for (const LibraryConstant& constant : kConstants)
    add(constant.name);
  if (prefix.empty()) names.push_back("math");
  return names;
}

std::optional<std::string_view> nearest(std::string_view name, std::span<const std::string_view> candidates) {
  constexpr size_t kLongest = 64;
  if (name.size() > kLongest || name.size() < 2) return std::nullopt;
  std::optional<std::string_view> best;
  const auto most = static_cast<unsigned>(std::max<size_t>(1, name.size() / 3));
  unsigned best_distance = most;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongest || candidate == name) continue;
    const size_t difference = std::max(candidate.size(), name.size()) - std::min(candidate.size(), name.size());
    if (difference > best_distance) continue;
    const unsigned distance = edit_distance(name, candidate);
    if (distance > most || distance > best_distance) continue;
    // Of equally near ones the first of the alphabet: candidates come from hash tables, which have no order.
    if (distance < best_distance || !best || candidate < *best) best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string suggestion(const std::optional<std::string_view>& nearest_name) {
  return nearest_name ? "; did you mean '" + std::string(*nearest_name) + "'" : "";
}

void suggest_fix(Diagnostic& diagnostic, const std::optional<std::string_view>& nearest_name) {
  if (nearest_name) diagnostic.suggest(diagnostic.span, std::string(*nearest_name));
}

} // namespace moonshade::sema
