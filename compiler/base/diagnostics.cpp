// The collection of diagnostics and the table of their wording.
#include "compiler/base/diagnostics.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace moonshade {
namespace {

struct CodeRow {
  std::string_view name;
  Severity severity;
  std::string_view message;
};

constexpr auto kRows = std::to_array<CodeRow>({
#define MOONSHADE_DIAGNOSTIC(name, code, severity, message) {code, Severity::severity, message},
#include "compiler/base/diagnostic_codes.def"
});

const CodeRow& row_of(DiagnosticCode code) { return kRows.at(static_cast<size_t>(code)); }

} // namespace

std::string_view name_of(DiagnosticCode code) { return row_of(code).name; }
Severity severity_of(DiagnosticCode code) { return row_of(code).severity; }

std::string_view name_of(Severity severity) {
  switch (severity) {
  case Severity::Error:
    return "error";
  case Severity::Warning:
    return "warning";
  case Severity::Note:
    return "note";
  }
  return "?";
}

/// What messages quote: a name or a chain of calls may be as long as the file.
static std::string shortened(const std::string& text) {
  constexpr size_t kMost = 1000, kHead = 400, kTail = 100;
  if (text.size() <= kMost) return text;
  return text.substr(0, kHead) + " ... " + text.substr(text.size() - kTail);
}

std::string format_message(DiagnosticCode code, std::initializer_list<std::string> args) {
  const std::string_view pattern = row_of(code).message;
  std::string result;
  for (size_t i = 0; i < pattern.size(); ++i) {
    const std::string_view rest = pattern.substr(i);
    if (rest.starts_with("{{") || rest.starts_with("}}")) {
      result += rest[0];
      ++i;
    } else if (rest.size() >= 3 && rest[0] == '{' && rest[1] >= '0' && rest[1] <= '9' && rest[2] == '}') {
      const auto index = static_cast<size_t>(rest[1] - '0');
      if (index < args.size()) result += shortened(args.begin()[index]);
      i += 2;
    } else {
      result += rest[0];
    }
  }
  return result;
}

Diagnostic& Diagnostic::note(DiagnosticCode note_code, Span note_span, std::initializer_list<std::string> args) {
  notes.push_back({note_span, format_message(note_code, args)});
  return *this;
}

Diagnostic& Diagnostic::suggest(Span fix_span, std::string replacement) {
  fix = DiagnosticFix{fix_span, std::move(replacement)};
  return *this;
}

Diagnostic& Diagnostics::report(DiagnosticCode code, Span span, std::initializer_list<std::string> args) {
  const Severity severity = severity_of(code);
  const bool is_error = severity == Severity::Error;
  size_t& count = is_error ? error_count_ : warning_count_;
  const size_t limit = is_error ? kMaxErrors : kMaxWarnings;
  dropped_ = {};
  if (is_repeated(code, span) || count > limit || (!is_error && count == limit)) return dropped_;
  if (++count > limit) {
    kept_.push_back(
        {DiagnosticCode::TooManyErrors, Severity::Error, span, format_message(DiagnosticCode::TooManyErrors), {}, {}});
    return dropped_;
  }
  return kept_.emplace_back(Diagnostic{code, severity, span, format_message(code, args), {}, {}});
}

bool Diagnostics::is_repeated(DiagnosticCode code, Span span) const {
  return std::any_of(kept_.begin(), kept_.end(),
                     [&](const Diagnostic& kept) { return kept.code == code && kept.span == span; });
}

std::vector<const Diagnostic*> Diagnostics::sorted() const {
  using Key = std::tuple<bool, FileId, uint32_t, size_t>;
  std::vector<std::pair<Key, const Diagnostic*>> keyed;
  for (const Diagnostic& d : kept_)
    keyed.emplace_back(Key(d.code == DiagnosticCode::TooManyErrors, d.span.file, d.span.begin, keyed.size()), &d);
  std::sort(keyed.begin(), keyed.end());
  std::vector<const Diagnostic*> result;
  for (const auto& [key, diagnostic] : keyed)
    result.push_back(diagnostic);
  return result;
}

void print_diagnostics(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out,
                       const DiagnosticPrintOptions& options) {
  switch (options.format) {
  case DiagnosticFormat::Text:
    return print_text(diagnostics, sources, out, options.colour);
  case DiagnosticFormat::Json:
    return print_json(diagnostics, sources, out);
  case DiagnosticFormat::Sarif:
    return print_sarif(diagnostics, sources, out);
  }
}

} // namespace moonshade
