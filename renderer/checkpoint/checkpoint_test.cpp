// Checkpoints: what they hold, whose they are, and that a render goes on from one as if nothing had happened.
#include "renderer/checkpoint/checkpoint_file.h"

#include "renderer/checkpoint/sha256.h"
#include "renderer/test_support.h"

#include <csignal>
#include <gmock/gmock.h>
#include <sys/resource.h>

namespace moonshade::renderer {
namespace {

using testing::CppShader;
using ::testing::HasSubstr;
using testing::render_text;
using testing::Rendering;
using testing::TemporaryFolder;

TEST(Sha256, GivesThePublishedDigests) {
  // FIPS 180-4's examples.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  Sha256 pieces;
  for (int k = 0; k < 1000; ++k)
    pieces.add(std::string(1000, 'a'));
  EXPECT_EQ(pieces.finish(), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/// A state of so many numbers.
class Numbers : public RenderState {
public:
  explicit Numbers(size_t count) : numbers(count) {
    for (size_t k = 0; k < count; ++k)
      numbers[k] = uint32_t(k * 2654435761u);
  }
  Picture picture() const override { return {}; }
  uint32_t samples() const override { return 0; }
  double seconds() const override { return 0; }
  void exchange(Archive& archive) override {
    archive.bytes(numbers.data(), numbers.size() * sizeof numbers[0]);
    archive.text(text);
  }
  std::vector<uint32_t> numbers;
  std::string text = "and words";
};

const Identity kIdentity{{{"scene", "1"}, {"options", "seed=0\nspp=4\n"}, {"build", "2"}}};

TEST(Checkpoint, GivesBackWhatWasWritten) {
  TemporaryFolder folder;
  for (size_t count : {size_t(0), size_t(1), size_t(1) << 18, size_t(1000000)}) {
    Numbers written(count);
    ASSERT_EQ(write_checkpoint(folder / "c", kIdentity, written), "");
    OpenedCheckpoint opened = open_checkpoint(folder / "c", kIdentity);
    ASSERT_TRUE(opened.state) << opened.error;
    Numbers read(count);
    std::fill(read.numbers.begin(), read.numbers.end(), 0);
    read.text = "";
    read.exchange(*opened.state);
    EXPECT_TRUE(opened.state->ok());
    EXPECT_EQ(read.numbers, written.numbers);
    EXPECT_EQ(read.text, "and words");
    uint8_t more = 0;
    opened.state->value(more);
    EXPECT_FALSE(opened.state->ok()); // there is no more
  }
}

TEST(Checkpoint, IsRefusedWhereItIsDamagedOrCutShort) {
  TemporaryFolder folder;
  Numbers numbers(1000);
  ASSERT_EQ(write_checkpoint(folder / "c", kIdentity, numbers), "");
  std::string bytes = read_file(folder / "c").text;
  for (size_t at = 0; at < bytes.size(); at += 97) {
    std::string damaged = bytes;
    damaged[at] = char(damaged[at] ^ 16);
    folder.write("c", damaged);
    EXPECT_THAT(open_checkpoint(folder / "c", kIdentity).error, HasSubstr("is damaged")) << at;
    folder.write("c", bytes.substr(0, at));
    EXPECT_THAT(open_checkpoint(folder / "c", kIdentity).error, HasSubstr("is damaged")) << at;
  }
  EXPECT_EQ(open_checkpoint(folder / "none", kIdentity).error, ""); // no checkpoint is no error
  EXPECT_THAT(open_checkpoint(folder / "", kIdentity).error, HasSubstr("is damaged"));
}

TEST(Checkpoint, IsRefusedWhereAnythingDiffers) {
  TemporaryFolder folder;
  Numbers numbers(3);
  ASSERT_EQ(write_checkpoint(folder / "c", kIdentity, numbers), "");
  auto error = [&](const std::string& part, const std::string& value) {
    Identity other = kIdentity;
    other.parts[part] = value;
    return open_checkpoint(folder / "c", other).error;
  };
  EXPECT_THAT(error("scene", "x"), HasSubstr("another render's: the scene;"));
  EXPECT_THAT(error("build", "x"), HasSubstr("another render's: the build;"));
  EXPECT_THAT(error("options", "seed=5\nspp=4\n"), HasSubstr("the options (then seed=0; now seed=5);"));
  EXPECT_THAT(error("models", "x"), HasSubstr("the models;"));
  Identity both = kIdentity;
  both.parts["scene"] = both.parts["build"] = "x";
  EXPECT_EQ(difference(kIdentity, both), "the build and the scene");
}

TEST(Checkpoint, KeepsTheOldOneWhereTheNewOneCannotBeWritten) {
  TemporaryFolder folder;
  Numbers old(10), large(100000);
  ASSERT_EQ(write_checkpoint(folder / "c", kIdentity, old), "");
  std::string before = read_file(folder / "c").text;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit normal{};
  getrlimit(RLIMIT_FSIZE, &normal);
  rlimit limit{4096, normal.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::string error = write_checkpoint(folder / "c", kIdentity, large);
  setrlimit(RLIMIT_FSIZE, &normal);
  EXPECT_THAT(error, HasSubstr("c: File too large"));
  EXPECT_EQ(read_file(folder / "c").text, before);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.new"));
  EXPECT_THAT(write_checkpoint(folder / "none/c", kIdentity, old), HasSubstr("none/c: No such file"));
}

TEST(Checkpoint, IsNotWrittenThroughALink) {
  TemporaryFolder folder;
  Numbers numbers(10);
  std::filesystem::create_symlink(folder.write("precious", "kept"), folder / "c.new");
  EXPECT_THAT(write_checkpoint(folder / "c", kIdentity, numbers), HasSubstr("symbolic links"));
  EXPECT_EQ(read_file(folder / "precious").text, "kept");
}

TEST(Identity, FollowsEveryFileAndOption) {
  TemporaryFolder folder;
  Scene scene;
  scene.file = folder.write("s.lua", "scene");
  scene.files = {folder.write("m.obj", "model"), folder.write("a.lua", "shader"), folder.write("i.png", "image")};
  RenderOptions options;
  ShaderOptions shaders;
  auto now = [&] { return identify(scene, {folder / "b.lua"}, options, shaders, {}); };
  folder.write("b.lua", "module");
  const Identity first = now();
  EXPECT_EQ(first, now());
  auto changed = [&](const char* file) {
    std::string before = read_file(folder / file).text;
    folder.write(file, before + "!");
    std::string what = difference(first, now());
    folder.write(file, before);
    return what;
  };
  EXPECT_EQ(changed("s.lua"), "the scene");
  EXPECT_EQ(changed("m.obj"), "the models");
  EXPECT_EQ(changed("a.lua"), "the shaders");
  EXPECT_EQ(changed("b.lua"), "the shaders");
  EXPECT_EQ(changed("i.png"), "the images");
  scene.settings.seed = 3;
  EXPECT_THAT(difference(first, now()), HasSubstr("the options (then seed=0; now seed=3)"));
  scene.settings.seed = 0;
  options.noise = 0.1;
  EXPECT_THAT(difference(first, now()), HasSubstr("now noise=0.1"));
  options.noise = 0, options.threads = 7, options.seconds = 5; // which change no sample
  EXPECT_EQ(first, now());
  shaders.precision = Precision::F64;
  EXPECT_THAT(difference(first, now()), HasSubstr("the options"));
  EXPECT_THAT(difference(first, identify(scene, {folder / "b.lua"}, options, {}, {{"gold", {{"scale", "2"}}}})),
              HasSubstr("now -D gold.scale=2"));
  EXPECT_EQ(build_identity(), build_identity());
}

/// Memory as an archive.
class Memory : public Archive {
public:
  bool reading() const override { return reading_; }
  bool ok() const override { return ok_; }
  void fail() override { ok_ = false; }
  void bytes(void* data, size_t size) override {
    char* p = static_cast<char*>(data);
    if (!reading_) {
      stored_.insert(stored_.end(), p, p + size);
    } else if (at_ + size <= stored_.size()) {
      std::copy_n(stored_.data() + at_, size, p);
      at_ += size;
    } else {
      ok_ = false;
    }
  }
  void rewind() { reading_ = true, at_ = 0; }

private:
  std::vector<char> stored_;
  size_t at_ = 0;
  bool reading_ = false, ok_ = true;
};

TEST(Resuming, GivesTheBitsOfAnUninterruptedRender) {
  // With a shader that faults, AOVs and adaptive sampling: everything that is remembered.
  auto shader = std::make_shared<CppShader>();
  shader->add("color", {{"P", ValueType::Vec3}}, ValueType::Vec3, [](const double* in, double* out) {
    out[0] = out[1] = out[2] = 0.5;
    return in[0] > 0.2 ? FaultCode::Assert : FaultCode::None;
  });
  const std::string scene = "camera{ from = {0, 2, 6}, to = {0, 0.5, 0} } plane{ material = material{ ior = 1 } }"
                            "box{ center = {0, 0.6, 0}, material = material{ shader = 'fake.lua' } }"
                            "render{ width = 48, height = 32, samples = 96, depth = 4 }";
  for (double noise : {0.0, 0.02}) {
    RenderOptions options;
    options.contents = {.squares = true, .first = true};
    options.noise = noise;
    Rendering whole = render_text(scene, shader, options);
    ASSERT_EQ(whole.error, "");
    EXPECT_GT(whole.result.fault_count, 0u);
    for (int stop : {1, 3, 7}) {
      Memory memory;
      int passes = 0;
      options.after_pass = [&](RenderState& state, bool) {
        if (++passes == stop) state.exchange(memory);
      };
      render_text(scene, shader, options);
      memory.rewind();
      options.after_pass = nullptr;
      options.resume = &memory;
      options.threads = unsigned(stop);
      Rendering rest = render_text(scene, shader, options);
      options.resume = nullptr;
      EXPECT_TRUE(memory.ok());
      EXPECT_EQ(rest.result.picture.pixels, whole.result.picture.pixels) << stop;
      EXPECT_EQ(rest.result.samples, whole.result.samples);
      EXPECT_EQ(rest.result.mean_samples, whole.result.mean_samples);
      EXPECT_EQ(rest.result.fault_count, whole.result.fault_count);
      EXPECT_EQ(rest.result.faults.size(), whole.result.faults.size());
      EXPECT_EQ(rest.result.stats.rays, whole.result.stats.rays);
      for (size_t k = 0; k < 48 * 32; ++k) {
        EXPECT_EQ(rest.result.film->variance(k), whole.result.film->variance(k));
        EXPECT_EQ(rest.result.film->first(k).normal, whole.result.film->first(k).normal);
        EXPECT_EQ(rest.result.film->first(k).object, whole.result.film->first(k).object);
      }
    }
  }
}

TEST(Resuming, KeepsTheControlsThatVolumesHaveRaised) {
  // Specks so rare that looking at the cells misses most of them.
  auto shader = std::make_shared<CppShader>();
  shader->add("density", {{"p", ValueType::Vec3}}, ValueType::Number, [](const double* in, double* out) {
    double h = std::sin(in[0] * 127.1 + in[1] * 311.7 + in[2] * 74.7) * 43758.5453;
    return out[0] = h - std::floor(h) < 3e-4 ? 60 : 2, FaultCode::None;
  });
  for (const char* integrator : {"path", "sppm", "irradiance"}) {
    const std::string scene = std::string("camera{ from = {0, 0.6, 4} } light{ type = 'sky' } plane{ point = {0, -1, "
                                          "0} } box{ material = material{ color = 0.9, shader = 'fake.lua' } } render{ "
                                          "width = 24, height = 16, samples = 48, photons = 2000, integrator = '") +
                              integrator + "' }";
    Rendering whole = render_text(scene, shader);
    ASSERT_EQ(whole.error, "");
    Memory memory;
    RenderOptions options;
    options.after_pass = [&](RenderState& state, bool) {
      if (state.samples() == 32) state.exchange(memory);
    };
    render_text(scene, shader, options);
    memory.rewind();
    options.after_pass = nullptr;
    options.resume = &memory;
    EXPECT_EQ(render_text(scene, shader, options).result.picture.pixels, whole.result.picture.pixels) << integrator;
    EXPECT_TRUE(memory.ok());
  }
}

TEST(Resuming, GivesUpWhereTheStateDoesNotFit) {
  Memory empty;
  empty.rewind();
  RenderOptions options;
  options.resume = &empty;
  Rendering r = render_text("sphere{} render{ width = 8, height = 8, samples = 1 }", nullptr, options);
  EXPECT_EQ(r.result.samples, 0u);
  EXPECT_FALSE(r.result.film);
}

} // namespace
} // namespace moonshade::renderer
