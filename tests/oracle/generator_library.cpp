// Calls of every function of the library, straight from its table.
#include "stdlib/library.h"
#include "tests/oracle/generator_impl.h"

#include <algorithm>
#include <array>

namespace moonshade::oracle {

namespace {

constexpr T type_of(ValueType type) { return static_cast<T>(type); }
static_assert(type_of(ValueType::Boolean) == T::B && type_of(ValueType::Vec4) == T::V4 &&
              type_of(ValueType::Mat4) == T::M4);

/// Rows that an expression can call, by what they give; componentwise rows also give vectors.
struct Rows {
  std::array<std::vector<const LibraryFunction*>, 8> by_result;
  Rows() {
    for (const LibraryFunction& row : library()) {
      if (row.name.starts_with("op.")) continue;
      by_result[size_t(row.results[0])].push_back(&row);
      if (row.componentwise)
        for (const ValueType type : {ValueType::Vec2, ValueType::Vec3, ValueType::Vec4})
          by_result[size_t(type)].push_back(&row);
    }
  }
};

/// Many instructions, all of them inlined.
bool is_heavy(const LibraryFunction& row) {
  static const std::vector<std::string_view> light = {"math.", "hash", "mix", "min", "max"};
  if (std::ranges::any_of(light, [&](std::string_view name) { return row.name.starts_with(name); })) return false;
  const std::string_view doc = row.doc;
  return doc.find("oise") != doc.npos || doc.find("octaves") != doc.npos || doc.find("oronoi") != doc.npos ||
         doc.find("orley") != doc.npos || row.result_count > 2;
}

/// An integer is another argument than the number that equals it.
bool tells_kinds(const LibraryFunction& row) { return row.name.starts_with("math.") || row.name == "hash"; }

} // namespace

/// A sum of a noise of the library, of a function of the program or of one written there.
std::string Generator::sum_of_function(int depth) {
  const std::string_view name =
      random_.pick(std::vector<std::string_view>{"fbm", "turbulence", "ridged", "hybrid", "warp"});
  const T point = random_.pick(std::vector<T>{T::N, T::V2, T::V3, T::V4});
  static const std::vector<std::string> noises = {"noise", "perlin", "valuenoise", "cellnoise", "worley"};
  std::string text = std::string(name) + "(";
  text += random_.chance(0.5) ? random_.pick(noises) : function_argument({point, T::N}, depth - 1);
  text += ", " + expression(point, depth - 1);
  const int count = random_.between(0, name == "hybrid" || name == "warp" ? 6 : 5);
  for (int i = 0; i < count; ++i) {
    static const std::vector<std::string> octaves = {"1", "2", "1.5", "3"};
    text += ", " + (i == 0                ? random_.pick(octaves)
                    : random_.chance(0.7) ? number_literal()
                                          : expression(T::N, depth - 1));
  }
  return text + ")";
}

std::string Generator::library(T type, int depth) {
  if (type == T::N && depth > 0 && heavy_ < kMaxHeavy && random_.chance(0.04)) {
    ++heavy_;
    return sum_of_function(depth);
  }
  static const Rows rows;
  const auto& fits = rows.by_result[static_cast<size_t>(type)];
  if (fits.empty()) return leaf(type, depth);
  const LibraryFunction* row = random_.pick(fits);
  if (row->name == "math.tointeger" && random_.chance(0.9)) return leaf(type, depth);
  if (is_heavy(*row)) {
    if (heavy_ >= kMaxHeavy || random_.chance(0.4)) return leaf(type, depth);
    ++heavy_;
  }
  const bool by_component = row->componentwise && is_vector(type);
  std::vector<T> types;
  const unsigned count = static_cast<unsigned>(random_.between(row->required_count, row->parameter_count));
  const unsigned certain = random_.below(std::max(count, 1u)); // which argument is a vector for sure
  for (unsigned i = 0; i < count; ++i) {
    T wanted = type_of(row->parameters[i]);
    if (by_component && (i == certain || random_.chance(0.6))) wanted = type;
    if (wanted == T::N && !tells_kinds(*row) && random_.chance(0.06)) wanted = T::I;
    types.push_back(wanted);
  }
  std::string text(row->name);
  unsigned first = 0;
  const bool is_method = count > 0 && (is_vector(types[0]) || is_matrix(types[0])) && random_.chance(0.2);
  if (is_method) {
    text = "(" + expression(types[0], depth - 1) + "):" + text;
    first = 1;
  }
  text += "(";
  for (unsigned i = first; i < count; ++i)
    text += (i > first ? ", " : "") + expression(types[i], depth - 1);
  text += ")";
  return row->result_count > 1 ? "(" + text + ")" : text;
}

} // namespace moonshade::oracle
