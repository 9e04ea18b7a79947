// The suite of speed: each workload of shaders/bench/ in stock Lua, compiled at every width, written by hand, and in
// LuaJIT where it is installed; all in one process (but LuaJIT), by turns. scripts/bench runs it.
#include "tests/bench/suite_report.h"

#include "runtime/floating_point.h"
#include "tools/support/files.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace {

using namespace moonshade;
using namespace moonshade::bench;

struct Options {
  std::vector<std::string> only;
  unsigned repetitions = 9;
  double seconds = 0.01;
  bool json = false;
  std::string plot, page;
};

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line))
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

/// Puts the measured part between the page's two marks. Gives the error.
std::string update_page(const std::string& path, const std::string& measured) {
  const std::string begin = "<!-- measured -->\n", end = "<!-- end -->\n";
  tools::FileText page = tools::read_file(path);
  if (!page.error.empty()) return page.error;
  const size_t from = page.text.find(begin), to = page.text.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) return "there is no measured part to replace";
  page.text.replace(from + begin.size(), to - from - begin.size(), measured);
  return tools::write_file(path, page.text);
}

int work(const Options& options) {
  const DefaultFloatingPoint environment;
  const Grid grid;
  std::vector<Result> results;
  for (const Workload& workload : kWorkloads) {
    if (!options.only.empty() && std::ranges::find(options.only, workload.id) == options.only.end()) continue;
    std::cerr << workload.id << "\n";
    Lineup lineup = line_up(workload, grid);
    if (!lineup.error.empty()) {
      std::cerr << "suite: error: " << workload.id << ": " << lineup.error << "\n";
      return 1;
    }
    compare(workload, lineup);
    for (unsigned repetition = 0; repetition < options.repetitions; ++repetition)
      repeat(lineup, options.seconds);
    add_luajit(workload, lineup, options.repetitions, options.seconds);
    results.push_back({&workload, std::move(lineup.contestants)});
  }
  const Summary summary{processor() + ", " + version(), options.repetitions, options.seconds};
  std::cout << (options.json ? json(results, summary) : text_table(results, summary));
  std::string error;
  if (!options.plot.empty()) error = tools::write_file(options.plot, plot(results));
  if (error.empty() && !options.page.empty()) error = update_page(options.page, markdown(results, summary));
  if (!error.empty()) {
    std::cerr << "suite: error: " << error << "\n";
    return 3;
  }
  for (const Result& result : results)
    for (const Contestant& contestant : result.contestants)
      if (!contestant.agrees) {
        std::cerr << "suite: error: " << result.workload->id << ": " << contestant.name << " differs from stock Lua at "
                  << contestant.differing << " of " << Grid::count << " points\n";
        return 1;
      }
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Million points a second of each workload and implementation"};
  Options options;
  app.add_option("WORKLOAD", options.only, "Only these: W1, W2, W3a, W3b, W4, W5, W6, W7, W8fd, W8ad, height");
  app.add_option("--repetitions", options.repetitions, "Of each implementation, by turns (default 9)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--seconds", options.seconds, "The least time of a repetition (default 0.01)");
  app.add_flag("--json", options.json, "JSON on standard output");
  app.add_option("--plot", options.plot, "Write a plot to this SVG file");
  app.add_option("--page", options.page, "Put the tables into this page, between its marks");
  CLI11_PARSE(app, argc, argv);
  return work(options);
}
