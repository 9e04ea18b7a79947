// The table itself, and its printing.
#include "renderer/scene/scene_reference.h"

#include "renderer/scene/scene.h"

#include <algorithm>
#include <cstdio>

namespace moonshade::renderer {

namespace {

using enum FieldKind;
using Values = std::array<double, 3>;

constexpr Values all(double value) { return {value, value, value}; }
constexpr double kMost = 1e9; ///< products of four such numbers are still finite in float

constexpr std::string_view kBumps[] = {"gradient", "differences", "paper"};
constexpr std::string_view kLightTypes[] = {"sun", "sky", "point", "area", "spot", "environment"};

constexpr FieldInfo kEveryObject[] = {
    {.name = "name",
     .doc = "for messages and the names of ids",
     .shown = "the function's name, or the file's",
     .kind = Text},
    {.name = "material",
     .doc = "what `material` gave, or its name",
     .shown = "a grey one; a model's own",
     .kind = Material},
    {.name = "matrix",
     .doc = "place in the world, row by row; the last row is 0, 0, 0, 1",
     .shown = "identity",
     .kind = Matrix},
    {.name = "scale", .doc = "after `matrix`; not zero", .otherwise = all(1), .kind = Triple},
    {.name = "rotate", .doc = "after `scale`: degrees around x, then y, then z", .otherwise = all(0), .kind = Vector},
    {.name = "translate", .doc = "after `rotate`", .otherwise = all(0), .kind = Vector},
};

constexpr FieldInfo kCamera[] = {
    {.name = "type", .doc = "how it sees", .words = kCameraNames, .kind = Choice},
    {.name = "from", .doc = "where it stands", .kind = Vector, .required = true},
    {.name = "to", .doc = "what it looks at", .otherwise = all(0), .kind = Vector},
    {.name = "up",
     .doc = "what is up in the picture; not along the view",
     .otherwise = Values{0, 1, 0},
     .kind = Vector},
    {.name = "fov",
     .doc = "vertical angle of view, in degrees",
     .least = 0.01,
     .most = 170,
     .only = "perspective",
     .otherwise = all(40)},
    {.name = "aperture",
     .doc = "diameter of the lens; 0: a pinhole, everything sharp",
     .least = 0,
     .only = "perspective",
     .otherwise = all(0)},
    {.name = "focus",
     .doc = "distance of the plane in focus, along the axis",
     .least = 1e-6,
     .only = "perspective",
     .shown = "that of `to`"},
    {.name = "height",
     .doc = "of what is seen, in the world's units",
     .least = 1e-6,
     .only = "orthographic",
     .otherwise = all(2)},
};

constexpr FieldInfo kRender[] = {
    {.name = "width", .doc = "pixels", .least = 1, .most = 65536, .otherwise = all(1280), .kind = Integer},
    {.name = "height", .doc = "pixels", .least = 1, .most = 65536, .otherwise = all(720), .kind = Integer},
    {.name = "samples",
     .doc = "of each pixel, at most",
     .least = 1,
     .most = 1 << 24,
     .otherwise = all(64),
     .kind = Integer},
    {.name = "seed",
     .doc = "of the random numbers",
     .least = 0,
     .most = UINT32_MAX,
     .otherwise = all(0),
     .kind = Integer},
    {.name = "depth",
     .doc = "segments that a path may have",
     .least = 1,
     .most = 1024,
     .otherwise = all(8),
     .kind = Integer},
    {.name = "integrator", .doc = "how light is followed", .words = kIntegratorNames, .kind = Choice},
    {.name = "photons",
     .doc = "of each pass, for `sppm`",
     .least = 1,
     .most = 1 << 26,
     .otherwise = all(200000),
     .kind = Integer},
    {.name = "tonemap", .doc = "of 8- and 16-bit files", .words = kTonemapNames, .kind = Choice},
    {.name = "exposure", .doc = "of 8- and 16-bit files, in stops", .least = -100, .most = 100, .otherwise = all(0)},
    {.name = "clamp", .doc = "bound of a sample's radiance; 0: none", .least = 0, .otherwise = all(0)},
    {.name = "time", .doc = "the shaders' `time`, in seconds; `--frames` wins", .otherwise = all(0)},
    {.name = "frame",
     .doc = "the shaders' `frame`; `--frames` wins",
     .least = INT32_MIN,
     .most = INT32_MAX,
     .otherwise = all(0),
     .kind = Integer},
};

constexpr FieldInfo kMaterial[] = {
    {.name = "name",
     .doc = "for messages, `material = \"name\"` and `-D name.parameter=value`",
     .shown = "a number",
     .kind = Text},
    {.name = "shader", .doc = "a shader that gives every entry below that it has", .kind = File},
    {.name = "params", .doc = "values of the shader's parameters, by name", .kind = Parameters},
    {.name = "color", .doc = "base colour", .otherwise = all(0.8), .kind = ColorOrShader},
    {.name = "roughness",
     .doc = "α = roughness²",
     .least = 0,
     .most = 1,
     .otherwise = all(0.5),
     .kind = NumberOrShader},
    {.name = "metallic",
     .doc = "0: dielectric, 1: metal",
     .least = 0,
     .most = 1,
     .otherwise = all(0),
     .kind = NumberOrShader},
    {.name = "ior",
     .doc = "index of refraction; 1: no coat, purely diffuse",
     .least = 1,
     .most = 100,
     .otherwise = all(1.5),
     .kind = NumberOrShader},
    {.name = "transmission",
     .doc = "share of glass",
     .least = 0,
     .most = 1,
     .otherwise = all(0),
     .kind = NumberOrShader},
    {.name = "opacity",
     .doc = "share of the surface that is there",
     .least = 0,
     .most = 1,
     .otherwise = all(1),
     .kind = NumberOrShader},
    {.name = "reflectance", .doc = "colour of the mirror-like reflection", .otherwise = all(0), .kind = ColorOrShader},
    {.name = "emission", .doc = "emitted radiance", .otherwise = all(0), .kind = ColorOrShader},
    {.name = "average_emission",
     .doc = "what a light is sampled by whose `emission` is a shader",
     .shown = "measured at load",
     .kind = Color},
    {.name = "height", .doc = "a shader whose `height` bends the normal", .kind = File},
    {.name = "bump",
     .doc = "how: by the surface gradient (Mikkelsen 2010) from the exact derivative of `height`; from six evaluations "
            "half a footprint around the point; by n − u/\\|u\\|, from the same six",
     .words = kBumps,
     .kind = Choice},
    {.name = "density",
     .doc = "extinction per unit of `p`: makes a volume of what it is given to, with `color` as albedo and `emission` "
            "per unit of length",
     .least = 0,
     .shown = "none: a surface",
     .kind = NumberOrShader},
    {.name = "anisotropy",
     .doc = "of a volume: Henyey and Greenstein's g",
     .least = -1,
     .most = 1,
     .otherwise = all(0)},
    {.name = "thin",
     .doc = "a sheet without inside: what it transmits goes on unbent",
     .otherwise = all(0),
     .kind = Boolean},
    {.name = "absorption",
     .doc = "how light fades within a solid that transmits, per unit of length, by colour",
     .otherwise = all(0),
     .kind = Color},
};

constexpr FieldInfo kSphere[] = {
    {.name = "center", .doc = "from where the shader's `p` is measured", .otherwise = all(0), .kind = Vector},
    {.name = "radius", .doc = "", .least = 1e-20, .otherwise = all(1)},
};
constexpr FieldInfo kRectangle[] = {
    {.name = "center", .doc = "", .otherwise = all(0), .kind = Vector},
    {.name = "u", .doc = "half of one side", .otherwise = Values{1, 0, 0}, .kind = Vector},
    {.name = "v", .doc = "half of the other; it faces cross(u, v)", .otherwise = Values{0, 0, -1}, .kind = Vector},
};
constexpr FieldInfo kPlane[] = {
    {.name = "point", .doc = "its middle", .otherwise = all(0), .kind = Vector},
    {.name = "normal", .doc = "where it faces", .otherwise = Values{0, 1, 0}, .kind = Vector},
    {.name = "size", .doc = "of its sides", .least = 1e-6, .most = 1e6, .otherwise = all(200)},
};
constexpr FieldInfo kBox[] = {
    {.name = "center", .doc = "", .otherwise = all(0), .kind = Vector},
    {.name = "size", .doc = "of its sides; positive", .otherwise = all(1), .kind = Triple},
};
constexpr FieldInfo kModel[] = {
    {.name = "file", .doc = "in the scene's folder or below", .kind = File, .required = true},
};

constexpr FieldInfo kLight[] = {
    {.name = "type", .doc = "", .words = kLightTypes, .kind = Choice, .required = true},
    {.name = "color",
     .doc = "sun: irradiance on a surface that faces it; point: intensity per steradian; spot: the same along its "
            "axis; area: radiance; sky and environment: what theirs is multiplied by",
     .otherwise = all(1),
     .kind = Color},
    {.name = "intensity", .doc = "multiplies the colour", .least = 0, .otherwise = all(1)},
    {.name = "direction", .doc = "towards it", .only = "sun", .otherwise = Values{0.6, 0.8, 0.5}, .kind = Vector},
    {.name = "angle",
     .doc = "apparent diameter, in degrees",
     .least = 0,
     .most = 60,
     .only = "sun",
     .otherwise = all(0.53)},
    {.name = "angle",
     .doc = "of its cone, in degrees",
     .least = 0.01,
     .most = 180,
     .only = "spot",
     .otherwise = all(40)},
    {.name = "zenith",
     .doc = "radiance overhead",
     .only = "sky",
     .shown = "1, or blue where one of the three is given",
     .kind = Color},
    {.name = "horizon",
     .doc = "radiance at the horizon",
     .only = "sky",
     .shown = "likewise, a light blue",
     .kind = Color},
    {.name = "ground", .doc = "radiance below it", .only = "sky", .shown = "likewise, a dark grey", .kind = Color},
    {.name = "position", .doc = "required by these", .only = "point, spot", .shown = "–", .kind = Vector},
    {.name = "to", .doc = "what it shines at", .only = "spot", .otherwise = all(0), .kind = Vector},
    {.name = "blend",
     .doc = "share of the cone's half angle over which it fades",
     .least = 0,
     .most = 1,
     .only = "spot",
     .otherwise = all(0.2)},
    {.name = "center", .doc = "", .only = "area", .otherwise = all(0), .kind = Vector},
    {.name = "u", .doc = "half of one side", .only = "area", .otherwise = Values{1, 0, 0}, .kind = Vector},
    {.name = "v", .doc = "half of the other", .only = "area", .otherwise = Values{0, 0, 1}, .kind = Vector},
    {.name = "two_sided",
     .doc = "or only where cross(u, v) points",
     .only = "area",
     .otherwise = all(1),
     .kind = Boolean},
    {.name = "image",
     .doc = "a picture of all around by longitude and latitude, its middle towards −z and its top +y",
     .only = "environment",
     .kind = File},
    {.name = "shader",
     .doc = "a file with `environment(i)`; either it or `image`",
     .only = "environment",
     .kind = File},
    {.name = "params", .doc = "values of the shader's parameters, by name", .only = "environment", .kind = Parameters},
    {.name = "rotate", .doc = "around y, in degrees", .only = "environment", .otherwise = all(0)},
    {.name = "name", .doc = "for messages and `-D`", .only = "environment", .shown = "`environment`", .kind = Text},
};

constexpr FieldInfo kGroup[] = {
    {.name = "hidden", .doc = "only instances of it are seen", .otherwise = all(0), .kind = Boolean},
};
constexpr FieldInfo kInstance[] = {
    {.name = "of", .doc = "what an object's function or `group` gave", .kind = Object, .required = true},
};

constexpr FunctionInfo kFunctions[] = {
    {"camera", "From where the picture is taken. A scene has one; without, everything is framed.", kCamera},
    {"render", "Settings of the render; options of the command line win.", kRender},
    {"material",
     "A surface; [what it scatters](materials.md). What takes a shader takes a constant, or the name of a file "
     "whose function of the field's name is used.",
     kMaterial},
    {"sphere", "", kSphere, true},
    {"rectangle", "", kRectangle, true},
    {"plane", "A large square.", kPlane, true},
    {"box", "", kBox, true},
    {"obj", "A Wavefront OBJ model, with the materials of its MTL file.", kModel, true},
    {"ply", "A PLY model.", kModel, true},
    {"gltf", "A glTF 2.0 model (`.gltf` or `.glb`), with its nodes' places and its materials.", kModel, true},
    {"light", "A scene without lights and without a material that emits gets a sky and a sun.", kLight},
    {"group",
     "Objects, in a list, placed together: `group{ sphere{...}, box{...}, rotate = {0, 45, 0} }`. Its `name`, if "
     "given, becomes theirs; it has no `material`.",
     kGroup, true, false},
    {"instance",
     "Another one of an object or a group, as that is at this line, placed anew; `name` and `material`, if given, take "
     "the place of its own. A model's triangles are kept once.",
     kInstance, true},
};
static_assert(std::size(kFunctions) == kSceneFunctionCount);

constexpr auto kNames = [] {
  std::array<std::string_view, kSceneFunctionCount> names;
  for (size_t k = 0; k < names.size(); ++k)
    names[k] = kFunctions[k].name;
  return names;
}();

const char* kind_text(FieldKind kind) {
  switch (kind) {
  case Number:
    return "number";
  case Integer:
    return "integer";
  case Boolean:
    return "boolean";
  case Text:
    return "string";
  case File:
    return "file";
  case Vector:
    return "3 numbers";
  case Triple:
    return "3 numbers, or 1 for all";
  case Color:
    return "colour";
  case ColorOrShader:
    return "colour, or shader";
  case NumberOrShader:
    return "number, or shader";
  case Matrix:
    return "12 or 16 numbers";
  case Choice:
    return "string";
  case Material:
    return "material";
  case Object:
    return "object";
  case Parameters:
    break;
  }
  return "table";
}

std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string default_text(const FieldInfo& field) {
  if (field.required) return "required";
  if (!field.shown.empty()) return std::string(field.shown);
  if (field.kind == Choice) return "`\"" + std::string(field.words[0]) + "\"`";
  if (!field.otherwise) return "";
  const Values& v = *field.otherwise;
  if (field.kind == Boolean) return v[0] != 0 ? "true" : "false";
  bool one = field.kind == Number || field.kind == Integer || field.kind == NumberOrShader ||
             (v[0] == v[1] && v[1] == v[2] && field.kind != Vector);
  if (one) return plain(v[0]);
  return "{" + plain(v[0]) + ", " + plain(v[1]) + ", " + plain(v[2]) + "}";
}

std::string doc_text(const FieldInfo& field) {
  std::string text;
  if (!field.only.empty()) text = "(" + std::string(field.only) + ") ";
  text += field.doc;
  for (size_t k = 0; k < field.words.size(); ++k)
    text += (k == 0                        ? (text.empty() ? "" : ": ")
             : k + 1 == field.words.size() ? " or "
                                           : ", ") +
            ("`\"" + std::string(field.words[k]) + "\"`");
  bool number = field.kind == Number || field.kind == Integer || field.kind == NumberOrShader;
  bool low = field.least > -kMost, high = field.most < kMost || field.kind == Integer;
  if (number && low && high)
    text += "; " + plain(field.least) + " to " + plain(field.most);
  else if (number && low)
    text += field.least == 0 ? "; not negative" : "; at least " + plain(field.least);
  if (text.starts_with("; ")) text = text.substr(2);
  return text;
}

void print_fields(std::string& out, std::span<const FieldInfo> fields) {
  out += "\n| field | is | default | |\n|---|---|---|---|\n";
  for (const FieldInfo& field : fields)
    out += "| `" + std::string(field.name) + "` | " + kind_text(field.kind) + " | " + default_text(field) + " | " +
           doc_text(field) + " |\n";
}

} // namespace

std::span<const FunctionInfo> scene_functions() { return kFunctions; }
std::span<const std::string_view> scene_function_names() { return kNames; }

namespace {

/// Whether a call of this type has the field; without a type it may have any.
bool is_for(const FieldInfo& field, std::string_view type) {
  return field.only.empty() || field.only.find(type) != std::string_view::npos;
}

} // namespace

const FieldInfo* find_field(const FunctionInfo& function, std::string_view name, std::string_view type) {
  const FieldInfo* other = nullptr; // of another type
  for (const FieldInfo& field : function.fields) {
    if (field.name != name) continue;
    if (is_for(field, type)) return &field;
    other = &field;
  }
  if (function.is_object && !other)
    for (const FieldInfo& field : kEveryObject)
      if (field.name == name) return &field;
  return other;
}

std::vector<std::string_view> field_names(const FunctionInfo& function, std::string_view type) {
  std::vector<std::string_view> names;
  for (const FieldInfo& field : function.fields)
    if (is_for(field, type) && std::find(names.begin(), names.end(), field.name) == names.end())
      names.push_back(field.name);
  if (function.is_object)
    for (const FieldInfo& field : kEveryObject)
      if (function.has_material || field.kind != FieldKind::Material) names.push_back(field.name);
  return names;
}

std::string scene_reference() {
  std::string out = "# Scene reference\n\nWhat each function of [a scene](scenes.md) takes. This page is what "
                    "`moonrender --help-scene` prints.\n\n"
                    "Vectors and colours are lists of three numbers, `vec3(x, y, z)` or `rgb(r, g, b)`; where a colour "
                    "is expected, one number is a grey, and none is "
                    "negative. Numbers reach to ±1e9 where nothing else is said. Files are named relative to the scene "
                    "and lie in its folder or below. "
                    "Words in parentheses are the types that have the field.\n";
  for (const FunctionInfo& function : kFunctions) {
    out += "\n## " + std::string(function.name) + "\n\n";
    if (!function.doc.empty()) out += std::string(function.doc) + "\n";
    if (function.is_object)
      out += std::string(function.doc.empty() ? "" : "\n") + "With the fields of [every object](#every-object).\n";
    print_fields(out, function.fields);
  }
  out += "\n## Every object\n";
  print_fields(out, kEveryObject);
  return out;
}

} // namespace moonshade::renderer
