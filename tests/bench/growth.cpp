// What growth costs, as tables in Markdown (docs/compile-time.md):
//
//     growth sources    time and memory to compile by lines of source, for several shapes of it
//     growth shaders    many different shaders in one process
//     growth batches    a call by the size of its batch
//
// Every row of `sources` is a process of its own, so that its memory is its own.
#include "runtime/shader.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <time.h>
#include <unistd.h>
#include <vector>

namespace {

using namespace moonshade;

double processor_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

double wall_nanoseconds() {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Resident bytes of this process, or 0.
double resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double size = 0, resident = 0;
  in >> size >> resident;
  return resident * double(::sysconf(_SC_PAGESIZE));
}

// ---- sources ------------------------------------------------------------------------------------------------------

struct Source {
  std::string text;
  std::map<std::string, std::string> modules;
};

std::string number(int i) { return std::to_string(i); }

/// Functions of four lines, each called once, ten by another.
Source many_functions(int lines) {
  std::string text, calls;
  const int count = lines / 5;
  for (int i = 0; i < count; ++i) {
    const std::string name = "f" + number(i);
    text += "function " + name + "(x)\n  local y = x * " + number(i + 2) + " + 0.5\n  return y * y - x\nend\n";
    calls += "  s = s + " + name + "(p.x)\n";
  }
  return {text + "function height(p)\n  local s = 0.0\n" + calls + "  return s\nend\n", {}};
}

Source long_function(int lines) {
  std::string text = "function height(p)\n  local s, t = p.x, p.y\n";
  for (int i = 0; i < lines - 4; ++i)
    text += i % 2 == 0 ? "  s = s * 0.5 + t * " + number(i) + "\n" : "  t = t - s * p.z\n";
  return {text + "  return s + t\nend\n", {}};
}

Source long_expressions(int lines) {
  std::string text = "function height(p)\n  local s = 0.0\n";
  for (int i = 0; i < lines / 100; ++i) {
    text += "  s = s * 0.5";
    for (int j = 0; j < 99; ++j)
      text += "\n    + p.x * " + number(j + i) + "." + number(j % 10);
    text += "\n";
  }
  return {text + "  return s\nend\n", {}};
}

/// One table of many rows, read at an index that depends on the point.
Source tables(int lines) {
  std::string text = "local rows = {\n";
  for (int i = 0; i < lines - 6; ++i)
    text += "  { a = " + number(i) + ".5, b = vec3(" + number(i) + ", 1, 2) },\n";
  return {text + "}\nfunction height(p)\n  local i = math.floor(abs(p.x)) % #rows + 1\n"
                 "  return rows[i].a + rows[i].b.y\nend\n",
          {}};
}

Source modules(int lines) {
  const int count = std::max(1, lines / 400);
  Source source;
  std::string calls;
  for (int m = 0; m < count; ++m) {
    std::string module = "return {\n";
    for (int i = 0; i < 99; ++i)
      module +=
          "  f" + number(i) + " = function(x)\n    local y = x * " + number(i + m) + "\n    return y - x\n  end,\n";
    source.modules["m" + number(m)] = module + "}\n";
    source.text += "local m" + number(m) + " = require \"m" + number(m) + "\"\n";
    for (int i = 0; i < 99; ++i)
      calls += "  s = s + m" + number(m) + ".f" + number(i) + "(p.x)\n";
  }
  source.text += "function height(p)\n  local s = 0.0\n" + calls + "  return s\nend\n";
  return source;
}

Source entries(int lines) {
  Source source;
  for (int i = 0; i < lines / 20; ++i) {
    source.text += "function e" + number(i) + "(p)\n  local s = p.x\n";
    for (int j = 0; j < 16; ++j)
      source.text += "  s = s * p.y + " + number(i * j) + "\n";
    source.text += "  return s\nend\n";
  }
  return source;
}

const std::vector<std::pair<const char*, Source (*)(int)>> kShapes = {{"many functions", many_functions},
                                                                      {"one long function", long_function},
                                                                      {"long expressions", long_expressions},
                                                                      {"a table of many rows", tables},
                                                                      {"many modules", modules},
                                                                      {"many entries", entries}};

struct Cost {
  double milliseconds = 0, megabytes = 0;
  bool compiled = false;
};

/// Compiles in a child process.
Cost cost_of(const Source& source) {
  int pipe_ends[2];
  if (::pipe(pipe_ends) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    CompileOptions options;
    options.modules = [&](const std::string& name) {
      const auto found = source.modules.find(name);
      return found != source.modules.end() ? ModuleText{name + ".lua", found->second, ""} : ModuleText{"", "", "none"};
    };
    compile("warm.lua", "function height(p) return noise(p) end", {}); // what a process needs once
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    const double begin = processor_milliseconds();
    const Compilation compilation = compile("grown.lua", source.text, options);
    Cost cost;
    cost.milliseconds = processor_milliseconds() - begin;
    ::getrusage(RUSAGE_SELF, &after);
    cost.megabytes = double(after.ru_maxrss - before.ru_maxrss) / 1024;
    cost.compiled = compilation.program != nullptr;
    if (!cost.compiled) std::fprintf(stderr, "%s", compilation.diagnostics.substr(0, 400).c_str());
    const bool told = ::write(pipe_ends[1], &cost, sizeof cost) == sizeof cost;
    ::_exit(told ? 0 : 1);
  }
  ::close(pipe_ends[1]);
  Cost cost;
  if (::read(pipe_ends[0], &cost, sizeof cost) != sizeof cost) cost = {};
  ::close(pipe_ends[0]);
  ::waitpid(child, nullptr, 0);
  return cost;
}

int measure_sources() {
  std::printf("| shape | lines | ms | µs a line | MB | KB a line |\n|---|---|---|---|---|---|\n");
  for (const auto& [name, make] : kShapes)
    for (const int lines : {1250, 2500, 5000, 10000, 20000}) {
      const Source source = make(lines);
      long actual = std::count(source.text.begin(), source.text.end(), '\n');
      for (const auto& [module, text] : source.modules)
        actual += std::count(text.begin(), text.end(), '\n');
      const Cost cost = cost_of(source);
      if (!cost.compiled) {
        std::printf("| %s | %ld | refused | | | |\n", name, actual);
        continue;
      }
      std::printf("| %s | %ld | %.1f | %.1f | %.1f | %.2f |\n", name, actual, cost.milliseconds,
                  cost.milliseconds * 1e3 / double(actual), cost.megabytes, cost.megabytes * 1024 / double(actual));
      std::fflush(stdout);
    }
  return 0;
}

// ---- shaders ------------------------------------------------------------------------------------------------------

int measure_shaders() {
  const auto text = [](int i) {
    return "local scale = param(\"scale\", " + number(i) +
           ".5)\nfunction color(p)\n  local n = noise(p * scale)\n"
           "  return mix(rgb(1, 0." +
           number(i % 10) + ", 0), rgb(0, 0, 1), smoothstep(0, 1, n)) * " + number(i) +
           "\nend\n"
           "function height(p) return fbm(p * " +
           number(i + 1) + ", 4) end\n";
  };
  constexpr int kCount = 1000, kPart = 100;
  std::vector<std::shared_ptr<const Program>> kept;
  std::printf("| shaders | ms each | resident KB each |\n|---|---|---|\n");
  compile("warm.lua", text(kCount), {});
  double total = 0;
  const double first = resident_bytes();
  for (int part = 0; part < kCount / kPart; ++part) {
    const double resident = resident_bytes(), begin = processor_milliseconds();
    for (int i = 0; i < kPart; ++i)
      kept.push_back(compile("many.lua", text(part * kPart + i), {}).program);
    const double milliseconds = processor_milliseconds() - begin;
    total += milliseconds;
    std::printf("| %d to %d | %.2f | %.0f |\n", part * kPart + 1, (part + 1) * kPart, milliseconds / kPart,
                (resident_bytes() - resident) / kPart / 1024);
  }
  std::printf("| all | %.2f | %.0f |\n", total / kCount, (resident_bytes() - first) / kCount / 1024);
  return std::ranges::count(kept, nullptr) == 0 ? 0 : 1;
}

// ---- batches ------------------------------------------------------------------------------------------------------

struct Workload {
  const char* name;
  const char* text;
};
constexpr Workload kWorkloads[] = {
    {"a product", "function height(p) return p.x * p.y end"},
    {"noise", "function height(p) return noise(p) end"},
    {"marble", "function height(p)\n  local s = 0.0\n  for i = 0, 5 do s = s + abs(noise(p * 2^i)) / 2^i end\n"
               "  return sin(p.x + s)\nend"}};

/// Nanoseconds of a call, the least of several measurements.
double call_nanoseconds(const Shader& shader, uint64_t count, unsigned threads) {
  std::vector<float> in(3 * count), out(count);
  for (size_t i = 0; i < in.size(); ++i)
    in[i] = float(i % 1000) * 0.01F;
  const double points = 4e5;
  const auto calls = std::max<uint64_t>(1, uint64_t(points / double(count)));
  const auto part = [&](unsigned thread) {
    const uint64_t begin = count * thread / threads, end = count * (thread + 1) / threads;
    const void* inputs[] = {&in[begin], &in[count + begin], &in[2 * count + begin]};
    void* outputs[] = {&out[begin]};
    for (uint64_t i = 0; i < calls; ++i)
      shader.run(0, {end - begin, inputs, outputs, nullptr, nullptr});
  };
  double best = INFINITY;
  for (int repetition = 0; repetition < 7; ++repetition) {
    const double begin = wall_nanoseconds();
    std::vector<std::thread> others;
    for (unsigned thread = 1; thread < threads; ++thread)
      others.emplace_back(part, thread);
    part(0);
    for (std::thread& other : others)
      other.join();
    best = std::min(best, (wall_nanoseconds() - begin) / double(calls));
  }
  return best;
}

int measure_batches() {
  std::printf("| workload | threads | points a call | ns a call | million points a second | of the best |\n"
              "|---|---|---|---|---|---|\n");
  for (const Workload& workload : kWorkloads) {
    const Compilation compilation = compile("batch.lua", workload.text, {});
    if (!compilation.program) return std::fprintf(stderr, "%s", compilation.diagnostics.c_str()), 1;
    const auto shader = compilation.program->instantiate({}).shader;
    for (const unsigned threads : {1u, 2u}) {
      std::vector<std::pair<uint64_t, double>> rows;
      for (const uint64_t count : {1, 4, 16, 64, 256, 1024, 4096, 16384, 65536, 262144, 1000000})
        if (count >= threads) rows.emplace_back(count, call_nanoseconds(*shader, count, threads));
      double best = 0;
      for (const auto& [count, nanoseconds] : rows)
        best = std::max(best, double(count) / nanoseconds);
      for (const auto& [count, nanoseconds] : rows)
        std::printf("| %s | %u | %llu | %.1f | %.1f | %.0f %% |\n", workload.name, threads,
                    static_cast<unsigned long long>(count), nanoseconds, double(count) / nanoseconds * 1e3,
                    double(count) / nanoseconds / best * 100);
    }
  }
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what == "sources") return measure_sources();
  if (what == "shaders") return measure_shaders();
  if (what == "batches") return measure_batches();
  std::fprintf(stderr, "usage: growth sources|shaders|batches\n");
  return 2;
}
