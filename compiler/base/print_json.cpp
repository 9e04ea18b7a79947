// Diagnostics as one JSON array, for programs. Ends are exclusive; bytes that are not UTF-8 become U+FFFD.
#include "compiler/base/diagnostics.h"

#include <nlohmann/json.hpp>
#include <ostream>

namespace moonshade {
namespace {

using nlohmann::ordered_json;

ordered_json place_of(Span span, const SourceSet& sources) {
  if (!span.has_place())
    return {{"file", nullptr}, {"line", nullptr}, {"column", nullptr}, {"endLine", nullptr}, {"endColumn", nullptr}};
  const LineColumn begin = sources.position(span.file, span.begin);
  const LineColumn end = sources.position(span.file, span.end);
  return {{"file", sources.name(span.file)},
          {"line", begin.line},
          {"column", begin.column},
          {"endLine", end.line},
          {"endColumn", end.column}};
}

ordered_json to_json(const Diagnostic& diagnostic, const SourceSet& sources) {
  ordered_json result = place_of(diagnostic.span, sources);
  result["severity"] = name_of(diagnostic.severity);
  result["code"] = name_of(diagnostic.code);
  result["message"] = diagnostic.message;
  result["notes"] = ordered_json::array();
  for (const DiagnosticNote& note : diagnostic.notes) {
    ordered_json entry = place_of(note.span, sources);
    entry["message"] = note.message;
    result["notes"].push_back(std::move(entry));
  }
  result["fix"] = nullptr;
  if (diagnostic.fix) {
    result["fix"] = place_of(diagnostic.fix->span, sources);
    result["fix"]["replacement"] = diagnostic.fix->replacement;
  }
  return result;
}

} // namespace

void print_json(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out) {
  ordered_json array = ordered_json::array();
  for (const Diagnostic* diagnostic : diagnostics.sorted())
    array.push_back(to_json(*diagnostic, sources));
  out << array.dump(2, ' ', false, ordered_json::error_handler_t::replace) << '\n';
}

} // namespace moonshade
