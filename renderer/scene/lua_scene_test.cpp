#include "renderer/scene/lua_scene.h"

#include "renderer/scene/lua_sandbox.h"
#include "renderer/scene/read_scene.h"
#include "renderer/scene/scene_fields.h"
#include "renderer/test_support.h"

#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

class LuaScene : public ::testing::Test {
protected:
  SceneReading parse(const std::string& text) {
    Folders folders = folder_.folders();
    return parse_lua_scene("s.lua", text, folders_.value_or(folders));
  }
  std::string error(const std::string& text) { return parse(text).error; }
  TemporaryFolder folder_;
  std::optional<Folders> folders_;
};

TEST_F(LuaScene, ReadsEveryKindOfThing) {
  SceneReading reading = parse(R"(
    camera{ from = {1, 2, 3}, to = {0, 0, 1}, fov = 30 }
    render{ width = 320, height = 200, samples = 5, seed = 9, depth = 3, integrator = "whitted", tonemap = "filmic", exposure = 1.5 }
    local red = material{ name = "red", color = {1, 0, 0}, roughness = 0.2 }
    sphere{ center = {1, 0, 0}, radius = 2, material = red }
    plane{ material = "red" }
    box{ size = 2, translate = {0, 1, 0} }
    rectangle{ center = {0, 3, 0} }
    light{ type = "sun", direction = {0, 2, 0}, color = 3 }
    light{ type = "point", position = {0, 5, 0}, intensity = 2 }
    light{ type = "area", center = {0, 4, 0}, color = {1, 2, 3} })");
  ASSERT_TRUE(reading.scene) << reading.error;
  const Scene& scene = *reading.scene;
  EXPECT_EQ(scene.camera.from, Vec3(1, 2, 3));
  EXPECT_EQ(scene.settings.width, 320);
  EXPECT_EQ(scene.settings.integrator, IntegratorKind::Whitted);
  EXPECT_EQ(scene.settings.tonemap, Tonemap::Filmic);
  ASSERT_EQ(scene.objects.size(), 5u);
  EXPECT_EQ(scene.objects[0].materials, std::vector<uint32_t>{1});
  EXPECT_EQ(scene.objects[1].materials, std::vector<uint32_t>{1});
  EXPECT_EQ(Vec3(scene.objects[0].to_world[3]), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(scene.objects[2].to_world[3]), Vec3(0, 1, 0));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].direction, Vec3(0, 1, 0));
  EXPECT_EQ(scene.lights[0].color, Vec3(3));
  EXPECT_EQ(scene.materials.back().values[size_t(Slot::Emission)], Vec3(1, 2, 3));
}

TEST_F(LuaScene, NamesLineAndNearestNameOfWrongFields) {
  EXPECT_EQ(error("\n\nsphere{ radus = 1 }"), "s.lua:3: sphere: unknown field 'radus'; did you mean 'radius'?");
  EXPECT_EQ(error("sphere{ radius = 'big' }"), "s.lua:1: sphere: 'radius' is a number");
  EXPECT_EQ(error("sphere{ radius = -1 }"), "s.lua:1: sphere: 'radius' lies between 1e-20 and 1e+09");
  EXPECT_EQ(error("light{ type = 'area', u = {math.mininteger, 0, 0} }"),
            "s.lua:1: light: 'u' lies between -1e+09 and 1e+09");
  EXPECT_EQ(error("sphere{ center = {1, 2} }"), "s.lua:1: sphere: 'center' is a list of 3 numbers");
  EXPECT_EQ(error("sphere{ center = {1, 2, 0/0} }"), "s.lua:1: sphere: 'center' is a list of 3 numbers");
  EXPECT_EQ(
      error("sphere{}\nlight{ type = 'sum' }"),
      "s.lua:2: light: unknown type 'sum'; did you mean 'sun'? (known: sun, sky, point, area, spot, environment)");
  EXPECT_EQ(error("sphere{}\nlight{}"), "s.lua:2: light: the field 'type' is missing");
  EXPECT_EQ(error("render{ width = 1.5 }"), "s.lua:1: render: 'width' is an integer");
  EXPECT_EQ(error("sphere{ material = 'gold' }"), "s.lua:1: sphere: there is no material 'gold'");
  EXPECT_EQ(error("sphere{ material = {} }"), "s.lua:1: sphere: 'material' is what material{} gave, or its name");
  EXPECT_EQ(error("material{ name = 'a' }\nmaterial{ name = 'a' }"),
            "s.lua:2: material: there is a material 'a' already");
  EXPECT_EQ(error("material{ density = -1 }"), "s.lua:1: material: 'density' lies between 0 and 1e+09");
  EXPECT_EQ(error("material{ color = {1, -1, 0} }"), "s.lua:1: material: 'color' is not negative");
  EXPECT_THAT(error("sphere{ 1, 2 }"), HasSubstr("s.lua:1: sphere: takes named fields only: center, radius, name"));
  EXPECT_THAT(error("sphere(1)"), HasSubstr("s.lua:1: 'sphere' takes one table"));
  EXPECT_THAT(error("sphre{}"), HasSubstr("did you mean 'sphere'?"));
  EXPECT_EQ(error("camera{ from = {0,0,0}, to = {0,0,0} }"), "s.lua:1: camera: 'from' and 'to' are the same point");
  EXPECT_EQ(error("camera{ from = {0,1,0}, to = {0,0,0} }"), "s.lua:1: camera: 'up' points along the view");
  EXPECT_EQ(error("camera{}"), "s.lua:1: camera: the field 'from' is missing");
  EXPECT_EQ(error(""), "s.lua: the scene has no objects");
  EXPECT_THAT(error("sphere{ radius = function() end }"), HasSubstr("s.lua:1: sphere: holds a function"));
  EXPECT_THAT(error("x = = 1"), HasSubstr("s.lua:1: "));
}

TEST_F(LuaScene, NamesAMisspeltFieldRatherThanWhatIsMissing) {
  EXPECT_EQ(error("\ncamera{ frm = {0,0,3} }"), "s.lua:2: camera: unknown field 'frm'; did you mean 'from'?");
  EXPECT_EQ(error("camera{ frm = {0,0,3}, fov = 'wide' }"),
            "s.lua:1: camera: unknown field 'frm'; did you mean 'from'?");
  EXPECT_EQ(error("light{ typ = 'sun' }"), "s.lua:1: light: unknown field 'typ'; did you mean 'type'?");
  EXPECT_EQ(error("light{ type = 'point', positon = {0,1,0} }"),
            "s.lua:1: light: unknown field 'positon'; did you mean 'position'?");
  EXPECT_EQ(error("light{ type = 'environment', imag = 'a.png' }"),
            "s.lua:1: light: unknown field 'imag'; did you mean 'image'?");
  for (const char* function : {"obj", "ply", "gltf"})
    EXPECT_EQ(error(std::string(function) + "{ fle = 'a' }"),
              "s.lua:1: " + std::string(function) + ": unknown field 'fle'; did you mean 'file'?");
  EXPECT_EQ(error("instance{ off = sphere{} }"), "s.lua:1: instance: unknown field 'off'; did you mean 'of'?");
  EXPECT_EQ(error("box{ siz = 0, size = 0 }"), "s.lua:1: box: unknown field 'siz'; did you mean 'size'?");
  EXPECT_EQ(error("rectangle{ u = {0,0,0}, centre = {0,0,0} }"),
            "s.lua:1: rectangle: unknown field 'centre'; did you mean 'center'?");
  EXPECT_EQ(error("plane{ normal = {0,0,0}, pint = {0,0,0} }"),
            "s.lua:1: plane: unknown field 'pint'; did you mean 'point'?");
  EXPECT_EQ(error("material{ density = -1, colour = 1 }"),
            "s.lua:1: material: unknown field 'colour'; did you mean 'color'?");
  EXPECT_EQ(error("render{ width = 1.5, hight = 2 }"),
            "s.lua:1: render: unknown field 'hight'; did you mean 'height'?");
  EXPECT_EQ(error("group{ hiden = true }"), "s.lua:1: group: unknown field 'hiden'; did you mean 'hidden'?");
}

TEST_F(LuaScene, KnowsTheFieldsOfTheTypeAlone) {
  EXPECT_EQ(error("light{ type = 'point', angle = 3 }"),
            "s.lua:1: light: unknown field 'angle' (known: type, color, intensity, position)");
  EXPECT_THAT(error("light{ type = 'sum', angle = 3 }"), HasSubstr("unknown type 'sum'; did you mean 'sun'?"));
  EXPECT_EQ(error("light{ angle = 3 }"), "s.lua:1: light: the field 'type' is missing");
  EXPECT_THAT(error("group{ sphere{}, material = 'a' }"), HasSubstr("s.lua:1: group: unknown field 'material'"));
  folder_.write("a.png", "");
  const char* text = "light{ type = 'environment', image = 'a.png', params = { a = 1 } }";
  EXPECT_THAT(parse_lua_scene(folder_ / "s.lua", text, folder_.folders()).error,
              HasSubstr("s.lua:1: light: 'params' are those of a 'shader'"));
}

TEST_F(LuaScene, TellsWhatItPrintsLineByLine) {
  EXPECT_THAT(
      parse("print('a', 1) print('b\\nc\\0d') print() sphere{}").warnings,
      ElementsAre("s.lua: print: a\t1", "s.lua: print: b", std::string("s.lua: print: c\0d", 17), "s.lua: print: "));
  EXPECT_EQ(parse("for i = 1, 200 do print(('x\\n'):rep(1000)) end sphere{}").warnings.size(), 100u);
}

TEST_F(LuaScene, OpensOnlyFilesOfItsFolders) {
  folder_.write("in.lua", "");
  folder_.write("sub/deep.lua", "");
  Folders folders = folder_.folders();
  auto error = [&](const std::string& text) { return parse_lua_scene(folder_ / "s.lua", text, folders).error; };
  EXPECT_EQ(error("sphere{ material = material{ shader = 'in.lua', height = 'sub/deep.lua' } }"), "");
  EXPECT_EQ(error("sphere{ material = material{ shader = 'sub/../in.lua' } }"), "");
  EXPECT_THAT(error("material{ shader = '../in.lua' }"),
              HasSubstr("s.lua:1: material: 'shader': '../in.lua' lies outside the folders"));
  EXPECT_THAT(error("material{ color = '/etc/passwd' }"), HasSubstr("lies outside the folders"));
  EXPECT_THAT(error("obj{ file = 'none.obj' }"), HasSubstr("s.lua:1: obj: 'file': there is no file 'none.obj'"));
}

TEST_F(LuaScene, TellsWhereAModelIsWrong) {
  folder_.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  SceneReading reading = parse_lua_scene(folder_ / "s.lua", "obj{ file = 'bad.obj' }", folder_.folders());
  EXPECT_THAT(reading.error, HasSubstr("s.lua:1: obj: "));
  EXPECT_THAT(reading.error, HasSubstr("bad.obj:2: the face names vertex 2"));
}

TEST_F(LuaScene, HasNoDangerousFunctions) {
  for (const char* name :
       {"io", "os", "debug", "package", "require", "load", "loadfile", "dofile", "loadstring", "coroutine",
        "collectgarbage", "setmetatable", "getmetatable", "pcall", "string.gsub", "string.dump", "table.move"})
    EXPECT_EQ(error("assert(" + std::string(name) + " == nil) sphere{}"), "") << name;
}

TEST_F(LuaScene, EndsEndlessAndHungryScenes) {
  SandboxLimits limits;
  limits.instructions = 1'000'000;
  limits.memory_bytes = 4 << 20;
  limits.calls = 100;
  std::string_view functions[] = {"sphere"};
  auto error = [&](const char* text) { return run_scene_file("s.lua", text, functions, {}, limits).error; };
  EXPECT_THAT(error("while true do end"), HasSubstr("s.lua:1: the scene runs too long"));
  EXPECT_THAT(error("local t = {} for i = 1, 1e9 do t[i] = i end"),
              HasSubstr("s.lua:1: the scene takes more than 4 MiB while it is read (memory limit)"));
  EXPECT_THAT(error("local s = ('x'):rep(1e9)"),
              HasSubstr("s.lua:1: the scene takes more than 4 MiB while it is read (memory limit)"));
  limits.seconds = 0.05;
  for (const char* loop : {"local s = ('x'):rep(500000)", "table.sort(t)", "table.insert(t, 1, i)"})
    EXPECT_THAT(error(("local t = {} for i = 1, 50000 do t[i] = i % 7 end\nwhile true do\nlocal i = 1 " +
                       std::string(loop) + " end")
                          .c_str()),
                HasSubstr("s.lua:3: the scene runs too long (time limit)"))
        << loop;
  limits.seconds = 4;
  EXPECT_THAT(error("local t = {1} for i = 1, 14 do t = {t, t, t, t} end sphere{ x = t }"), HasSubstr("too much"));
  limits.memory_bytes = 256 << 20;
  limits.instructions = 100'000'000;
  EXPECT_THAT(error("local function f() return f() + 1 end f()"), HasSubstr("s.lua:1: stack overflow"));
  EXPECT_THAT(error("for i = 1, 200 do sphere{} end"), HasSubstr("describes too many things"));
  EXPECT_THAT(error("local t = {} t.t = t sphere{ t }"), HasSubstr("nested too deeply"));
  EXPECT_THAT(error("error{}"), HasSubstr("s.lua: "));
}

TEST_F(LuaScene, BoundsWhatTheLibraryLoopsOver) {
  for (const char* arguments : {"math.maxinteger", "math.maxinteger, ''"})
    EXPECT_EQ(error("local s = (''):rep(" + std::string(arguments) + ") sphere{}"), "");
  // A table with holes, whose length Lua takes to be 2^61.
  const std::string holes = "local t = {} for i = 61, 0, -1 do t[1 << i] = 1 end ";
  for (const char* call : {"table.insert(t, 1, 1)", "table.remove(t, 1)"})
    EXPECT_EQ(error(holes + call), "s.lua:1: the table is too long, or has holes") << call;
  EXPECT_EQ(
      error("local t = {1, 2} table.insert(t, 3) table.insert(t, 1, 0) assert(table.remove(t, 1) == 0 and "
            "table.remove(t) == 3 and #t == 2 and ('ab'):rep(2, '-') == 'ab-ab' and ('x'):rep(0) == '') sphere{}"),
      "");
  EXPECT_EQ(error("('x'):rep({})"), "s.lua:1: bad argument #1 to 'rep' (number expected, got table)");
  EXPECT_EQ(error("table.insert({}, 5, 1)"), "s.lua:1: bad argument #2 to 'insert' (position out of bounds)");
}

TEST_F(LuaScene, BoundsSurroundings) {
  EXPECT_EQ(error("sphere{} for i = 1, 64 do light{ type = 'sky' } end"), "");
  EXPECT_EQ(error("sphere{} for i = 1, 65 do light{ type = 'sky' } end"),
            "s.lua:1: light: a scene has at most 64 skies");
}

TEST_F(LuaScene, StatesRangesInFull) {
  EXPECT_THAT(error("render{ samples = 0 }"), HasSubstr("'samples' lies between 1 and 16777216"));
  EXPECT_THAT(error("render{ seed = -1 }"), HasSubstr("'seed' lies between 0 and 4294967295"));
}

TEST_F(LuaScene, PassesOverAByteOrderMarkAndAFirstLineForTheShell) {
  EXPECT_EQ(error("\xEF\xBB\xBFsphere{}"), "");
  EXPECT_EQ(error("#!/usr/bin/env moonrender\nsphere{}"), "");
  EXPECT_EQ(error("\xEF\xBB\xBF#!/usr/bin/env moonrender\r\nspere{}"),
            "s.lua:2: attempt to call a nil value (global 'spere'); did you mean 'sphere'?");
  EXPECT_EQ(error("#"), "s.lua: the scene has no objects");
}

TEST_F(LuaScene, IsTheSameEveryTime) {
  const char* text = R"(
    local t = {} for i = 1, 50 do t["k" .. i] = i end
    for k, v in pairs(t) do sphere{ center = {v, math.random(), 0}, radius = 0.1 } end)";
  SceneReading first = parse(text), second = parse(text);
  ASSERT_TRUE(first.scene && second.scene) << first.error;
  const Scene &a = *first.scene, &b = *second.scene;
  for (size_t i = 0; i < 50; ++i)
    EXPECT_EQ(a.objects[i].to_world, b.objects[i].to_world);
}

TEST_F(LuaScene, RemembersFieldsAsTheyWereAtTheCall) {
  SceneReading reading = parse("local t = { radius = 0.5 } for i = 1, 3 do t.center = {i, 0, 0} sphere(t) end");
  ASSERT_TRUE(reading.scene) << reading.error;
  EXPECT_EQ(Vec3(reading.scene->objects[0].to_world[3]), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(reading.scene->objects[2].to_world[3]), Vec3(3, 0, 0));
}

TEST_F(LuaScene, GetsCameraAndDaylightWhereItHasNone) {
  SceneReading reading = parse("sphere{ center = {0, 10, 0} }");
  ASSERT_TRUE(reading.scene) << reading.error;
  EXPECT_EQ(reading.scene->camera.to, Vec3(0, 10, 0));
  EXPECT_EQ(reading.scene->lights.size(), 2u);
  EXPECT_EQ(parse("sphere{ material = material{ emission = 1 } }").scene->lights.size(), 0u);
}

TEST_F(LuaScene, PlacesByScaleThenRotationThenTranslation) {
  SceneReading reading = parse("box{ scale = {2, 1, 1}, rotate = {0, 0, 90}, translate = {10, 0, 0} }");
  ASSERT_TRUE(reading.scene) << reading.error;
  Vec4 corner = reading.scene->objects[0].to_world * Vec4(0.5f, 0.5f, 0.5f, 1);
  EXPECT_NEAR(corner.x, 9.5f, 1e-5f);
  EXPECT_NEAR(corner.y, 1, 1e-5f);
}

TEST_F(LuaScene, HasNoFieldWithoutARow) {
  // Every field of every function with its default, where that is a constant.
  for (const FunctionInfo& function : scene_functions()) {
    EXPECT_EQ(find_field(function, "nonsense"), nullptr);
    for (const FieldInfo& field : function.fields)
      EXPECT_EQ(find_field(function, field.name, field.only.substr(0, field.only.find(','))), &field) << field.name;
  }
  for (const SlotInfo& slot : slot_infos()) {
    const FieldInfo* field = find_field(scene_function(SceneFunction::Material), slot.name);
    ASSERT_TRUE(field) << slot.name;
    EXPECT_EQ(Vec3((*field->otherwise)[0], (*field->otherwise)[1], (*field->otherwise)[2]), slot.default_value);
  }
  const Settings standard;
  SceneReading reading = parse("sphere{} render{} camera{ from = {0, 0, 5} }");
  ASSERT_TRUE(reading.scene) << reading.error;
  EXPECT_EQ(reading.scene->settings.width, standard.width);
  EXPECT_EQ(reading.scene->settings.samples, standard.samples);
  EXPECT_EQ(reading.scene->settings.depth, standard.depth);
  EXPECT_EQ(reading.scene->camera.fov, Camera().fov);
  EXPECT_THAT(error("light{ type = 'sun', angle = 90 }"), HasSubstr("'angle' lies between 0 and 60"));
  EXPECT_THAT(error("light{ type = 'spot', position = {0, 1, 0}, angle = 190 }"),
              HasSubstr("'angle' lies between 0.01 and 180"));
}

TEST_F(LuaScene, HasCamerasOfEveryKind) {
  auto camera = [&](const std::string& fields) {
    SceneReading reading = parse("sphere{} camera{ from = {0, 0, 5}, to = {0, 0, 0}, " + fields + " }");
    EXPECT_TRUE(reading.scene) << reading.error;
    return reading.scene ? reading.scene->camera : Camera();
  };
  EXPECT_EQ(camera("type = 'orthographic', height = 3").kind, CameraKind::Orthographic);
  EXPECT_EQ(camera("type = 'orthographic', height = 3").height, 3);
  EXPECT_EQ(camera("fov = 20, aperture = 0.1, focus = 4").focus, 4);
  EXPECT_EQ(camera("fov = 20, aperture = 0.1, focus = 4").aperture, 0.1f);
  EXPECT_THAT(error("camera{ from = {0, 0, 5}, type = 'orthographic', fov = 20 }"),
              HasSubstr("s.lua:1: camera: unknown field 'fov'"));
  EXPECT_THAT(error("camera{ from = {0, 0, 5}, type = 'ortographic' }"), HasSubstr("did you mean 'orthographic'?"));
  EXPECT_THAT(error("camera{ from = {0, 0, 5}, aperture = -1 }"), HasSubstr("'aperture' lies between"));
}

TEST_F(LuaScene, GroupsAndInstancesComposeTheirPlaces) {
  SceneReading reading = parse(R"(
    local red = material{ name = "red" }
    local ball = sphere{ center = {1, 0, 0}, radius = 0.5 }
    local pair = group{ ball, box{ center = {0, 1, 0} }, rotate = {0, 0, 90}, translate = {10, 0, 0}, name = "pair" }
    instance{ of = pair, translate = {0, 0, 5}, material = red }
    instance{ of = ball, scale = 2, name = "large" }
    local hidden = group{ sphere{ center = {7, 7, 7} }, hidden = true }
    instance{ of = hidden, translate = {1, 0, 0} })");
  ASSERT_TRUE(reading.scene) << reading.error;
  const std::vector<Object>& o = reading.scene->objects;
  ASSERT_EQ(o.size(), 6u);
  auto center = [&](size_t k) { return Vec3(o[k].to_world[3]); };
  EXPECT_LT(glm::distance(center(0), Vec3(10, 1, 0)), 1e-5f); // (1, 0, 0) turned by 90 degrees around z
  EXPECT_EQ(o[1].name, "pair");
  EXPECT_LT(glm::distance(center(2), Vec3(10, 1, 5)), 1e-5f);
  EXPECT_EQ(o[2].materials, std::vector<uint32_t>{1});
  EXPECT_EQ(o[0].materials, std::vector<uint32_t>{0});
  EXPECT_EQ(o[1].mesh, o[3].mesh); // kept once
  EXPECT_EQ(o[4].name, "large");
  EXPECT_LT(glm::distance(center(4), Vec3(20, 2, 0)), 1e-4f);
  EXPECT_EQ(center(5), Vec3(8, 7, 7)); // the hidden one itself is not there
  EXPECT_EQ(error("group{ 1 }"), "s.lua:1: group: holds what is no object");
  EXPECT_EQ(error("group{ material{} }"), "s.lua:1: group: holds what is no object");
  EXPECT_THAT(error("group{}"), HasSubstr("group: holds no objects"));
  EXPECT_THAT(error("local s = sphere{}\ngroup{ s }\ngroup{ s }"),
              HasSubstr("s.lua:3: group: holds what is in a group"));
  EXPECT_EQ(error("instance{ of = {} }"), "s.lua:1: instance: 'of' is what an object's function or group{} gave");
  EXPECT_EQ(error("instance{}"), "s.lua:1: instance: the field 'of' is missing");
  EXPECT_EQ(error("group{ sphere{}, hidden = true }"), "s.lua: the scene has no objects");
  for (const char* scale : {"1e9", "1e-9"})
    EXPECT_THAT(error("local g = sphere{} for i = 1, 8 do g = group{ g, scale = " + std::string(scale) + " } end"),
                HasSubstr("group: 'sphere' lies too far out, or has no extent left"));
  EXPECT_THAT(error("local g = sphere{} for i = 1, 40 do g = group{ g, instance{ of = g } } end"),
              HasSubstr("the scene describes too many things"));
}

TEST_F(LuaScene, PlacesByAMatrix) {
  SceneReading reading = parse("sphere{ matrix = {0, 0, 1, 5,  0, 1, 0, 6,  -1, 0, 0, 7}, translate = {1, 0, 0} }");
  ASSERT_TRUE(reading.scene) << reading.error;
  Vec4 p = reading.scene->objects[0].to_world * Vec4(1, 2, 3, 1);
  EXPECT_EQ(Vec3(p), Vec3(9, 8, 6));
  EXPECT_THAT(error("sphere{ matrix = {1, 2} }"), HasSubstr("'matrix' is a list of 12 or 16 numbers, row by row"));
  EXPECT_THAT(error("sphere{ matrix = {0,0,0,0, 0,0,0,0, 0,0,0,0} }"), HasSubstr("'matrix' leaves no extent"));
  EXPECT_THAT(error("sphere{ matrix = {1,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,0,1} }"), HasSubstr("the last row"));
}

TEST_F(LuaScene, SeesTimeAndFrame) {
  Folders folders = folder_.folders();
  const char* text = "assert(math.type(frame) == 'integer') sphere{ center = {time, frame, 0} } render{ time = 3 }";
  SceneReading still = parse_lua_scene("s.lua", text, folders);
  ASSERT_TRUE(still.scene) << still.error;
  EXPECT_EQ(Vec3(still.scene->objects[0].to_world[3]), Vec3(0));
  SceneReading moving = parse_lua_scene("s.lua", text, folders, {7, 0.25});
  ASSERT_TRUE(moving.scene) << moving.error;
  EXPECT_EQ(Vec3(moving.scene->objects[0].to_world[3]), Vec3(0.25f, 7, 0));
}

TEST_F(LuaScene, ReadsModelsOfEveryFormatOnce) {
  folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder_.write("m.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  SceneReading reading = parse_lua_scene(folder_ / "s.lua",
                                         "obj{ file = 'm.obj' } obj{ file = 'm.obj', translate = {2, 0, 0} }"
                                         "ply{ file = 'm.ply', name = 'tile', material = material{ name = 'a' } }",
                                         folder_.folders());
  ASSERT_TRUE(reading.scene) << reading.error;
  ASSERT_EQ(reading.scene->objects.size(), 3u);
  EXPECT_EQ(reading.scene->objects[0].mesh, reading.scene->objects[1].mesh);
  EXPECT_EQ(reading.scene->objects[0].materials, reading.scene->objects[1].materials);
  EXPECT_EQ(reading.scene->objects[2].name, "tile");
  EXPECT_EQ(reading.scene->materials[reading.scene->objects[2].materials[0]].name, "a");
}

TEST(ReadScene, ChoosesTheReaderByTheEnding) {
  TemporaryFolder folder;
  std::string obj = folder.write("M.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  SceneReading bare = read_scene(obj);
  ASSERT_TRUE(bare.scene) << bare.error;
  EXPECT_EQ(bare.scene->lights.size(), 2u);
  EXPECT_THAT(read_scene(folder.write("s.txt", "")).error, HasSubstr("neither a Lua scene"));
  EXPECT_THAT(read_scene(folder / "none.lua").error, HasSubstr("none.lua: No such file"));
}

} // namespace
} // namespace moonshade::renderer
