// --run: evaluates one entry at one point or at the points of a CSV file, in blocks, so that files of any size stream.
#include "compiler/base/printable.h"
#include "runtime/interpret.h"
#include "tools/shaderc/actions.h"
#include "tools/shaderc/check.h"
#include "tools/shaderc/parameters.h"
#include "tools/support/csv.h"
#include "tools/support/exit_status.h"
#include "tools/support/images.h"
#include "tools/support/points.h"
#include "tools/support/values.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

namespace moonshade::shaderc {

namespace {

using namespace tools;

constexpr size_t kBlock = 8192;

/// What a step gives: nothing, or the exit status with which to end (the reason is printed).
using Ending = std::optional<int>;

/// What the shader or the points had a part in, on standard error: terminals must not obey it.
void say(std::string_view text) { std::cerr << printable(text, "\n\t") << '\n'; }

int machine_error(const std::string& message) {
  say("shaderc: error: " + message);
  return kMachineAtFault;
}

// ---- the shader ----------------------------------------------------------------------------------------------------

/// The entry that the call means: the one it names, or the only one.
Ending find_entry(const ShaderInfo& info, const Options& options, size_t& index) {
  const std::vector<std::string> names = names_of(info.entries);
  if (options.compile.entries.empty() && names.size() == 1) {
    index = 0;
    return std::nullopt;
  }
  if (options.compile.entries.empty())
    return call_error("--run needs --entry=NAME; the shader's entries are " + quoted_list(names));
  const auto found = std::find(names.begin(), names.end(), options.compile.entries[0]);
  if (found == names.end())
    return call_error("the shader has no entry '" + options.compile.entries[0] + "'; there are " + quoted_list(names));
  index = size_t(found - names.begin());
  return std::nullopt;
}

/// "FILE:LINE:COLUMN: message" in the form of a diagnostic; other errors as the program's own.
std::string as_diagnostic(const std::string& error, const CheckedShader& checked) {
  const std::string file = std::string(checked.sources().name(0)) + ":";
  const size_t space = error.starts_with(file) ? error.find(": ", file.size()) : std::string::npos;
  if (space == std::string::npos) return "shaderc: error: " + error;
  return error.substr(0, space) + ": error: " + error.substr(space + 2);
}

/// Compiles or interprets the shader, with its parameters set.
Ending instantiate(const CheckedShader& checked, const Options& options, std::shared_ptr<const Shader>& shader) {
  std::map<std::string, Constant> parameters;
  if (const Ending ending = read_parameters(checked.info(), options, parameters)) return ending;
  const ImageOpener images = tools::images_of(options.files[0], options.module_path);
  Instantiation instance;
  if (options.interpret) {
    if (options.time_report) print_times(options.files[0], checked.times());
    instance = interpret(checked, parameters,
                         {.count_steps = true, .step_limit = options.compile.step_limit, .images = images});
  } else {
    CompileOptions compile_options = options.compile;
    compile_options.images = images;
    if (options.compile.bake) compile_options.baked = std::exchange(parameters, {});
    const Compilation compilation = compile(checked, compile_options);
    if (compilation.is_too_large) {
      std::cerr << compilation.diagnostics;
      return kInputAtFault;
    }
    if (!compilation.program) return machine_error("the checked shader cannot be compiled\n" + compilation.diagnostics);
    if (options.time_report) print_times(options.files[0], compilation.program->times());
    instance = compilation.program->instantiate(parameters);
  }
  if (!instance.shader) {
    say(as_diagnostic(instance.error, checked));
    return kInputAtFault;
  }
  shader = instance.shader;
  return std::nullopt;
}

// ---- its inputs ----------------------------------------------------------------------------------------------------

/// Where a component of an input comes from: a column of the CSV, or the value that --input gives.
struct Source {
  std::string name; ///< "p.x"
  size_t column = kNoColumn;
  bool is_given = false; ///< by --input, as
  Scalar value{};

  static constexpr size_t kNoColumn = SIZE_MAX;
};

Ending read_inputs(const EntryInfo& entry, const Options& options, std::vector<Source>& sources) {
  std::map<std::string, std::vector<Scalar>, std::less<>> given;
  for (const std::string& text : options.inputs) {
    const auto [name, value] = split_assignment(text);
    const auto type = input_type(name);
    if (!type) return call_error("--input: the dialect has no input '" + std::string(name) + "'");
    const auto components = parse_value(*type, value);
    if (!components)
      return call_error("--input: '" + std::string(value) + "' is no " + std::string(name_of(*type)) + " (for '" +
                        std::string(name) + "')");
    given[std::string(name)] = *components;
  }
  for (const InputInfo& input : entry.inputs) {
    const auto found = given.find(input.name);
    for (unsigned i = 0; i < component_count(input.type); ++i) {
      Source& source = sources.emplace_back();
      source.name = component_name(input.name, input.type, i);
      source.is_given = found != given.end();
      if (source.is_given) source.value = found->second[i];
    }
    if (options.points.empty() && found == given.end())
      return call_error("the input '" + input.name + "' of '" + entry.name + "' is not given: --input " + input.name +
                        "=VALUE");
  }
  return std::nullopt;
}

/// Finds each component's column; those that --input gives need none.
Ending read_header(const std::vector<std::string>& header, const Options& options, std::vector<Source>& sources) {
  for (Source& source : sources) {
    const auto found = std::find(header.begin(), header.end(), source.name);
    if (found != header.end())
      source.column = size_t(found - header.begin());
    else if (!source.is_given)
      return call_error("the input '" + source.name.substr(0, source.name.find('.')) +
                        "' is not given: " + options.points + " has no column '" + source.name + "'");
  }
  return std::nullopt;
}

Ending read_row(const CsvReader& csv, const Options& options, const std::vector<Source>& sources, Points& points,
                size_t row) {
  const auto fail = [&](const std::string& message) {
    say(options.points + ":" + std::to_string(csv.line()) + ":1: error: " + message);
    return kInputAtFault;
  };
  for (size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].column == Source::kNoColumn) {
      points.set_input(i, row, sources[i].value);
      continue;
    }
    if (sources[i].column >= csv.fields().size()) return fail("the column '" + sources[i].name + "' is missing");
    const std::string& field = csv.fields()[sources[i].column];
    const auto value = parse_scalar(points.input_type(i), field);
    if (!value) {
      const bool plain = points.input_type(i) == ValueType::Integer || points.input_type(i) == ValueType::Boolean;
      return fail("'" + field + "' is no " + std::string(plain ? name_of(points.input_type(i)) : "number") +
                  " (column '" + sources[i].name + "')");
    }
    points.set_input(i, row, *value);
  }
  return std::nullopt;
}

// ---- running -------------------------------------------------------------------------------------------------------

/// Shades blocks, prints their rows, and keeps count of the faults.
class Runner {
public:
  Runner(const Shader& shader, size_t entry, size_t capacity)
      : shader_(shader), entry_(entry), points_(shader.info().entries[entry], shader.precision(), capacity) {}

  Points& points() { return points_; }

  /// Shades the first `count` rows; false where standard output cannot be written.
  bool flush(size_t count) {
    if (count == 0) return true;
    const FaultReport report = points_.run(shader_, entry_, count);
    if (report.count != 0 && faults_ == 0) note_first(report);
    faults_ += report.count;
    print_lines(count);
    done_ += count;
    std::string text;
    for (size_t row = 0; row < count; ++row) {
      points_.append_row(text, row);
      text += '\n';
    }
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  }

  int finish() {
    if (std::fflush(stdout) != 0) return machine_error("cannot write to standard output");
    if (faults_ == 0) return kDone;
    if (done_ > 1) first_ += "; " + std::to_string(faults_) + " of " + std::to_string(done_) + " points faulted";
    say(first_);
    return kInputAtFault;
  }

private:
  /// What the points print, in their order, while it is not much.
  void print_lines(size_t count) {
    for (size_t row = 0; row < count && shader_.has_prints() && lines_ < kMostLines; ++row)
      points_.print(shader_, entry_, row, [&](std::string_view line) {
        if (lines_++ < kMostLines) say(line);
      });
  }

  void note_first(const FaultReport& report) {
    const FaultSite site = shader_.fault_site(report.first_site);
    first_ = site.file + ":" + std::to_string(site.line) + ":" + std::to_string(site.column) +
             ": error: fault: " + fault_name(report.first_code);
    if (!site.message.empty()) first_ += ": " + site.message;
    first_ += " at point " + std::to_string(done_ + report.first_point + 1);
    const std::string inputs = describe_inputs(shader_.info().entries[entry_], points_, report.first_point);
    if (!inputs.empty()) first_ += " (" + inputs + ")";
  }

  const Shader& shader_;
  size_t entry_;
  Points points_;
  static constexpr size_t kMostLines = 100;
  uint64_t faults_ = 0, done_ = 0;
  size_t lines_ = 0;
  std::string first_;
};

int run_one_point(const Shader& shader, size_t entry, const std::vector<Source>& sources) {
  Runner runner(shader, entry, 1);
  for (size_t i = 0; i < sources.size(); ++i)
    runner.points().set_input(i, 0, sources[i].value);
  if (!runner.flush(1)) return machine_error("cannot write to standard output");
  return runner.finish();
}

int run_csv(const Shader& shader, size_t entry, const Options& options, std::vector<Source>& sources, CsvReader& csv) {
  Runner runner(shader, entry, kBlock);
  size_t rows = 0;
  Ending ending;
  while (!ending && csv.next()) {
    ending = read_row(csv, options, sources, runner.points(), rows);
    if (ending) break;
    if (++rows < kBlock) continue;
    if (!runner.flush(rows)) return machine_error("cannot write to standard output");
    rows = 0;
  }
  if (!runner.flush(rows)) return machine_error("cannot write to standard output");
  if (!csv.error().empty()) return machine_error("cannot read '" + options.points + "': " + csv.error());
  const int status = runner.finish();
  return ending.value_or(status);
}

} // namespace

int run_shader(const CheckedShader& checked, const Options& options) {
  size_t entry = 0;
  std::vector<Source> sources;
  if (const Ending ending = find_entry(checked.info(), options, entry)) return *ending;
  if (const Ending ending = read_inputs(checked.info().entries[entry], options, sources)) return *ending;
  std::optional<CsvReader> csv;
  if (!options.points.empty()) {
    csv.emplace(options.points);
    const bool has_header = csv->next();
    if (!has_header) {
      say(options.points + ":1:1: error: " +
          (csv->error().empty() ? "the header line is missing" : "cannot read the file: " + csv->error()));
      return kInputAtFault;
    }
    if (const Ending ending = read_header(csv->fields(), options, sources)) return *ending;
  }
  std::shared_ptr<const Shader> shader;
  if (const Ending ending = instantiate(checked, options, shader)) return *ending;
  return csv ? run_csv(*shader, entry, options, sources, *csv) : run_one_point(*shader, entry, sources);
}

} // namespace moonshade::shaderc
