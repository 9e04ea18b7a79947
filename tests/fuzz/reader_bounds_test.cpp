// The renderer's readers on files that are large on purpose: each ends soon, in bounded memory, with a mesh or scene or
// an error. As in bounds_test.cpp, time is asserted only far beyond what is usual.
#include "renderer/scene/lua_scene.h"
#include "renderer/scene/mtl_reader.h"
#include "renderer/scene/obj_reader.h"
#include "renderer/scene/ply_reader.h"
#include "tests/fuzz/measure.h"

#include <cmath>
#include <gtest/gtest.h>

namespace moonshade::renderer {
namespace {

using fuzz::expect_bounded;
using fuzz::Measure;

void expect_obj(const std::string& text) {
  const Measure measure;
  const ObjReading obj = parse_obj("hostile.obj", text, Folders());
  EXPECT_NE(obj.mesh == nullptr, obj.error.empty());
  expect_bounded(measure, text.size(), obj.mesh ? "a mesh" : obj.error);
}

void expect_scene(const std::string& text) {
  const Measure measure;
  const SceneReading reading = parse_lua_scene("hostile.lua", text, Folders());
  EXPECT_NE(!reading.scene, reading.error.empty());
  expect_bounded(measure, text.size(), reading.scene ? "a scene" : reading.error.substr(0, 100));
}

std::string point_on_circle(double radius, double angle) {
  return "v " + std::to_string(radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) + " 0\n";
}

template <class Point> std::string polygon(int corners, const Point& point) {
  std::string text, face = "f";
  for (int i = 0; i < corners; ++i) {
    text += point(i);
    face += " " + std::to_string(i + 1);
  }
  return text + face + "\n";
}

TEST(ReaderBounds, APolygonOfManyCorners) {
  expect_obj(polygon(30'000, [](int i) { return point_on_circle(1, i * 2e-4); }));
}

TEST(ReaderBounds, AStarOfManyCorners) {
  expect_obj(polygon(30'000, [](int i) { return point_on_circle(i % 2 != 0 ? 1.0 : 0.5, i * 2e-4); }));
}

TEST(ReaderBounds, ASpiralOfManyCorners) {
  expect_obj(polygon(20'000, [](int i) {
    const bool is_outer = i < 10'000;
    const double turn = (is_outer ? i : 20'000 - i) * 0.01;
    return point_on_circle(1 + turn + (is_outer ? 2.0 : 0.0), turn);
  }));
}

TEST(ReaderBounds, AFanAroundOneVertex) {
  std::string text = "v 0 0 1\n";
  for (int i = 0; i < 20'000; ++i)
    text += point_on_circle(1, i * 3e-4);
  for (int i = 2; i < 20'000; ++i)
    text += "f 1 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  expect_obj(text);
}

TEST(ReaderBounds, ManyFacesOnTheSameVertices) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  for (size_t i = 0; i < 100'000; ++i)
    text += i % 2 ? "f 1 2 3\n" : "f 1 3 4\n";
  expect_obj(text);
}

TEST(ReaderBounds, ManySmoothingGroupsAndMaterials) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (size_t i = 0; i < 30'000; ++i)
    text += "s " + std::to_string(i) + "\nusemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  expect_obj(text);
}

TEST(ReaderBounds, ALineThatIsContinuedForLong) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3";
  for (size_t i = 0; i < 300'000; ++i)
    text += " \\\n";
  expect_obj(text + "\n");
}

TEST(ReaderBounds, ManyMaterialLibrariesOnALine) {
  std::string text = "mtllib";
  for (size_t i = 0; i < 100'000; ++i)
    text += " m" + std::to_string(i);
  expect_obj(text + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

TEST(ReaderBounds, APlyOfManyElementsOfALongName) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
                     "property char z\nelement face 1\nproperty list uchar uchar vertex_indices\nelement " +
                     std::string(4000, 'x') + " 20000000\nproperty uchar a\nend_header\n";
  for (const char byte : {0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2})
    text += byte;
  text.append(20'000'000, '\0');
  const Measure measure;
  const Model ply = parse_ply("hostile.ply", text);
  EXPECT_EQ(ply.error, "");
  EXPECT_LT(measure.seconds(), 4) << "the name is copied for every element";
  expect_bounded(measure, text.size(), "a mesh");
}

TEST(ReaderBounds, ManyMaterials) {
  std::string text;
  for (size_t i = 0; i < 50'000; ++i)
    text += "newmtl m" + std::to_string(i) + "\nKd 1 0 0\n";
  const Measure measure;
  const MtlReading mtl = parse_mtl("hostile.mtl", text, Folders());
  EXPECT_EQ(mtl.materials.size(), 50'000u) << mtl.error;
  expect_bounded(measure, text.size(), "materials");
}

TEST(ReaderBounds, AnEndlessScene) { expect_scene("while true do end"); }
TEST(ReaderBounds, AnEndlessCoroutineOfStrings) { expect_scene("local s = 'x' while true do s = s .. s end"); }

TEST(ReaderBounds, ASceneOfRepeatedStrings) { expect_scene("for i = 1, 1e9 do local s = ('x'):rep(100000000) end"); }

TEST(ReaderBounds, ASceneThatComparesLongStrings) {
  expect_scene("local a, b = ('x'):rep(50000000), ('x'):rep(50000000) .. 'y' for i = 1, 1e9 do local c = a < b end");
}

TEST(ReaderBounds, ASceneThatInsertsInFront) {
  expect_scene("local t = {} for i = 1, 1e9 do table.insert(t, 1, i) end");
}

TEST(ReaderBounds, ASceneThatJoinsLongLists) {
  expect_scene("local t = {} for i = 1, 1000000 do t[i] = 'x' end for i = 1, 1e9 do local s = table.concat(t) end");
}

TEST(ReaderBounds, ASceneThatSortsLongLists) {
  expect_scene("local t = {} for i = 1, 1000000 do t[i] = i % 7 end for i = 1, 1e9 do table.sort(t) end");
}

TEST(ReaderBounds, ATableThatStandsInItselfManyTimes) {
  expect_scene("local t = { 1 } for i = 1, 14 do t = { t, t, t, t, t, t, t, t } end sphere { center = t }");
}

TEST(ReaderBounds, ATableThatHoldsItself) { expect_scene("local t = {} t[1] = t sphere { center = t }"); }

TEST(ReaderBounds, ManySpheres) { expect_scene("for i = 1, 1e9 do sphere { center = { i, 0, 0 } } end"); }

TEST(ReaderBounds, ManyMaterialsOfAScene) {
  expect_scene(
      "for i = 1, 200000 do material { name = 'm' .. i } end for i = 1, 200000 do sphere { material = 'm' .. i } end");
}

TEST(ReaderBounds, DeepCalls) { expect_scene("local function f(n) return 1 + f(n + 1) end f(1)"); }
TEST(ReaderBounds, DeepNesting) { expect_scene("x = " + std::string(400'000, '{')); }

} // namespace
} // namespace moonshade::renderer
