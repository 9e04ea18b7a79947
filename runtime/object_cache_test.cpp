// The object cache: what is found, what is not trusted, what makes a key, many writers, the limit.
#include "runtime/object_cache.h"

#include "runtime/archive.h"
#include "runtime/cache_key.h"
#include "runtime/frontend.h"
#include "runtime/program_archive.h"
#include "runtime/shade_fixture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace moonshade {
namespace {

using namespace testing;
using ::testing::HasSubstr;

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

class ObjectCacheTest : public ::testing::Test {
protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "moonshade-cache-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
    std::filesystem::remove_all(folder_);
  }

  CompileOptions options(uint64_t limit = uint64_t{256} << 20) const {
    CompileOptions options;
    options.modules = stone_reader();
    options.cache = open_object_cache(folder_.string(), limit);
    return options;
  }
  std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      paths.push_back(entry.path());
    return paths;
  }

  std::filesystem::path folder_;
};

CacheKey key_of(uint8_t first) {
  CacheKey key{};
  key[0] = first;
  return key;
}

TEST_F(ObjectCacheTest, GivesTheSameProgramAgain) {
  const CompileOptions first = options();
  const Compilation compiled = compile("rich.lua", kRichShader, first);
  EXPECT_FALSE(compiled.program->times().cached);
  EXPECT_EQ(cache_counts(*first.cache).stored, 1u);
  const CompileOptions second = options(); // as another process would
  const Compilation found = compile("rich.lua", kRichShader, second);
  ASSERT_NE(found.program, nullptr);
  EXPECT_TRUE(found.program->times().cached);
  EXPECT_GT(found.program->times().cache, 0);
  EXPECT_EQ(found.program->times().codegen, 0);
  EXPECT_EQ(cache_counts(*second.cache).hits, 1u);
  EXPECT_THAT(found.diagnostics, HasSubstr("unused"));
  EXPECT_EQ(found.diagnostics, compiled.diagnostics);
  const std::map<std::string, Constant> parameters = {
      {"scale", 3.0}, {"count", int64_t{2}}, {"kind", std::string("wood")}, {"tint", std::vector<double>{1, 2, 3}}};
  for (const auto& given : {std::map<std::string, Constant>{}, parameters, {{"on", false}}}) {
    const auto a = instantiated(compiled, given), b = instantiated(found, given);
    ASSERT_EQ(a->info().entries.size(), b->info().entries.size());
    for (size_t entry = 0; entry < a->info().entries.size(); ++entry)
      EXPECT_EQ(shade_all(*a, entry), shade_all(*b, entry));
  }
  const auto shader = instantiated(found);
  const size_t height = shader->info().entries[0].name == "height" ? 0 : 1;
  EXPECT_GT(shade_all(*shader, height).fault_count, 0u);
  EXPECT_THAT(found.program->instantiate({{"scale", 11.0}}).error, HasSubstr("scale"));
  EXPECT_EQ(found.program->info().parameters[0].doc, "size");
  const float far[] = {1e4F, 0, 0};
  float result = 1;
  const void* inputs[] = {&far[0], &far[1], &far[2]};
  void* outputs[] = {&result};
  FaultReport faults;
  shader->run(height, {1, inputs, outputs, &faults, nullptr});
  EXPECT_EQ(faults.count, 1u);
  EXPECT_EQ(shader->fault_site(faults.first_site).message, "too far");
  EXPECT_EQ(shader->fault_site(faults.first_site).line, 18u);
}

TEST_F(ObjectCacheTest, ServesCheckedShadersAndGradients) {
  CompileOptions with_gradient = options();
  with_gradient.gradients = {{"height", {"p"}}};
  const CheckedShader checked("rich.lua", kRichShader, {}, with_gradient.modules);
  const Compilation compiled = compile(checked, with_gradient), found = compile(checked, with_gradient);
  EXPECT_TRUE(found.program->times().cached);
  EXPECT_GT(found.program->times().parse, 0);
  ASSERT_EQ(found.program->info().entries.size(), 3u);
  EXPECT_EQ(shade_all(*instantiated(compiled), 2), shade_all(*instantiated(found), 2));
  EXPECT_TRUE(compile("rich.lua", kRichShader, with_gradient).program->times().cached) << "by the text, too";
}

TEST_F(ObjectCacheTest, PrintsFromACachedProgram) {
  const std::string text = "function height(p)\n  print(p.x)\n  return p.y\nend\n";
  compile("print.lua", text, options());
  const Compilation found = compile("print.lua", text, options());
  ASSERT_TRUE(found.program->times().cached);
  const auto shader = instantiated(found);
  ASSERT_TRUE(shader->has_prints());
  const float p[] = {1.5F, 2, 3};
  float result = 0;
  const void* inputs[] = {&p[0], &p[1], &p[2]};
  void* outputs[] = {&result};
  std::string printed;
  shader->print(0, {1, inputs, outputs, nullptr, nullptr}, 0, [&](std::string_view line) { printed += line; });
  EXPECT_EQ(printed, "1.5");
}

TEST_F(ObjectCacheTest, KeepsNothingOfWhatIsRefused) {
  const CompileOptions o = options();
  EXPECT_EQ(compile("bad.lua", "function color(p) return q end", o).program, nullptr);
  EXPECT_THAT(entries(), ::testing::IsEmpty());
}

// ---- keys ---------------------------------------------------------------------------------------------------------

TEST(CacheKey, DependsOnEverythingThatMatters) {
  const SourceClosure sources{"a.lua", "function height(p) return p.x end", {{"m", {"m.lua", "return {}", ""}}}};
  const CompileOptions options;
  std::map<CacheKey, std::string> keys;
  const auto add = [&](const std::string& what, const SourceClosure& s, const CompileOptions& o) {
    const auto key = cache_key(s, o);
    ASSERT_TRUE(key) << "the build has no identifier";
    const auto [found, is_new] = keys.emplace(*key, what);
    EXPECT_TRUE(is_new) << what << " has the key of " << found->second;
  };
  const auto vary_source = [&](const std::string& what, const std::function<void(SourceClosure&)>& change) {
    SourceClosure changed = sources;
    change(changed);
    add(what, changed, options);
  };
  const auto vary = [&](const std::string& what, const std::function<void(CompileOptions&)>& change) {
    CompileOptions changed = options;
    change(changed);
    add(what, sources, changed);
  };
  add("nothing", sources, options);
  vary_source("name", [](SourceClosure& s) { s.name = "b.lua"; });
  vary_source("text", [](SourceClosure& s) { s.text += " "; });
  vary_source("bytes moved", [](SourceClosure& s) { s.name = "a.luaf", s.text.erase(0, 1); });
  vary_source("module's text", [](SourceClosure& s) { s.modules["m"].text += " "; });
  vary_source("module's path", [](SourceClosure& s) { s.modules["m"].path = "x/m.lua"; });
  vary_source("module's name", [](SourceClosure& s) { s.modules["n"] = s.modules["m"], s.modules.erase("m"); });
  vary_source("no module", [](SourceClosure& s) { s.modules.clear(); });
  vary("precision", [](CompileOptions& o) { o.precision = Precision::F64; });
  for (const unsigned width : kWidths)
    vary("width " + std::to_string(width), [&](CompileOptions& o) { o.width = width; });
  for (const int level : {0, 1, 3})
    vary("-O" + std::to_string(level), [&](CompileOptions& o) { o.optimization = level; });
  vary("cpu", [](CompileOptions& o) { o.cpu = "x86-64-v2"; });
  vary("target", [](CompileOptions& o) { o.target = "aarch64-linux-gnu"; });
  vary("entry", [](CompileOptions& o) { o.entries = {"height"}; });
  vary("uniform input", [](CompileOptions& o) { o.uniform_inputs = {"height"}; });
  vary("step limit", [](CompileOptions& o) { o.step_limit = 5; });
  vary("colour", [](CompileOptions& o) { o.color_diagnostics = true; });
  vary("gradient", [](CompileOptions& o) { o.gradients = {{"height", {"p"}}}; });
  vary("gradient's inputs", [](CompileOptions& o) { o.gradients = {{"height", {"p", "uv"}}}; });
  vary("bake", [](CompileOptions& o) { o.bake = true; });
  vary("baked integer", [](CompileOptions& o) { o.bake = true, o.baked = {{"s", int64_t{1}}}; });
  vary("baked number", [](CompileOptions& o) { o.bake = true, o.baked = {{"s", 1.0}}; });
  vary("another number", [](CompileOptions& o) { o.bake = true, o.baked = {{"s", -0.0}}; });
  vary("zero", [](CompileOptions& o) { o.bake = true, o.baked = {{"s", 0.0}}; });
  vary("baked vector", [](CompileOptions& o) { o.bake = true, o.baked = {{"s", std::vector<double>{1, 2}}}; });
  vary("baked string", [](CompileOptions& o) { o.bake = true, o.baked = {{"s", std::string("1")}}; });
}

TEST(CacheKey, FindsModulesByTheirNames) {
  std::vector<std::string> asked;
  const ModuleReader reader = [&](const std::string& name) {
    asked.push_back(name);
    if (name == "a") return ModuleText{"a.lua", "local b = require 'b' -- require 'not'\nreturn {}", ""};
    if (name == "b") return ModuleText{"b.lua", "return { s = \"require 'no'\" }", ""};
    return ModuleText{"", "", "none"};
  };
  const SourceClosure closure =
      source_closure("x.lua", "local a = require(\"a\")\nlocal a2 = require 'a'\nlocal c = require [[c]]", reader);
  EXPECT_THAT(asked, ::testing::ElementsAre("a", "b", "c"));
  EXPECT_EQ(closure.modules.size(), 2u);
}

TEST_F(ObjectCacheTest, SeesAModuleThatChanged) {
  CompileOptions o = options();
  compile("rich.lua", kRichShader, o);
  o.modules = stone_reader("return { hardness = function(p) return 0.0 end }\n");
  const Compilation changed = compile("rich.lua", kRichShader, o);
  EXPECT_FALSE(changed.program->times().cached);
  o.modules = stone_reader();
  EXPECT_TRUE(compile("rich.lua", kRichShader, o).program->times().cached);
}

TEST_F(ObjectCacheTest, ParametersCompileNothing) {
  const CompileOptions o = options();
  const Compilation compiled = compile("rich.lua", kRichShader, o);
  const CacheCounts before = cache_counts(*o.cache);
  std::vector<Shaded> results;
  for (int i = 1; i <= 50; ++i)
    results.push_back(shade_all(*instantiated(compiled, {{"scale", 0.5 + i * 0.1}}), 0, 100));
  EXPECT_NE(results[0], results[1]);
  const CacheCounts after = cache_counts(*o.cache);
  EXPECT_EQ(after.hits + after.misses, before.hits + before.misses) << "every compilation asks the cache once";
  EXPECT_EQ(after.stored, before.stored);
}

// ---- what is not trusted ------------------------------------------------------------------------------------------

TEST_F(ObjectCacheTest, RejectsEveryTruncation) {
  ObjectCache cache(folder_.string(), 1 << 20);
  const CacheKey key = key_of(1);
  const std::string payload = "a payload of some length, with \0 zeros";
  cache.store(key, payload);
  ASSERT_EQ(cache.find(key), payload);
  const std::string whole = read_bytes(cache.path_of(key));
  for (size_t size = 0; size < whole.size(); ++size) {
    write_bytes(cache.path_of(key), whole.substr(0, size));
    ::chmod(cache.path_of(key).c_str(), 0600);
    EXPECT_EQ(cache.find(key), std::nullopt) << size;
    EXPECT_FALSE(std::filesystem::exists(cache.path_of(key))) << size;
  }
  write_bytes(cache.path_of(key), whole + "x");
  ::chmod(cache.path_of(key).c_str(), 0600);
  EXPECT_EQ(cache.find(key), std::nullopt);
  EXPECT_EQ(cache.counts().rejected, whole.size() + 1);
}

TEST_F(ObjectCacheTest, RejectsEveryFlippedBit) {
  ObjectCache cache(folder_.string(), 1 << 20);
  const CacheKey key = key_of(2);
  cache.store(key, "a payload of some length");
  const std::string whole = read_bytes(cache.path_of(key));
  for (size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    write_bytes(cache.path_of(key), damaged);
    ::chmod(cache.path_of(key).c_str(), 0600);
    EXPECT_EQ(cache.find(key), std::nullopt) << bit;
  }
}

TEST_F(ObjectCacheTest, RejectsAnEntryOfAnotherKey) {
  ObjectCache cache(folder_.string(), 1 << 20);
  cache.store(key_of(1), "one");
  std::filesystem::rename(cache.path_of(key_of(1)), cache.path_of(key_of(2)));
  EXPECT_EQ(cache.find(key_of(2)), std::nullopt);
  EXPECT_EQ(cache.counts().rejected, 1u);
}

TEST_F(ObjectCacheTest, RejectsWhatOthersCouldHaveWritten) {
  ObjectCache cache(folder_.string(), 1 << 20);
  const CacheKey key = key_of(1);
  for (const mode_t mode : {0620, 0602}) {
    cache.store(key, "one");
    ::chmod(cache.path_of(key).c_str(), mode);
    EXPECT_EQ(cache.find(key), std::nullopt) << mode;
  }
  cache.store(key, "one");
  std::filesystem::rename(cache.path_of(key), folder_ / "elsewhere");
  std::filesystem::create_symlink(folder_ / "elsewhere", cache.path_of(key));
  EXPECT_EQ(cache.find(key), std::nullopt);
  if (::geteuid() != 0) return; // only root gives files away
  std::filesystem::remove(cache.path_of(key));
  cache.store(key, "one");
  ASSERT_EQ(::chown(cache.path_of(key).c_str(), 12345, 12345), 0);
  EXPECT_EQ(cache.find(key), std::nullopt);
}

TEST_F(ObjectCacheTest, CompilesWhatIsDamaged) {
  const CompileOptions o = options();
  const Shaded expected = shade_all(*instantiated(compile("rich.lua", kRichShader, o)));
  const std::filesystem::path path = entries().at(0);
  const std::string whole = read_bytes(path);
  std::mt19937 random(1);
  for (int i = 0; i < 8; ++i) {
    std::string damaged = whole;
    if (i % 2 == 0)
      damaged.resize(random() % whole.size());
    else
      damaged[random() % whole.size()] ^= 1;
    write_bytes(path, damaged);
    ::chmod(path.c_str(), 0600);
    const Compilation again = compile("rich.lua", kRichShader, o);
    EXPECT_FALSE(again.program->times().cached);
    EXPECT_EQ(shade_all(*instantiated(again)), expected);
    EXPECT_TRUE(compile("rich.lua", kRichShader, o).program->times().cached) << "stored anew";
  }
  EXPECT_EQ(cache_counts(*o.cache).rejected, 8u);
}

TEST_F(ObjectCacheTest, TakesBytesThatAreNoProgramForAMiss) {
  const CompileOptions o = options();
  const SourceClosure sources{"a.lua", "function height(p) return p.x end", {}};
  o.cache->store(*cache_key(sources, o), "rubbish");
  const Compilation compiled = compile(sources.name, sources.text, o);
  ASSERT_NE(compiled.program, nullptr);
  EXPECT_FALSE(compiled.program->times().cached);
  EXPECT_EQ(cache_counts(*o.cache).rejected, 1u);
}

TEST(ProgramArchive, ReadsAnyBytesSafely) {
  ArchivedProgram program;
  program.info.entries = {{"color", {{"p", ValueType::Vec3}}, {ValueType::Vec3}}};
  program.info.parameters.resize(2);
  program.info.parameters[0].name = "scale";
  program.info.parameters[0].default_value = std::vector<double>{1, 2};
  program.info.parameters[0].choices = {std::string("a"), int64_t{3}, true};
  program.code.entries = {{"moonshade_entry_color", {1, {{4, false}}, {{4, false}}, {FaultCode::Index}}}};
  program.code.places = {{FaultCode::Index, {0, 1, 2}, "message"}};
  program.sites = {{"a.lua", 1, 2, "message"}};
  program.slots = {{1, ValueType::Number, 0}};
  program.code.constants_size = 64;
  program.object = "object";
  const std::string bytes = to_bytes(program);
  const auto same = archived_program(bytes);
  ASSERT_TRUE(same);
  EXPECT_EQ(to_bytes(*same), bytes);
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(archived_program(std::string_view(bytes).substr(0, size))) << size;
  std::mt19937 random(7);
  size_t read = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string damaged = bytes;
    for (unsigned n = 1 + random() % 4; n > 0; --n)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    read += archived_program(damaged).has_value(); // sanitizers watch; what is read again must be writable
  }
  EXPECT_LT(read, 200'000u);
}

// ---- folders ------------------------------------------------------------------------------------------------------

TEST_F(ObjectCacheTest, DoesWithoutAFolder) {
  EXPECT_EQ(open_object_cache(""), nullptr);
  CompileOptions o = options();
  for (const std::string& folder :
       {std::string("/proc/nowhere/cache"), std::string("/dev/null"), (folder_ / "f" / "x").string()}) {
    write_bytes(folder_ / "f", "a file");
    o.cache = open_object_cache(folder);
    EXPECT_NE(compile("rich.lua", kRichShader, o).program, nullptr) << folder;
    EXPECT_NE(compile("rich.lua", kRichShader, o).program, nullptr) << folder;
    EXPECT_EQ(cache_counts(*o.cache).stored, 0u);
  }
}

TEST_F(ObjectCacheTest, ReadsAFolderThatItCannotWrite) {
  compile("rich.lua", kRichShader, options());
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const CompileOptions o = options();
  EXPECT_TRUE(compile("rich.lua", kRichShader, o).program->times().cached);
  EXPECT_NE(compile("other.lua", kRichShader, o).program, nullptr);
}

TEST_F(ObjectCacheTest, WritesNoHalfEntryWhereTheDiskIsFull) {
  const pid_t child = ::fork();
  if (child == 0) { // as a full disk does: a write that ends short
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100, 100};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ObjectCache cache(folder_.string(), 1 << 20);
    cache.store(key_of(1), std::string(1000, 'x'));
    ::_exit(cache.counts().stored == 0 ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_THAT(entries(), ::testing::IsEmpty());
}

TEST_F(ObjectCacheTest, MakesItsFolderForThisUserAlone) {
  ObjectCache cache((folder_ / "a" / "b").string(), 1 << 20);
  cache.store(key_of(1), "one");
  struct stat facts{};
  ASSERT_EQ(::stat((folder_ / "a" / "b").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0700u);
}

TEST_F(ObjectCacheTest, StaysWithinItsLimitAndKeepsWhatIsUsed) {
  const uint64_t limit = 64 * 1024;
  const std::string payload(1000, 'x');
  ObjectCache cache(folder_.string(), limit);
  cache.store(key_of(0), payload);
  uint64_t largest = 0;
  for (int i = 1; i < 256; ++i) {
    cache.store(key_of(static_cast<uint8_t>(i)), payload);
    EXPECT_TRUE(cache.find(key_of(0))) << i << ": it is used all the time";
    uint64_t sum = 0;
    for (const auto& path : entries())
      sum += std::filesystem::file_size(path);
    largest = std::max(largest, sum);
  }
  EXPECT_LE(largest, limit + limit / 16 + payload.size());
  EXPECT_GE(largest, limit - limit / 4);
  EXPECT_TRUE(cache.find(key_of(255)));
  EXPECT_FALSE(cache.find(key_of(1)));
}

TEST_F(ObjectCacheTest, TakesAwayWhatDeadProcessesLeft) {
  const std::filesystem::path old = folder_ / "00.shader.1.1.tmp", fresh = folder_ / "00.shader.1.2.tmp";
  write_bytes(old, "x");
  write_bytes(fresh, "x");
  std::filesystem::last_write_time(old, std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
  ObjectCache(folder_.string(), 1 << 20).store(key_of(1), "one");
  EXPECT_FALSE(std::filesystem::exists(old));
  EXPECT_TRUE(std::filesystem::exists(fresh));
}

TEST_F(ObjectCacheTest, ServesProcessesAndThreadsAtOnce) {
  const auto text = [](int i) { return "function height(p) return p.x * " + std::to_string(i) + " + noise(p) end"; };
  const auto work = [&] {
    bool right = true;
    const CompileOptions o = options(1 << 20);
    for (int round = 0; round < 3; ++round)
      for (int i = 0; i < 12; ++i) {
        const Compilation compiled = compile("s.lua", text(i), o);
        const float p[] = {0.5F, 0, 0};
        float result = 0;
        const void* inputs[] = {&p[0], &p[1], &p[2]};
        void* outputs[] = {&result};
        compiled.program->instantiate({}).shader->run(0, {1, inputs, outputs, nullptr, nullptr});
        right = right && std::isfinite(result) && (i == 0 || result != 0);
      }
    return right;
  };
  std::vector<pid_t> children;
  for (int i = 0; i < 2; ++i)
    if (const pid_t child = ::fork(); child == 0) {
      bool right = true;
      std::thread other([&] { right = work(); });
      const bool mine = work();
      other.join();
      ::_exit(right && mine ? 0 : 1);
    } else {
      children.push_back(child);
    }
  for (const pid_t child : children) {
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(entries().size(), 12u) << "no temporary files are left";
  const CompileOptions o = options();
  for (int i = 0; i < 12; ++i) {
    const Compilation found = compile("s.lua", text(i), o);
    EXPECT_TRUE(found.program->times().cached);
    EXPECT_EQ(shade_all(*instantiated(found), 0, 100), shade_all(*instantiated(compile("s.lua", text(i), {})), 0, 100));
  }
}

TEST(ObjectCacheFolder, FollowsTheEnvironment) {
  const auto with = [](const char* cache, const char* home) {
    cache != nullptr ? ::setenv("XDG_CACHE_HOME", cache, 1) : ::unsetenv("XDG_CACHE_HOME");
    home != nullptr ? ::setenv("HOME", home, 1) : ::unsetenv("HOME");
    return default_cache_folder();
  };
  const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "/";
  EXPECT_EQ(with("/c", "/h"), "/c/moonshade");
  EXPECT_EQ(with("relative", "/h"), "/h/.cache/moonshade");
  EXPECT_EQ(with(nullptr, "/h"), "/h/.cache/moonshade");
  EXPECT_EQ(with("", nullptr), "");
  ::setenv("HOME", home.c_str(), 1);
}

} // namespace
} // namespace moonshade
