// The table itself, and its printing.
#include "renderer/scene/scene_reference.h"

#include "renderer/scene/scene.h"

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
     .kind = Text,
     .doc = "for messages and the names of ids",
     .shown = "the function's name, or the file's"},
    {.name = "material",
     .kind = Material,
     .doc = "what `material` gave, or its name",
     .shown = "a grey one; a model's own"},
    {.name = "matrix",
     .kind = Matrix,
     .doc = "place in the world, row by row; the last row is 0, 0, 0, 1",
     .shown = "identity"},
    {.name = "scale", .kind = Triple, .doc = "after `matrix`; not zero", .otherwise = all(1)},
    {.name = "rotate", .kind = Vector, .doc = "after `scale`: degrees around x, then y, then z", .otherwise = all(0)},
    {.name = "translate", .kind = Vector, .doc = "after `rotate`", .otherwise = all(0)},
};

constexpr FieldInfo kCamera[] = {
    {.name = "type", .kind = Choice, .doc = "how it sees", .words = kCameraNames},
    {.name = "from", .kind = Vector, .doc = "where it stands", .required = true},
    {.name = "to", .kind = Vector, .doc = "what it looks at", .otherwise = all(0)},
    {.name = "up",
     .kind = Vector,
     .doc = "what is up in the picture; not along the view",
     .otherwise = Values{0, 1, 0}},
    {.name = "fov",
     .doc = "vertical angle of view, in degrees",
     .otherwise = all(40),
     .least = 0.01,
     .most = 170,
     .only = "perspective"},
    {.name = "aperture",
     .doc = "diameter of the lens; 0: a pinhole, everything sharp",
     .otherwise = all(0),
     .least = 0,
     .only = "perspective"},
    {.name = "focus",
     .doc = "distance of the plane in focus, along the axis",
     .least = 1e-6,
     .only = "perspective",
     .shown = "that of `to`"},
    {.name = "height",
     .doc = "of what is seen, in the world's units",
     .otherwise = all(2),
     .least = 1e-6,
     .only = "orthographic"},
};

constexpr FieldInfo kRender[] = {
    {.name = "width", .kind = Integer, .doc = "pixels", .otherwise = all(1280), .least = 1, .most = 65536},
    {.name = "height", .kind = Integer, .doc = "pixels", .otherwise = all(720), .least = 1, .most = 65536},
    {.name = "samples",
     .kind = Integer,
     .doc = "of each pixel, at most",
     .otherwise = all(64),
     .least = 1,
     .most = 1 << 24},
    {.name = "seed",
     .kind = Integer,
     .doc = "of the random numbers",
     .otherwise = all(0),
     .least = 0,
     .most = UINT32_MAX},
    {.name = "depth",
     .kind = Integer,
     .doc = "segments that a path may have",
     .otherwise = all(8),
     .least = 1,
     .most = 1024},
    {.name = "integrator", .kind = Choice, .doc = "how light is followed", .words = kIntegratorNames},
    {.name = "tonemap", .kind = Choice, .doc = "of 8- and 16-bit files", .words = kTonemapNames},
    {.name = "exposure", .doc = "of 8- and 16-bit files, in stops", .otherwise = all(0), .least = -100, .most = 100},
    {.name = "clamp", .doc = "bound of a sample's radiance; 0: none", .otherwise = all(0), .least = 0},
    {.name = "time", .doc = "the shaders' `time`, in seconds; `--frames` wins", .otherwise = all(0)},
    {.name = "frame",
     .kind = Integer,
     .doc = "the shaders' `frame`; `--frames` wins",
     .otherwise = all(0),
     .least = INT32_MIN,
     .most = INT32_MAX},
};

constexpr FieldInfo kMaterial[] = {
    {.name = "name",
     .kind = Text,
     .doc = "for messages, `material = \"name\"` and `-D name.parameter=value`",
     .shown = "a number"},
    {.name = "shader", .kind = File, .doc = "a shader that gives every entry below that it has"},
    {.name = "params", .kind = Parameters, .doc = "values of the shader's parameters, by name"},
    {.name = "color", .kind = ColorOrShader, .doc = "base colour", .otherwise = all(0.8)},
    {.name = "roughness",
     .kind = NumberOrShader,
     .doc = "α = roughness²",
     .otherwise = all(0.5),
     .least = 0,
     .most = 1},
    {.name = "metallic",
     .kind = NumberOrShader,
     .doc = "0: dielectric, 1: metal",
     .otherwise = all(0),
     .least = 0,
     .most = 1},
    {.name = "ior",
     .kind = NumberOrShader,
     .doc = "index of refraction; 1: no coat, purely diffuse",
     .otherwise = all(1.5),
     .least = 1,
     .most = 100},
    {.name = "transmission",
     .kind = NumberOrShader,
     .doc = "share of glass",
     .otherwise = all(0),
     .least = 0,
     .most = 1},
    {.name = "opacity",
     .kind = NumberOrShader,
     .doc = "share of the surface that is there",
     .otherwise = all(1),
     .least = 0,
     .most = 1},
    {.name = "reflectance", .kind = ColorOrShader, .doc = "colour of the mirror-like reflection", .otherwise = all(0)},
    {.name = "emission", .kind = ColorOrShader, .doc = "emitted radiance", .otherwise = all(0)},
    {.name = "average_emission",
     .kind = Color,
     .doc = "what a light is sampled by whose `emission` is a shader",
     .shown = "measured at load"},
    {.name = "height", .kind = File, .doc = "a shader whose `height` bends the normal"},
    {.name = "bump",
     .kind = Choice,
     .doc = "how: by the surface gradient (Mikkelsen 2010) from the exact derivative of `height`; from six evaluations "
            "half a footprint around the point; by n − u/\\|u\\|, from the same six",
     .words = kBumps},
    {.name = "thin",
     .kind = Boolean,
     .doc = "a sheet without inside: what it transmits goes on unbent",
     .otherwise = all(0)},
    {.name = "absorption",
     .kind = Color,
     .doc = "how light fades within a solid that transmits, per unit of length, by colour",
     .otherwise = all(0)},
};

constexpr FieldInfo kSphere[] = {
    {.name = "center", .kind = Vector, .doc = "from where the shader's `p` is measured", .otherwise = all(0)},
    {.name = "radius", .doc = "", .otherwise = all(1), .least = 1e-20},
};
constexpr FieldInfo kRectangle[] = {
    {.name = "center", .kind = Vector, .doc = "", .otherwise = all(0)},
    {.name = "u", .kind = Vector, .doc = "half of one side", .otherwise = Values{1, 0, 0}},
    {.name = "v", .kind = Vector, .doc = "half of the other; it faces cross(u, v)", .otherwise = Values{0, 0, -1}},
};
constexpr FieldInfo kPlane[] = {
    {.name = "point", .kind = Vector, .doc = "its middle", .otherwise = all(0)},
    {.name = "normal", .kind = Vector, .doc = "where it faces", .otherwise = Values{0, 1, 0}},
    {.name = "size", .doc = "of its sides", .otherwise = all(200), .least = 1e-6, .most = 1e6},
};
constexpr FieldInfo kBox[] = {
    {.name = "center", .kind = Vector, .doc = "", .otherwise = all(0)},
    {.name = "size", .kind = Triple, .doc = "of its sides; positive", .otherwise = all(1)},
};
constexpr FieldInfo kModel[] = {
    {.name = "file", .kind = File, .doc = "in the scene's folder or below", .required = true},
};

constexpr FieldInfo kLight[] = {
    {.name = "type", .kind = Choice, .doc = "", .words = kLightTypes, .required = true},
    {.name = "color",
     .kind = Color,
     .doc = "sun: irradiance on a surface that faces it; point: intensity per steradian; spot: the same along its "
            "axis; area: radiance; sky and environment: what theirs is multiplied by",
     .otherwise = all(1)},
    {.name = "intensity", .doc = "multiplies the colour", .otherwise = all(1), .least = 0},
    {.name = "direction", .kind = Vector, .doc = "towards it", .otherwise = Values{0.6, 0.8, 0.5}, .only = "sun"},
    {.name = "angle",
     .doc = "apparent diameter, in degrees",
     .otherwise = all(0.53),
     .least = 0,
     .most = 60,
     .only = "sun"},
    {.name = "angle",
     .doc = "of its cone, in degrees",
     .otherwise = all(40),
     .least = 0.01,
     .most = 180,
     .only = "spot"},
    {.name = "zenith",
     .kind = Color,
     .doc = "radiance overhead",
     .only = "sky",
     .shown = "1, or blue where one of the three is given"},
    {.name = "horizon",
     .kind = Color,
     .doc = "radiance at the horizon",
     .only = "sky",
     .shown = "likewise, a light blue"},
    {.name = "ground", .kind = Color, .doc = "radiance below it", .only = "sky", .shown = "likewise, a dark grey"},
    {.name = "position", .kind = Vector, .doc = "required by these", .only = "point, spot", .shown = "–"},
    {.name = "to", .kind = Vector, .doc = "what it shines at", .otherwise = all(0), .only = "spot"},
    {.name = "blend",
     .doc = "share of the cone's half angle over which it fades",
     .otherwise = all(0.2),
     .least = 0,
     .most = 1,
     .only = "spot"},
    {.name = "center", .kind = Vector, .doc = "", .otherwise = all(0), .only = "area"},
    {.name = "u", .kind = Vector, .doc = "half of one side", .otherwise = Values{1, 0, 0}, .only = "area"},
    {.name = "v", .kind = Vector, .doc = "half of the other", .otherwise = Values{0, 0, 1}, .only = "area"},
    {.name = "two_sided",
     .kind = Boolean,
     .doc = "or only where cross(u, v) points",
     .otherwise = all(1),
     .only = "area"},
    {.name = "image",
     .kind = File,
     .doc = "a picture of all around by longitude and latitude, its middle towards −z and its top +y",
     .only = "environment"},
    {.name = "shader",
     .kind = File,
     .doc = "a file with `environment(i)`; either it or `image`",
     .only = "environment"},
    {.name = "params", .kind = Parameters, .doc = "values of the shader's parameters, by name", .only = "environment"},
    {.name = "rotate", .doc = "around y, in degrees", .otherwise = all(0), .only = "environment"},
    {.name = "name", .kind = Text, .doc = "for messages and `-D`", .only = "environment", .shown = "`environment`"},
};

constexpr FieldInfo kGroup[] = {
    {.name = "hidden", .kind = Boolean, .doc = "only instances of it are seen", .otherwise = all(0)},
};
constexpr FieldInfo kInstance[] = {
    {.name = "of", .kind = Object, .doc = "what an object's function or `group` gave", .required = true},
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
     kGroup, true},
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

const FieldInfo* find_field(const FunctionInfo& function, std::string_view name, std::string_view type) {
  const FieldInfo* other = nullptr; // of another type
  for (const FieldInfo& field : function.fields) {
    if (field.name != name) continue;
    if (field.only.empty() || field.only.find(type) != std::string_view::npos) return &field;
    other = &field;
  }
  if (function.is_object && !other)
    for (const FieldInfo& field : kEveryObject)
      if (field.name == name) return &field;
  return other;
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
