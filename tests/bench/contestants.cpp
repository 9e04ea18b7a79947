// Making, comparing and timing the implementations of a workload (contestants.h).
#include "tests/bench/contestants.h"

#include "compiler/codegen/stack_place.h"
#include "runtime/interpret.h"
#include "tests/bench/hand/kernels.h"
#include "tools/support/files.h"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <sstream>

namespace moonshade::bench {

namespace {

/// Seconds that this thread has computed: what other programs take from it does not count.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// Results of a contestant, a column for each component: those that are compared, and behind them a batch for timing.
template <class Number> struct Columns {
  std::vector<std::vector<Number>> columns;
  explicit Columns(unsigned outputs) : columns(outputs, std::vector<Number>(Grid::count + Grid::batch)) {}
};

template <class Number> void keep_results(Contestant& contestant, std::shared_ptr<Columns<Number>> results) {
  contestant.result = [results = std::move(results)](unsigned component, size_t row) {
    return static_cast<double>(results->columns[component][row]);
  };
}

/// Shaders, interpreted or compiled, over the grid's points as they take them.
template <class Number>
Contestant of_shader(std::shared_ptr<const Shader> shader, const Workload& workload,
                     const std::array<std::vector<Number>, 3>& points) {
  Contestant contestant;
  contestant.width = shader->width();
  const std::vector<EntryInfo>& entries = shader->info().entries;
  const auto entry =
      static_cast<size_t>(std::ranges::find(entries, workload.entry, &EntryInfo::name) - entries.begin());
  auto results = std::make_shared<Columns<Number>>(workload.outputs);
  contestant.run = [shader = std::move(shader), entry, results, &points](size_t begin, size_t to) {
    const void* inputs[] = {points[0].data() + begin, points[1].data() + begin, points[2].data() + begin};
    void* outputs[3] = {};
    for (size_t i = 0; i < results->columns.size(); ++i)
      outputs[i] = results->columns[i].data() + to;
    Batch batch;
    batch.count = Grid::batch;
    batch.inputs = inputs;
    batch.outputs = outputs;
    shader->run(entry, batch);
  };
  keep_results(contestant, std::move(results));
  return contestant;
}

/// Where the stack should be for a function to be fast, as compiled shaders have it by themselves.
size_t best_stack(const std::function<void(size_t)>& run_at) {
  double least = std::numeric_limits<double>::infinity();
  size_t best = 0;
  for (int look = 0; look < 3; ++look)
    for (size_t place = 0; place < codegen::kPlaces; place += 256) {
      const double start = thread_seconds();
      for (int k = 0; k < 8; ++k)
        run_at(place);
      const double seconds = thread_seconds() - start;
      if (seconds < least) least = seconds, best = place;
    }
  return best;
}

Contestant by_hand(hand::Kernel kernel, const Workload& workload, const Grid& grid) {
  Contestant contestant;
  auto results = std::make_shared<Columns<float>>(workload.outputs);
  const auto run_at = [kernel, results, &grid](size_t stack, size_t begin, size_t to) {
    const float* inputs[] = {grid.p[0].data() + begin, grid.p[1].data() + begin, grid.p[2].data() + begin};
    float* outputs[3] = {};
    for (size_t i = 0; i < results->columns.size(); ++i)
      outputs[i] = results->columns[i].data() + to;
    codegen::call_with_stack_at(stack, [&] { kernel(inputs, outputs, Grid::batch); });
  };
  const size_t stack = best_stack([&](size_t place) { run_at(place, 0, Grid::count); });
  contestant.run = [run_at, stack](size_t begin, size_t to) { run_at(stack, begin, to); };
  keep_results(contestant, std::move(results));
  return contestant;
}

struct Maker {
  const Workload& workload;
  const Grid& grid;
  const CheckedShader& shader;
  Lineup& lineup;

  void stock_lua(const std::array<std::vector<double>, 3>& points) const {
    InterpretOptions options;
    options.count_steps = false;
    options.step_limit = 0;
    const Instantiation instance = interpret(shader, {}, options);
    if (!instance.error.empty()) lineup.error = instance.error;
    if (!lineup.error.empty()) return;
    Contestant contestant = of_shader<double>(instance.shader, workload, points);
    contestant.name = "stock Lua";
    contestant.kind = Kind::StockLua;
    lineup.contestants.push_back(std::move(contestant));
  }

  /// width 0: as the compiler chooses.
  void compiled(unsigned width, const char* cpu) const {
    if (!lineup.error.empty()) return;
    const bool native = std::string(cpu) == "native";
    CompileOptions options;
    options.width = width;
    options.optimization = 3; // the code that a renderer ends up with
    options.cpu = cpu;
    options.entries = {workload.entry};
    const double start = thread_seconds();
    const Compilation compilation = compile(shader, options);
    const double milliseconds = (thread_seconds() - start) * 1e3;
    lineup.error = compilation.program ? "" : compilation.diagnostics;
    if (!lineup.error.empty()) return;
    const Instantiation instance = compilation.program->instantiate({});
    lineup.error = instance.error;
    if (!lineup.error.empty()) return;
    if (width == 0) {
      for (Contestant& contestant : lineup.contestants)
        contestant.chosen |= contestant.kind == Kind::Compiled && contestant.width == instance.shader->width();
      return;
    }
    Contestant contestant = of_shader<float>(instance.shader, workload, grid.p);
    contestant.name = std::string(native ? "compiled " : "compiled AVX2 ") + std::to_string(contestant.width);
    contestant.kind = native ? Kind::Compiled : Kind::CompiledAvx2;
    contestant.compile_ms = milliseconds;
    lineup.contestants.push_back(std::move(contestant));
  }

  void by_hand(const char* name, Kind kind, unsigned width, hand::Kernel kernel) const {
    if (kernel == nullptr) return;
    Contestant contestant = bench::by_hand(kernel, workload, grid);
    contestant.name = name;
    contestant.kind = kind;
    contestant.width = width;
    lineup.contestants.push_back(std::move(contestant));
  }
};

const std::array<std::vector<double>, 3>& in_double(const Grid& grid) {
  static const std::array<std::vector<double>, 3> points = [&] {
    std::array<std::vector<double>, 3> result;
    for (size_t i = 0; i < 3; ++i)
      result[i].assign(grid.p[i].begin(), grid.p[i].end());
    return result;
  }();
  return points;
}

double share(std::vector<double> sorted, double part) {
  std::ranges::sort(sorted);
  return sorted[static_cast<size_t>(std::lround(part * static_cast<double>(sorted.size() - 1)))];
}

} // namespace

double Contestant::median() const { return share(seconds, 0.5); }
double Contestant::spread() const { return (share(seconds, 0.75) - share(seconds, 0.25)) / 2 / median(); }

Lineup line_up(const Workload& workload, const Grid& grid) {
  Lineup lineup;
  const std::string path = std::string(MOONSHADE_BENCH_SHADERS "/") + workload.shader;
  const tools::FileText file = tools::read_file(path);
  if (!file.error.empty()) {
    lineup.error = path + ": " + file.error;
    return lineup;
  }
  const CheckedShader shader(path, file.text, {workload.entry});
  if (!shader.ok()) {
    std::ostringstream text;
    print_text(shader.diagnostics(), shader.sources(), text, false);
    lineup.error = text.str();
    return lineup;
  }
  const Maker make{workload, grid, shader, lineup};
  make.stock_lua(in_double(grid));
  for (const unsigned width : {1U, 4U, 8U, 16U, 32U})
    make.compiled(width, "native");
  make.compiled(0, "native");
  if (__builtin_cpu_supports("avx2") != 0)
    for (const unsigned width : {8U, 16U})
      make.compiled(width, "haswell");
  make.by_hand("hand 1", Kind::Hand, 1, hand::scalar_kernel(workload.id));
  if (__builtin_cpu_supports("avx2") != 0)
    make.by_hand("hand AVX2 8", Kind::HandAvx2, 8, hand::avx2_kernel(workload.id));
  make.by_hand("hand 16", Kind::Hand, 16, hand::kernel_16(workload.id));
  make.by_hand("hand 32", Kind::Hand, 32, hand::kernel_32(workload.id));
  return lineup;
}

void compare(const Workload& workload, Lineup& lineup) {
  for (Contestant& contestant : lineup.contestants)
    for (size_t begin = 0; begin < Grid::count; begin += Grid::batch)
      contestant.run(begin, begin);
  const Contestant& reference = lineup.contestants.front();
  for (Contestant& contestant : lineup.contestants) {
    for (size_t row = 0; row < Grid::count; ++row) {
      bool differs = false;
      for (unsigned component = 0; component < workload.outputs; ++component) {
        const double expected = reference.result(component, row);
        const double difference = std::fabs(contestant.result(component, row) - expected);
        differs |= !(difference <= workload.tolerance * std::max(1.0, std::fabs(expected)));
        contestant.max_difference = std::max(contestant.max_difference, difference);
      }
      contestant.differing += differs ? 1 : 0;
    }
    contestant.agrees = static_cast<double>(contestant.differing) <= workload.share * Grid::count;
  }
}

void repeat(Lineup& lineup, double least_seconds) {
  for (Contestant& contestant : lineup.contestants) {
    size_t begin = 0, points = 0;
    const double start = thread_seconds();
    double seconds = 0;
    do {
      // Half the grid between two looks at the clock, but for what is slow.
      const size_t batches = contestant.kind == Kind::StockLua ? 1 : 8;
      for (size_t i = 0; i < batches; ++i) {
        contestant.run(begin, Grid::count);
        begin = (begin + Grid::batch) % Grid::count;
      }
      points += batches * Grid::batch;
      seconds = thread_seconds() - start;
    } while (seconds < least_seconds || begin != 0);
    contestant.seconds.push_back(seconds / static_cast<double>(points));
  }
}

bool add_luajit(const Workload& workload, Lineup& lineup, unsigned repetitions, double least_seconds) {
  const std::string command = "luajit '" MOONSHADE_BENCH_FOLDER "/luajit.lua' '" MOONSHADE_BENCH_NOISE "' " +
                              std::string(workload.id) + " " + std::to_string(repetitions) + " " +
                              std::to_string(least_seconds) + " 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c): a measurement, run by hand
  if (pipe == nullptr) return false;
  Contestant contestant;
  contestant.name = "LuaJIT";
  contestant.kind = Kind::LuaJit;
  auto results = std::make_shared<Columns<double>>(workload.outputs);
  size_t samples = 0;
  char line[256];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    double seconds = 0;
    size_t row = 0;
    if (word == "seconds" && words >> seconds) contestant.seconds.push_back(seconds);
    if (word != "value" || !(words >> row) || row >= Grid::count) continue;
    const Contestant& reference = lineup.contestants.front();
    bool differs = false;
    for (unsigned component = 0; component < workload.outputs; ++component) {
      double value = NAN;
      words >> value;
      const double expected = reference.result(component, row);
      const double difference = std::fabs(value - expected);
      differs |= !(difference <= workload.tolerance * std::max(1.0, std::fabs(expected)));
      contestant.max_difference = std::max(contestant.max_difference, difference);
    }
    contestant.differing += differs ? 1 : 0;
    ++samples;
  }
  const bool ended_well = pclose(pipe) == 0 && contestant.seconds.size() == repetitions && samples > 0;
  contestant.agrees = static_cast<double>(contestant.differing) <= workload.share * static_cast<double>(samples);
  if (ended_well) lineup.contestants.push_back(std::move(contestant));
  return ended_well;
}

} // namespace moonshade::bench
