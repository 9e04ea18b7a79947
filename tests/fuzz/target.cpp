// Checks that several targets share.
#include "tests/fuzz/target.h"

#include "compiler/base/printable.h"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

namespace moonshade::fuzz {
namespace {

/// A message quotes names and tokens of the input; it must not quote megabytes of them.
constexpr size_t kMaxShownBytes = 8192;

void check_span(Span span, const SourceSet& sources, const std::string& message) {
  if (!span.has_place()) return;
  require(span.file < sources.size(), "a span is of no file: " + message);
  const bool lies_within = span.begin <= span.end && span.end <= sources.text(span.file).size();
  require(lies_within, "a span leaves its text: " + message);
}

std::string printed(const Diagnostics& diagnostics, const SourceSet& sources, DiagnosticPrintOptions options) {
  std::ostringstream out;
  print_diagnostics(diagnostics, sources, out, options);
  return out.str();
}

void check_text(const std::string& text, size_t count) {
  require(text.size() <= kMaxShownBytes * count, "diagnostics of " + std::to_string(text.size()) + " bytes");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    require(printable(line) == line, "a line of the diagnostics is not printable: " + printable(line));
}

} // namespace

void fail(const std::string& what) {
  std::fprintf(stderr, "PROPERTY: %s\n", what.c_str());
  std::abort();
}

void require(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

uint64_t choice_of(std::string_view text) {
  uint64_t hash = 0xcbf29ce484222325; // FNV-1a
  for (char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash ^ hash >> 32;
}

void check_diagnostics(const Diagnostics& diagnostics, const SourceSet& sources) {
  size_t count = 0;
  for (const Diagnostic* diagnostic : diagnostics.sorted()) {
    require(!diagnostic->message.empty(), "a diagnostic without a message");
    require(diagnostic->code != DiagnosticCode::InternalError, diagnostic->message);
    check_span(diagnostic->span, sources, diagnostic->message);
    for (const DiagnosticNote& note : diagnostic->notes)
      check_span(note.span, sources, note.message);
    if (diagnostic->fix) check_span(diagnostic->fix->span, sources, diagnostic->message);
    count += 2 + diagnostic->notes.size();
  }
  check_text(printed(diagnostics, sources, {}), count);
  printed(diagnostics, sources, {.colour = true});
  for (DiagnosticFormat format : {DiagnosticFormat::Json, DiagnosticFormat::Sarif}) {
    const std::string json = printed(diagnostics, sources, {.format = format});
    require(nlohmann::json::accept(json), "diagnostics are no JSON: " + json);
  }
}

} // namespace moonshade::fuzz
