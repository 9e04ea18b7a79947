// tests/oracle/run: generated programs, in stock Lua and compiled. A failure is reduced and written to a file.
#include "tests/oracle/compare.h"
#include "tests/oracle/generator.h"
#include "tests/oracle/random.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <thread>

namespace {

using namespace moonshade;
using namespace moonshade::oracle;

struct Settings {
  uint64_t first = 1, programs = 200;
  bool draw = false, no_reduce = false;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::string out = "oracle-failures";
  uint64_t print = 0;
  std::string replay;
};

struct Tally {
  std::mutex mutex;
  uint64_t done = 0, failed = 0, variants = 0;
};

void report_failure(const Settings& settings, uint64_t seed, const std::string& text,
                    const std::vector<Variant>& variants, const Outcome& outcome, Tally& tally) {
  const std::string reduced = settings.no_reduce ? text : reduce(text, variants, seed, outcome.verdict);
  const std::lock_guard lock(tally.mutex);
  ++tally.failed;
  std::filesystem::create_directories(settings.out);
  const std::string name = settings.out + "/" + std::to_string(seed);
  std::ofstream(name + ".lua") << "-- seed " << seed << ": " << outcome.detail.substr(0, outcome.detail.find('\n'))
                               << "\n"
                               << reduced;
  std::cout << "seed " << seed << ": " << outcome.detail << "\n" << reduced << std::endl;
}

void work(const Settings& settings, std::atomic<uint64_t>& next, Tally& tally) {
  for (;;) {
    const uint64_t index = next++;
    if (index >= settings.programs) return;
    const uint64_t seed = settings.first + index;
    const std::string text = generate_program(seed);
    std::vector<Variant> variants = all_variants();
    if (settings.draw) variants = {variants[Random(seed ^ 0x5eed).below(variants.size())]};
    const Outcome outcome = compare(text, variants, seed);
    if (outcome.verdict != Verdict::Agrees) report_failure(settings, seed, text, variants, outcome, tally);
    const std::lock_guard lock(tally.mutex);
    ++tally.done;
    tally.variants += variants.size();
    if (tally.done % 1000 == 0) std::cerr << tally.done << " programs, " << tally.failed << " failures" << std::endl;
  }
}

/// Runs each program of a folder in every variant: those that once failed.
int replay(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".lua") files.push_back(entry.path());
  std::ranges::sort(files);
  uint64_t failed = 0;
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    const Outcome outcome = compare(text, all_variants(), 1);
    if (outcome.verdict == Verdict::Agrees) continue;
    ++failed;
    std::cout << file.string() << ": " << outcome.detail << std::endl;
  }
  std::cout << files.size() << " programs, " << failed << " failures" << std::endl;
  return failed || files.empty() ? 1 : 0;
}

} // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Runs generated shaders in stock Lua and compiled, and compares the results bit for bit.");
  app.add_option("--programs", settings.programs, "how many programs");
  app.add_option("--seed", settings.first, "seed of the first; the others follow it");
  app.add_flag("--draw", settings.draw, "each program in one variant drawn at random, not in all");
  app.add_flag("--no-reduce", settings.no_reduce, "write failures as they are");
  app.add_option("--threads", settings.threads, "worker threads")->check(CLI::Range(1, 1024));
  app.add_option("--out", settings.out, "folder for failing programs");
  app.add_option("--print", settings.print, "only print the program of this seed");
  app.add_option("--replay", settings.replay, "instead of generated programs: those of this folder")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  if (!settings.replay.empty()) return replay(settings.replay);
  if (settings.print) {
    std::cout << generate_program(settings.print);
    return 0;
  }
  std::atomic<uint64_t> next = 0;
  Tally tally;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < settings.threads; ++i)
    threads.emplace_back([&] { work(settings, next, tally); });
  for (std::thread& thread : threads)
    thread.join();
  std::cout << tally.done << " programs (seeds " << settings.first << " to " << settings.first + settings.programs - 1
            << "), " << tally.variants << " compilations, " << tally.failed << " failures" << std::endl;
  return tally.failed ? 1 : 0;
}
