// Reading and checking one file, and printing what the checks found.
#include "tools/shaderc/check.h"

#include "tools/support/exit_status.h"
#include "tools/support/files.h"
#include "tools/support/images.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <iostream>
#include <sstream>

namespace moonshade::shaderc {

namespace {

void report_unreadable(const std::string& path, const std::string& error, Reporter& reporter) {
  SourceSet sources;
  Diagnostics diagnostics;
  const FileId file = sources.add(path, "");
  diagnostics.report(DiagnosticCode::CannotReadFile, Span{file, 0, 0}, {path, error});
  reporter.add(diagnostics, sources);
}

/// The message, where all that is wrong is an entry that the call names and the shader has not.
std::string only_missing_entry(const Diagnostics& diagnostics) {
  std::string message;
  for (const Diagnostic* diagnostic : diagnostics.sorted()) {
    if (diagnostic->severity != Severity::Error) continue;
    if (diagnostic->code != DiagnosticCode::UnknownEntry) return "";
    message = diagnostic->message;
  }
  return message;
}

} // namespace

void Reporter::add(const Diagnostics& diagnostics, const SourceSet& sources) {
  if (options_.diagnostics == DiagnosticFormat::Text)
    return print_text(diagnostics, sources, std::cerr, options_.colour);
  if (options_.diagnostics == DiagnosticFormat::Sarif) return sarif_.add(diagnostics, sources);
  std::ostringstream text;
  print_json(diagnostics, sources, text);
  json_.push_back(text.str());
}

void Reporter::finish() {
  if (finished_) return;
  finished_ = true;
  if (options_.diagnostics == DiagnosticFormat::Sarif) sarif_.print(std::cerr);
  if (options_.diagnostics != DiagnosticFormat::Json) return;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& text : json_)
    for (auto& diagnostic : nlohmann::ordered_json::parse(text))
      all.push_back(std::move(diagnostic));
  std::cerr << all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
}

CheckedFile check_file(const std::string& path, const Options& options, Reporter& reporter) {
  tools::FileText file = tools::read_file(path);
  if (!file.error.empty()) {
    report_unreadable(path, file.error, reporter);
    return {nullptr, tools::kInputAtFault};
  }
  // The tree is the parser's: what the dialect leaves out has one, too.
  auto shader = options.emit == Stage::Ast
                    ? std::make_unique<CheckedShader>(CheckedShader::parsed(path, file.text))
                    : std::make_unique<CheckedShader>(path, file.text, options.compile.entries,
                                                      tools::modules_of(path, options.module_path));
  if (!options.emit && !shader->info().images.empty())
    shader->check_images(tools::images_of(path, options.module_path));
  const std::string missing_entry = only_missing_entry(shader->diagnostics());
  if (missing_entry.empty()) reporter.add(shader->diagnostics(), shader->sources());
  if (!missing_entry.empty()) return {nullptr, call_error("--entry: " + missing_entry)};
  if (options.remarks && shader->ok() && options.emit != Stage::Ast) {
    Diagnostics remarks;
    if (const std::string error = report_remarks(*shader, options.compile, remarks); !error.empty())
      return {nullptr, call_error(error)};
    reporter.add(remarks, shader->sources());
  }
  const int status = shader->ok() ? tools::kDone : tools::kInputAtFault;
  return {std::move(shader), status};
}

void print_times(const std::string& file, const CompileTimes& times) {
  const auto print = [&](const char* stage, double milliseconds) {
    if (milliseconds > 0) std::fprintf(stderr, "%s: %s %.3f ms\n", file.c_str(), stage, milliseconds);
  };
  if (times.cached || times.cache > 0)
    std::fprintf(stderr, "%s: cache %.3f ms (%s)\n", file.c_str(), times.cache, times.cached ? "hit" : "miss");
  print("parse", times.parse);
  print("sema", times.sema);
  print("ir", times.ir);
  print("emit", times.emit);
  print("optimize", times.optimize);
  print("codegen", times.codegen);
  print("total", times.total);
}

} // namespace moonshade::shaderc
