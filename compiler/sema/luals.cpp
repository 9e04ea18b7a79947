// Writes the definitions (luals.h): plain Lua, all of whose content are annotations. `math`, `assert`, `error` and
// `print` are LuaLS's own.
#include "compiler/sema/luals.h"

#include "stdlib/library.h"
#include "stdlib/sums.h"

#include <array>
#include <cstdio>
#include <set>
#include <vector>

namespace moonshade::sema {

namespace {

constexpr std::string_view kHead = R"(---@meta moonshade
-- The standard library of Moonshade's shaders, for LuaLS. Written by `shaderc --emit=luals`; do not edit.

)";

/// What is no row of the table.
constexpr std::string_view kBuiltIns =
    R"(---A vector: one number for both components, or numbers and vectors of 2 components in all.
---@param x number|vec2
---@param y? number
---@return vec2
function vec2(x, y) end

---A vector: one number for all components, or numbers and vectors of 3 components in all.
---@param x number|vec2|vec3
---@param y? number|vec2
---@param z? number
---@return vec3
function vec3(x, y, z) end

---A vector: one number for all components, or numbers and vectors of 4 components in all.
---@param x number|vec2|vec3|vec4
---@param y? number|vec2|vec3
---@param z? number|vec2
---@param w? number
---@return vec4
function vec4(x, y, z, w) end

---A colour, linear Rec. 709: vec3 by another name.
---@param r number
---@param g number
---@param b number
---@return vec3
---@overload fun(grey: number): vec3
function rgb(r, g, b) end

---A matrix: its columns, its nine numbers column by column, one number for the diagonal, or a mat4 to cut.
---@param ... number|vec3|mat4
---@return mat3
function mat3(...) end

---A matrix: its columns, its sixteen numbers column by column, one number for the diagonal, or a mat3 to grow.
---@param ... number|vec4|mat3
---@return mat4
function mat4(...) end

---@class moonshade.parameter
---@field min? number
---@field max? number
---@field step? number
---@field doc? string
---@field label? string
---@field choices? any[]

---Declares a parameter of the shader, at the top level; a host may set another value.
---@generic T: boolean|number|vec2|vec3|vec4|string
---@param name string
---@param default T
---@param meta? moonshade.parameter
---@return T
function param(name, default, meta) end

---The exact derivative of a number-valued function of a number or a vector.
---@param f fun(p: vec3): number
---@param p vec3
---@return vec3
---@overload fun(f: (fun(p: vec2): number), p: vec2): vec2
---@overload fun(f: (fun(p: vec4): number), p: vec4): vec4
---@overload fun(f: (fun(x: number): number), x: number): number
function gradient(f, p) end

---Through an array of values at equal distances over 0..1, along lines; x is clamped.
---@param x number
---@param values number[]
---@return number
---@overload fun(x: number, values: vec2[]): vec2
---@overload fun(x: number, values: vec3[]): vec3
---@overload fun(x: number, values: vec4[]): vec4
function ramp(x, values) end

---Looks up an image: red, green, blue, alpha (1 where the file has none). v goes up, the image repeats.
---@param file string a constant name, relative to this file, or a parameter
---@param uv vec2
---@param width? number width of the footprint, in the units of uv; 0 interpolates between four texels
---@param options? { raw: boolean } raw: 8-bit files are not decoded from sRGB
---@return vec4
---@overload fun(file: string, uv: vec2, options: { raw: boolean }): vec4
function texture(file, uv, width, options) end

---How much f changes over the footprint fw at p.
---@param f fun(p: any): number
---@param p number|vec2|vec3|vec4
---@param fw number
---@return number
function fwidth(f, p, fw) end

)";

constexpr std::array<ValueType, 5> kClasses = {ValueType::Vec2, ValueType::Vec3, ValueType::Vec4, ValueType::Mat3,
                                               ValueType::Mat4};

bool is_written(const LibraryFunction& row) { return row.name.find('.') == std::string_view::npos; }

std::string type_text(ValueType type) { return std::string(name_of(type)); }

std::vector<std::string> names_of(const LibraryFunction& row) {
  std::vector<std::string> names;
  std::string_view rest = row.parameter_names;
  while (!rest.empty()) {
    const size_t blank = rest.find(' ');
    names.emplace_back(rest.substr(0, blank));
    rest = blank == std::string_view::npos ? std::string_view{} : rest.substr(blank + 1);
  }
  // Words of Lua cannot name a parameter.
  for (std::string& name : names)
    if (name == "end" || name == "in" || name == "function" || name == "repeat") name += '_';
  return names;
}

/// A row's types, or those of its form by component.
struct Form {
  const LibraryFunction* row;
  ValueType number = ValueType::Number; ///< what stands for numbers

  ValueType of(ValueType type) const { return type == ValueType::Number ? number : type; }
};

std::vector<Form> forms_of(std::span<const LibraryFunction> rows) {
  std::vector<Form> forms;
  for (const LibraryFunction& row : rows) {
    forms.push_back({&row});
    if (!row.componentwise) continue;
    for (const ValueType vector : {ValueType::Vec2, ValueType::Vec3, ValueType::Vec4})
      forms.push_back({&row, vector});
  }
  return forms;
}

/// "number|vec3" for the parameters behind the first of a form by component: a number counts for each component.
std::string parameter_type(const Form& form, size_t index) {
  const ValueType declared = form.row->parameters[index];
  std::string type = type_text(form.of(declared));
  if (form.number != ValueType::Number && declared == ValueType::Number && form.row->parameter_count > 1)
    type += "|number";
  return type;
}

std::string results_text(const Form& form) {
  std::string text;
  for (unsigned i = 0; i < form.row->result_count; ++i)
    text += (i == 0 ? "" : ", ") + type_text(form.of(form.row->results[i]));
  return text;
}

/// "fun(x: number, y?: number): number"
std::string overload(const Form& form, const char* self) {
  const std::vector<std::string> names = names_of(*form.row);
  std::string text = "fun(";
  for (unsigned i = 0; i < form.row->parameter_count; ++i) {
    text += (i == 0 ? "" : ", ") + (i == 0 && self != nullptr ? std::string(self) : names[i]);
    text += (i < form.row->required_count ? ": " : "?: ") + parameter_type(form, i);
  }
  return text + "): " + results_text(form);
}

/// Of a sum of noise, with the noise: "fun(f: (fun(p: vec3): number), p: vec3, octaves?: number, mean?: number):
/// number"
std::string sum_overload(const LibraryFunction& row) {
  const std::vector<std::string> names = names_of(row);
  const std::string point = type_text(row.parameters[0]);
  std::string text = "fun(f: (fun(p: " + point + "): number), p: " + point;
  for (unsigned i = 1; i < row.parameter_count; ++i)
    text += ", " + names[i] + "?: number";
  return text + ", mean?: number): number";
}

std::string default_text(const LibraryFunction& row, unsigned index) {
  if (index < row.required_count) return "";
  char text[40];
  std::snprintf(text, sizeof text, " default %.9g", row.defaults[index]);
  return text;
}

void write_function(std::string& out, std::span<const LibraryFunction> rows) {
  const std::vector<Form> forms = forms_of(rows);
  const Form& first = forms[0];
  const std::vector<std::string> names = names_of(*first.row);
  std::set<std::string_view> said;
  for (const Form& form : forms)
    if (said.insert(form.row->doc).second) out += "---" + std::string(form.row->doc) + "\n";
  std::string list;
  for (unsigned i = 0; i < first.row->parameter_count; ++i) {
    out += "---@param " + names[i] + (i < first.row->required_count ? " " : "? ") + parameter_type(first, i) +
           default_text(*first.row, i) + "\n";
    list += (i == 0 ? "" : ", ") + names[i];
  }
  out += "---@return " + results_text(first) + "\n";
  for (size_t i = 1; i < forms.size(); ++i)
    out += "---@overload " + overload(forms[i], nullptr) + "\n";
  if (find_noise_sum(first.row->name) != nullptr)
    for (const LibraryFunction& row : rows)
      out += "---@overload " + sum_overload(row) + "\n";
  out += "function " + std::string(first.row->name) + "(" + list + ") end\n\n";
}

// ---- vectors and matrices ------------------------------------------------------------------------------------------

void write_swizzles(std::string& out, unsigned size, std::string_view letters, const std::string& begin) {
  for (unsigned i = 0; i < size; ++i) {
    const std::string name = begin + letters[i];
    const ValueType type = name.size() == 1 ? ValueType::Number : vector_type(static_cast<unsigned>(name.size()));
    out += "---@field " + name + " " + type_text(type) + "\n";
    if (name.size() < 4) write_swizzles(out, size, letters, name);
  }
}

void write_operators(std::string& out, ValueType type) {
  const std::string self = type_text(type), given = "): " + self + "\n";
  for (const char* name : {"add", "sub", "mul", "div", "mod", "idiv", "pow"}) {
    const bool is_linear = name == std::string_view("add") || name == std::string_view("sub");
    if (is_matrix(type) && !is_linear && name != std::string_view("mul") && name != std::string_view("div")) continue;
    if (!is_matrix(type) || name != std::string_view("div"))
      out.append("---@operator ").append(name).append("(").append(self).append(given);
    if (!is_matrix(type) || !is_linear) out.append("---@operator ").append(name).append("(number").append(given);
  }
  if (is_matrix(type)) {
    const std::string vector = type == ValueType::Mat3 ? "vec3" : "vec4";
    out += "---@operator mul(" + vector + "): " + vector + "\n";
  }
  out += "---@operator unm: " + self + "\n";
}

/// `v:length()`: the functions of the library whose first parameter is such a value.
void write_methods(std::string& out, ValueType type) {
  std::string_view last;
  for (const LibraryFunction& row : library()) {
    if (!is_written(row) || row.name == last || row.parameter_count == 0) continue;
    std::string types;
    for (const Form& form : forms_of(library_overloads(row.name)))
      if (form.row->parameter_count > 0 && form.of(form.row->parameters[0]) == type)
        types += (types.empty() ? "" : "|") + std::string("(") + overload(form, "self") + ")";
    last = row.name;
    if (!types.empty()) out += "---@field " + std::string(row.name) + " " + types + "\n";
  }
}

void write_class(std::string& out, ValueType type) {
  out += "---@class " + type_text(type) + "\n";
  const unsigned size = component_count(type);
  if (is_vector(type)) {
    write_swizzles(out, size, "xyzw", "");
    write_swizzles(out, size, "rgba", "");
    out += "---@field [integer] number\n";
  } else {
    out += std::string("---@field [integer] ") + (type == ValueType::Mat3 ? "vec3" : "vec4") + "\n";
  }
  write_operators(out, type);
  write_methods(out, type);
  out += "\n";
}

} // namespace

std::string luals_definitions() {
  std::string out(kHead);
  for (const ValueType type : kClasses)
    write_class(out, type);
  out += kBuiltIns;
  std::string_view last;
  for (const LibraryFunction& row : library()) {
    if (!is_written(row) || row.name == last) continue;
    last = row.name;
    write_function(out, library_overloads(row.name));
  }
  return out;
}

} // namespace moonshade::sema
