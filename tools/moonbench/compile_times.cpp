// From a text in memory to code that can be called, for each entry alone: optimised; made quickly, as hosts get it
// first where they have it optimised in the background; and from the object cache. Processor time of this thread, which
// does all the work; the median of the repetitions, all of which are compilations of their own.
#include "tools/moonbench/compile_times.h"

#include "tools/moonbench/measure.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace moonshade::moonbench {

namespace {

/// One way to compile an entry.
struct Timing {
  double milliseconds = 0;
  CompileTimes stages;
};

struct CompileRow {
  std::string shader, entry;
  Timing optimised, quick, cached;
};

double middle(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

/// A folder for the time of the measurement.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "moonbench-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

private:
  std::string path_;
};

/// The median of several compilations; the error of one that fails.
std::string median_of(const std::string& path, const std::string& text, const CompileOptions& options,
                      unsigned repetitions, Timing& timing) {
  std::vector<Timing> timings;
  for (unsigned i = 0; i < repetitions; ++i) {
    const double begin = thread_seconds();
    const Compilation compilation = compile(path, text, options);
    const double end = thread_seconds();
    if (!compilation.program) return compilation.diagnostics;
    timings.push_back({(end - begin) * 1e3, compilation.program->times()});
  }
  std::ranges::sort(timings, {}, &Timing::milliseconds);
  timing = timings[timings.size() / 2];
  // The stages are told by the clock, to which other programs add: the least of each.
  for (double CompileTimes::* stage :
       {&CompileTimes::parse, &CompileTimes::sema, &CompileTimes::ir, &CompileTimes::emit, &CompileTimes::optimize,
        &CompileTimes::codegen, &CompileTimes::cache})
    for (const Timing& other : timings)
      timing.stages.*stage = std::min(timing.stages.*stage, other.stages.*stage);
  return {};
}

std::string measure_entry(const std::string& text, const Options& options, const std::string& cache, CompileRow& row) {
  CompileOptions compile_options;
  compile_options.precision = options.precision;
  compile_options.width = options.width;
  compile_options.entries = {row.entry};
  compile_options.modules = tools::modules_of(row.shader);
  const auto median = [&](Timing& timing) {
    return median_of(row.shader, text, compile_options, options.repetitions, timing);
  };
  if (std::string error = median(row.optimised); !error.empty()) return error;
  compile_options.background = std::make_shared<BackgroundCompiler>(false); // nothing is optimised meanwhile
  if (std::string error = median(row.quick); !error.empty()) return error;
  compile_options.background = nullptr;
  compile_options.cache = open_object_cache(cache);
  compile(row.shader, text, compile_options);
  if (std::string error = median(row.cached); !error.empty()) return error;
  return row.cached.stages.cached ? "" : "the object cache keeps nothing\n";
}

nlohmann::ordered_json stages_json(const CompileTimes& t) {
  return {{"parse", t.parse},       {"sema", t.sema},       {"ir", t.ir},      {"emit", t.emit},
          {"optimize", t.optimize}, {"codegen", t.codegen}, {"cache", t.cache}};
}

void print_json_rows(const std::vector<CompileRow>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const CompileRow& row : rows)
    all.push_back({{"shader", row.shader},
                   {"entry", row.entry},
                   {"optimised_ms", row.optimised.milliseconds},
                   {"quick_ms", row.quick.milliseconds},
                   {"cached_ms", row.cached.milliseconds},
                   {"stages", stages_json(row.optimised.stages)}});
  std::cout << all.dump(2) << "\n";
}

void print_table(const std::vector<CompileRow>& rows) {
  std::printf("| shader | entry | parse | check | IR | emit, link | optimise | code | optimised | quick | cached |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<double> optimised, quick, cached;
  for (const CompileRow& row : rows) {
    const CompileTimes& t = row.optimised.stages;
    const std::string name = std::filesystem::path(row.shader).stem().string();
    std::printf("| %s | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", name.c_str(),
                row.entry.c_str(), t.parse, t.sema, t.ir, t.emit, t.optimize, t.codegen, row.optimised.milliseconds,
                row.quick.milliseconds, row.cached.milliseconds);
    optimised.push_back(row.optimised.milliseconds);
    quick.push_back(row.quick.milliseconds);
    cached.push_back(row.cached.milliseconds);
  }
  std::printf("| median | | | | | | | | %.2f | %.2f | %.2f |\n", middle(optimised), middle(quick), middle(cached));
  std::printf("| worst | | | | | | | | %.2f | %.2f | %.2f |\n", *std::ranges::max_element(optimised),
              *std::ranges::max_element(quick), *std::ranges::max_element(cached));
}

} // namespace

int report_compile_times(const Options& options) {
  const TemporaryFolder folder;
  if (folder.path().empty()) return fail(tools::kMachineAtFault, "no temporary folder can be made");
  std::vector<CompileRow> rows;
  for (const std::string& path : options.files) {
    const tools::FileText file = tools::read_file(path);
    if (!file.error.empty()) return fail(tools::kInputAtFault, "cannot read '" + path + "': " + file.error);
    const CheckedShader shader(path, file.text, {}, tools::modules_of(path));
    print_text(shader.diagnostics(), shader.sources(), std::cerr, isatty(STDERR_FILENO));
    if (!shader.ok()) return tools::kInputAtFault;
    for (const EntryInfo& entry : shader.info().entries) {
      if (!options.entries.empty() && std::ranges::find(options.entries, entry.name) == options.entries.end()) continue;
      CompileRow row{path, entry.name, {}, {}, {}};
      if (const std::string error = measure_entry(file.text, options, folder.path(), row); !error.empty())
        return fail(tools::kInputAtFault, path + ": " + error);
      rows.push_back(std::move(row));
    }
  }
  if (rows.empty()) return fail(tools::kCallAtFault, "there is no such entry");
  options.json ? print_json_rows(rows) : print_table(rows);
  return tools::finish_output("moonbench");
}

} // namespace moonshade::moonbench
