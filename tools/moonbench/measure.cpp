// Measuring one entry in every mode. Repetitions are interleaved, so that a machine that gets slower or faster
// meanwhile does so for all modes, and the best counts: noise only ever adds time.
#include "tools/moonbench/measure.h"

#include "runtime/interpret.h"
#include "tools/moonbench/inputs.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

namespace moonshade::moonbench {

namespace {

using Clock = std::chrono::steady_clock;
using tools::Points;

/// A measurement lasts at least this long, so that the clock and the start of threads do not count.
constexpr double kShortest = 0.02;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// One mode of one entry.
struct Contestant {
  Row row;
  std::shared_ptr<const Shader> shader;
  size_t entry = 0; ///< its index in this shader
  std::unique_ptr<Points> points;
  unsigned calls = 1;     ///< of a measurement
  double best = INFINITY; ///< seconds for all points once
};

/// Every point once; contiguous parts on `threads` threads.
FaultReport shade(Contestant& contestant, unsigned threads) {
  const size_t count = contestant.points->capacity();
  const size_t part = (count + threads - 1) / threads;
  std::vector<FaultReport> reports(threads);
  const auto work = [&](unsigned thread) {
    const size_t begin = std::min(count, thread * part), end = std::min(count, begin + part);
    if (begin < end)
      reports[thread] = contestant.points->run_range(*contestant.shader, contestant.entry, begin, end - begin);
  };
  std::vector<std::thread> pool;
  for (unsigned thread = 1; thread < threads; ++thread)
    pool.emplace_back(work, thread);
  work(0);
  for (std::thread& thread : pool)
    thread.join();
  FaultReport total;
  for (const FaultReport& report : reports)
    total.count += report.count;
  return total;
}

double time_once(Contestant& contestant, unsigned threads) {
  const auto start = Clock::now();
  const double thread_start = thread_seconds();
  for (unsigned call = 0; call < contestant.calls; ++call)
    shade(contestant, threads);
  const double seconds = threads == 1 ? thread_seconds() - thread_start : seconds_since(start);
  return seconds / contestant.calls;
}

// ---- making the contestants ----------------------------------------------------------------------------------------

Contestant interpreted(const CheckedShader& shader, const InterpretOptions& options, std::string& error) {
  Contestant contestant;
  const double start = thread_seconds();
  Instantiation instance = interpret(shader, {}, options);
  contestant.row.mode = "lua";
  contestant.row.compile_ms = (thread_seconds() - start) * 1e3;
  contestant.shader = instance.shader;
  error = instance.error;
  return contestant;
}

Contestant compiled(const CheckedShader& shader, const std::string& entry, const Options& options, unsigned width,
                    std::string& error) {
  Contestant contestant;
  CompileOptions compile_options;
  compile_options.precision = options.precision;
  compile_options.width = width;
  compile_options.entries = {entry};
  compile_options.images = options.images;
  const double start = thread_seconds();
  const Compilation compilation = compile(shader, compile_options);
  contestant.row.mode = width == 1 ? "scalar" : "simd";
  contestant.row.compile_ms = (thread_seconds() - start) * 1e3;
  if (!compilation.program) {
    error = compilation.diagnostics;
    return contestant;
  }
  contestant.row.width = compilation.program->width();
  Instantiation instance = compilation.program->instantiate({});
  contestant.shader = instance.shader;
  error = instance.error;
  return contestant;
}

/// Finds the entry, makes the points, warms up and finds how many calls make a measurement.
void prepare(Contestant& contestant, const std::string& entry, const Options& options) {
  const auto& entries = contestant.shader->info().entries;
  contestant.entry = size_t(std::find_if(entries.begin(), entries.end(),
                                         [&](const EntryInfo& candidate) { return candidate.name == entry; }) -
                            entries.begin());
  contestant.points =
      std::make_unique<Points>(entries[contestant.entry], contestant.shader->precision(), options.points);
  fill_inputs(entries[contestant.entry], *contestant.points);
  contestant.row.faults = shade(contestant, options.threads).count;
  const double once = time_once(contestant, options.threads);
  contestant.calls = unsigned(std::clamp(std::ceil(kShortest / std::max(once, 1e-9)), 1.0, 1e6));
}

// ---- comparing -----------------------------------------------------------------------------------------------------

bool same_bits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}

struct Difference {
  double amount = 0;
  bool tolerable = true;
};

/// Of one component; `exact` is stock Lua's value.
Difference difference(ValueType type, tools::Scalar exact, tools::Scalar value, Precision precision) {
  if (type == ValueType::Boolean) return {exact.boolean == value.boolean ? 0.0 : 1.0, exact.boolean == value.boolean};
  if (type == ValueType::Integer) {
    const double amount = std::fabs(double(exact.integer) - double(value.integer));
    return {amount,
            exact.integer == value.integer ||
                (precision == Precision::F32 && amount <= 1e-3 * std::max(1.0, std::fabs(double(exact.integer))))};
  }
  if (same_bits(exact.number, value.number)) return {};
  const double amount = std::fabs(exact.number - value.number);
  const bool close = precision == Precision::F32 && amount <= 1e-3 * std::max(1.0, std::fabs(exact.number));
  return {std::isfinite(amount) ? amount : 0, close};
}

void compare(const Contestant& lua, Contestant& other, Precision precision) {
  const Points& exact = *lua.points;
  const Points& values = *other.points;
  for (size_t row = 0; row < exact.capacity(); ++row) {
    bool tolerable = exact.fault(row) == values.fault(row);
    for (size_t i = 0; tolerable && i < exact.output_count(); ++i) {
      const Difference d = difference(exact.output_type(i), exact.output(i, row), values.output(i, row), precision);
      other.row.max_difference = std::max(other.row.max_difference, d.amount);
      tolerable = tolerable && d.tolerable;
    }
    other.row.differing_points += !tolerable;
  }
  const uint64_t allowed = precision == Precision::F32 ? exact.capacity() / 1000 : 0;
  other.row.agrees = other.row.differing_points <= allowed;
}

} // namespace

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

Measurement measure(const CheckedShader& shader, size_t entry_index, const Options& options) {
  Measurement result;
  const std::string entry = shader.info().entries[entry_index].name;
  std::vector<Contestant> contestants;
  const auto add = [&](Contestant contestant) {
    if (result.error.empty()) prepare(contestant, entry, options);
    contestants.push_back(std::move(contestant));
    return result.error.empty();
  };
  // With counted steps the points are known to end; the measured state then does without any guard.
  Contestant reference = interpreted(shader, {.count_steps = true, .images = options.images}, result.error);
  if (!result.error.empty()) return result;
  reference.calls = 1;
  prepare(reference, entry, options);
  const bool ends = [&] {
    for (size_t row = 0; row < options.points; ++row)
      if (reference.points->fault(row) == FaultCode::StepLimit) return false;
    return true;
  }();
  const InterpretOptions plain{.count_steps = false, .step_limit = ends ? 0u : 1'000'000u, .images = options.images};
  if (!add(interpreted(shader, plain, result.error))) return result;
  if (!add(compiled(shader, entry, options, 1, result.error))) return result;
  if (options.width != 1 && !add(compiled(shader, entry, options, options.width, result.error))) return result;

  for (unsigned repetition = 0; repetition < options.repetitions; ++repetition)
    for (Contestant& contestant : contestants)
      contestant.best = std::min(contestant.best, time_once(contestant, options.threads));
  for (Contestant& contestant : contestants) {
    if (contestant.row.mode != "lua") compare(reference, contestant, options.precision);
    contestant.row.entry = entry;
    contestant.row.mpoints_per_second = double(options.points) / contestant.best * 1e-6;
    contestant.row.ratio_to_lua = contestants[0].best / contestant.best;
    result.rows.push_back(contestant.row);
  }
  return result;
}

} // namespace moonshade::moonbench
