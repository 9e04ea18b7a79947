// Checkpoints. One whose hash does not fit is refused; one whose hash fits, whatever it holds, is gone on with or
// refused, and never more than was asked for.
//
// The input is damage to a checkpoint of a small render (damage.h); its first byte says whether the hash is made anew.
#include "renderer/checkpoint/checkpoint_file.h"
#include "renderer/scene/lua_scene.h"
#include "tests/fuzz/damage.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

#include <iterator>

namespace moonshade::renderer {
namespace {

using fuzz::require;

const Identity kIdentity{{{"scene", "1"}, {"options", "seed=0\nspp=4\n"}, {"build", "2"}}};

/// A shader that faults here and there, so that faults are remembered.
class FaultyShaders : public ShaderSource {
public:
  ShaderLoad load(const std::string&, const std::map<std::string, Constant>&,
                  const std::map<std::string, std::string>&) override {
    CompileOptions options;
    options.width = 1;
    options.optimization = 0;
    const Compilation compiled =
        compile("s.lua", "function color(p)\n  assert(p.x < 0.1, 'too far')\n  return p\nend\n", options);
    require(compiled.program != nullptr, compiled.diagnostics);
    return {compiled.program->instantiate({}).shader, "", ""};
  }
};

/// A small scene and what stays the same of its renders.
struct Small {
  std::unique_ptr<PreparedScene> scene;
  RenderOptions options;
  uint32_t asked = 0;

  explicit Small(uint32_t samples) : asked(samples) {
    const fuzz::Scratch shader(".lua");
    Folders folders;
    folders.allow_folder_of(shader.write("-- FaultyShaders gives what stands here"));
    const std::string text =
        "camera{ from = {0, 0, 4} } light{ type = 'sky' } sphere{ material = material{ shader = '" + shader.path() +
        "' } } render{ width = 5, height = 3, depth = 2, samples = " + std::to_string(samples) + " }";
    SceneReading reading = parse_lua_scene("small.lua", text, folders);
    if (!reading.scene) fuzz::fail(reading.error);
    FaultyShaders shaders;
    Preparation preparation = prepare(std::move(*reading.scene), shaders);
    require(preparation.prepared != nullptr, preparation.error);
    scene = std::move(preparation.prepared);
    options.threads = 1;
    options.noise = 1e-6;
    options.contents = {.squares = true, .first = true};
  }
};

class Bytes : public Archive {
public:
  bool reading() const override { return false; }
  bool ok() const override { return true; }
  void fail() override {}
  void bytes(void* data, size_t size) override { text.append(static_cast<const char*>(data), size); }
  std::string text;
};

/// Bytes that stand for a state.
class AnyState : public RenderState {
public:
  explicit AnyState(std::string state) : state_(std::move(state)) {}
  Picture picture() const override { return {}; }
  uint32_t samples() const override { return 0; }
  double seconds() const override { return 0; }
  void exchange(Archive& archive) override { archive.bytes(state_.data(), state_.size()); }

private:
  std::string state_;
};

/// The state after some of the samples.
std::string a_state(const Small& small) {
  Bytes bytes;
  RenderOptions options = small.options;
  RenderProgress progress;
  options.after_pass = [&](RenderState& state, bool) {
    if (bytes.text.empty()) state.exchange(bytes);
  };
  render(*small.scene, options, progress);
  require(!bytes.text.empty(), "no state");
  return bytes.text;
}

std::string file_of(const std::string& state) {
  const fuzz::Scratch file(".checkpoint");
  AnyState any(state);
  require(write_checkpoint(file.path(), kIdentity, any).empty(), "a checkpoint is not written");
  std::ifstream in(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The hash is that of the file as it was.
void check_damaged_file(const std::string& whole, std::string_view edits) {
  const std::string bytes = fuzz::damaged(whole, edits);
  const fuzz::Scratch file(".checkpoint");
  const OpenedCheckpoint opened = open_checkpoint(file.write(bytes), kIdentity);
  require((opened.state != nullptr) == (bytes == whole), "a damaged checkpoint is opened, or a whole one is not");
  require(opened.error.empty() == (opened.state != nullptr), "either a state or an error");
}

/// The hash is right.
void check_damaged_state(const Small& small, const std::string& state) {
  const fuzz::Scratch file(".checkpoint");
  const OpenedCheckpoint opened = open_checkpoint(file.write(file_of(state)), kIdentity);
  require(opened.state != nullptr, opened.error);
  RenderOptions options = small.options;
  options.resume = opened.state.get();
  RenderProgress progress;
  const RenderResult result = render(*small.scene, options, progress);
  require(opened.state->ok() == (result.film != nullptr), "either an error or a picture");
  require(result.samples <= small.asked, "more samples than were asked for");
}

} // namespace
} // namespace moonshade::renderer

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade::renderer;
  static const Small small(48);
  static const std::string state = a_state(small), whole = file_of(state);
  if (size == 0 || size > 600) return 0;
  const std::string_view edits = moonshade::fuzz::text_of(data + 1, size - 1);
  if (data[0] & 1)
    check_damaged_file(whole, edits);
  else
    check_damaged_state(small, moonshade::fuzz::damaged(state, edits));
  return 0;
}
