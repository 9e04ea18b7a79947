// moonbench: for each shader and entry, stock Lua against compiled code over the same points.
#include "tools/moonbench/compile_times.h"
#include "tools/moonbench/measure.h"
#include "tools/moonbench/report.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"
#include "tools/support/images.h"
#include "tools/support/interrupt.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <unistd.h>

namespace {

using namespace moonshade;
using namespace moonshade::moonbench;
using namespace moonshade::tools;

bool wanted(const Options& options, const std::string& entry) {
  return options.entries.empty() ||
         std::find(options.entries.begin(), options.entries.end(), entry) != options.entries.end();
}

/// Adds the rows of one file's entries; gives the exit status.
int measure_file(const std::string& path, Options options, std::vector<Row>& rows) {
  options.images = images_of(path);
  const FileText file = read_file(path);
  if (!file.error.empty()) return fail(kInputAtFault, "cannot read '" + path + "': " + file.error);
  const CheckedShader shader(path, file.text, {}, tools::modules_of(path));
  print_text(shader.diagnostics(), shader.sources(), std::cerr, isatty(STDERR_FILENO));
  if (!shader.ok()) return kInputAtFault;
  const auto& entries = shader.info().entries;
  if (entries.empty()) return fail(kInputAtFault, path + ": the shader has no entry points");
  for (size_t entry = 0; entry < entries.size(); ++entry) {
    if (!wanted(options, entries[entry].name)) continue;
    if (isatty(STDERR_FILENO)) std::cerr << path << ": " << entries[entry].name << "\n";
    Measurement measurement = measure(shader, entry, options);
    if (!measurement.error.empty()) return fail(kInputAtFault, path + ": " + measurement.error);
    for (Row& row : measurement.rows) {
      row.shader = path;
      rows.push_back(std::move(row));
    }
  }
  return kDone;
}

int report_rows(const Options& options, const std::vector<Row>& rows) {
  std::cout << (options.json ? json(rows) : table(rows));
  if (const int status = tools::finish_output("moonbench"); status != kDone) return status;
  if (!options.plot.empty())
    if (const std::string error = write_file(options.plot, plot(rows)); !error.empty())
      return fail(kMachineAtFault, "cannot write '" + options.plot + "': " + error);
  for (const Row& row : rows)
    if (!row.agrees)
      return fail(kInputAtFault, row.shader + ": " + row.entry + ": " + row.mode + " code differs from stock Lua at " +
                                     std::to_string(row.differing_points) + " of " + std::to_string(options.points) +
                                     " points");
  return kDone;
}

int work(const Options& options) {
  if (options.compile_times) return report_compile_times(options);
  std::vector<Row> rows;
  int status = kDone;
  for (const std::string& file : options.files)
    if (const int file_status = measure_file(file, options, rows); file_status != kDone) status = file_status;
  if (status == kDone && rows.empty()) return fail(kCallAtFault, "there is no such entry");
  const int report_status = report_rows(options, rows);
  return report_status != kDone ? report_status : status;
}

} // namespace

int main(int argc, char** argv) {
  keep_standard_files_apart();
  exit_on_interrupt();
  try {
    const ParsedOptions parsed = parse_options(argc, argv);
    return parsed.options ? work(*parsed.options) : parsed.exit_status;
  } catch (const std::exception& error) {
    return fail(kMachineAtFault, std::string("internal error: ") + error.what());
  }
}
