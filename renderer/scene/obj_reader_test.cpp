#include "renderer/scene/obj_reader.h"

#include "renderer/scene/mesh.h"
#include "renderer/scene/read_scene.h"
#include "renderer/test_support.h"

#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

ObjReading parse(const std::string& text) { return parse_obj("m.obj", text, Folders()); }

/// Doubled area of all triangles together.
double area(const Mesh& mesh) {
  double sum = 0;
  for (const Mesh::Corners& t : mesh.triangles) {
    DVec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    sum += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  return sum;
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjReader, ReadsQuadsNegativeIndicesAndContinuedLines) {
  ObjReading obj = parse(kSquare + "f -4 -3 \\\n-2 -1\n");
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_EQ(obj.mesh->triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(area(*obj.mesh), 1.0);
  EXPECT_TRUE(obj.warnings.empty());
}

TEST(ObjReader, ReadsEveryLineEnding) {
  for (const char* ending : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char* line : {"# made by hand", "v 0 0 0 # corner", "v\t1 0 0", "  v 0 1 0", "", "f 1 2 3 # the face"})
      text += line + std::string(ending);
    ObjReading obj = parse(text);
    ASSERT_TRUE(obj.mesh) << obj.error;
    EXPECT_EQ(obj.mesh->triangles.size(), 1u);
  }
}

TEST(ObjReader, ReadsAMaterialLibraryOnceAndFindsTheOneThatCameAlong) {
  TemporaryFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nmap_Bump dents.png\n");
  const std::string path = folder / "m.obj";
  for (const char* name : {"m.mtl", "C:\\models\\m.mtl", "/home/somebody/m.mtl", "sub/m.mtl"}) {
    std::string text;
    for (int k = 0; k < 1000; ++k)
      text += "mtllib " + std::string(name) + "\n";
    const ObjReading obj = parse_obj(path, text + kSquare + "usemtl red\nf 1 2 3 4\n", folder.folders());
    ASSERT_TRUE(obj.mesh) << obj.error;
    EXPECT_EQ(obj.warnings.size(), 1u) << name; // the bump map's
    EXPECT_EQ(obj.materials[0].name, "red");
  }
  const ObjReading outside = parse_obj(path, "mtllib ../../none/n.mtl\n" + kSquare + "f 1 2 3 4\n", folder.folders());
  ASSERT_EQ(outside.warnings.size(), 1u);
  EXPECT_THAT(outside.warnings[0], HasSubstr("m.obj:1: '../../none/n.mtl' lies outside"));
}

TEST(ObjReader, PassesOverFreeFormsWithAWarning) {
  const ObjReading obj =
      parse(kSquare + "vp 0 0\ncstype bezier\ndeg 1 1\ncurv 0 1 1 2\nparm u 0 1\nsurf 0 1 0 1 1 2 3 4\nend\n"
                      "l 1 2\np 1\nf 1 2 3 4\n");
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_EQ(obj.mesh->triangles.size(), 2u);
  EXPECT_EQ(obj.warnings, std::vector<std::string>{"m.obj:8: free-form curves and surfaces are passed over"});
}

TEST(ObjReader, FillsConcavePolygonsExactly) {
  // An L of area 3, in both orders.
  std::string corners = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
  for (const char* face : {"f 1 2 3 4 5 6\n", "f 6 5 4 3 2 1\n", "f 4 5 6 1 2 3\n"}) {
    ObjReading obj = parse(corners + face);
    ASSERT_TRUE(obj.mesh) << obj.error;
    EXPECT_DOUBLE_EQ(area(*obj.mesh), 3.0) << face;
  }
}

TEST(ObjReader, SplitsConcaveQuadsInside) {
  ObjReading obj = parse("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n"); // an arrowhead of area 4
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_DOUBLE_EQ(area(*obj.mesh), 4.0);
}

TEST(ObjReader, ReadsFacesOfManyCorners) {
  std::string text, face = "f";
  for (int i = 0; i < 500; ++i) {
    text += "v " + std::to_string(std::cos(i * 2 * M_PI / 500)) + " " + std::to_string(std::sin(i * 2 * M_PI / 500)) +
            " 0\n";
    face += " " + std::to_string(i + 1);
  }
  ObjReading obj = parse(text + face + "\n");
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_EQ(obj.mesh->triangles.size(), 498u);
  EXPECT_NEAR(area(*obj.mesh), M_PI, 1e-3);
}

TEST(ObjReader, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_EQ(parse(kSquare + "f 1 2 9\n").error, "m.obj:5: the face names vertex 9, but there are 4 so far");
  EXPECT_EQ(parse(kSquare + "\n\nf 1 2 -5\n").error, "m.obj:7: the face names vertex -5, but there are 4 so far");
  EXPECT_EQ(parse(kSquare + "f 1/1 2/1 3/1\n").error,
            "m.obj:5: the face names texture coordinate 1, but there are 0 so far");
  EXPECT_EQ(parse(kSquare + "f 1//2 2//2 3//2\n").error, "m.obj:5: the face names normal 2, but there are 0 so far");
  EXPECT_EQ(parse(kSquare + "f 0 1 2\n").error, "m.obj:5: the face names vertex 0, but there are 4 so far");
  EXPECT_EQ(parse("v 1 2\nf 1 1 1\n").error, "m.obj:1: expected at least 3 numbers");
  EXPECT_EQ(parse("v a b c\n").error, "m.obj:1: expected at least 3 numbers");
}

TEST(ObjReader, RefusesCornersThatAreNoIndices) {
  for (const char* corner : {"99999999999999999999", "1.5", "1/x", "1/1/1/1", "x"})
    EXPECT_EQ(parse(kSquare + "f " + corner + " 2 3\n").error,
              "m.obj:5: '" + std::string(corner) + "' is no corner of a face: expected v, v/t, v//n or v/t/n");
}

TEST(ObjReader, ReadsCornersWithEmptyPlaces) {
  ObjReading obj = parse(kSquare + "f 1/ 2// 3//\n");
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_EQ(obj.mesh->triangles.size(), 1u);
}

TEST(ObjReader, RefusesWhatLiesTooFarOut) {
  EXPECT_EQ(parse("v 0 0 0\nv 1 0 0\nv 1e20 1 0\nf 1 2 3\n").error,
            "m.obj:4: vertex 3 lies too far out; coordinates reach to 1e15");
}

TEST(ObjReader, FramesWhatFacesUse) {
  Object object;
  object.mesh = parse(kSquare + "v 1000 0 0\nf 1 2 3 4\n").mesh;
  EXPECT_EQ(bounds_of(object).high.x, 1);
}

TEST(ObjReader, RefusesBareModelsTooSmallToFrame) {
  TemporaryFolder folder;
  std::string file = folder.write("tiny.obj", "v 0 0 0\nv 1e-15 0 0\nv 0 1e-15 0\nf 1 2 3\n");
  EXPECT_THAT(read_scene(file).error, HasSubstr("tiny.obj: "));
}

TEST(ObjReader, RefusesWhatHasNoFaces) {
  EXPECT_EQ(parse("").error, "m.obj: has no faces");
  EXPECT_EQ(parse("# nothing\nv 0 0 0\n").error, "m.obj: has no faces");
  EXPECT_EQ(parse("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").error, "m.obj: no face is left");
}

TEST(ObjReader, SkipsFacesThatCannotBeDrawn) {
  ObjReading obj = parse(kSquare + "v nan 0 0\nv 1e99 0 0\nf 1 2 3\nf 1 2 5\nf 1 2 6\nf 1 1 2\nf 1 2\n");
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_EQ(obj.mesh->triangles.size(), 1u);
  ASSERT_EQ(obj.warnings.size(), 3u);
  EXPECT_THAT(obj.warnings[0], HasSubstr("1 faces with fewer than three corners"));
  EXPECT_THAT(obj.warnings[1], HasSubstr("2 faces with a vertex that is not finite"));
  EXPECT_THAT(obj.warnings[2], HasSubstr("1 triangles without area"));
}

TEST(ObjReader, SmoothsWhereAnglesAreSmall) {
  // Two squares along a fold of 20 degrees, then of 90.
  for (auto [height, smooth] : {std::pair{0.364f, true}, std::pair{100.0f, false}}) {
    ObjReading obj = parse(kSquare + "v 2 0 " + std::to_string(height) + "\nv 2 1 " + std::to_string(height) +
                           "\nf 1 2 3 4\nf 2 5 6 3\n");
    ASSERT_TRUE(obj.mesh) << obj.error;
    const Mesh& mesh = *obj.mesh;
    Vec3 at_fold(0);
    for (int c = 0; c < 3; ++c)
      if (mesh.triangles[0][c] == 1) at_fold = mesh.normals[mesh.normal_corners[0][c]];
    EXPECT_EQ(at_fold.z < 0.999f, smooth);
  }
}

TEST(ObjReader, FollowsSmoothingGroups) {
  std::string fold = kSquare + "v 2 0 1\nv 2 1 1\n";
  auto normals = [&](const std::string& faces) { return parse(fold + faces).mesh->normals.size(); };
  EXPECT_EQ(normals("s off\nf 1 2 3 4\nf 2 5 6 3\n") > 3, true);
  // In one group the two points of the fold have one normal each.
  ObjReading joined = parse(fold + "s 1\nf 1 2 3 4\nf 2 5 6 3\n");
  Vec3 expected = glm::normalize(glm::normalize(Vec3(-1, 0, 1)) + Vec3(0, 0, 1));
  bool found = false;
  for (const Vec3& n : joined.mesh->normals)
    found |= glm::distance(n, expected) < 1e-5f;
  EXPECT_TRUE(found);
  // In two groups none is shared.
  ObjReading apart = parse(fold + "s 1\nf 1 2 3 4\ns 2\nf 2 5 6 3\n");
  for (const Vec3& n : apart.mesh->normals)
    EXPECT_GT(glm::distance(n, expected), 0.1f);
}

TEST(ObjReader, SmoothsAcrossRepeatedPositions) {
  ObjReading obj = parse(kSquare + "v 1 0 0\nv 1 1 0\nv 2 0 0.3\nv 2 1 0.3\nf 1 2 3 4\nf 5 7 8 6\n");
  ASSERT_TRUE(obj.mesh) << obj.error;
  bool bent = false;
  for (const Vec3& n : obj.mesh->normals)
    bent |= n.z < 0.999f && n.z > 0.97f;
  EXPECT_TRUE(bent);
}

TEST(ObjReader, ReadsMaterialsAndGroupsThemIntoSlots) {
  TemporaryFolder folder;
  folder.write("two words.mtl", "newmtl red\nKd 1 0 0\nnewmtl unused\n");
  std::string path =
      folder.write("m.obj", "mtllib two words.mtl\n" + kSquare + "usemtl red\nf 1 2 3\nusemtl missing\nf 1 3 4\n");
  ObjReading obj = read_obj(path, folder.folders());
  ASSERT_TRUE(obj.mesh) << obj.error;
  ASSERT_EQ(obj.materials.size(), 2u);
  EXPECT_EQ(obj.materials[0].name, "red");
  EXPECT_EQ(obj.materials[0].values[size_t(Slot::Color)], Vec3(1, 0, 0));
  EXPECT_EQ(obj.materials[1].name, "default");
  EXPECT_EQ(obj.mesh->material_slots, (std::vector<uint32_t>{0, 1}));
  ASSERT_EQ(obj.warnings.size(), 1u);
  EXPECT_EQ(obj.warnings[0], path + ":8: no material 'missing' has been read; the default one stands in");
}

TEST(ObjReader, GoesOnWithoutAMaterialFileButNotOutsideItsFolder) {
  TemporaryFolder folder;
  folder.write("secret.mtl", "newmtl red\nKd 1 0 0\n");
  std::string path = folder.write("sub/m.obj", "mtllib ../secret.mtl\nmtllib none.mtl\n" + kSquare + "f 1 2 3\n");
  Folders folders;
  folders.allow_folder_of(path);
  ObjReading obj = read_obj(path, folders);
  ASSERT_TRUE(obj.mesh) << obj.error;
  ASSERT_EQ(obj.warnings.size(), 2u);
  EXPECT_THAT(obj.warnings[0], HasSubstr("m.obj:1: '../secret.mtl' lies outside the folders that may be read"));
  EXPECT_THAT(obj.warnings[1], HasSubstr("m.obj:2: there is no file 'none.mtl'"));
}

TEST(ObjReader, FollowsNoLinkOutOfItsFolder) {
  TemporaryFolder folder;
  folder.write("secret.mtl", "newmtl red\n");
  std::string path = folder.write("sub/m.obj", "mtllib link.mtl\n" + kSquare + "f 1 2 3\n");
  std::filesystem::create_symlink(folder / "secret.mtl", folder / "sub/link.mtl");
  Folders folders;
  folders.allow_folder_of(path);
  EXPECT_THAT(read_obj(path, folders).warnings[0], HasSubstr("outside the folders"));
}

TEST(ObjReader, ReadsHundredsOfThousandsOfTriangles) {
  constexpr int kSide = 300;
  std::string text;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      int a = y * (kSide + 1) + x + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + kSide + 2) + " " +
              std::to_string(a + kSide + 1) + "\n";
    }
  ObjReading obj = parse(text);
  ASSERT_TRUE(obj.mesh) << obj.error;
  EXPECT_EQ(obj.mesh->triangles.size(), 2u * kSide * kSide);
  EXPECT_EQ(obj.mesh->normals.size(), size_t(kSide + 1) * (kSide + 1)); // one a vertex: all faces agree there
}

TEST(ObjReader, ReportsUnreadableFiles) {
  TemporaryFolder folder;
  EXPECT_THAT(read_obj(folder / "none.obj", folder.folders()).error, HasSubstr("none.obj: No such file"));
  std::filesystem::create_directory(folder / "d.obj");
  EXPECT_THAT(read_obj(folder / "d.obj", folder.folders()).error, HasSubstr("is a folder"));
}

} // namespace
} // namespace moonshade::renderer
