// Look-ups of images in files against closed forms; what is wrong with a file shows when it is opened.
#include "runtime/images/file_images.h"

#include <OpenImageIO/imageio.h>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <sys/stat.h>
#include <thread>

namespace moonshade {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Result {
  std::array<float, 4> value{}, by_u{}, by_v{};
  bool operator==(const Result&) const = default;
};

Result look_up(const Image& image, float u, float v, float width = 0) {
  Result result;
  ImageLookup lookup{.count = 1, .u = &u, .v = &v, .width = &width};
  for (size_t c = 0; c < 4; ++c) {
    lookup.values[c] = &result.value[c];
    lookup.by_u[c] = &result.by_u[c];
    lookup.by_v[c] = &result.by_v[c];
  }
  image.look_up(lookup);
  return result;
}

class FileImages : public testing::Test {
protected:
  FileImages() {
    folder_ = fs::temp_directory_path() / ("moonshade-images-" + std::to_string(std::random_device()()));
    fs::create_directories(folder_ / "scene" / "deep");
    AllowedFolders folders;
    folders.allow((folder_ / "scene").string());
    opener_ = file_images(folders);
  }
  ~FileImages() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / "scene" / name; }

  /// Writes an image of these numbers, rows from the top.
  void write(const std::string& name, int width, int height, int channels, const std::vector<float>& numbers,
             OIIO::TypeDesc type = OIIO::TypeUInt8) {
    OIIO::ImageSpec spec(width, height, channels, type);
    spec["oiio:UnassociatedAlpha"] = 1;
    const auto output = OIIO::ImageOutput::create(path(name).string());
    ASSERT_TRUE(output && output->open(path(name).string(), spec)) << OIIO::geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, numbers.data()) && output->close()) << output->geterror();
  }
  void write_bytes(const std::string& name, const std::string& bytes) {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  std::string bytes_of(const std::string& name) {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  OpenedImage open(const std::string& name, bool raw = true, const std::string& from = "shader.lua") {
    return opener_(name, path(from).string(), raw);
  }
  std::string error_of(const std::string& name) { return open(name).error; }

  fs::path folder_;
  ImageOpener opener_;
};

TEST_F(FileImages, InterpolateBetweenTexelsAndRepeat) {
  write("four.png", 2, 2, 1, {0, 1, 0.2f, 0.6f});
  const OpenedImage four = open("four.png");
  ASSERT_TRUE(four.image) << four.error;
  // The middles of texels: v goes up, so the last row is at v = 1/4.
  EXPECT_NEAR(look_up(*four.image, 0.25f, 0.75f).value[0], 0, 1e-6);
  EXPECT_NEAR(look_up(*four.image, 0.75f, 0.75f).value[0], 1, 1e-6);
  EXPECT_NEAR(look_up(*four.image, 0.25f, 0.25f).value[0], 0.2, 1e-6);
  EXPECT_NEAR(look_up(*four.image, 0.75f, 0.25f).value[0], 0.6, 1e-6);
  EXPECT_NEAR(look_up(*four.image, 0.5f, 0.5f).value[0], 0.45, 1e-6);
  EXPECT_NEAR(look_up(*four.image, 0.0f, 0.75f).value[0], 0.5, 1e-6) << "across the border";
  EXPECT_NEAR(look_up(*four.image, 1.0f, 0.75f).value[0], 0.5, 1e-6);
  EXPECT_EQ(look_up(*four.image, 0.3f, 0.4f).value[3], 1);
}

TEST_F(FileImages, DecodeBytesAloneAndNeverAlpha) {
  write("bytes.png", 1, 1, 4, {0.5f, 0.2f, 0.0f, 0.5f});
  write("numbers.exr", 1, 1, 3, {0.5f, 2.0f, -1.0f}, OIIO::TypeFloat);
  write("wide.png", 1, 1, 1, {0.5f}, OIIO::TypeUInt16);
  const auto decoded = [](double x) { return std::pow((x + 0.055) / 1.055, 2.4); };
  const Result colour = look_up(*open("bytes.png", false).image, 0.5f, 0.5f);
  EXPECT_NEAR(colour.value[0], decoded(128 / 255.0), 1e-6);
  EXPECT_NEAR(colour.value[1], decoded(51 / 255.0), 1e-6);
  EXPECT_NEAR(colour.value[3], 128 / 255.0, 1e-6) << "and is not multiplied in";
  EXPECT_NEAR(look_up(*open("bytes.png", true).image, 0.5f, 0.5f).value[0], 128 / 255.0, 1e-6);
  const Result numbers = look_up(*open("numbers.exr", false).image, 0.5f, 0.5f);
  EXPECT_EQ(numbers.value, (std::array<float, 4>{0.5f, 2, -1, 1}));
  EXPECT_NEAR(look_up(*open("wide.png", false).image, 0.5f, 0.5f).value[2], 0.5, 1e-4);
}

TEST_F(FileImages, FilterOverTheFootprint) {
  // Columns of black and white, of odd number: the mean of all is that of a look-up as wide as the image.
  constexpr int kSide = 129;
  std::vector<float> stripes;
  for (int i = 0; i < kSide * kSide; ++i)
    stripes.push_back(i % kSide % 2 == 0 ? 1.0f : 0.0f);
  write("stripes.png", kSide, kSide, 1, stripes);
  const OpenedImage image = open("stripes.png");
  ASSERT_TRUE(image.image) << image.error;
  const float mean = 65.0f / 129;
  EXPECT_NEAR(look_up(*image.image, 0.3f, 0.7f, 1).value[0], mean, 1e-4);
  for (int i = 0; i < 50; ++i)
    EXPECT_NEAR(look_up(*image.image, float(i) / 50, 0.5f, 0.1f).value[0], mean, 0.03) << "finer than the footprint";
  // Below a texel nothing is filtered.
  EXPECT_NEAR(look_up(*image.image, 0.5f / kSide, 0.5f, 0.4f / kSide).value[0], 1, 1e-5);
}

TEST_F(FileImages, SlopesAreThoseOfWhatIsLookedUp) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> random(0, 1);
  std::vector<float> texels(64 * 48 * 3);
  for (float& texel : texels)
    texel = random(engine);
  write("noise.exr", 64, 48, 3, texels, OIIO::TypeFloat);
  const OpenedImage image = open("noise.exr");
  ASSERT_TRUE(image.image) << image.error;
  size_t compared = 0;
  for (int i = 0; i < 400; ++i) {
    const float u = random(engine) * 0.9f + 0.05f, v = random(engine) * 0.9f + 0.05f;
    const float width = i % 3 == 0 ? 0.0f : 0.1f * random(engine), h = 1.0f / 4096;
    // Away from the lines where bilinear interpolation has its kinks, of the finest two levels that are read.
    const auto kinks = [&](float x, float texels) {
      const float from = (x - h) * texels - 0.5f, to = (x + h) * texels - 0.5f;
      return std::floor(from) != std::floor(to);
    };
    bool has_kink = false;
    for (float side = 64; side >= 1; side /= 2)
      has_kink = has_kink || kinks(u, side) || kinks(1 - v, side * 0.75f) || kinks(1 - v, std::floor(side * 0.75f));
    if (has_kink) continue;
    ++compared;
    const Result at = look_up(*image.image, u, v, width);
    for (size_t c = 0; c < 3; ++c) {
      const float by_u =
          (look_up(*image.image, u + h, v, width).value[c] - look_up(*image.image, u - h, v, width).value[c]) / (2 * h);
      const float by_v =
          (look_up(*image.image, u, v + h, width).value[c] - look_up(*image.image, u, v - h, width).value[c]) / (2 * h);
      EXPECT_NEAR(at.by_u[c], by_u, 0.01f * (1 + std::abs(by_u))) << u << " " << v << " " << width;
      EXPECT_NEAR(at.by_v[c], by_v, 0.01f * (1 + std::abs(by_v))) << u << " " << v << " " << width;
    }
  }
  EXPECT_GT(compared, 150u);
}

TEST_F(FileImages, AreTheSameInEveryBlockAndThread) {
  std::vector<float> texels(300 * 200 * 4);
  for (size_t i = 0; i < texels.size(); ++i)
    texels[i] = float(i * 2654435761u % 1000) / 1000;
  write("large.png", 300, 200, 4, texels);
  constexpr uint32_t kPoints = 4000;
  std::vector<float> u(kPoints), v(kPoints), width(kPoints);
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> random(0, 1);
  for (uint32_t i = 0; i < kPoints; ++i)
    u[i] = random(engine), v[i] = random(engine), width[i] = i % 2 == 0 ? 0 : 0.2f * random(engine);
  // Each run opens the image anew, in a texture system of its own.
  const auto run = [&](uint32_t block, unsigned threads) {
    AllowedFolders folders;
    folders.allow((folder_ / "scene").string());
    const OpenedImage image = file_images(folders)("large.png", path("a.lua").string(), false);
    std::vector<float> values(size_t(kPoints) * 12);
    const auto part = [&](unsigned thread) {
      for (uint32_t first = thread * block; first < kPoints; first += threads * block) {
        ImageLookup lookup;
        lookup.count = std::min(block, kPoints - first);
        lookup.u = &u[first], lookup.v = &v[first], lookup.width = &width[first];
        for (size_t c = 0; c < 4; ++c) {
          lookup.values[c] = &values[c * kPoints + first];
          lookup.by_u[c] = &values[(4 + c) * kPoints + first];
          lookup.by_v[c] = &values[(8 + c) * kPoints + first];
        }
        image.image->look_up(lookup);
      }
    };
    std::vector<std::thread> running;
    for (unsigned thread = 0; thread < threads; ++thread)
      running.emplace_back(part, thread);
    for (std::thread& thread : running)
      thread.join();
    return values;
  };
  const std::vector<float> one = run(1, 1);
  EXPECT_EQ(run(7, 1), one);
  EXPECT_EQ(run(16, 4), one);
  EXPECT_EQ(run(32, 3), one);
}

TEST_F(FileImages, StayInTheirFolders) {
  write("inside.png", 1, 1, 1, {1});
  fs::copy(path("inside.png"), folder_ / "outside.png");
  fs::create_symlink(folder_ / "outside.png", path("link.png"));
  EXPECT_EQ(error_of("inside.png"), "");
  EXPECT_EQ(open("../inside.png", true, "deep/module.lua").error, "") << "out of a folder within";
  EXPECT_THAT(error_of("../outside.png"), HasSubstr("lies outside"));
  EXPECT_THAT(error_of((folder_ / "outside.png").string()), HasSubstr("lies outside"));
  EXPECT_THAT(error_of("link.png"), HasSubstr("lies outside"));
  EXPECT_THAT(error_of("/etc/passwd"), HasSubstr("lies outside"));
  EXPECT_EQ(error_of(path("inside.png").string()), "") << "by its whole name";
}

TEST_F(FileImages, RefuseWhatIsNoImage) {
  write("good.png", 64, 64, 3, std::vector<float>(64 * 64 * 3, 0.5f));
  const std::string good = bytes_of("good.png");
  fs::create_directory(path("folder.png"));
  ASSERT_EQ(mkfifo(path("pipe.png").c_str(), 0600), 0);
  write_bytes("text.png", "this is no image");
  write_bytes("empty.png", "");
  write_bytes("cut.png", good.substr(0, good.size() / 2));
  write_bytes("head.png", good.substr(0, 30));
  write_bytes("script.lua", "return 1");
  std::string huge = good; // its header claims 2^31 - 1 texels a side; the reader may find its checksum wrong first
  for (const size_t at : {16u, 20u})
    huge.replace(at, 4, "\x7f\xff\xff\xff", 4);
  write_bytes("huge.png", huge);
  write("wide.exr", 1, 1, 1, {1}, OIIO::TypeFloat);
  EXPECT_THAT(error_of("missing.png"), HasSubstr("there is no file"));
  EXPECT_THAT(error_of(""), HasSubstr("an empty file name"));
  EXPECT_THAT(error_of(std::string("a\0.png", 6)), HasSubstr("zero byte"));
  EXPECT_THAT(error_of("folder.png"), HasSubstr("is not a file"));
  EXPECT_THAT(error_of("pipe.png"), HasSubstr("is not a file"));
  EXPECT_THAT(error_of("script.lua"), HasSubstr("its name ends as no image"));
  for (const char* name : {"text.png", "empty.png", "cut.png", "head.png", "huge.png"})
    EXPECT_NE(error_of(name), "") << name;
}

/// A header that is right in itself and claims more than is read.
TEST_F(FileImages, RefuseWhatIsTooLarge) {
  std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n";
  write_bytes("huge.hdr", header);
  EXPECT_THAT(error_of("huge.hdr"), HasSubstr("it is too large (60000 x 60000"));
  write_bytes("wide.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 900000\n");
  EXPECT_THAT(error_of("wide.hdr"), HasSubstr("its size"));
}

/// Files of some bytes may claim hundreds of megabytes each.
TEST_F(FileImages, AreBoundedTogether) {
  write("a.png", 64, 64, 3, std::vector<float>(size_t(3) * 64 * 64, 0.5f));
  const auto bytes = std::make_shared<const std::string>(bytes_of("a.png"));
  const auto more = std::make_shared<const std::string>(*bytes);
  const ImageStore store(AllowedFolders(), 60'000); // one takes 12 kB, and 21 kB for its levels
  OpenedImage first = store.decode(bytes, false);
  ASSERT_NE(first.image, nullptr) << first.error;
  EXPECT_EQ(store.decode(bytes, false).image, first.image);
  EXPECT_EQ(store.decode(more, false).error, "it takes too much memory beside the other images");
  first = {};
  EXPECT_EQ(store.decode(more, false).error, "");
}

TEST_F(FileImages, OutliveTheirFiles) {
  write("gone.png", 2, 2, 1, {0, 1, 1, 0});
  const OpenedImage image = open("gone.png");
  const Result before = look_up(*image.image, 0.3f, 0.4f, 0.6f);
  fs::remove(path("gone.png"));
  EXPECT_EQ(look_up(*image.image, 0.3f, 0.4f, 0.6f), before);
  opener_ = {};
  EXPECT_EQ(look_up(*image.image, 0.3f, 0.4f, 0.6f), before) << "and their opener";
}

TEST_F(FileImages, DecodesBytesAsItReadsFiles) {
  write("a.png", 2, 1, 3, {1, 0.5f, 0, 0, 0, 1});
  write("a.jpg", 1, 1, 3, {1, 1, 1});
  write("a.tif", 1, 1, 3, {1, 1, 1});
  const ImageStore store{AllowedFolders()};
  const auto png = std::make_shared<const std::string>(bytes_of("a.png"));
  for (const bool raw : {false, true}) {
    const OpenedImage decoded = store.decode(png, raw);
    ASSERT_NE(decoded.image, nullptr) << decoded.error;
    EXPECT_EQ(decoded.path, "");
    EXPECT_EQ(look_up(*decoded.image, 0.3f, 0.5f), look_up(*open("a.png", raw).image, 0.3f, 0.5f));
    EXPECT_EQ(store.decode(png, raw).image, decoded.image); // kept once
    EXPECT_NE(store.decode(png, !raw).image, decoded.image);
  }
  EXPECT_EQ(store.decode(std::make_shared<const std::string>(bytes_of("a.jpg")), true).error, "");
  for (const std::string& bytes : {std::string(), bytes_of("a.tif"), std::string("<svg/>")})
    EXPECT_EQ(store.decode(std::make_shared<const std::string>(bytes), true).error, "it is neither a PNG nor a JPEG");
  for (size_t size = 4; size < png->size() / 2; size += 3)
    EXPECT_NE(store.decode(std::make_shared<const std::string>(png->substr(0, size)), true).error, "") << size;
}

} // namespace
} // namespace moonshade
