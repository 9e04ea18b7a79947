// PLY and glTF: what they may hold, and what hostile ones hold.
#include "renderer/sampling/sampler.h"
#include "renderer/scene/gltf_reader.h"
#include "renderer/scene/ply_reader.h"
#include "renderer/scene/read_scene.h"
#include "renderer/test_support.h"

#include <cstring>
#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using testing::base64;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

// PLY
// -------------------------------------------------------------------------------------------------------------------

std::string header(const std::string& vertices, const std::string& faces, const std::string& more = "",
                   const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\n" + more + "element face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}
const std::string kCorners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

const Mesh& mesh_of(const Model& model) {
  static const Mesh none;
  EXPECT_EQ(model.error, "");
  return model.objects.empty() ? none : *model.objects[0].mesh;
}

TEST(Ply, ReadsAsciiWithPolygonsNormalsAndTextureCoordinates) {
  Model model =
      parse_ply("a.ply", header("4", "1",
                                "property float nx\nproperty float ny\nproperty float nz\n"
                                "property uchar red\nproperty float s\nproperty float t\n") +
                             "0 0 0 0 0 2 255 0 0\r\n1 0 0 0 0 1 1 1 0\n1 1 0 0 0 1 0 1 1\n0 1 0 0 0 1 0 0 1\n"
                             "4 0 1 2 3\n");
  const Mesh& mesh = mesh_of(model);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.normals[0], Vec3(0, 0, 1)); // brought to unit length
  EXPECT_EQ(mesh.uvs[2], Vec2(1, 1));
  EXPECT_EQ(mesh.uv_corners.size(), 2u);
  EXPECT_EQ(model.warnings.size(), 0u);
  EXPECT_EQ(model.materials.size(), 1u);
}

template <typename T> void put(std::string& out, T value, bool big) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big) std::reverse(raw, raw + sizeof raw);
  out.append(raw, sizeof raw);
}

TEST(Ply, ReadsBothByteOrdersAndEveryType) {
  for (bool big : {false, true}) {
    std::string bytes = "ply\nformat " + std::string(big ? "binary_big_endian" : "binary_little_endian") +
                        " 1.0\nelement vertex 3\nproperty double x\nproperty float32 y\nproperty short z\n"
                        "property list ushort int8 neighbours\nelement strange 1\nproperty uint a\nproperty int b\n"
                        "element face 1\nproperty char material\nproperty list uint ushort vertex_index\nend_header\n";
    for (int k = 0; k < 3; ++k) {
      put(bytes, double(k == 1), big), put(bytes, float(k == 2), big), put(bytes, int16_t(-7), big);
      put(bytes, uint16_t(k), big);
      for (int i = 0; i < k; ++i)
        put(bytes, int8_t(-1), big);
    }
    put(bytes, uint32_t(1), big), put(bytes, int32_t(-1), big);
    put(bytes, int8_t(3), big), put(bytes, uint32_t(3), big);
    for (int k = 0; k < 3; ++k)
      put(bytes, uint16_t(k), big);
    Model model = parse_ply("a.ply", bytes);
    const Mesh& mesh = mesh_of(model);
    EXPECT_THAT(mesh.positions, ElementsAre(Vec3(0, 0, -7), Vec3(1, 0, -7), Vec3(0, 1, -7))) << big;
    EXPECT_EQ(mesh.triangles.size(), 1u);
    for (size_t length = 0; length < bytes.size(); ++length)
      EXPECT_NE(parse_ply("a.ply", bytes.substr(0, length)).error, "") << length;
  }
}

TEST(Ply, MayHaveItsFacesFirst) {
  Model model =
      parse_ply("a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
                         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                         "3 0 1 2\n" +
                             kCorners);
  EXPECT_EQ(mesh_of(model).triangles.size(), 1u);
}

TEST(Ply, SkipsFacesThatAreNoneWithAWarning) {
  Model model = parse_ply("a.ply", header("5", "5") + kCorners + "nan 1 1\n3 0 1 2\n2 0 1\n3 0 0 1\n3 0 1 4\n0\n");
  EXPECT_EQ(mesh_of(model).triangles.size(), 1u);
  EXPECT_THAT(model.warnings, ElementsAre("a.ply: 1 faces with fewer than three corners skipped",
                                          "a.ply: 1 faces with a vertex that is not finite skipped",
                                          "a.ply: 1 triangles without area skipped"));
}

TEST(Ply, NamesTheLineOfWhatIsWrong) {
  auto error = [](const std::string& text) { return parse_ply("a.ply", text).error; };
  EXPECT_EQ(error(""), "a.ply:1: does not begin with 'ply'");
  EXPECT_EQ(error("ply\n"), "a.ply:1: the header does not end");
  EXPECT_EQ(error("ply\nformat utf8 1.0\n"), "a.ply:2: unknown format");
  EXPECT_EQ(error("ply\nproperty float x\n"), "a.ply:2: a property before any element");
  EXPECT_EQ(error("ply\nelement vertex\n"), "a.ply:2: expected 'element NAME COUNT'");
  EXPECT_EQ(error("ply\nelement vertex -1\n"), "a.ply:2: expected 'element NAME COUNT'");
  EXPECT_EQ(error("ply\nelement vertex 9999999999\n"), "a.ply:2: too many elements");
  EXPECT_EQ(error("ply\nelement vertex 1\nproperty half x\n"), "a.ply:3: unknown type 'half'");
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty list int x\n"),
              HasSubstr("a.ply:3: expected 'property TYPE NAME'"));
  EXPECT_EQ(error("ply\nnonsense\n"), "a.ply:2: unknown statement 'nonsense'");
  EXPECT_EQ(error(header("4", "1") + kCorners + "3 0 1 4\n"), "a.ply:14: face 0: the face names vertex 4 of 4");
  EXPECT_EQ(error(header("4", "1") + kCorners + "3 0 1 -1\n"), "a.ply:14: face 0: a vertex cannot have this number");
  EXPECT_EQ(error(header("4", "1") + kCorners + "3 0 1 x\n"), "a.ply:14: face 0: expected a number");
  EXPECT_EQ(error(header("4", "1") + kCorners + "-3 0 1 2\n"), "a.ply:14: face 0: a list cannot have such a length");
  EXPECT_EQ(error(header("4", "1") + "0 0 1e20\n1 0 0\n0 1 0\n0 0 0\n3 0 1 2\n"),
            "a.ply:14: face 0: vertex 0 lies too far out; coordinates reach to 1e15");
  EXPECT_EQ(error(header("4", "0") + kCorners), "a.ply: has no faces");
  EXPECT_THAT(error(header("4000000000", "1") + kCorners), HasSubstr("vertex 4: the file ends too early"));
  EXPECT_THAT(error(header("1", "1", "", "binary_little_endian") + std::string(12, '\0') + "\xff"),
              HasSubstr("face 0: the file ends too early"));
  EXPECT_EQ(error("ply\nformat ascii 1.0\nelement " + std::string(4000, 'x') + " 2\nproperty int a\nend_header\n1\n"),
            "a.ply:6: " + std::string(40, 'x') + " 1: the file ends too early");
  EXPECT_EQ(error("ply\nformat ascii 1.0\nelement nothing 4000000000\nend_header\n"), "a.ply: has no faces"); // at once
}

TEST(Ply, SurvivesDamage) {
  std::string ascii = header("4", "2") + kCorners + "3 0 1 2\n3 0 2 3\n";
  for (uint32_t seed = 0; seed < 3000; ++seed) {
    std::string damaged = ascii;
    for (uint32_t k = 0; k < 1 + seed % 4; ++k)
      damaged[hash_combine(seed, k) % damaged.size()] = char(hash_combine(seed, k + 100));
    Model model = parse_ply("a.ply", damaged);
    EXPECT_TRUE(model.error.empty() != model.objects.empty());
  }
}

// glTF
// ------------------------------------------------------------------------------------------------------------------

/// A unit square: four positions, then six indices of 16 bits.
std::string square_bytes() {
  std::string bytes;
  for (float f : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
    put(bytes, f, false);
  for (uint16_t i : {0, 1, 2, 0, 2, 3})
    put(bytes, i, false);
  return bytes;
}

std::string gltf(const std::string& nodes, const std::string& uri, const std::string& more = "",
                 const std::string& indices = R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"})",
                 const std::string& primitive = R"("attributes":{"POSITION":0},"indices":1)") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"name":"square","primitives":[{)" + primitive + R"(}]}],)" + more +
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)" + indices +
         R"(],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)" +
         R"("buffers":[{"byteLength":60,"uri":")" + uri + R"("}]})";
}
std::string data_uri() { return "data:application/octet-stream;base64," + base64(square_bytes()); }

TEST(Gltf, ReadsNodesMeshesAndMaterials) {
  Folders folders;
  Model model = parse_gltf(
      "a.gltf",
      gltf(
          R"([{"children":[1,2],"translation":[1,0,0]},{"mesh":0,"name":"left","scale":[2,2,2]},{"mesh":0,"rotation":[0,0,0.70710678,0.70710678]}])",
          data_uri(),
          R"("materials":[{"name":"gold","pbrMetallicRoughness":{"baseColorFactor":[1,0.8,0.3,0.5],"metallicFactor":0.9,"roughnessFactor":0.2},"emissiveFactor":[0,0,1],"alphaMode":"BLEND","extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},"KHR_materials_ior":{"ior":1.7},"KHR_materials_transmission":{"transmissionFactor":0.25}}}],)",
          R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"})",
          R"("attributes":{"POSITION":0},"indices":1,"material":0)"),
      folders);
  ASSERT_EQ(model.error, "");
  ASSERT_EQ(model.objects.size(), 2u);
  EXPECT_EQ(model.objects[0].name, "left");
  EXPECT_EQ(model.objects[1].name, "square");
  EXPECT_EQ(model.objects[0].mesh, model.objects[1].mesh); // kept once
  EXPECT_EQ(model.objects[0].mesh->triangles.size(), 2u);
  EXPECT_EQ(Vec3(model.objects[0].to_world * Vec4(1, 1, 0, 1)), Vec3(3, 2, 0));
  EXPECT_LT(glm::distance(Vec3(model.objects[1].to_world * Vec4(1, 0, 0, 1)), Vec3(1, 1, 0)), 1e-6f);
  const Material& m = model.materials[model.objects[0].materials[0]];
  EXPECT_EQ(m.name, "gold");
  EXPECT_EQ(m.values[size_t(Slot::Color)], Vec3(1, 0.8f, 0.3f));
  EXPECT_EQ(m.values[size_t(Slot::Metallic)], Vec3(0.9f));
  EXPECT_EQ(m.values[size_t(Slot::Roughness)], Vec3(0.2f));
  EXPECT_EQ(m.values[size_t(Slot::Emission)], Vec3(0, 0, 4));
  EXPECT_EQ(m.values[size_t(Slot::Ior)], Vec3(1.7f));
  EXPECT_EQ(m.values[size_t(Slot::Transmission)], Vec3(0.25f));
  EXPECT_EQ(m.values[size_t(Slot::Opacity)], Vec3(0.5f));
}

TEST(Gltf, ReadsBinariesAndBuffersBesideTheFile) {
  TemporaryFolder folder;
  folder.write("square.bin", square_bytes());
  std::string path = folder.write("a.gltf", gltf(R"([{"mesh":0}])", "square.bin"));
  SceneReading bare = read_scene(path);
  ASSERT_TRUE(bare.scene) << bare.error;
  EXPECT_THAT(bare.scene->files, ElementsAre(folder / "square.bin")); // part of what the picture is made of
  EXPECT_THAT(read_scene(folder.write("b.gltf", gltf(R"([{"mesh":0}])", "../square.bin"))).error,
              HasSubstr("square.bin"));
  EXPECT_THAT(read_scene(folder.write("b.gltf", gltf(R"([{"mesh":0}])", "none.bin"))).error, HasSubstr("none.bin"));
  EXPECT_THAT(read_scene(folder.write("b.gltf", gltf(R"([{"mesh":0}])", "/etc/passwd"))).error, HasSubstr("b.gltf: "));
  std::string json = gltf(R"([{"mesh":0}])", "x");
  json.replace(json.find(R"(,"uri":"x")"), 10, "");
  while (json.size() % 4)
    json += ' ';
  std::string bytes = square_bytes(), glb = "glTF";
  for (uint32_t word : {2u, uint32_t(12 + 8 + json.size() + 8 + bytes.size()), uint32_t(json.size()), 0x4E4F534Au})
    put(glb, word, false);
  glb += json;
  put(glb, uint32_t(bytes.size()), false), put(glb, uint32_t(0x004E4942), false);
  glb += bytes;
  Model model = parse_gltf("a.glb", glb, Folders());
  EXPECT_EQ(mesh_of(model).triangles.size(), 2u);
  for (size_t length = 4; length < glb.size(); ++length)
    EXPECT_NE(parse_gltf("a.glb", glb.substr(0, length), Folders()).error, "") << length;
}

TEST(Gltf, RefusesWhatReachesBeyondTheFile) {
  Folders folders;
  auto error = [&](const std::string& text) { return parse_gltf("a.gltf", text, folders).error; };
  auto indices = [&](const std::string& accessor) { return error(gltf(R"([{"mesh":0}])", data_uri(), "", accessor)); };
  EXPECT_THAT(indices(R"({"bufferView":1,"componentType":5123,"count":7,"type":"SCALAR"})"),
              HasSubstr("mesh 0, primitive 0: indices reaches beyond its buffer"));
  EXPECT_THAT(indices(R"({"bufferView":1,"byteOffset":4294967295,"componentType":5123,"count":6,"type":"SCALAR"})"),
              HasSubstr("a.gltf: "));
  EXPECT_THAT(indices(R"({"bufferView":9,"componentType":5123,"count":6,"type":"SCALAR"})"),
              HasSubstr("a.gltf: accessor[1] invalid bufferView"));
  EXPECT_THAT(indices(R"({"bufferView":0,"byteOffset":6,"componentType":5123,"count":6,"type":"SCALAR"})"),
              HasSubstr("mesh 0, primitive 0: the face names vertex 16256 of 4")); // floats as indices
  EXPECT_THAT(indices(R"({"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"})"),
              HasSubstr("are no unsigned integers"));
  for (const char* type : {"5120", "5122", "5124", "5130"}) // signed, and double
    EXPECT_NE(indices(R"({"bufferView":1,"componentType":)" + std::string(type) + R"(,"count":1,"type":"SCALAR"})"),
              "");
  EXPECT_THAT(error(gltf(R"([{"mesh":3}])", data_uri())), HasSubstr("the mesh of node 0 is missing"));
  EXPECT_THAT(error(gltf(R"([{"mesh":0,"children":[0]}])", data_uri())),
              HasSubstr("node 0 has two parents, or is its own"));
  EXPECT_THAT(error(gltf(R"([{"children":[7]}])", data_uri())), HasSubstr("node 7 is missing"));
  EXPECT_THAT(error(gltf(R"([{"mesh":0,"scale":[1e300,1,1]}])", data_uri())), HasSubstr("its place is not finite"));
  EXPECT_THAT(error(gltf(R"([{"mesh":0,"scale":[0,1,1]}])", data_uri())), HasSubstr("has no triangles"));
  EXPECT_THAT(error("{"), HasSubstr("a.gltf: "));
  EXPECT_THAT(error(""), HasSubstr("a.gltf: "));
  EXPECT_THAT(error(std::string(100000, '[')), HasSubstr("a.gltf: "));
}

TEST(Gltf, BoundsWhatSharedElementsComeTo) {
  // A hundred primitives that read the same ten million zeros.
  std::string primitives = R"({"attributes":{"POSITION":0},"indices":1})";
  for (int k = 1; k < 100; ++k)
    primitives += R"(,{"attributes":{"POSITION":0},"indices":1})";
  const std::string text =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitives +
      R"(]}],"accessors":[{"componentType":5126,"count":9999999,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}},)"
      R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
      R"("buffers":[{"byteLength":60,"uri":")" +
      data_uri() + R"("}]})";
  EXPECT_EQ(parse_gltf("a.gltf", text, Folders()).error,
            "a.gltf: mesh 0, primitive 3: the primitives come to too many elements for the size of the file");
}

TEST(Gltf, SurvivesDamage) {
  std::string text = gltf(R"([{"mesh":0,"translation":[1,2,3]}])", data_uri(), R"("materials":[{"name":"m"}],)");
  for (uint32_t seed = 0; seed < 2000; ++seed) {
    std::string damaged = text;
    for (uint32_t k = 0; k < 1 + seed % 3; ++k) {
      char& c = damaged[hash_combine(seed, k) % damaged.size()];
      c = std::isdigit((unsigned char)c) ? char('0' + hash_combine(seed, k + 100) % 10)
                                         : char(32 + hash_combine(seed, k + 200) % 95);
    }
    Model model = parse_gltf("a.gltf", damaged, Folders());
    EXPECT_TRUE(model.error.empty() != model.objects.empty());
  }
}

} // namespace
} // namespace moonshade::renderer
