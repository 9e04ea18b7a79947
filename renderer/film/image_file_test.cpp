#include "renderer/film/image_file.h"

#include "renderer/test_support.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <unistd.h>

namespace moonshade::renderer {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

const Picture kPicture{2, 2, {Vec3(0), Vec3(0.5f), Vec3(3), Vec3(0.25f, 0.5f, 1)}};
const ImageMetadata kMetadata{"moonshade test", "scene.lua", 7, 16, 1.5, true, 0};

size_t files_in(const TemporaryFolder& folder) {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / ""))
    ++count;
  return count;
}

std::vector<float> read(const std::string& path, OIIO::ImageSpec& spec) {
  auto input = OIIO::ImageInput::open(path);
  if (!input) return {};
  spec = input->spec();
  std::vector<float> pixels(size_t(spec.width * spec.height * spec.nchannels));
  input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data());
  return pixels;
}

TEST(ImageFile, WritesEveryFormatWithMetadata) {
  TemporaryFolder folder;
  for (const char* ending : {"png", "exr", "jpg", "tif", "hdr"}) {
    std::string path = folder / ("a." + std::string(ending));
    ImageFile file;
    ASSERT_EQ(file.open(path), "");
    EXPECT_FALSE(std::filesystem::exists(path)); // not before it is whole
    ASSERT_EQ(file.write(kPicture, {}, kMetadata), "") << ending;
    OIIO::ImageSpec spec;
    std::vector<float> pixels = read(path, spec);
    ASSERT_EQ(pixels.size(), 12u) << ending;
    if (std::string(ending) == "hdr") continue; // has no text fields
    std::string description = spec.get_string_attribute("ImageDescription");
    EXPECT_THAT(description, HasSubstr("scene.lua")) << ending;
    EXPECT_THAT(description, HasSubstr("samples 16")) << ending;
    EXPECT_THAT(description, HasSubstr("interrupted")) << ending;
  }
  EXPECT_EQ(files_in(folder), 5u); // no temporary file is left
}

TEST(ImageFile, ExrHoldsTheFloatsUntouched) {
  TemporaryFolder folder;
  ImageFile file;
  ASSERT_EQ(file.open(folder / "a.exr"), "");
  ASSERT_EQ(file.write(kPicture, {5, Tonemap::Filmic}, kMetadata), "");
  OIIO::ImageSpec spec;
  std::vector<float> pixels = read(folder / "a.exr", spec);
  EXPECT_EQ(pixels[6], 3.0f);
  EXPECT_EQ(pixels[9], 0.25f);
}

TEST(ImageFile, PngIsClippedAndEncoded) {
  TemporaryFolder folder;
  ImageFile file;
  ASSERT_EQ(file.open(folder / "a.png"), "");
  ASSERT_EQ(file.write(kPicture, {}, kMetadata), "");
  OIIO::ImageSpec spec;
  std::vector<float> pixels = read(folder / "a.png", spec);
  EXPECT_EQ(pixels[0], 0.0f);
  EXPECT_NEAR(pixels[3], srgb_encode(0.5f), 1.01f / 255); // dithered by up to a level
  EXPECT_EQ(pixels[6], 1.0f);
}

TEST(ImageFile, ExposureBrightensByStops) {
  EXPECT_EQ(display_value(Vec3(0.125f), {2, Tonemap::None}), Vec3(0.5f));
  EXPECT_EQ(display_value(Vec3(-1, 2, 1e30f), {}), Vec3(0, 1, 1));
  EXPECT_LE(display_value(Vec3(1e30f), {0, Tonemap::Filmic}).x, 1.0f);
}

TEST(ImageFile, DitherKeepsTheMean) {
  TemporaryFolder folder;
  Picture grey{64, 64, std::vector<Vec3>(64 * 64, Vec3(0.2f))};
  ImageFile file;
  ASSERT_EQ(file.open(folder / "a.png"), "");
  ASSERT_EQ(file.write(grey, {}, kMetadata), "");
  OIIO::ImageSpec spec;
  double sum = 0;
  for (float v : read(folder / "a.png", spec))
    sum += v;
  EXPECT_NEAR(sum / (64 * 64 * 3), srgb_encode(0.2f), 0.1 / 255);
}

TEST(ImageFile, RefusesPlacesThatCannotBeWrittenBeforeTheWork) {
  TemporaryFolder folder;
  ImageFile a, b, c;
  EXPECT_THAT(a.open(folder / "a.bmp"), HasSubstr("the ending is none of"));
  EXPECT_THAT(b.open(folder / "none/a.png"), HasSubstr("No such file"));
  std::filesystem::create_directory(folder / "d.png");
  EXPECT_THAT(c.open(folder / "d.png"), HasSubstr("is a folder"));
  if (::geteuid() != 0) {
    std::filesystem::create_directory(folder / "locked");
    std::filesystem::permissions(folder / "locked", std::filesystem::perms::owner_read);
    ImageFile d;
    EXPECT_THAT(d.open(folder / "locked/a.png"), HasSubstr("Permission denied"));
  }
}

TEST(ImageFile, KeepsTheOldFileAndLeavesNothingWhereNothingIsWritten) {
  TemporaryFolder folder;
  folder.write("a.png", "old");
  {
    ImageFile file;
    ASSERT_EQ(file.open(folder / "a.png"), "");
    EXPECT_EQ(files_in(folder), 2u);
  }
  EXPECT_EQ(files_in(folder), 1u);
  EXPECT_EQ(read_file(folder / "a.png").text, "old");
}

} // namespace
} // namespace moonshade::renderer
