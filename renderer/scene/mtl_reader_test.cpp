#include "renderer/scene/mtl_reader.h"

#include "renderer/test_support.h"

#include <gmock/gmock.h>

namespace moonshade::renderer {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

class MtlReader : public ::testing::Test {
protected:
  MtlReader() {
    for (const char* name : {"a.lua", "b.lua", "with blank.lua", "sub/c.lua"})
      folder_.write(name, "");
  }
  MtlReading parse(const std::string& text) { return parse_mtl(folder_ / "m.mtl", text, folder_.folders()); }
  TemporaryFolder folder_;
};

TEST_F(MtlReader, KnowsBothSpellingsOfTheShaderStatements) {
  for (const char* separator : {"_", " "}) {
    std::string s = separator;
    MtlReading mtl = parse("newmtl m\r\ntexture" + s + "shader a.lua\r\n\tbump" + s + "shader  b.lua  \r\nreflect" + s +
                           "shader sub/c.lua\r\n");
    ASSERT_EQ(mtl.error, "");
    EXPECT_TRUE(mtl.warnings.empty());
    EXPECT_EQ(mtl.materials[0].shaders[size_t(Slot::Color)], folder_ / "a.lua");
    EXPECT_EQ(mtl.materials[0].height_shader, folder_ / "b.lua");
    EXPECT_EQ(mtl.materials[0].shaders[size_t(Slot::Reflectance)], folder_ / "sub/c.lua");
  }
}

TEST_F(MtlReader, ReportsShaderStatementsThatNameNothingOrAreUnknown) {
  EXPECT_THAT(parse("newmtl m\ntexture shader\n").error, HasSubstr("m.mtl:2: texture shader names no file"));
  MtlReading mtl = parse("newmtl m\nTexture_Shader a.lua\nbumps shader b.lua\n");
  ASSERT_EQ(mtl.warnings.size(), 2u);
  EXPECT_THAT(mtl.warnings[0], HasSubstr("m.mtl:2: unknown statement 'Texture_Shader'"));
}

TEST_F(MtlReader, CutsCommentsBehindShaderNames) {
  EXPECT_EQ(parse("newmtl m\ntexture_shader a.lua # copper\n").materials[0].shaders[0], folder_ / "a.lua");
}

TEST_F(MtlReader, TakesNamesWithBlanksAndBackslashes) {
  EXPECT_EQ(parse("newmtl m\ntexture_shader with blank.lua\n").materials[0].shaders[0], folder_ / "with blank.lua");
  EXPECT_EQ(parse("newmtl m\ntexture_shader sub\\c.lua\n").materials[0].shaders[0], folder_ / "sub/c.lua");
}

TEST_F(MtlReader, RefusesShadersThatItCannotOpen) {
  EXPECT_EQ(parse("newmtl m\n\nbump_shader none.lua\n").error,
            folder_ / "m.mtl:3: bump_shader: there is no file 'none.lua'");
  EXPECT_THAT(parse("newmtl m\ntexture_shader /etc/passwd\n").error,
              HasSubstr("m.mtl:2: texture_shader: '/etc/passwd' lies outside"));
  EXPECT_THAT(parse("newmtl m\nreflect shader ../../etc/passwd\n").error, HasSubstr("lies outside the folders"));
  EXPECT_EQ(parse("newmtl m\ntexture_shader\n").error, folder_ / "m.mtl:2: texture_shader names no file");
}

TEST_F(MtlReader, BumpImagesAreNoShaders) {
  MtlReading mtl = parse("newmtl m\nbump rock.png\nmap_Ks rock.png\nmap_Ka rock.png\n");
  EXPECT_EQ(mtl.error, "");
  EXPECT_EQ(mtl.materials[0].height_shader, "");
  ASSERT_EQ(mtl.warnings.size(), 2u);
  EXPECT_THAT(mtl.warnings[0], HasSubstr("m.mtl:2: 'bump': there is no file 'rock.png'"));
}

TEST_F(MtlReader, ReadsTheCommonNumbers) {
  MtlReading mtl =
      parse("newmtl a b\nKd 0.1 0.2 0.3\nKs 0 0 0\nNs 6\nKe 2\nnewmtl other\nPr 0.25\nPm 1\nNi 1.3\nd 0.5\nKd x y z\n");
  ASSERT_EQ(mtl.materials.size(), 2u);
  const Material &first = mtl.materials[0], &second = mtl.materials[1];
  EXPECT_EQ(first.name, "a b");
  EXPECT_EQ(first.values[size_t(Slot::Color)], Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(first.values[size_t(Slot::Ior)], Vec3(1));
  EXPECT_FLOAT_EQ(first.values[size_t(Slot::Roughness)]->x, std::sqrt(std::sqrt(0.25f)));
  EXPECT_EQ(first.values[size_t(Slot::Emission)], Vec3(2));
  EXPECT_EQ(second.values[size_t(Slot::Roughness)]->x, 0.25f);
  EXPECT_EQ(second.values[size_t(Slot::Metallic)]->x, 1.0f);
  EXPECT_EQ(second.values[size_t(Slot::Ior)]->x, 1.3f);
  EXPECT_EQ(second.values[size_t(Slot::Opacity)], Vec3(0.5f));
  ASSERT_EQ(mtl.warnings.size(), 1u);
  EXPECT_THAT(mtl.warnings[0], HasSubstr("m.mtl:11: no colour"));
}

TEST_F(MtlReader, BelievesTheNewerStatementOfTwo) {
  MtlReading mtl = parse("newmtl a\nPr 0.25\nNs 6\nTr 1\nd 0.75\nnewmtl b\nTr 0.25\nnewmtl c\n");
  ASSERT_EQ(mtl.materials.size(), 3u);
  EXPECT_EQ(mtl.materials[0].values[size_t(Slot::Roughness)], Vec3(0.25f)); // Pr, whatever Ns says
  EXPECT_EQ(mtl.materials[0].values[size_t(Slot::Opacity)], Vec3(0.75f));   // d, whatever Tr says
  EXPECT_EQ(mtl.materials[1].values[size_t(Slot::Opacity)], Vec3(0.75f));
  EXPECT_FALSE(mtl.materials[1].values[size_t(Slot::Roughness)]);
  EXPECT_FALSE(mtl.materials[2].values[size_t(Slot::Opacity)]);
}

TEST_F(MtlReader, SurvivesWhatIsNoMaterialFile) {
  EXPECT_THAT(parse(std::string("newmtl m\n\0\0\n", 12)).error, HasSubstr("m.mtl:2: a zero byte"));
  EXPECT_THAT(parse("Kd 1 1 1\n").warnings[0], HasSubstr("before the first newmtl"));
  EXPECT_EQ(parse("").error, "");
}

} // namespace
} // namespace moonshade::renderer
