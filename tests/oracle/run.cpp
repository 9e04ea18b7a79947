// tests/oracle/run: generated programs, in stock Lua and compiled. What disagrees, is refused or crashes is reduced and
// written to a file. The programs run in child processes, a few hundred each, so that a crash is a finding like another
// one; a long run keeps its place and its counts in a state file and goes on from there.
#include "tests/oracle/compare.h"
#include "tests/oracle/generator.h"
#include "tests/oracle/random.h"

#include <CLI/CLI.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <mutex>
#include <thread>

namespace {

using namespace moonshade;
using namespace moonshade::oracle;

constexpr uint64_t kChunk = 200; // programs a child process

struct Settings {
  uint64_t first = 1, programs = 200;
  double seconds = std::numeric_limits<double>::infinity();
  bool draw = false, no_reduce = false;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::string out = "oracle-failures";
  uint64_t print = 0;
  std::string replay, state, reduce;
};

/// What a run has done so far; the state file is these numbers and what they are.
struct Tally {
  uint64_t next = 0, done = 0, variants = 0, points = 0, faulted = 0;
  std::array<uint64_t, 5> verdicts{}; // by Verdict
  uint64_t failures() const { return done - verdicts[0]; }
};

constexpr std::array<const char*, 5> kVerdictNames = {"agree", "refused", "differ", "broken", "crashed"};

bool read_state(const std::string& path, Tally& tally) {
  std::ifstream in(path);
  std::string name;
  if (!(in >> name >> tally.next >> name >> tally.done >> name >> tally.variants >> name >> tally.points >> name >>
        tally.faulted))
    return false;
  for (uint64_t& count : tally.verdicts)
    in >> name >> count;
  return bool(in);
}

void print_tally(std::ostream& out, const Tally& tally) {
  out << "next " << tally.next << "\nprograms " << tally.done << "\ncompilations " << tally.variants << "\npoints "
      << tally.points << "\nfaulted " << tally.faulted << "\n";
  for (size_t i = 0; i < kVerdictNames.size(); ++i)
    out << kVerdictNames[i] << " " << tally.verdicts[i] << "\n";
}

void write_state(const std::string& path, const Tally& tally) {
  if (path.empty()) return;
  {
    std::ofstream out(path + ".new");
    print_tally(out, tally);
  }
  std::filesystem::rename(path + ".new", path);
}

std::vector<Variant> variants_of(const Settings& settings, uint64_t seed) {
  std::vector<Variant> variants = all_variants();
  if (settings.draw) variants = {variants[Random(seed ^ 0x5eed).below(variants.size())]};
  return variants;
}

/// What a child tells of a program before and after it ran.
struct Message {
  uint64_t seed;
  Verdict verdict;
  bool is_begun; // nothing is known yet
  uint64_t points, faulted;
};

[[noreturn]] void run_chunk(const Settings& settings, uint64_t first, uint64_t count, int pipe) {
  for (uint64_t seed = first; seed < first + count; ++seed) {
    Message message{seed, Verdict::Crashed, true, 0, 0};
    if (write(pipe, &message, sizeof message) != sizeof message) _exit(1);
    const Outcome outcome = compare(generate_program(seed), variants_of(settings, seed), seed);
    message = {seed, outcome.verdict, false, outcome.points, outcome.faulted};
    if (write(pipe, &message, sizeof message) != sizeof message) _exit(1);
  }
  _exit(0);
}

class Run {
public:
  explicit Run(const Settings& settings) : settings_(settings) {
    tally_.next = settings.first;
    if (!settings.state.empty()) read_state(settings.state, tally_);
    end_ = settings.first + settings.programs;
  }

  const Tally& tally() const { return tally_; }

  /// Chunks until none is left. Several threads may do so; the state file counts what is done in order for one only.
  void work() {
    for (;;) {
      uint64_t first, count;
      {
        const std::lock_guard lock(mutex_);
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
        if (tally_.next >= end_ || spent.count() > settings_.seconds) return;
        first = tally_.next;
        count = std::min(kChunk, end_ - first);
        tally_.next += count;
      }
      while (count > 0) { // again after a crash
        const uint64_t done = in_child(first, count);
        first += done;
        count -= done;
      }
      const std::lock_guard lock(mutex_);
      write_state(settings_.state, tally_);
    }
  }

private:
  /// How many programs of the chunk have run: all, or up to one that crashed.
  uint64_t in_child(uint64_t first, uint64_t count) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      run_chunk(settings_, first, count, ends[1]);
    }
    close(ends[1]);
    Message message{};
    uint64_t done = 0;
    bool is_running = false;
    while (read(ends[0], &message, sizeof message) == sizeof message) {
      is_running = message.is_begun;
      if (is_running) continue;
      ++done;
      finished(message);
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (!is_running) return count;
    message.is_begun = false;
    finished(message);
    return done + 1;
  }

  void finished(const Message& message) {
    if (message.verdict != Verdict::Agrees) report(message.seed, message.verdict);
    const std::lock_guard lock(mutex_);
    ++tally_.done;
    tally_.variants += settings_.draw ? 1 : all_variants().size();
    tally_.points += message.points;
    tally_.faulted += message.faulted;
    ++tally_.verdicts[static_cast<size_t>(message.verdict)];
  }

  void report(uint64_t seed, Verdict verdict) {
    const std::string text = generate_program(seed);
    const std::vector<Variant> variants = variants_of(settings_, seed);
    const std::string detail = verdict == Verdict::Crashed ? "crashed, " + name_of(variants[0]) + " or another one"
                                                           : compare(text, variants, seed).detail;
    const std::string reduced = settings_.no_reduce ? text : reduce(text, variants, seed, verdict);
    const std::lock_guard lock(mutex_);
    std::filesystem::create_directories(settings_.out);
    std::ofstream(settings_.out + "/" + std::to_string(seed) + ".lua")
        << "-- seed " << seed << ": " << detail.substr(0, detail.find('\n')) << "\n"
        << reduced;
    std::cout << "seed " << seed << ", " << kVerdictNames[size_t(verdict)] << ": " << detail << "\n"
              << reduced << std::endl;
  }

  const Settings& settings_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  uint64_t end_ = 0;
  std::mutex mutex_;
  Tally tally_;
};

/// The shortest form of a file that fails, in the first variant in which it does.
int reduce_file(const std::string& path) {
  std::ifstream in(path);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  for (const Variant& variant : all_variants()) {
    const Verdict verdict = verdict_in_child(text, {variant}, 1);
    if (verdict == Verdict::Agrees) continue;
    const std::string shortest = reduce(text, {variant}, 1, verdict);
    std::cout << "-- " << name_of(variant) << ": " << kVerdictNames[size_t(verdict)] << "\n" << shortest;
    if (verdict != Verdict::Crashed) std::cout << "-- " << compare(shortest, {variant}, 1).detail << std::endl;
    return 1;
  }
  std::cout << "agrees" << std::endl;
  return 0;
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
  app.add_option("--programs", settings.programs, "how many programs, with those of the state file");
  app.add_option("--seed", settings.first, "seed of the first; the others follow it");
  app.add_option("--seconds", settings.seconds, "begin no more programs after this time");
  app.add_option("--state", settings.state, "a file that keeps place and counts: the same command goes on from there");
  app.add_flag("--draw", settings.draw, "each program in one variant drawn at random, not in all");
  app.add_option("--threads", settings.threads)->check(CLI::Range(1, 256));
  app.add_option("--out", settings.out, "folder for the programs that failed");
  app.add_flag("--no-reduce", settings.no_reduce);
  app.add_option("--print", settings.print, "only print the program of this seed");
  app.add_option("--replay", settings.replay, "instead of generated programs: those of this folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--reduce", settings.reduce, "instead of generated programs: shorten this one, which fails")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  if (!settings.reduce.empty()) return reduce_file(settings.reduce);
  if (!settings.replay.empty()) return replay(settings.replay);
  if (settings.print) {
    std::cout << generate_program(settings.print);
    return 0;
  }
  Run run(settings);
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < settings.threads; ++i)
    threads.emplace_back([&] { run.work(); });
  for (std::thread& thread : threads)
    thread.join();
  std::cout << "seeds " << settings.first << " to " << run.tally().next - 1 << "\n";
  print_tally(std::cout, run.tally());
  return run.tally().failures() ? 1 : 0;
}
