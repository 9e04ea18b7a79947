// Kinds of fields, and their messages.
#include "renderer/scene/scene_fields.h"

#include "renderer/scene/nearest_name.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace moonshade::renderer {

/// The word of the call's `type`; empty where the function has no types, or the call no known one.
static std::string_view type_of(const SceneCall& call, const FunctionInfo& function) {
  const FieldInfo* field = find_field(function, "type");
  if (!field) return {};
  auto given = call.fields.find("type");
  if (given == call.fields.end()) return field->required ? std::string_view() : field->words[0];
  const auto* text = std::get_if<std::string>(&given->second.value);
  auto word = text ? std::find(field->words.begin(), field->words.end(), *text) : field->words.end();
  return word == field->words.end() ? std::string_view() : *word;
}

SceneFields::SceneFields(const SceneCall& call, const FunctionInfo& function, std::string place)
    : call_(call), function_(function), place_(std::move(place)), type_(type_of(call, function)),
      known_(field_names(function, type_)) {
  for (const auto& [name, value] : call_.fields)
    if (std::find(known_.begin(), known_.end(), name) == known_.end()) {
      std::string hint = did_you_mean(name, known_);
      fail("unknown field '" + name + "'" + (hint.empty() ? " (known: " + join_names(known_) + ")" : hint));
    }
}

void SceneFields::fail(const std::string& message) {
  if (error_.empty()) error_ = place_ + ": " + std::string(function_.name) + ": " + message;
}

/// A field without a row is our own mistake; it shows in the first scene that has the function.
const FieldInfo& SceneFields::row(std::string_view name) {
  static constexpr FieldInfo kNone;
  const FieldInfo* field = find_field(function_, name, type_);
  if (!field) fail("the field '" + std::string(name) + "' is not in the reference");
  return field ? *field : kNone;
}

Vec3 SceneFields::constant(std::string_view name) {
  std::array<double, 3> v = row(name).otherwise.value_or(std::array<double, 3>{});
  return {float(v[0]), float(v[1]), float(v[2])};
}

const SceneValue* SceneFields::find(std::string_view name) const {
  auto found = call_.fields.find(std::string(name));
  return found == call_.fields.end() ? nullptr : &found->second;
}

void SceneFields::require(std::string_view name) {
  if (!has(name)) fail("the field '" + std::string(name) + "' is missing");
}

static std::optional<double> as_number(const SceneValue& value) {
  if (auto* i = std::get_if<int64_t>(&value.value)) return double(*i);
  if (auto* d = std::get_if<double>(&value.value)) return *d;
  return std::nullopt;
}

static std::string plain(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  if (std::strtod(text.data(), nullptr) != value) std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

double SceneFields::number(std::string_view name, std::optional<double> default_value) {
  const FieldInfo& info = row(name);
  const double otherwise = default_value ? *default_value : info.otherwise ? (*info.otherwise)[0] : 0.0;
  const SceneValue* value = find(name);
  if (!value) return otherwise;
  std::optional<double> number = as_number(*value);
  if (!number || !std::isfinite(*number)) {
    fail("'" + std::string(name) + "' is a number");
    return otherwise;
  }
  if (*number < info.least || *number > info.most) {
    fail("'" + std::string(name) + "' lies between " + plain(info.least) + " and " + plain(info.most));
    return otherwise;
  }
  return *number;
}

int64_t SceneFields::integer(std::string_view name) {
  double value = number(name);
  if (value != std::floor(value)) fail("'" + std::string(name) + "' is an integer");
  return int64_t(value);
}

bool SceneFields::boolean(std::string_view name) {
  const bool otherwise = constant(name).x != 0;
  const SceneValue* value = find(name);
  if (!value) return otherwise;
  if (auto* b = std::get_if<bool>(&value->value)) return *b;
  fail("'" + std::string(name) + "' is true or false");
  return otherwise;
}

std::string SceneFields::text(std::string_view name, const std::string& otherwise) {
  row(name);
  const SceneValue* value = find(name);
  if (!value) return otherwise;
  if (auto* s = std::get_if<std::string>(&value->value)) return *s;
  fail("'" + std::string(name) + "' is a string");
  return otherwise;
}

static constexpr double kMost = FieldInfo().most; // of the numbers of lists, too

bool SceneFields::numbers(std::string_view name, const SceneValue& value, size_t count, double* out) {
  const auto* list = std::get_if<SceneValue::List>(&value.value);
  bool ok = list && list->size() == count;
  for (size_t i = 0; ok && i < count; ++i) {
    std::optional<double> number = as_number((*list)[i]);
    ok = number && std::isfinite(*number);
    if (ok) out[i] = *number;
    if (ok && std::abs(*number) > kMost) {
      fail("'" + std::string(name) + "' lies between " + plain(-kMost) + " and " + plain(kMost));
      return false;
    }
  }
  if (!ok) fail("'" + std::string(name) + "' is a list of " + std::to_string(count) + " numbers");
  return ok;
}

Vec3 SceneFields::vector(std::string_view name) {
  const SceneValue* value = find(name);
  double v[3];
  return value && numbers(name, *value, 3, v) ? Vec3(v[0], v[1], v[2]) : constant(name);
}

Mat4 SceneFields::matrix(std::string_view name) {
  Mat4 m(1.0f);
  const SceneValue* value = find(name);
  if (!value) return m;
  const auto* list = std::get_if<SceneValue::List>(&value->value);
  double v[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  if (!list || (list->size() != 12 && list->size() != 16))
    return fail("'" + std::string(name) + "' is a list of 12 or 16 numbers, row by row"), m;
  if (!numbers(name, *value, list->size(), v)) return m;
  if (v[12] != 0 || v[13] != 0 || v[14] != 0 || v[15] != 1)
    fail("the last row of '" + std::string(name) + "' is 0, 0, 0, 1");
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      m[column][row] = float(v[4 * row + column]);
  return m;
}

Vec3 SceneFields::triple(std::string_view name, std::optional<Vec3> otherwise) {
  const SceneValue* value = find(name);
  if (!value) return otherwise ? *otherwise : constant(name);
  return as_number(*value) ? Vec3(float(number(name))) : vector(name);
}

Vec3 SceneFields::color(std::string_view name, std::optional<Vec3> otherwise) {
  Vec3 v = triple(name, otherwise);
  if (v.x < 0 || v.y < 0 || v.z < 0) fail("'" + std::string(name) + "' is not negative");
  return v;
}

size_t SceneFields::choice(std::string_view name) {
  std::span<const std::string_view> words = row(name).words;
  if (words.empty()) return 0;
  std::string word = text(name, std::string(words[0]));
  for (size_t i = 0; i < words.size(); ++i)
    if (words[i] == word) return i;
  fail("unknown " + std::string(name) + " '" + word + "'" + did_you_mean(word, words) +
       " (known: " + join_names(words) + ")");
  return 0;
}

std::string SceneFields::finish(bool takes_items) {
  if (!takes_items && !call_.items.empty()) fail("takes named fields only: " + join_names(known_));
  return error_;
}

} // namespace moonshade::renderer
