// Diagnostics as SARIF 2.1.0 (the OASIS standard for results of static analysis), for code hosts and editors.
//
// SARIF counts columns in characters; ours count bytes, so each column is counted anew in code points of its line (a
// byte that is no UTF-8 is one character, a byte order mark none). Section numbers are those of the standard.
#include "compiler/base/diagnostics.h"
#include "compiler/base/printable.h"

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

namespace moonshade {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The text with a backslash before each '[' where it would otherwise read as a link (3.11.6), and braces doubled, as
/// they mark placeholders (3.11.5).
ordered_json message_of(std::string_view message) {
  const std::string shown = printable(message);
  const bool has_link = shown.find("](") != std::string::npos;
  std::string text;
  for (char c : shown) {
    if (c == '{' || c == '}') text += c;
    if (c == '[' && has_link) text += '\\';
    text += c;
  }
  return {{"text", std::move(text)}};
}

/// A file's name as a URI, or as a reference relative to where the compiler ran (3.4.4).
std::string uri_of(std::string_view name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/!$&'()*+,;=@";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const std::string path = std::filesystem::path(name).lexically_normal().generic_string();
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (char c : path) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += '%';
    uri += kHex[byte >> 4];
    uri += kHex[byte & 15];
  }
  return uri;
}

size_t count_characters(std::string_view text) {
  size_t count = 0;
  while (!text.empty()) {
    text.remove_prefix(printable_character(text).bytes);
    ++count;
  }
  return count;
}

LineColumn character_position(FileId file, uint32_t offset, const SourceSet& sources) {
  const LineColumn place = sources.position(file, offset);
  const uint32_t bytes = place.column - 1;
  offset = std::min(offset, static_cast<uint32_t>(sources.text(file).size()));
  std::string_view before = sources.text(file).substr(offset - bytes, bytes);
  if (place.line == 1 && before.starts_with(kByteOrderMark)) before.remove_prefix(kByteOrderMark.size());
  return {place.line, static_cast<uint32_t>(count_characters(before)) + 1};
}

ordered_json region_of(Span span, const SourceSet& sources) {
  const LineColumn begin = character_position(span.file, span.begin, sources);
  const LineColumn end = character_position(span.file, span.end, sources);
  return {{"startLine", begin.line},
          {"startColumn", begin.column},
          {"endLine", end.line},
          {"endColumn", end.column}}; // just after the region, as ours
}

ordered_json artifact_of(FileId file, const SourceSet& sources) { return {{"uri", uri_of(sources.name(file))}}; }

ordered_json location_of(Span span, const SourceSet& sources) {
  ordered_json location = ordered_json::object();
  if (!span.has_place()) return location;
  location["physicalLocation"] = {{"artifactLocation", artifact_of(span.file, sources)},
                                  {"region", region_of(span, sources)}};
  return location;
}

ordered_json related_locations_of(const Diagnostic& diagnostic, const SourceSet& sources) {
  ordered_json related = ordered_json::array();
  for (const DiagnosticNote& note : diagnostic.notes) {
    ordered_json location = {{"id", related.size()}};
    location.update(location_of(note.span, sources));
    location["message"] = message_of(note.message);
    related.push_back(std::move(location));
  }
  return related;
}

ordered_json fix_of(const DiagnosticFix& fix, const SourceSet& sources) {
  const std::string description = fix.replacement.empty()
                                      ? format_message(DiagnosticCode::NoteRemove)
                                      : format_message(DiagnosticCode::NoteWriteInstead, {fix.replacement});
  const ordered_json replacement = {{"deletedRegion", region_of(fix.span, sources)},
                                    {"insertedContent", {{"text", fix.replacement}}}};
  const ordered_json change = {{"artifactLocation", artifact_of(fix.span.file, sources)},
                               {"replacements", ordered_json::array({replacement})}};
  return {{"description", message_of(description)}, {"artifactChanges", ordered_json::array({change})}};
}

} // namespace

struct SarifLog::Content {
  ordered_json rules = ordered_json::array();
  ordered_json results = ordered_json::array();
  std::map<std::string_view, size_t> rule_indices;

  size_t rule_index(DiagnosticCode code) {
    const auto [entry, is_new] = rule_indices.try_emplace(name_of(code), rules.size());
    if (is_new)
      rules.push_back({{"id", name_of(code)}, {"defaultConfiguration", {{"level", name_of(severity_of(code))}}}});
    return entry->second;
  }
};

SarifLog::SarifLog() : content_(std::make_unique<Content>()) {}
SarifLog::~SarifLog() = default;
SarifLog::SarifLog(SarifLog&&) noexcept = default;
SarifLog& SarifLog::operator=(SarifLog&&) noexcept = default;

void SarifLog::add(const Diagnostics& diagnostics, const SourceSet& sources) {
  for (const Diagnostic* diagnostic : diagnostics.sorted()) {
    ordered_json result = {{"ruleId", name_of(diagnostic->code)},
                           {"ruleIndex", content_->rule_index(diagnostic->code)},
                           {"level", name_of(diagnostic->severity)},
                           {"message", message_of(diagnostic->message)}};
    if (diagnostic->span.has_place())
      result["locations"] = ordered_json::array({location_of(diagnostic->span, sources)});
    if (!diagnostic->notes.empty()) result["relatedLocations"] = related_locations_of(*diagnostic, sources);
    if (const auto& fix = diagnostic->fix; fix && fix->span.has_place())
      result["fixes"] = ordered_json::array({fix_of(*fix, sources)});
    content_->results.push_back(std::move(result));
  }
}

bool SarifLog::empty() const { return content_->results.empty(); }

void SarifLog::print(std::ostream& out) const {
  const ordered_json driver = {{"name", "Moonshade"},
                               {"version", MOONSHADE_VERSION},
                               {"semanticVersion", MOONSHADE_VERSION},
                               {"rules", content_->rules}};
  const ordered_json run = {{"tool", {{"driver", driver}}},
                            {"defaultEncoding", "UTF-8"},
                            {"defaultSourceLanguage", "lua"},
                            {"columnKind", "unicodeCodePoints"},
                            {"newlineSequences", {"\r\n", "\n\r", "\n", "\r"}}, // where Lua's lexer ends a line
                            {"results", content_->results}};
  const ordered_json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                            {"version", "2.1.0"},
                            {"runs", ordered_json::array({run})}};
  out << log.dump(2, ' ', false, ordered_json::error_handler_t::replace) << '\n';
}

void print_sarif(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out) {
  SarifLog log;
  log.add(diagnostics, sources);
  log.print(out);
}

} // namespace moonshade
