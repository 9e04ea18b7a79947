// Diagnostics are values: a code, a place, a message, notes, sometimes a fix. They are collected while compiling, and
// sorted and printed at the end. All wording stands in diagnostic_codes.def.
#pragma once

#include "compiler/base/source.h"

#include <cstddef>
#include <deque>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade {

enum class Severity : uint8_t { Error, Warning, Note };

enum class DiagnosticCode : uint16_t {
#define MOONSHADE_DIAGNOSTIC(name, code, severity, message) name,
#include "compiler/base/diagnostic_codes.def"
};

/// The stable kebab-case name.
std::string_view name_of(DiagnosticCode code);
Severity severity_of(DiagnosticCode code);
/// "error", "warning" or "note".
std::string_view name_of(Severity severity);
/// The wording of `code` with {0}, {1}, ... replaced.
std::string format_message(DiagnosticCode code, std::initializer_list<std::string> args = {});

/// Another place that a diagnostic points at.
struct DiagnosticNote {
  Span span;
  std::string message;
};

/// Text that, put in place of the span, removes the fault.
struct DiagnosticFix {
  Span span;
  std::string replacement;
};

struct Diagnostic {
  DiagnosticCode code = {};
  Severity severity = Severity::Error;
  Span span;
  std::string message;
  std::vector<DiagnosticNote> notes;
  std::optional<DiagnosticFix> fix;

  /// Adds a note worded by a row of severity Note.
  Diagnostic& note(DiagnosticCode note_code, Span note_span, std::initializer_list<std::string> args = {});
  Diagnostic& suggest(Span fix_span, std::string replacement);
};

/// What one compilation has to say.
class Diagnostics {
public:
  static constexpr size_t kMaxErrors = 100;
  static constexpr size_t kMaxWarnings = 100;

  /// Adds a diagnostic, to which notes and a fix may then be attached. After kMaxErrors errors one `too-many-errors`
  /// is added and all that follows is dropped (the reference is then to a value that nobody prints). A second
  /// diagnostic of the same code at the same span is dropped too.
  Diagnostic& report(DiagnosticCode code, Span span, std::initializer_list<std::string> args = {});

  bool has_errors() const { return error_count_ != 0; }
  size_t error_count() const { return error_count_; }
  bool empty() const { return kept_.empty(); }

  /// By file and place; those at one place in the order in which they were reported. `too-many-errors` comes last.
  std::vector<const Diagnostic*> sorted() const;

private:
  bool is_repeated(DiagnosticCode code, Span span) const;

  std::deque<Diagnostic> kept_; // references stay valid
  Diagnostic dropped_;
  size_t error_count_ = 0;
  size_t warning_count_ = 0;
};

enum class DiagnosticFormat : uint8_t { Text, Json, Sarif };

struct DiagnosticPrintOptions {
  DiagnosticFormat format = DiagnosticFormat::Text;
  bool colour = false;
};

/// Prints all, sorted. Text: `FILE:LINE:COLUMN: error: message [code]`, the source line and its underline, then the
/// notes; nothing where there is nothing to say. JSON: one array. SARIF: one log of one run.
void print_diagnostics(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out,
                       const DiagnosticPrintOptions& options = {});

/// The forms one by one.
void print_text(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out, bool colour = false);
void print_json(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out);
void print_sarif(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out);

/// SARIF 2.1.0 for the diagnostics of any number of compilations: one log of one run.
class SarifLog {
public:
  SarifLog();
  ~SarifLog();
  SarifLog(SarifLog&&) noexcept;
  SarifLog& operator=(SarifLog&&) noexcept;

  /// Takes the facts over; neither argument is kept.
  void add(const Diagnostics& diagnostics, const SourceSet& sources);
  bool empty() const;
  void print(std::ostream& out) const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace moonshade
