// The command line of shaderc: docs/tools.md is its contract.
#include "tools/shaderc/options.h"

#include "compiler/base/printable.h"
#include "tools/support/arguments.h"
#include "tools/support/cache_options.h"
#include "tools/support/exit_status.h"

#include <cctype>
#include <cstdlib>
#include <iostream>
#include <unistd.h>

namespace moonshade::shaderc {

namespace {

using namespace tools;

constexpr const char* kExamples = R"(Examples:
  shaderc copper.lua                                    check it
  shaderc --emit=asm --width=16 -o copper.s copper.lua  look at the code
  shaderc --describe copper.lua                         entries and parameters as JSON
  shaderc --run --entry=height --input p=1,2,3 -D scale=2 copper.lua
  shaderc --run --entry=color --points=points.csv copper.lua
)";

/// Options as they stand on the command line, before they are judged.
struct Raw {
  std::string emit, width = "auto", precision = "f32", diagnostics = "text", optimization = "2";
  CacheOptions cache;
};

void add_output_options(CLI::App& app, Options& options, Raw& raw) {
  const char* group = "What to do (default: check)";
  app.add_option("--emit", raw.emit, "Write that stage")
      ->option_text("ast|ir|llvm|asm|obj|header|luals")
      ->check(CLI::IsMember({"ast", "ir", "llvm", "asm", "obj", "header", "luals"}))
      ->group(group);
  app.add_option("-o", options.output, "File for --emit; - = standard output")->option_text("FILE")->group(group);
  app.add_option("--prefix", options.prefix, "How names in obj and header begin (default: the file's name)")
      ->option_text("NAME")
      ->group(group);
  app.add_flag("--describe", options.describe, "Print entries, parameters, modules and images as JSON")->group(group);
  app.add_flag("--run", options.run, "Evaluate one entry point and print its results")->group(group);
}

void add_run_options(CLI::App& app, Options& options) {
  const char* group = "With --run";
  app.add_option("--input", options.inputs, "An input, such as p=1,2,3 (repeatable)")
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--points", options.points,
                 "A CSV of points; its header names the inputs' components: p.x,p.y,p.z,time")
      ->option_text("FILE.csv")
      ->group(group);
  app.add_flag("--interpret", options.interpret, "Run by stock Lua 5.4, in double, instead of compiling")->group(group);
  app.add_option("-D", options.definitions, "Override a parameter: -D scale=2, -D tint=0.2,0.4,1 (repeatable)")
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false)
      ->group(group);
}

void add_compile_options(CLI::App& app, Options& options, Raw& raw) {
  const char* group = "Compilation";
  app.add_option("--entry", options.compile.entries, "Only this entry point (repeatable)")
      ->option_text("NAME")
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("-I", options.module_path, "Folder of modules for require, after the shader's own (repeatable)")
      ->option_text("DIR")
      ->allow_extra_args(false)
      ->check(CLI::ExistingDirectory)
      ->group(group);
  app.add_option("--precision", raw.precision, "Of numbers (default f32)")
      ->option_text("f32|f64")
      ->check(CLI::IsMember({"f32", "f64"}))
      ->group(group);
  app.add_option("--width", raw.width, "Lanes (default auto: the best for the target)")
      ->option_text("auto|1|4|8|16|32")
      ->check(CLI::IsMember({"auto", "1", "4", "8", "16", "32"}))
      ->group(group);
  app.add_option("--cpu", options.compile.cpu, "As clang's -march (default native)")
      ->option_text("native|NAME")
      ->group(group);
  app.add_option("--target", options.compile.target, "Target triple (default this machine's)")
      ->option_text("TRIPLE")
      ->group(group);
  app.add_option("-O", raw.optimization, "Level of optimisation, -O0 to -O3 (default -O2)")
      ->option_text("0|1|2|3")
      ->check(CLI::IsMember({"0", "1", "2", "3"}))
      ->group(group);
  app.add_flag("--bake", options.compile.bake, "Compile parameters as constants: those of -D, and defaults")
      ->group(group);
  add_cache_options(app, raw.cache, group);
}

void add_report_options(CLI::App& app, Options& options, Raw& raw) {
  const char* group = "Reports";
  app.add_option("--diagnostics", raw.diagnostics, "Form of the diagnostics on standard error")
      ->option_text("text|json|sarif")
      ->check(CLI::IsMember({"text", "json", "sarif"}))
      ->group(group);
  app.add_flag("--remarks", options.remarks,
               "What the compiler decided: width, varying branches and loops, gathers, calls, counted steps")
      ->group(group);
  app.add_flag("--time-report", options.time_report, "Print the time of each stage on standard error")->group(group);
}

std::optional<Stage> stage_of(const std::string& name) {
  if (name == "ast") return Stage::Ast;
  if (name == "ir") return Stage::Ir;
  if (name == "llvm") return Stage::Llvm;
  if (name == "asm") return Stage::Assembly;
  if (name == "obj") return Stage::Object;
  if (name == "header") return Stage::Header;
  return std::nullopt;
}

DiagnosticFormat format_of(const std::string& name) {
  if (name == "json") return DiagnosticFormat::Json;
  if (name == "sarif") return DiagnosticFormat::Sarif;
  return DiagnosticFormat::Text;
}

/// `--input p=1,2,3 time=0`: further inputs behind the first arrive among the files.
void move_inputs_from_files(Options& options) {
  if (options.inputs.empty()) return;
  std::erase_if(options.files, [&](const std::string& file) {
    if (split_assignment(file).name.empty() || file.ends_with(".lua")) return false;
    options.inputs.push_back(file);
    return true;
  });
}

/// Letters, digits and underscores, a letter first.
bool is_identifier(const std::string& text) {
  for (char c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  return std::isalpha(static_cast<unsigned char>(text[0])) != 0;
}

/// What the options say together; empty where they fit.
std::string contradiction(const Options& options) {
  const int actions = int(options.emit.has_value()) + int(options.describe) + int(options.run);
  if (actions > 1) return "--emit, --describe and --run exclude each other";
  if (options.luals && (options.describe || options.run)) return "--emit, --describe and --run exclude each other";
  if (options.luals && !options.files.empty()) return "--emit=luals takes no file: it describes the library";
  if (options.files.empty() && !options.luals) return "no file is given";
  if (!options.prefix.empty() && !is_identifier(options.prefix))
    return "--prefix: '" + options.prefix + "' cannot begin a name in C";
  if (options.files.size() > 1 && (options.emit || options.run)) return "--emit and --run take one file";
  if (!options.emit && !options.luals && !options.output.empty()) return "-o stands with --emit";
  if (!options.run && !options.inputs.empty()) return "--input stands with --run";
  if (!options.run && !options.points.empty()) return "--points stands with --run";
  if (!options.run && options.interpret) return "--interpret stands with --run";
  if (options.run && options.compile.entries.size() > 1) return "--run takes one --entry";
  if (!options.emit && !options.remarks && !options.run &&
      (options.compile.cpu != "native" || !options.compile.target.empty()))
    return "--cpu and --target stand with --emit, --remarks or --run";
  if (options.compile.bake && !options.run && !options.emit) return "--bake stands with --run and --emit";
  for (const std::string& definition : options.definitions)
    if (split_assignment(definition).name.empty()) return "-D takes NAME=VALUE, not '" + definition + "'";
  for (const std::string& input : options.inputs)
    if (split_assignment(input).name.empty()) return "--input takes NAME=VALUE, not '" + input + "'";
  if (options.emit == Stage::Object && (options.output.empty() || options.output == "-") && isatty(STDOUT_FILENO))
    return "--emit=obj needs -o FILE: an object file is nothing for a terminal";
  return "";
}

bool colour_wanted() {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) && (!no_colour || !*no_colour);
}

void settle(Options& options, const Raw& raw) {
  options.emit = stage_of(raw.emit);
  options.luals = raw.emit == "luals";
  options.compile.precision = raw.precision == "f64" ? Precision::F64 : Precision::F32;
  options.compile.width = raw.width == "auto" ? 0 : unsigned(std::stoul(raw.width));
  options.compile.optimization = std::stoi(raw.optimization);
  options.diagnostics = format_of(raw.diagnostics);
  options.colour = colour_wanted();
  options.compile.color_diagnostics = options.colour;
  if (options.run && !options.interpret) options.compile.cache = open_cache(raw.cache);
  move_inputs_from_files(options);
}

} // namespace

int call_error(const std::string& message) {
  std::cerr << "shaderc: error: " << printable(message, "\n\t") << "\n";
  return kCallAtFault;
}

Assignment split_assignment(std::string_view text) {
  const size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) return {};
  for (char c : text.substr(0, equals))
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return {};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

ParsedOptions parse_options(int argc, char** argv) {
  CLI::App app("Compiles and checks Moonshade shaders.", "shaderc");
  Options options;
  Raw raw;
  app.add_option("FILE", options.files, "Shaders")->option_text("FILE.lua ...");
  add_output_options(app, options, raw);
  add_run_options(app, options);
  add_compile_options(app, options, raw);
  add_report_options(app, options, raw);
  app.set_help_flag("-h,--help", "Print this help")->group("Reports");
  app.set_version_flag("--version", version(), "Print the version")->group("Reports");
  app.footer(kExamples);
  if (const auto status = parse_arguments(app, argc, argv, "shaderc")) return {std::nullopt, *status};
  settle(options, raw);
  if (const std::string problem = contradiction(options); !problem.empty()) return {std::nullopt, call_error(problem)};
  return {std::move(options), kDone};
}

} // namespace moonshade::shaderc
