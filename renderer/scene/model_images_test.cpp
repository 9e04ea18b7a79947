// Images that models name: from the file to the slot, and to the picture.
#include "renderer/checkpoint/identity.h"
#include "renderer/scene/gltf_reader.h"
#include "renderer/scene/read_scene.h"
#include "renderer/test_support.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using testing::base64;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// A square that the camera of picture_of() sees exactly, with the image upright on it.
const std::string kSquare = "mtllib m.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                            "vt 0 1\nf 1/1 2/2 3/3 4/4\n";
constexpr uint8_t kHalf = 188; // decoded from sRGB 0.503

class ModelImages : public ::testing::Test {
protected:
  ModelImages() : shaders_(runtime_shaders({.folders = {folder_ / ""}})) {}

  /// Of bytes, rows from the top.
  std::string write(const std::string& name, int width, int height, int channels, const std::vector<uint8_t>& bytes) {
    std::string path = folder_.write(name, "");
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeUInt8);
    spec["oiio:UnassociatedAlpha"] = 1;
    auto output = OIIO::ImageOutput::create(path);
    EXPECT_TRUE(output && output->open(path, spec) && output->write_image(OIIO::TypeUInt8, bytes.data()) &&
                output->close());
    return path;
  }
  void write_corners(const std::string& name) {
    write(name, 2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}); // red, green; blue, white
  }
  void read(const std::string& path) {
    SceneReading reading = read_scene(path);
    warnings_ = std::move(reading.warnings);
    ASSERT_TRUE(reading.scene) << reading.error;
    files_ = reading.scene->files;
    Preparation preparation = prepare(std::move(*reading.scene), *shaders_);
    ASSERT_TRUE(preparation.prepared) << preparation.error;
    prepared_ = std::move(preparation.prepared);
    prepare_warnings_ = preparation.warnings;
  }
  /// The square with this material.
  void read_mtl(const std::string& statements) {
    folder_.write("m.mtl", "newmtl m\n" + statements);
    read(folder_.write("m.obj", kSquare));
  }
  /// The last material's.
  Vec3 slot(Slot slot, float u, float v) const {
    const CompiledMaterial& material = prepared_->materials[prepared_->materials.size() - 1];
    if (!material.calls[size_t(slot)]) return material.constants[size_t(slot)];
    ShadingBatch batch(1, 0, 0);
    batch.inputs[kUv][0] = u, batch.inputs[kUv + 1][0] = v;
    FaultLog faults;
    prepared_->materials.shade(material, batch, 0, 1, faults);
    EXPECT_TRUE(faults.empty());
    Vec3 value(0);
    for (unsigned c = 0; c < 3; ++c)
      value[int(c)] =
          batch.results[kResultOffset[size_t(slot)] + (slot_infos()[size_t(slot)].components == 3 ? c : 0)][0];
    return value;
  }
  Picture picture_of(const std::string& model) {
    read(folder_.write("scene.lua", "camera{ type = 'orthographic', from = {0, 0, 3}, to = {0, 0, 0}, height = 2 }\n"
                                    "render{ width = 8, height = 8, samples = 4 }\n" +
                                        model));
    RenderProgress progress;
    return prepared_ ? render(*prepared_, {}, progress).picture : Picture{};
  }

  /// What is seen in the middle of the square's left upper quarter, of which the model m.obj or m.gltf is made.
  Vec3 normal_of(const std::string& model) {
    read(folder_.write("scene.lua", "camera{ type = 'orthographic', from = {0, 0, 3}, to = {0, 0, 0}, height = 2 }\n"
                                    "render{ width = 8, height = 8, samples = 4 }\n" +
                                        model));
    RenderProgress progress;
    RenderOptions options;
    options.contents.first = true;
    return prepared_ ? glm::normalize(Vec3(render(*prepared_, options, progress).film->first(18).normal)) : Vec3(0);
  }
  Vec3 normal_of_mtl(const std::string& statements, const std::string& place = "") {
    folder_.write("m.mtl", "newmtl m\n" + statements);
    folder_.write("m.obj", kSquare);
    return normal_of("obj{ file = 'm.obj'" + place + " }");
  }

  TemporaryFolder folder_;
  std::unique_ptr<ShaderSource> shaders_;
  std::unique_ptr<PreparedScene> prepared_;
  std::vector<std::string> warnings_, files_;
  std::string prepare_warnings_;
};

void expect_near(const Vec3& actual, const Vec3& expected, float error = 0.003f) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], error) << "component " << c;
}

/// In the middles of the quarters of the picture: red, green; blue, white; each with 0.11 of its two neighbours (the
/// image repeats) and 0.016 of the third.
void expect_corners(const Picture& picture) {
  ASSERT_EQ(picture.pixels.size(), 64u);
  auto at = [&](size_t x, size_t y) { return picture.pixels[y * 8 + x]; };
  expect_near(at(1, 1), Vec3(0.78f, 0.125f, 0.125f), 0.05f);
  expect_near(at(6, 1), Vec3(0.22f, 0.875f, 0.125f), 0.05f);
  expect_near(at(1, 6), Vec3(0.22f, 0.125f, 0.875f), 0.05f);
  expect_near(at(6, 6), Vec3(0.78f, 0.875f, 0.875f), 0.05f);
}

TEST_F(ModelImages, OfMtlStandUprightInThePicture) {
  write_corners("corners.png");
  folder_.write("m.mtl", "newmtl m\nKd 0 0 0\nKs 0 0 0\nmap_Ke corners.png\n");
  folder_.write("m.obj", kSquare);
  expect_corners(picture_of("obj{ file = 'm.obj' }"));
}

TEST_F(ModelImages, OfMtlAreMultipliedByTheNumberBesideThem) {
  write("grey.png", 1, 1, 3, {kHalf, kHalf, kHalf});
  read_mtl(
      "map_Kd grey.png\nKd 1 0.5 0.1\nmap_Ke grey.png\nKe 0 0 0\nmap_Pr grey.png\nNs 10\nPm 0.5\nmap_Pm grey.png\n");
  EXPECT_TRUE(warnings_.empty() && prepare_warnings_.empty());
  expect_near(slot(Slot::Color, 0.3f, 0.6f), Vec3(0.503f, 0.2514f, 0.0503f));
  expect_near(slot(Slot::Emission, 0, 0), Vec3(0.503f));          // zeros beside an image count as none
  expect_near(slot(Slot::Roughness, 0, 0), Vec3(kHalf / 255.0f)); // no colour, and Ns is no factor of it
  expect_near(slot(Slot::Metallic, 0, 0), Vec3(0.5f * kHalf / 255.0f));
  read_mtl("Pr 0.5\nNs 10\nmap_Pr grey.png\nmap_Kd grey.png\n");
  expect_near(slot(Slot::Roughness, 0, 0), Vec3(0.5f * kHalf / 255.0f));
  expect_near(slot(Slot::Color, 0, 0), Vec3(0.503f));
}

TEST_F(ModelImages, OfMtlAreScaledAndMovedByTheirOptions) {
  write_corners("two words.png");
  read_mtl("map_Kd -clamp on -bm 0.2 -s 2 0.5 1 -o 0.5 0 -mm 0 1 -texres 64 two words.png # upright\n");
  EXPECT_TRUE(warnings_.empty() && prepare_warnings_.empty());
  expect_near(slot(Slot::Color, 0.375f, 0.5f), Vec3(0, 0, 1)); // at (1.25, 0.25)
  expect_near(slot(Slot::Color, 0.625f, 1.5f), Vec3(0, 1, 0)); // at (1.75, 0.75)
  read_mtl("map_Kd -s 2 two words.png\n");
  expect_near(slot(Slot::Color, 0.125f, 0.75f), Vec3(1, 0, 0)); // at (0.25, 0.75)
}

TEST_F(ModelImages, OfMtlGiveOpacityByAlphaOrElseByGrey) {
  write("cut.png", 2, 1, 4, {255, 255, 255, 255, 255, 255, 255, 51});
  write("mask.png", 2, 1, 1, {255, 51});
  for (const char* name : {"cut.png", "mask.png"}) {
    read_mtl("map_d " + std::string(name) + "\n");
    expect_near(slot(Slot::Opacity, 0.25f, 0.5f), Vec3(1));
    expect_near(slot(Slot::Opacity, 0.75f, 0.5f), Vec3(0.2f));
    EXPECT_TRUE(prepared_->materials.any_passable());
  }
  read_mtl("d 0.5\nmap_d mask.png\n");
  expect_near(slot(Slot::Opacity, 0.75f, 0.5f), Vec3(0.1f));
}

TEST_F(ModelImages, AreFoundUnderNamesFromOtherMachines) {
  write("wood grain.png", 1, 1, 3, {255, 0, 0});
  write("deep/stone.png", 1, 1, 3, {255, 0, 0});
  for (const char* name : {"wood grain.png", "C:\\models\\table\\wood grain.png", "/home/her/wood grain.png",
                           "deep\\stone.png", "./deep/stone.png"}) {
    read_mtl("map_Kd " + std::string(name) + "\n");
    EXPECT_TRUE(warnings_.empty() && prepare_warnings_.empty()) << name;
    expect_near(slot(Slot::Color, 0, 0), Vec3(1, 0, 0));
  }
}

TEST_F(ModelImages, OfMtlThatAreNotThereLeaveThePlainColour) {
  folder_.write("sub/x.txt", "");
  for (const char* name : {"none.png", "../../etc/passwd", "../../../../../../etc/passwd", "/etc/passwd", "sub",
                           "-s 1 1 1", "-o", "-clamp"}) {
    read_mtl("Kd 0.25 0.5 0.75\nmap_Kd " + std::string(name) + "\n");
    ASSERT_EQ(warnings_.size(), 1u) << name;
    EXPECT_THAT(warnings_[0], HasSubstr("m.mtl:3: 'map_Kd'")) << name;
    expect_near(slot(Slot::Color, 0, 0), Vec3(0.25f, 0.5f, 0.75f));
  }
  read_mtl("map_Kd ../../etc/passwd\n");
  EXPECT_EQ(warnings_[0], folder_ / "m.mtl:2: 'map_Kd': '../../etc/passwd' lies outside the folders that may be read; "
                                    "drawn without this image");
}

TEST_F(ModelImages, ThatCannotBeReadLeaveThePlainColour) {
  folder_.write("broken.png", "\x89PNG\r\n\x1a\nbroken");
  folder_.write("strange.dds", "DDS");
  folder_.write("lies.png", "<svg/>");
  for (const char* name : {"broken.png", "strange.dds", "lies.png"}) {
    read_mtl("Kd 0.25 0.5 0.75\nmap_Kd " + std::string(name) + "\nKe 1 1 1\nmap_Ke " + name + "\n");
    EXPECT_TRUE(warnings_.empty());
    EXPECT_THAT(prepare_warnings_, HasSubstr("m.mtl:3: warning: the image '" + std::string(name) + "' is not shown: "));
    expect_near(slot(Slot::Color, 0, 0), Vec3(0.25f, 0.5f, 0.75f));
    expect_near(slot(Slot::Emission, 0, 0), Vec3(0)); // and not a lamp
  }
  EXPECT_EQ(picture_of("obj{ file = 'm.obj' }").pixels.size(), 64u);
}

TEST_F(ModelImages, ArePartOfWhatAPictureIsMadeOf) {
  write("grey.png", 1, 1, 1, {kHalf});
  read_mtl("map_Kd grey.png\n");
  EXPECT_THAT(files_, Contains(folder_ / "grey.png"));
  RecordingShaders recording(*shaders_);
  SceneReading reading = read_scene(folder_ / "m.obj");
  ASSERT_TRUE(prepare(std::move(*reading.scene), recording).prepared);
  EXPECT_THAT(recording.files(), ElementsAre(folder_ / "grey.png"));
}

// Bumps ---------------------------------------------------------------------------------------------------------------

TEST_F(ModelImages, OfMtlThatAreGreyBendTheNormalAsHeights) {
  std::vector<uint8_t> ramp, upwards;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      ramp.push_back(uint8_t(4 * x)), upwards.push_back(uint8_t(4 * (63 - y)));
  write("ramp.png", 64, 64, 1, ramp);
  write("upwards.png", 64, 64, 1, upwards);
  // White stands out by 0.02 · 25 of the image's width.
  const float slope = 0.5f * 256 / 255;
  for (const char* key : {"map_Bump", "map_bump", "bump", "BUMP"})
    expect_near(normal_of_mtl(std::string(key) + " -bm 25 ramp.png\n"), glm::normalize(Vec3(-slope, 0, 1)), 1e-3f);
  EXPECT_TRUE(warnings_.empty() && prepare_warnings_.empty());
  expect_near(normal_of_mtl("bump -bm 25 upwards.png\n"), glm::normalize(Vec3(0, -slope, 1)), 1e-3f);
  expect_near(normal_of_mtl("bump -bm -25 ramp.png\n"), glm::normalize(Vec3(slope, 0, 1)), 1e-3f);
  expect_near(normal_of_mtl("bump -bm 25 -s -1 1 1 ramp.png\n"), glm::normalize(Vec3(slope, 0, 1)), 1e-3f);
  // It looks the same in whatever size, but for how often it is repeated.
  expect_near(normal_of_mtl("bump -bm 25 ramp.png\n", ", scale = 3"), glm::normalize(Vec3(-slope, 0, 1)), 1e-3f);
  expect_near(normal_of_mtl("bump -bm 25 -s 0.5 0.5 1 ramp.png\n"), glm::normalize(Vec3(-slope, 0, 1)), 1e-3f);
}

TEST_F(ModelImages, OfNormalsBendTheNormal) {
  write("normals.png", 1, 1, 3, {204, 102, 230});
  write("inward.png", 1, 1, 3, {128, 255, 0});
  const Vec3 stated = Vec3(204, 102, 230) * (2 / 255.0f) - Vec3(1);
  expect_near(normal_of_mtl("norm normals.png\n"), glm::normalize(stated), 1e-3f);
  write("blue.png", 1, 1, 3, {153, 102, 230});
  expect_near(normal_of_mtl("map_Bump blue.png\n"), glm::normalize(Vec3(153, 102, 230) * (2 / 255.0f) - Vec3(1)),
              1e-3f);
  expect_near(normal_of_mtl("norm -bm 0.5 normals.png\n"), glm::normalize(stated * Vec3(0.5f, 0.5f, 1)), 1e-3f);
  expect_near(normal_of_mtl("norm normals.png\nbump inward.png\n"), glm::normalize(stated), 1e-3f);
  expect_near(normal_of_mtl("norm normals.png\n", ", scale = {3, 3, 3}, rotate = {0, 0, 90}"),
              glm::normalize(Vec3(-stated.y, stated.x, stated.z)), 1e-3f);
  const Vec3 steep = normal_of_mtl("norm inward.png\n");
  EXPECT_TRUE(steep.y > 0.9f && steep.z > 0) << steep.y << " " << steep.z;
}

TEST_F(ModelImages, OfBumpsGiveWayToShadersAndMayBeMissing) {
  write("normals.png", 1, 1, 3, {204, 102, 230});
  folder_.write("flat.lua", "function height(p) return 0 * p.x end\n");
  expect_near(normal_of_mtl("norm normals.png\nbump_shader flat.lua\n"), Vec3(0, 0, 1));
  expect_near(normal_of_mtl("bump none.png\n"), Vec3(0, 0, 1));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("m.mtl:2: 'bump': "));
  folder_.write("broken.png", "\x89PNG\r\n\x1a\nbroken");
  expect_near(normal_of_mtl("norm broken.png\n"), Vec3(0, 0, 1));
  EXPECT_THAT(prepare_warnings_, HasSubstr("m.mtl:2: warning: the image 'broken.png' is not shown: "));
}

// glTF
// ------------------------------------------------------------------------------------------------------------------

std::string bytes_of(const std::string& path) { return read_file(path).text; }

/// The same square; `materials` are the fields of its material, `more` further members of the file.
std::string gltf(const std::string& material, const std::string& more, const std::string& image_bytes = "") {
  std::string bytes;
  for (float f : {-1.f, -1.f, 0.f, 1.f, -1.f, 0.f, 1.f, 1.f, 0.f, -1.f, 1.f, 0.f, // positions
                  0.f,  1.f,  1.f, 1.f, 1.f,  0.f, 0.f, 0.f})                     // v points down
    bytes.append(reinterpret_cast<const char*>(&f), sizeof f);
  for (uint16_t i : {0, 1, 2, 0, 2, 3})
    bytes.append(reinterpret_cast<const char*>(&i), sizeof i);
  bytes += image_bytes;
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":)"
         R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],"materials":[{"name":"m",)" +
         material + "}]," + more +
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
         R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":48},)"
         R"({"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12},)"
         R"({"buffer":0,"byteOffset":92,"byteLength":)" +
         std::to_string(image_bytes.size()) + R"(}],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + R"("}]})";
}
std::string image(const std::string& fields) { return R"("textures":[{"source":0}],"images":[{)" + fields + "}],"; }

TEST_F(ModelImages, OfGltfStandUprightFromFilesAndFromWithin) {
  write_corners("the corners.png");
  const std::string bytes = bytes_of(folder_ / "the corners.png");
  for (const std::string& where :
       {std::string(R"("uri":"the%20corners.png")"), std::string(R"("uri":"the corners.png")"),
        R"("uri":"data:image/png;base64,)" + base64(bytes) + "\"",
        std::string(R"("bufferView":3,"mimeType":"image/png")")}) {
    folder_.write("m.gltf", gltf(R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":0},)"
                                 R"("pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0},)"
                                 R"("extensions":{"KHR_materials_ior":{"ior":1}})",
                                 image(where), bytes));
    expect_corners(picture_of("gltf{ file = 'm.gltf' }"));
    EXPECT_TRUE(warnings_.empty() && prepare_warnings_.empty()) << where << prepare_warnings_;
  }
}

TEST_F(ModelImages, OfGltfGiveEachSlotItsPart) {
  write("parts.png", 2, 1, 4, {kHalf, 51, 102, 255, kHalf, 51, 102, 51});
  const std::string texture = R"({"index":0})", file = image(R"("uri":"parts.png")");
  auto material = [&](const std::string& more) {
    return R"("pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,0.8],"baseColorTexture":)" + texture +
           R"(,"metallicRoughnessTexture":)" + texture + R"(,"roughnessFactor":0.5})" + more;
  };
  read(folder_.write("m.gltf", gltf(material(""), file)));
  expect_near(slot(Slot::Color, 0.25f, 0.5f), Vec3(0.503f, 0.0166f, 0));
  expect_near(slot(Slot::Roughness, 0.25f, 0.5f), Vec3(0.1f)); // green, raw
  expect_near(slot(Slot::Metallic, 0.25f, 0.5f), Vec3(0.4f));  // blue, raw
  expect_near(slot(Slot::Opacity, 0.75f, 0.5f), Vec3(1));      // opaque unless the material says other
  read(folder_.write("m.gltf", gltf(material(R"(,"alphaMode":"BLEND")"), file)));
  expect_near(slot(Slot::Opacity, 0.25f, 0.5f), Vec3(0.8f));
  expect_near(slot(Slot::Opacity, 0.75f, 0.5f), Vec3(0.16f));
  read(folder_.write("m.gltf", gltf(material(R"(,"alphaMode":"MASK","alphaCutoff":0.3)"), file)));
  expect_near(slot(Slot::Opacity, 0.25f, 0.5f), Vec3(1));
  expect_near(slot(Slot::Opacity, 0.75f, 0.5f), Vec3(0));
}

TEST_F(ModelImages, OfGltfAreTransformedWithVPointingDown) {
  write_corners("corners.png");
  read(folder_.write("m.gltf", gltf(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
                                    R"({"KHR_texture_transform":{"offset":[0.5,0.25],"scale":[1,0.5]}}}})",
                                    image(R"("uri":"corners.png")"))));
  // (0, 0) at the top left of the file's coordinates is (0, 1) here, and leads to (0.5, 0.25) there.
  expect_near(slot(Slot::Color, 0.25f, 1), Vec3(0, 1, 0));
  expect_near(slot(Slot::Color, 0.25f, 0), Vec3(1)); // (0.75, 0.75)
}

TEST_F(ModelImages, OfGltfBendTheNormal) {
  write("normals.png", 1, 1, 3, {204, 102, 230});
  const Vec3 stated = Vec3(204, 102, 230) * (2 / 255.0f) - Vec3(1);
  for (const auto& [scale, factor] : {std::pair(R"(,"scale":0.5)", 0.5f), std::pair("", 1.0f)}) {
    folder_.write("m.gltf",
                  gltf(R"("normalTexture":{"index":0)" + std::string(scale) + "}", image(R"("uri":"normals.png")")));
    expect_near(normal_of("gltf{ file = 'm.gltf' }"), glm::normalize(stated * Vec3(factor, factor, 1)), 1e-3f);
    EXPECT_TRUE(warnings_.empty() && prepare_warnings_.empty());
  }
}

TEST_F(ModelImages, OfGltfThatAreNotThereLeaveThePlainColour) {
  folder_.write("sub/x.txt", "");
  const std::string texture = R"("pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1],"metallicFactor":0,)"
                              R"("baseColorTexture":{"index":0}})";
  for (const char* uri : {"none.png", "../../etc/passwd", "/etc/passwd", "sub", "..%2F..%2Fetc%2Fpasswd", "%", "a%0"}) {
    read(folder_.write("m.gltf", gltf(texture, image("\"uri\":\"" + std::string(uri) + "\""))));
    ASSERT_EQ(warnings_.size(), 1u) << uri;
    EXPECT_THAT(warnings_[0], HasSubstr("m.gltf: the material 'm': the image '")) << uri;
    EXPECT_THAT(warnings_[0], HasSubstr("of its color is not shown: ")) << uri;
    expect_near(slot(Slot::Color, 0, 0), Vec3(0.25f, 0.5f, 0.75f));
  }
  for (const std::string& more : {std::string(), std::string(R"("textures":[{}],)")}) {
    read(folder_.write("m.gltf", gltf(texture, more)));
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_THAT(warnings_[0], HasSubstr("the material 'm': the image of its color is not shown: "));
  }
  for (const char* where : {R"("bufferView":3,"mimeType":"image/png")", R"("uri":"data:image/png;base64,AAAA")"}) {
    read(folder_.write("m.gltf", gltf(texture, image(where), "\x89PNG broken")));
    EXPECT_THAT(prepare_warnings_, HasSubstr("m.gltf: warning: the image 'image 0' is not shown: "));
    expect_near(slot(Slot::Color, 0, 0), Vec3(0.25f, 0.5f, 0.75f));
  }
  write_corners("corners.png");
  read(folder_.write("m.gltf", gltf(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}},)"
                                    R"("normalTexture":{"index":3})",
                                    image(R"("uri":"corners.png")"))));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("texture coordinates of its own"),
                                     HasSubstr("of its normals is not shown: it is not there")));
}

} // namespace
} // namespace moonshade::renderer
