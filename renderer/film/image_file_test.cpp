#include "renderer/film/image_file.h"

#include "renderer/sampling/sampler.h"
#include "renderer/test_support.h"

#include <OpenImageIO/imageio.h>
#include <csignal>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

namespace moonshade::renderer {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

const Picture kPicture{2, 2, {Vec3(0), Vec3(0.5f), Vec3(3), Vec3(0.25f, 0.5f, 1)}};
const ImageMetadata kMetadata{"moonshade test", {{"scene", "scene.lua"}, {"samples", "16"}, {"interrupted", "yes"}}};

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
    EXPECT_THAT(description, HasSubstr("interrupted yes")) << ending;
    EXPECT_EQ(read_fact(path, "samples"), "16") << ending;
    EXPECT_EQ(read_fact(path, "nothing"), "") << ending;
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

TEST(ImageFile, LeavesTheOldFileAloneUntilThereIsANewOne) {
  TemporaryFolder folder;
  folder.write("a.png", "old");
  ImageFile file;
  ASSERT_EQ(file.open(folder / "a.png"), "");
  EXPECT_EQ(files_in(folder), 1u); // nothing to leave behind, however the program ends
  EXPECT_EQ(read_file(folder / "a.png").text, "old");
  std::filesystem::remove(folder / "a.png");
  std::filesystem::create_directory(folder / "a.png"); // meanwhile
  EXPECT_THAT(file.write(kPicture, {}, kMetadata), HasSubstr("a.png: "));
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(ImageFile, TellsOfTheTemporaryFileWhileThereIsOne) {
  TemporaryFolder folder;
  ImageFile file;
  ASSERT_EQ(file.open(folder / "a.png"), "");
  std::vector<std::string> told;
  auto tell = [&](const char* name) {
    told.push_back(name ? name : "none");
    if (name) EXPECT_TRUE(std::filesystem::exists(name));
  };
  ASSERT_EQ(file.write(kPicture, {}, kMetadata, {}, {}, tell), "");
  ASSERT_EQ(told.size(), 2u);
  EXPECT_THAT(told[0], HasSubstr("a.png."));
  EXPECT_EQ(told[1], "none");
}

TEST(ImageFile, ReportsAFullDisk) {
  // A limit on the size of files stands in: writing fails as on a full disk, at the same places.
  TemporaryFolder folder;
  Picture noise{256, 256, {}};
  for (uint32_t k = 0; k < 256 * 256; ++k)
    noise.pixels.push_back(Vec3(unit_float(hash32(k)), unit_float(hash32(k + 77777)), unit_float(hash32(~k))));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const char* ending : {"png", "exr", "tif", "hdr", "jpg"}) {
    ImageFile file;
    ASSERT_EQ(file.open(folder / ("a." + std::string(ending))), "");
    rlimit limit{16384, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::string error = file.write(noise, {}, kMetadata);
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(error, "") << ending;
  }
  EXPECT_EQ(files_in(folder), 0u);
}

TEST(ImageFile, PutsAovsIntoExrUnderTheirNames) {
  TemporaryFolder folder;
  Film film(2, 1, {.squares = true, .first = true});
  Vec3 radiance[] = {Vec3(1, 2, 3), Vec3(3, 2, 1)};
  uint8_t faulted[] = {0, 1};
  FirstHit first[] = {{Vec3(0.5f), Vec3(0, 1, 0), Vec3(1, 2, 3), 4, 7, 3000000007},
                      {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(4, 5, 6), 3, 8, 9}};
  film.add(0, {radiance, faulted, first}, 0, 2);
  AovList aovs;
  ASSERT_EQ(parse_aovs("all", aovs), "");
  ImageFile file;
  ASSERT_EQ(file.open(folder / "a.exr"), "");
  ASSERT_EQ(file.write(film.picture(), {}, kMetadata, {&film, aovs}, {5, 6, 20, 30}), "");
  auto input = OIIO::ImageInput::open(folder / "a.exr");
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(spec.x, 5);
  EXPECT_EQ(spec.full_height, 30);
  std::vector<float> pixels(size_t(2 * spec.nchannels));
  ASSERT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()));
  auto value = [&](const std::string& name) {
    int channel = spec.channelindex(name);
    EXPECT_GE(channel, 0) << name;
    return channel < 0 ? -1.0f : pixels[size_t(channel)];
  };
  EXPECT_EQ(value("R"), 2);
  EXPECT_EQ(value("albedo.R"), 0.75f);
  EXPECT_EQ(value("N.Y"), 0.5f);
  EXPECT_EQ(value("Z"), 3);
  EXPECT_EQ(value("P.Z"), 6);
  EXPECT_EQ(value("variance.R"), 1);
  EXPECT_EQ(value("faults"), 0.5f);
  EXPECT_EQ(spec.channelformat(spec.channelindex("id.object")), OIIO::TypeDesc::UINT32);
  std::vector<uint32_t> ids(2);
  int at = spec.channelindex("id.material");
  ASSERT_TRUE(input->read_image(0, 0, at, at + 1, OIIO::TypeDesc::UINT32, ids.data()));
  EXPECT_EQ(ids[0], 9u);
  at = spec.channelindex("sampleCount");
  ASSERT_TRUE(input->read_image(0, 0, at, at + 1, OIIO::TypeDesc::UINT32, ids.data()));
  EXPECT_EQ(ids[0], 2u);
  EXPECT_EQ(ids[1], 0u);
}

} // namespace
} // namespace moonshade::renderer
