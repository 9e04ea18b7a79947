// Entries of the object cache. One that is damaged is never used, wherever the damage is: the shader is compiled anew
// and gives the same, and the entry is replaced by a whole one. And what an entry says of a program, hash or not, is
// read without harm and written again as it was.
//
// The input is damage to an entry (damage.h).
#include "runtime/object_cache.h"
#include "runtime/program_archive.h"
#include "tests/fuzz/damage.h"
#include "tests/fuzz/target.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace moonshade {
namespace {

using fuzz::require;
namespace fs = std::filesystem;

constexpr size_t kHeadBytes = 80; ///< of an entry, before the program

/// A shader of everything that is archived, quick to compile.
constexpr const char* kShader = R"(local scale = param("scale", 2.0, { min = 0.5, max = 10, doc = "size" })
local count = param("count", 3, { choices = { 1, 2, 3 } })
local kind = param("kind", "wood")
local weights = { 0.5, 0.25, 0.125 }
function height(p)
  assert(p.x < 9000, "too far")
  if kind == "wood" then return weights[count] * p.x end
  print(p.y)
  return p.y * scale
end
)";

/// A folder that is deleted at the end.
class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "moonshade-fuzz-XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "no folder for the cache");
    path_ = name;
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path entry() const {
    fs::path found;
    for (const auto& file : fs::directory_iterator(path_)) {
      require(found.empty(), "more files than one");
      found = file.path();
    }
    require(!found.empty(), "nothing is stored");
    return found;
  }
  std::string read() const {
    std::ifstream in(entry(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& bytes) const {
    const fs::path path = entry();
    std::ofstream(path, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  }
  const std::string& path() const { return path_; }

private:
  std::string path_;
};

struct Result {
  bool cached;
  std::array<float, 3> values;
  bool operator==(const Result&) const = default;
};

Result compile_and_run(const Folder& folder) {
  CompileOptions options;
  options.width = 4;
  options.optimization = 0;
  options.cache = open_object_cache(folder.path());
  const Compilation compiled = compile("fuzz.lua", kShader, options);
  require(compiled.program != nullptr, compiled.diagnostics);
  const Instantiation instance = compiled.program->instantiate({{"count", int64_t{2}}});
  require(instance.shader != nullptr, instance.error);
  Result result{compiled.program->times().cached, {}};
  const std::array<float, 3> x = {0.5F, 1e4F, -3}, y = {1, 2, 3}, z = {};
  const std::array<const void*, 3> inputs = {x.data(), y.data(), z.data()};
  const std::array<void*, 1> outputs = {result.values.data()};
  FaultReport faults;
  instance.shader->run(0, {x.size(), inputs.data(), outputs.data(), &faults, nullptr});
  require(faults.count == 1 && instance.shader->fault_site(faults.first_site).message == "too far", "another fault");
  return result;
}

void check_archive(const std::string& bytes) {
  if (const auto program = archived_program(bytes))
    require(to_bytes(*program) == bytes, "a program that is read is written in another way");
}

} // namespace
} // namespace moonshade

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  static const Folder folder;
  static const Result expected = compile_and_run(folder);
  static const std::string whole = folder.read();
  if (size > 600) return 0;
  const std::string_view edits = fuzz::text_of(data, size);
  check_archive(fuzz::damaged(whole.substr(kHeadBytes), edits));
  const std::string bytes = fuzz::damaged(whole, edits);
  folder.write(bytes);
  const Result found = compile_and_run(folder);
  fuzz::require(found.cached == (bytes == whole), "a damaged entry is used, or a whole one is not");
  fuzz::require(found.values == expected.values, "other values");
  fuzz::require(folder.read() == whole, "the entry is not replaced");
  return 0;
}
