// The command line of moonbench: docs/tools.md is its contract.
#include "tools/moonbench/options.h"

#include "compiler/base/printable.h"
#include "tools/support/arguments.h"
#include "tools/support/exit_status.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace moonshade::moonbench {

namespace {

using namespace tools;

constexpr const char* kNotes =
    R"(Columns: million points a second, ratio to stock Lua, milliseconds to compile, largest difference from stock Lua.
Each row is the best of several interleaved repetitions; on one thread its processor time counts, on several the clock.
Modes: lua (stock Lua 5.4, every argument over its stack), scalar (compiled, one lane), simd (compiled, all lanes).
There are no luajit rows yet: the standard library is bound for Lua 5.4 only, and without it a shader does not run in
LuaJIT.
Exit status 1: under f32 more than 0.1 % of the points differ from stock Lua by more than 1e-3 * max(1, |x|), or under
f64 any bit differs.

Examples:
  moonbench                                   the gallery
  moonbench --points=1000000 copper.lua
  moonbench --precision=f64 --json planet.lua > planet.json
  moonbench --plot=speed.svg
)";

/// The shaders of the gallery: its Lua files that are no scenes and make no models.
std::vector<std::string> gallery() {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(MOONSHADE_GALLERY, error)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".lua" || stem.starts_with("make_") || stem.ends_with(".scene")) continue;
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

int fail(int status, const std::string& message) {
  std::cerr << "moonbench: error: " << printable(message, "\n\t") << "\n";
  return status;
}

ParsedOptions parse_options(int argc, char** argv) {
  CLI::App app("Measures shaders: stock Lua against compiled code.", "moonbench");
  Options options;
  std::string precision = "f32", width = "auto";
  app.add_option("SHADER", options.files, "Shaders; without any: the gallery")->option_text("SHADER.lua ...");
  app.add_option("--entry", options.entries, "Only this entry point (repeatable)")
      ->option_text("NAME")
      ->allow_extra_args(false)
      ->group("What to measure");
  app.add_option("--points", options.points, "Points (default 65536)")
      ->option_text("N")
      ->check(CLI::Range(size_t{1}, size_t{1} << 26))
      ->group("What to measure");
  app.add_option("--threads", options.threads, "Threads, for every mode (default 1)")
      ->option_text("N")
      ->check(CLI::Range(1u, 1024u))
      ->group("What to measure");
  app.add_option("--repetitions", options.repetitions, "Of each measurement, the best of which counts (default 5)")
      ->option_text("N")
      ->check(CLI::Range(1u, 1000u))
      ->group("What to measure");
  app.add_option("--precision", precision, "Of compiled code (default f32)")
      ->option_text("f32|f64")
      ->check(CLI::IsMember({"f32", "f64"}))
      ->group("What to measure");
  app.add_option("--width", width, "Lanes of the simd rows (default auto)")
      ->option_text("auto|4|8|16|32")
      ->check(CLI::IsMember({"auto", "1", "4", "8", "16", "32"}))
      ->group("What to measure");
  app.add_flag("--compile-times", options.compile_times,
               "Instead: milliseconds to compile each entry, optimised, quickly, and from the object cache")
      ->group("What to measure");
  app.add_flag("--json", options.json, "Print an array of objects instead of a table")->group("Reports");
  app.add_option("--plot", options.plot, "Draw a bar chart")->option_text("FILE.svg")->group("Reports");
  app.set_help_flag("-h,--help", "Print this help")->group("Reports");
  app.set_version_flag("--version", version(), "Print the version")->group("Reports");
  app.footer(kNotes);
  if (const auto status = parse_arguments(app, argc, argv, "moonbench")) return {std::nullopt, *status};
  options.precision = precision == "f64" ? Precision::F64 : Precision::F32;
  options.width = width == "auto" ? 0 : unsigned(std::stoul(width));
  if (options.files.empty()) options.files = gallery();
  if (options.files.empty())
    return {std::nullopt, fail(kCallAtFault, "no shader is given, and the gallery is not at " MOONSHADE_GALLERY)};
  return {std::move(options), kDone};
}

} // namespace moonshade::moonbench
