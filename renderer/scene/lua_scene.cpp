// Two passes over the recorded calls: materials first, so that an object may come before the material that it names.
#include "renderer/scene/lua_scene.h"

#include "renderer/scene/gltf_reader.h"
#include "renderer/scene/lua_sandbox.h"
#include "renderer/scene/mesh.h"
#include "renderer/scene/obj_reader.h"
#include "renderer/scene/ply_reader.h"
#include "renderer/scene/read_scene.h"
#include "renderer/scene/scene_fields.h"
#include "renderer/scene/shapes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <set>

namespace moonshade::renderer {

namespace {

class SceneBuilder {
public:
  SceneBuilder(const std::string& path, const Folders& folders) : path_(path), folders_(folders) {
    scene_.file = path;
    Material standard;
    standard.name = "default";
    standard.place = path;
    scene_.materials.push_back(standard);
  }
  SceneReading build(SandboxRun run);

private:
  std::string place(const SceneCall& call) const { return path_ + ":" + std::to_string(call.line); }
  bool apply(const SceneCall& call, size_t index);

  void camera(SceneFields& fields);
  void render(SceneFields& fields);
  void material(SceneFields& fields, const SceneCall& call, size_t index);
  void slot(SceneFields& fields, Material& material, Slot slot);
  void parameters(SceneFields& fields, std::map<std::string, Constant>& parameters);
  void environment(SceneFields& fields, Light& light, const SceneCall& call);
  void light(SceneFields& fields, const SceneCall& call);
  void area_light(SceneFields& fields);
  void model(SceneFields& fields, SceneFunction function);
  void group(SceneFields& fields, const SceneCall& call, size_t index);
  void instance(SceneFields& fields);
  void remove_hidden();
  Object mesh_object(SceneFields& fields, const std::string& name, std::shared_ptr<const Mesh> mesh);
  /// By `matrix`, `scale`, `rotate` and `translate`, in this order.
  Mat4 placement(SceneFields& fields);
  /// Moves an object; places within places must not end beyond what floats hold, or in a point.
  void move(SceneFields& fields, const Mat4& to_world, Object& object);
  void place_object(SceneFields& fields, Object& object) { move(fields, placement(fields), object); }
  uint32_t material_of(SceneFields& fields);
  std::string file(SceneFields& fields, std::string_view field, const std::string& name);
  void add(Object object) { scene_.objects.push_back(std::move(object)); }
  /// Groups of groups multiply: counts what they come to. False, and an error, beyond the limit.
  bool afford(SceneFields& fields, size_t objects);

  std::string path_;
  const Folders& folders_;
  Scene scene_;
  SceneReading reading_;
  std::map<int64_t, uint32_t> material_of_call_;
  std::map<std::string, uint32_t> material_of_name_;
  bool has_camera_ = false, has_render_ = false, has_emission_ = false;
  struct LoadedModel {
    Model model;
    std::optional<uint32_t> first_material; ///< in the scene, where its own are used
  };
  std::map<std::string, LoadedModel> models_;
  /// Objects of the scene that a call has made, itself or as a group: [first, last) may hold others' in between, so
  /// each is listed.
  std::map<int64_t, std::vector<uint32_t>> objects_of_call_;
  std::set<int64_t> grouped_; ///< calls whose objects belong to a group
  size_t objects_placed_ = 0; ///< by groups and instances
  size_t environments_ = 0, skies_ = 0;
  std::set<uint32_t> hidden_; ///< objects that only instances show
};

std::string SceneBuilder::file(SceneFields& fields, std::string_view field, const std::string& name) {
  ResolvedPath path = folders_.resolve(folder_of(path_), name);
  if (!path.error.empty()) fields.fail("'" + std::string(field) + "': " + path.error);
  return path.path;
}

void SceneBuilder::camera(SceneFields& fields) {
  if (has_camera_) fields.fail("a scene has one camera");
  has_camera_ = true;
  Camera& c = scene_.camera;
  fields.require("from");
  c.from = fields.vector("from");
  c.to = fields.vector("to");
  c.up = fields.vector("up");
  c.kind = CameraKind(fields.choice("type"));
  if (c.kind == CameraKind::Perspective) {
    c.fov = float(fields.number("fov"));
    c.aperture = float(fields.number("aperture"));
    c.focus = float(fields.number("focus"));
  } else {
    c.height = float(fields.number("height"));
  }
  if (c.from == c.to)
    fields.fail("'from' and 'to' are the same point");
  else if (glm::length(glm::cross(normalize_or(c.to - c.from, Vec3(0)), normalize_or(c.up, Vec3(0)))) < 1e-5f)
    fields.fail("'up' points along the view");
}

void SceneBuilder::render(SceneFields& fields) {
  if (has_render_) fields.fail("a scene has one render");
  has_render_ = true;
  Settings& s = scene_.settings;
  s.width = int(fields.integer("width"));
  s.height = int(fields.integer("height"));
  s.samples = uint32_t(fields.integer("samples"));
  s.seed = uint32_t(fields.integer("seed"));
  s.depth = uint32_t(fields.integer("depth"));
  s.photons = uint32_t(fields.integer("photons"));
  s.integrator = IntegratorKind(fields.choice("integrator"));
  s.tonemap = Tonemap(fields.choice("tonemap"));
  s.exposure = float(fields.number("exposure"));
  s.clamp = float(fields.number("clamp"));
  s.time = fields.number("time");
  s.frame = fields.integer("frame");
}

/// A constant, or the name of a shader file.
void SceneBuilder::slot(SceneFields& fields, Material& material, Slot slot) {
  const SlotInfo& info = slot_infos()[size_t(slot)];
  const SceneValue* value = fields.find(info.name);
  if (!value) return;
  if (const auto* name = std::get_if<std::string>(&value->value)) {
    material.shaders[size_t(slot)] = file(fields, info.name, *name);
    return;
  }
  if (info.components == 3)
    material.values[size_t(slot)] = fields.color(info.name);
  else
    material.values[size_t(slot)] = Vec3(float(fields.number(info.name)));
}

void SceneBuilder::parameters(SceneFields& fields, std::map<std::string, Constant>& parameters) {
  const SceneValue* value = fields.find("params");
  if (!value) return;
  const auto* list = std::get_if<SceneValue::Fields>(&value->value);
  const auto* empty = std::get_if<SceneValue::List>(&value->value);
  if (!list && !(empty && empty->empty())) return fields.fail("'params' is a table of names and values");
  if (!list) return;
  for (const auto& [name, v] : *list) {
    if (auto* b = std::get_if<bool>(&v.value))
      parameters[name] = *b;
    else if (auto* i = std::get_if<int64_t>(&v.value))
      parameters[name] = *i;
    else if (auto* d = std::get_if<double>(&v.value))
      parameters[name] = *d;
    else if (auto* s = std::get_if<std::string>(&v.value))
      parameters[name] = *s;
    else if (auto* items = std::get_if<SceneValue::List>(&v.value)) {
      std::vector<double> numbers;
      for (const SceneValue& item : *items) {
        if (auto* i = std::get_if<int64_t>(&item.value))
          numbers.push_back(double(*i));
        else if (auto* d = std::get_if<double>(&item.value))
          numbers.push_back(*d);
      }
      if (numbers.size() != items->size() || numbers.size() < 2 || numbers.size() > 4)
        fields.fail("parameter '" + name + "' is a list of 2 to 4 numbers");
      parameters[name] = std::move(numbers);
    } else {
      fields.fail("parameter '" + name + "' is no value that a parameter can have");
    }
  }
}

void SceneBuilder::material(SceneFields& fields, const SceneCall& call, size_t index) {
  Material m;
  m.place = place(call);
  m.name = fields.text("name", "material" + std::to_string(scene_.materials.size()));
  if (std::string name = fields.text("shader"); !name.empty()) m.shader = file(fields, "shader", name);
  for (size_t s = 0; s < kSlotCount; ++s)
    slot(fields, m, Slot(s));
  if (std::string name = fields.text("height"); !name.empty()) m.height_shader = file(fields, "height", name);
  m.bump = BumpMode(fields.choice("bump"));
  m.thin = fields.boolean("thin");
  m.absorption = fields.color("absorption");
  if (fields.has("average_emission")) m.average_emission = fields.color("average_emission");
  parameters(fields, m.parameters);
  if (const SceneValue* density = fields.find("density")) {
    if (const auto* name = std::get_if<std::string>(&density->value))
      m.density_shader = file(fields, "density", *name);
    else
      m.density = float(fields.number("density"));
  }
  m.anisotropy = float(fields.number("anisotropy"));
  const auto& emission = m.values[size_t(Slot::Emission)];
  has_emission_ |= (emission && !is_black(*emission)) || !m.shaders[size_t(Slot::Emission)].empty();
  uint32_t id = uint32_t(scene_.materials.size());
  if (!material_of_name_.try_emplace(m.name, id).second) fields.fail("there is a material '" + m.name + "' already");
  material_of_call_[int64_t(index)] = id;
  scene_.materials.push_back(std::move(m));
}

uint32_t SceneBuilder::material_of(SceneFields& fields) {
  const SceneValue* value = fields.find("material");
  if (!value) return 0;
  if (const auto* name = std::get_if<std::string>(&value->value)) {
    if (auto found = material_of_name_.find(*name); found != material_of_name_.end()) return found->second;
    fields.fail("there is no material '" + *name + "'");
    return 0;
  }
  if (auto found = material_of_call_.find(value->call); found != material_of_call_.end()) return found->second;
  fields.fail("'material' is what material{} gave, or its name");
  return 0;
}

Mat4 SceneBuilder::placement(SceneFields& fields) {
  Vec3 scale = fields.triple("scale"), rotate = fields.vector("rotate");
  Mat4 m = glm::translate(Mat4(1.0f), fields.vector("translate"));
  for (int axis = 2; axis >= 0; --axis) {
    Vec3 around(0);
    around[axis] = 1;
    if (rotate[axis] != 0) m = glm::rotate(m, glm::radians(rotate[axis]), around);
  }
  m = glm::scale(m, scale);
  if (scale.x == 0 || scale.y == 0 || scale.z == 0) fields.fail("'scale' is not zero");
  Mat4 matrix = fields.matrix("matrix");
  if (glm::determinant(DMat3(matrix)) == 0) fields.fail("'matrix' leaves no extent");
  return m * matrix;
}

void SceneBuilder::move(SceneFields& fields, const Mat4& to_world, Object& object) {
  object.to_world = to_world * object.to_world;
  double determinant = std::abs(glm::determinant(DMat4(object.to_world)));
  bool sound = determinant > 1e-60 && std::isfinite(determinant);
  for (int column = 0; column < 4; ++column)
    sound = sound && is_finite(Vec3(object.to_world[column]));
  if (!sound) fields.fail("'" + object.name + "' lies too far out, or has no extent left");
}

Object SceneBuilder::mesh_object(SceneFields& fields, const std::string& name, std::shared_ptr<const Mesh> mesh) {
  Object object;
  object.name = fields.text("name", name);
  object.mesh = std::move(mesh);
  object.materials = {material_of(fields)};
  place_object(fields, object);
  return object;
}

/// A file is read once; its objects share their meshes wherever they are placed.
void SceneBuilder::model(SceneFields& fields, SceneFunction function) {
  fields.require("file");
  std::string name = fields.text("file");
  if (name.empty()) return;
  std::string path = file(fields, "file", name);
  if (path.empty()) return;
  auto [found, is_new] = models_.try_emplace(path);
  LoadedModel& loaded = found->second;
  Model& model = loaded.model;
  if (is_new) {
    model = function == SceneFunction::Ply    ? read_ply(path)
            : function == SceneFunction::Gltf ? read_gltf(path, folders_)
                                              : model_of_obj(path, folders_);
    reading_.warnings.insert(reading_.warnings.end(), model.warnings.begin(), model.warnings.end());
  }
  if (!model.error.empty()) return fields.fail(model.error);
  std::optional<uint32_t> material;
  if (fields.has("material")) material = material_of(fields);
  if (!material && !loaded.first_material) {
    loaded.first_material = uint32_t(scene_.materials.size());
    for (const Material& m : model.materials) {
      const auto& emission = m.values[size_t(Slot::Emission)];
      has_emission_ |= emission && !is_black(*emission);
      scene_.materials.push_back(m);
    }
  }
  std::string own_name = fields.text("name");
  Mat4 to_world = placement(fields);
  for (const Object& source : model.objects) {
    Object object = source;
    if (!own_name.empty()) object.name = own_name;
    move(fields, to_world, object);
    for (uint32_t& slot : object.materials)
      slot = material ? *material : *loaded.first_material + slot;
    add(std::move(object));
  }
}

bool SceneBuilder::afford(SceneFields& fields, size_t objects) {
  constexpr size_t kMost = 4'000'000;
  objects_placed_ += objects;
  if (objects_placed_ <= kMost) return true;
  fields.fail("the scene describes too many things");
  return false;
}

void SceneBuilder::group(SceneFields& fields, const SceneCall& call, size_t index) {
  std::vector<uint32_t>& objects = objects_of_call_[int64_t(index)];
  Mat4 to_world = placement(fields);
  std::string name = fields.text("name");
  for (const SceneValue& item : call.items) {
    auto members = objects_of_call_.find(item.call);
    if (item.call < 0 || members == objects_of_call_.end() || members->second.empty())
      return fields.fail("holds what is no object");
    if (!grouped_.insert(item.call).second)
      return fields.fail("holds what is in a group already; instance{ of = ... } gives another one");
    if (!afford(fields, members->second.size())) return;
    objects.insert(objects.end(), members->second.begin(), members->second.end());
  }
  if (call.items.empty()) fields.fail("holds no objects: group{ sphere{...}, box{...}, translate = ... }");
  for (uint32_t k : objects) {
    move(fields, to_world, scene_.objects[k]);
    if (!name.empty()) scene_.objects[k].name = name;
  }
  if (fields.boolean("hidden")) hidden_.insert(objects.begin(), objects.end());
}

void SceneBuilder::instance(SceneFields& fields) {
  fields.require("of");
  const SceneValue* of = fields.find("of");
  if (!of) return;
  auto source = objects_of_call_.find(of->call);
  if (of->call < 0 || source == objects_of_call_.end() || source->second.empty())
    return fields.fail("'of' is what an object's function or group{} gave");
  if (!afford(fields, source->second.size())) return;
  std::optional<uint32_t> material;
  if (fields.has("material")) material = material_of(fields);
  std::string name = fields.text("name");
  Mat4 to_world = placement(fields);
  for (uint32_t k : std::vector<uint32_t>(source->second)) {
    Object object = scene_.objects[k];
    move(fields, to_world, object);
    if (!name.empty()) object.name = name;
    if (material) std::fill(object.materials.begin(), object.materials.end(), *material);
    add(std::move(object));
  }
}

void SceneBuilder::remove_hidden() {
  uint32_t index = 0;
  std::erase_if(scene_.objects, [&](const Object&) { return hidden_.contains(index++); });
}

void SceneBuilder::area_light(SceneFields& fields) {
  Material m;
  m.name = "light" + std::to_string(scene_.materials.size());
  m.place = path_;
  m.values[size_t(Slot::Color)] = Vec3(0);
  m.values[size_t(Slot::Ior)] = Vec3(1);
  m.values[size_t(Slot::Emission)] = fields.color("color") * float(fields.number("intensity"));
  m.emits_outward_only = !fields.boolean("two_sided");
  Vec3 center = fields.vector("center");
  Vec3 u = fields.vector("u"), v = fields.vector("v");
  if (is_black(glm::cross(u, v))) fields.fail("'u' and 'v' span no area");
  Object object;
  object.name = m.name;
  object.mesh = make_rectangle(center, u, v);
  object.materials = {uint32_t(scene_.materials.size())};
  scene_.materials.push_back(std::move(m));
  has_emission_ = true;
  add(std::move(object));
}

void SceneBuilder::environment(SceneFields& fields, Light& light, const SceneCall& call) {
  constexpr size_t kMost = 4; // each has an image or a table of its own, and is looked at for every ray that ends
  if (++environments_ > kMost) return fields.fail("a scene has at most " + std::to_string(kMost) + " environments");
  light.kind = LightKind::Environment;
  light.place = place(call);
  light.name = fields.text("name", "environment");
  light.rotate = float(fields.number("rotate"));
  std::string image = fields.text("image"), shader = fields.text("shader");
  if (image.empty() == shader.empty()) return fields.fail("either 'image' or 'shader' names a file");
  (image.empty() ? light.shader : light.image) =
      file(fields, image.empty() ? "shader" : "image", image.empty() ? shader : image);
  if (!shader.empty())
    parameters(fields, light.parameters);
  else if (fields.has("params"))
    fields.fail("'params' are those of a 'shader'");
}

void SceneBuilder::light(SceneFields& fields, const SceneCall& call) {
  fields.require("type");
  size_t type = fields.choice("type");
  if (type == 3) return area_light(fields);
  Light light;
  Vec3 color = fields.color("color");
  float intensity = float(fields.number("intensity"));
  if (type == 0) {
    light.kind = LightKind::Sun;
    light.direction = normalize_or(fields.vector("direction"), Vec3(0));
    light.angle = float(fields.number("angle"));
    if (is_black(light.direction)) fields.fail("'direction' has no direction");
  } else if (type == 1) {
    light.kind = LightKind::Sky;
    constexpr size_t kMost = 64; // each has a table of its own, and is looked at for every ray that ends
    if (++skies_ > kMost) fields.fail("a scene has at most " + std::to_string(kMost) + " skies");
    bool plain = !fields.has("zenith") && !fields.has("horizon") && !fields.has("ground");
    light.zenith = fields.color("zenith", plain ? Vec3(1) : Vec3(0.18f, 0.32f, 0.65f)) * color * intensity;
    light.horizon = fields.color("horizon", plain ? Vec3(1) : Vec3(0.62f, 0.70f, 0.80f)) * color * intensity;
    light.ground = fields.color("ground", plain ? Vec3(1) : Vec3(0.24f, 0.22f, 0.20f)) * color * intensity;
  } else if (type == 5) {
    environment(fields, light, call);
  } else {
    light.kind = type == 4 ? LightKind::Spot : LightKind::Point;
    fields.require("position");
    light.position = fields.vector("position");
    if (type == 4) {
      light.direction = normalize_or(fields.vector("to") - light.position, Vec3(0));
      light.angle = float(fields.number("angle"));
      light.blend = float(fields.number("blend"));
      if (is_black(light.direction)) fields.fail("'position' and 'to' are the same point");
    }
  }
  light.color = color * intensity;
  scene_.lights.push_back(light);
}

bool SceneBuilder::apply(const SceneCall& call, size_t index) {
  SceneFields fields(call, scene_functions()[call.function], place(call));
  size_t before = scene_.objects.size();
  switch (SceneFunction(call.function)) {
  case SceneFunction::Camera:
    camera(fields);
    break;
  case SceneFunction::Render:
    render(fields);
    break;
  case SceneFunction::Material:
    material(fields, call, index);
    break;
  case SceneFunction::Light:
    light(fields, call);
    break;
  case SceneFunction::Obj:
  case SceneFunction::Ply:
  case SceneFunction::Gltf:
    model(fields, SceneFunction(call.function));
    break;
  case SceneFunction::Group:
    group(fields, call, index);
    break;
  case SceneFunction::Instance:
    instance(fields);
    break;
  case SceneFunction::Sphere: {
    Object object;
    object.name = fields.text("name", "sphere");
    object.shape = Shape::Sphere;
    object.to_world = glm::translate(Mat4(1.0f), fields.vector("center"));
    object.radius = float(fields.number("radius"));
    object.materials = {material_of(fields)};
    place_object(fields, object);
    add(std::move(object));
    break;
  }
  case SceneFunction::Rectangle: {
    Vec3 u = fields.vector("u"), v = fields.vector("v");
    if (is_black(glm::cross(u, v))) fields.fail("'u' and 'v' span no area");
    add(mesh_object(fields, "rectangle", make_rectangle(fields.vector("center"), u, v)));
    break;
  }
  case SceneFunction::Plane: {
    Vec3 normal = normalize_or(fields.vector("normal"), Vec3(0));
    if (is_black(normal)) fields.fail("'normal' has no direction"), normal = Vec3(0, 1, 0);
    float half = 0.5f * float(fields.number("size"));
    // u along x where it can be, so that texture coordinates lie as one expects on a floor.
    Vec3 u = normalize_or(Vec3(1, 0, 0) - normal * normal.x, Vec3(0, 0, 1));
    if (std::abs(normal.x) > 0.99f) u = normalize_or(Vec3(0, 0, 1) - normal * normal.z, Vec3(0, 0, 1));
    Vec3 v = glm::cross(normal, u);
    add(mesh_object(fields, "plane", make_rectangle(fields.vector("point"), u * half, v * half)));
    break;
  }
  case SceneFunction::Box: {
    Vec3 size = fields.triple("size");
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) fields.fail("'size' is positive");
    add(mesh_object(fields, "box", make_box(fields.vector("center"), size)));
    break;
  }
  }
  std::vector<uint32_t>& made = objects_of_call_[int64_t(index)];
  for (uint32_t k = uint32_t(before); k < scene_.objects.size(); ++k)
    made.push_back(k);
  reading_.error = fields.finish(SceneFunction(call.function) == SceneFunction::Group);
  return reading_.error.empty();
}

SceneReading SceneBuilder::build(SandboxRun run) {
  constexpr size_t kMostLines = 100;
  for (std::string_view text : run.printed)
    for (bool goes_on = true; goes_on && reading_.warnings.size() < kMostLines;) {
      const size_t end = text.find('\n');
      reading_.warnings.push_back(path_ + ": print: " + std::string(text.substr(0, end)));
      goes_on = end != std::string_view::npos;
      if (goes_on) text.remove_prefix(end + 1);
    }
  reading_.error = run.error;
  if (!run.error.empty()) return std::move(reading_);
  for (size_t pass = 0; pass < 2; ++pass)
    for (size_t i = 0; i < run.calls.size(); ++i)
      if ((SceneFunction(run.calls[i].function) == SceneFunction::Material) == (pass == 0) && !apply(run.calls[i], i))
        return std::move(reading_);
  remove_hidden();
  if (scene_.objects.empty()) {
    reading_.error = path_ + ": the scene has no objects";
    return std::move(reading_);
  }
  if (!has_camera_) scene_.camera = framing_camera(bounds_of(scene_));
  if (scene_.lights.empty() && !has_emission_) add_daylight(scene_);
  reading_.scene = std::move(scene_);
  return std::move(reading_);
}

} // namespace

SceneReading parse_lua_scene(const std::string& path, std::string_view text, const Folders& folders,
                             const Animation& animation) {
  SandboxConstants constants = {{"time", animation.time}, {"frame", animation.frame.value_or(0)}};
  return SceneBuilder(path, folders).build(run_scene_file(path, text, scene_function_names(), constants));
}

} // namespace moonshade::renderer
