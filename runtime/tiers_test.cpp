// Code that is made quickly and replaced by optimised code, at any moment and while threads run it; baked parameters;
// and the library's functions as calls of machine code: all of it gives the same bits.
#include "runtime/frontend.h"
#include "runtime/frontend_parts.h"
#include "runtime/shade_fixture.h"

#include <gmock/gmock.h>

#include <atomic>
#include <random>
#include <thread>

namespace moonshade {
namespace {

using namespace testing;
using ::testing::HasSubstr;

CompileOptions rich_options() {
  CompileOptions options;
  options.modules = stone_reader();
  return options;
}

TEST(Tiers, GiveTheSameBitsWheneverTheCodeIsReplaced) {
  CompileOptions options = rich_options();
  const auto optimised = instantiated(compile("rich.lua", kRichShader, options));
  std::mt19937 random(3);
  for (size_t entry = 0; entry < optimised->info().entries.size(); ++entry) {
    const Shaded expected = shade_all(*optimised, entry);
    for (int repetition = 0; repetition < 6; ++repetition) {
      options.background = std::make_shared<BackgroundCompiler>(false);
      const Compilation tiered = compile("rich.lua", kRichShader, options);
      ASSERT_TRUE(tiered.program->is_quick());
      EXPECT_TRUE(tiered.program->times().quick);
      const auto shader = instantiated(tiered);
      const size_t batch = 1 + random() % 97;
      const size_t moment = random() % (1003 / batch + 1);
      size_t done = 0;
      EXPECT_EQ(shade_batches(*shader, entry, 1003, batch,
                              [&] {
                                if (done++ == moment) EXPECT_TRUE(options.background->run_one());
                              }),
                expected)
          << "replaced before batch " << moment << " of " << batch << " points";
      EXPECT_FALSE(tiered.program->is_quick());
      EXPECT_EQ(shader->width(), optimised->width()); // which the quick code may not have had
    }
  }
}

TEST(Tiers, ReplaceCodeThatThreadsAreRunning) {
  CompileOptions options = rich_options();
  const Shaded expected = shade_all(*instantiated(compile("rich.lua", kRichShader, options)));
  options.background = std::make_shared<BackgroundCompiler>();
  const Compilation tiered = compile("rich.lua", kRichShader, options);
  const auto shader = instantiated(tiered);
  std::atomic<bool> replaced = false;
  std::vector<std::thread> threads;
  std::vector<int> wrong(2);
  for (int& count : wrong)
    threads.emplace_back([&] {
      for (bool last = false; !last;) {
        last = replaced; // once more with the optimised code
        if (shade_batches(*shader, 0, 1003, 50, [] {}) != expected) ++count;
      }
    });
  options.background->wait();
  replaced = true;
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_FALSE(tiered.program->is_quick());
  EXPECT_EQ(wrong, std::vector<int>(2));
}

TEST(Tiers, DropProgramsThatNobodyHas) {
  CompileOptions options = rich_options();
  options.background = std::make_shared<BackgroundCompiler>(false);
  compile("rich.lua", kRichShader, options);
  EXPECT_TRUE(options.background->run_one()) << "it waited; its program is gone";
  EXPECT_FALSE(options.background->run_one());
  const Compilation kept = compile("rich.lua", kRichShader, options);
  options.background = nullptr; // and with it what waits
  EXPECT_TRUE(kept.program->is_quick());
  EXPECT_EQ(shade_all(*instantiated(kept)).outputs.size(), 3u);
}

TEST(Tiers, CompileQuicklyOnlyWhatWouldBeOptimised) {
  CompileOptions options = rich_options();
  options.background = std::make_shared<BackgroundCompiler>(false);
  options.optimization = 0;
  EXPECT_FALSE(compile("rich.lua", kRichShader, options).program->is_quick());
  EXPECT_FALSE(options.background->run_one());
}

TEST(Bake, GivesTheBitsOfTheSameParameters) {
  CompileOptions options = rich_options();
  const Compilation open = compile("rich.lua", kRichShader, options);
  const std::vector<std::map<std::string, Constant>> sets = {
      {},
      {{"scale", 1.0}},
      {{"scale", 0.7}, {"count", int64_t{2}}, {"kind", std::string("steel")}},
      {{"on", false}, {"scale", int64_t{3}}},
      {{"tint", std::vector<double>{0.1, 0.2, 0.3}}, {"count", int64_t{1}}}};
  for (const Precision precision : {Precision::F32})
    for (const auto& values : sets) {
      options.precision = precision;
      options.bake = true;
      options.baked = values;
      const Compilation baked = compile("rich.lua", kRichShader, options);
      EXPECT_THAT(baked.program->info().parameters, ::testing::IsEmpty());
      const auto shader = instantiated(baked), other = instantiated(open, values);
      for (size_t entry = 0; entry < shader->info().entries.size(); ++entry)
        EXPECT_EQ(shade_all(*shader, entry), shade_all(*other, entry)) << entry;
    }
}

TEST(Bake, KeepsTheRoundingsOfF32) {
  // As a parameter, a * b + p.x is one operation; a folded product would be two roundings.
  const std::string text = "local a = param('a', 0.1)\nlocal b = param('b', 0.3)\n"
                           "function height(p) return a * b + p.x end";
  CompileOptions options;
  const auto open = instantiated(compile("a.lua", text, options));
  options.bake = true;
  EXPECT_EQ(shade_all(*instantiated(compile("a.lua", text, options))), shade_all(*open));
}

TEST(Bake, FoldsTheConstants) {
  const CheckedShader shader("a.lua", "local k = param('k', 2)\nlocal twice = k * 2\nlocal on = param('on', true)\n"
                                      "function height(p) if on then return p.x * twice end return noise(p) end");
  CompileOptions options;
  const std::string open = emit(shader, Stage::Ir, options).bytes;
  options.bake = true;
  options.baked = {{"on", false}};
  const std::string off = emit(shader, Stage::Ir, options).bytes;
  options.baked = {{"k", int64_t{3}}};
  const std::string on = emit(shader, Stage::Ir, options).bytes;
  EXPECT_THAT(open, HasSubstr("load_global"));
  for (const std::string& baked : {off, on}) {
    EXPECT_THAT(baked, ::testing::Not(HasSubstr("load_global"))) << baked;
    EXPECT_THAT(baked, ::testing::Not(HasSubstr(" if "))) << baked;
  }
  EXPECT_THAT(off, HasSubstr("noise"));
  EXPECT_THAT(on, ::testing::Not(HasSubstr("noise")));
  EXPECT_THAT(on, HasSubstr("6"));
}

TEST(Bake, RefusesValuesThatDoNotFit) {
  CompileOptions options = rich_options();
  options.bake = true;
  for (const auto& [name, value] : std::map<std::string, Constant>{{"scale", 11.0}, {"scael", 1.0}, {"on", 1.0}}) {
    options.baked = {{name, value}};
    const Compilation compilation = compile("rich.lua", kRichShader, options);
    EXPECT_EQ(compilation.program, nullptr);
    EXPECT_THAT(compilation.diagnostics, HasSubstr(name));
  }
  options.baked.clear();
  const Compilation baked = compile("rich.lua", kRichShader, options);
  EXPECT_THAT(baked.program->instantiate({{"scale", 2.0}}).error, HasSubstr("scale"));
}

/// Every level calls other functions of the library, and inlines the others.
TEST(NativeCalls, GiveTheBitsOfInlinedCode) {
  CompileOptions options = rich_options();
  options.gradients = {{"height", {"p"}}};
  for (const unsigned width : kWidths) {
    options.width = width;
    options.optimization = 3;
    const auto inlined = instantiated(compile("rich.lua", kRichShader, options));
    for (const int level : {0, 1, 2}) {
      options.optimization = level;
      const auto calling = instantiated(compile("rich.lua", kRichShader, options));
      for (size_t entry = 0; entry < calling->info().entries.size(); ++entry)
        EXPECT_EQ(shade_all(*calling, entry), shade_all(*inlined, entry)) << width << " lanes, -O" << level;
    }
  }
}

TEST(NativeCalls, AreForCodeOfThisProcessAlone) {
  const CheckedShader shader("test.lua", "function height(p) return turbulence(p, 5) + fbm(p, 4) end");
  const CompileOptions options;
  for (const Stage stage : {Stage::Llvm, Stage::Assembly})
    EXPECT_THAT(emit(shader, stage, options).bytes, ::testing::Not(HasSubstr("native_")));
}

} // namespace
} // namespace moonshade
