// Diagnostics as text for people: place and message, the source line, and an underline of the span. Lines of any
// content and length are shown safely: bytes by printable.h, long lines cut around the span.
#include "compiler/base/diagnostics.h"
#include "compiler/base/printable.h"

#include <ostream>

namespace moonshade {
namespace {

constexpr size_t kMaxColumns = 110;   // of source text shown
constexpr size_t kColumnsBefore = 60; // of these, at most so many before the span
constexpr std::string_view kTab = "    ";

struct Colours {
  std::string_view bold, error, warning, note, reset;
};
constexpr Colours kPlain = {};
constexpr Colours kAnsi = {"\x1b[1m", "\x1b[1;31m", "\x1b[1;35m", "\x1b[1;36m", "\x1b[0m"};

std::string_view colour_of(Severity severity, const Colours& colours) {
  switch (severity) {
  case Severity::Error:
    return colours.error;
  case Severity::Warning:
    return colours.warning;
  case Severity::Note:
    return colours.note;
  }
  return {};
}

PrintableCharacter shown_character(std::string_view text) {
  if (text.front() == '\t') return {1, std::string(kTab), kTab.size()};
  return printable_character(text);
}

/// The beginning of the excerpt of a line: at a character's border, so many bytes before `begin` that they take at most
/// kColumnsBefore columns (one byte takes up to four).
size_t excerpt_begin(std::string_view line, size_t begin) {
  size_t at = begin > kColumnsBefore ? begin - kColumnsBefore : 0;
  while (at > 0 && at < begin && (static_cast<unsigned char>(line[at]) & 0xC0) == 0x80)
    ++at;
  size_t columns = 0;
  for (size_t i = at; i < begin;) {
    const PrintableCharacter character = shown_character(line.substr(i));
    columns += character.columns;
    i += character.bytes;
  }
  while (columns > kColumnsBefore) {
    const PrintableCharacter character = shown_character(line.substr(at));
    columns -= character.columns;
    at += character.bytes;
  }
  return at;
}

struct Excerpt {
  std::string text;
  std::string underline;
};

/// Bytes [begin, end) of the line underlined, at least one column (also just after the end of the line).
Excerpt make_excerpt(std::string_view line, size_t begin, size_t end) {
  Excerpt excerpt;
  size_t at = excerpt_begin(line, begin);
  size_t columns = 0;
  if (at > 0) {
    excerpt.text = "...";
    excerpt.underline = "   ";
  }
  while (at < line.size() && columns < kMaxColumns) {
    const PrintableCharacter character = shown_character(line.substr(at));
    const bool is_inside = at + character.bytes > begin && at < end;
    const bool is_first = is_inside && excerpt.underline.find('^') == std::string::npos;
    excerpt.text += character.shown;
    if (is_first)
      excerpt.underline += '^' + std::string(character.columns - 1, '~');
    else
      excerpt.underline += std::string(character.columns, is_inside ? '~' : ' ');
    columns += character.columns;
    at += character.bytes;
  }
  if (at < line.size()) excerpt.text += "...";
  if (excerpt.underline.find('^') == std::string::npos) {
    // Nothing of the line lies in the span: an empty span, or one at the end of the line.
    size_t column = excerpt.underline.size();
    if (begin < line.size()) column = make_excerpt(line, begin, begin + 1).underline.find('^');
    excerpt.underline.resize(std::max(column, excerpt.underline.size()), ' ');
    excerpt.underline.resize(column);
    excerpt.underline += '^';
  }
  excerpt.underline.erase(excerpt.underline.find_last_not_of(' ') + 1);
  return excerpt;
}

void print_excerpt(Span span, const SourceSet& sources, std::ostream& out, std::string_view colour,
                   const Colours& colours) {
  const LineColumn place = sources.position(span.file, span.begin);
  const std::string_view line = sources.line_text(span.file, place.line);
  const size_t begin = place.column - 1;
  const Excerpt excerpt = make_excerpt(line, begin, begin + span.size());
  std::string number = std::to_string(place.line);
  if (number.size() < 5) number.insert(0, 5 - number.size(), ' ');
  out << number << " | " << excerpt.text << '\n';
  out << std::string(number.size(), ' ') << " | " << colour << excerpt.underline << colours.reset << '\n';
}

void print_line(Severity severity, Span span, std::string_view message, std::string_view code, const SourceSet& sources,
                std::ostream& out, const Colours& colours) {
  const std::string_view colour = colour_of(severity, colours);
  out << colours.bold;
  if (span.has_place()) {
    const LineColumn place = sources.position(span.file, span.begin);
    out << printable(sources.name(span.file)) << ':' << place.line << ':' << place.column << ": ";
  }
  out << colours.reset << colour << name_of(severity) << ": " << colours.reset << colours.bold << printable(message)
      << colours.reset;
  if (!code.empty()) out << " [" << code << ']';
  out << '\n';
  if (span.has_place()) print_excerpt(span, sources, out, colour, colours);
}

} // namespace

void print_text(const Diagnostics& diagnostics, const SourceSet& sources, std::ostream& out, bool colour) {
  const Colours& colours = colour ? kAnsi : kPlain;
  for (const Diagnostic* diagnostic : diagnostics.sorted()) {
    print_line(diagnostic->severity, diagnostic->span, diagnostic->message, name_of(diagnostic->code), sources, out,
               colours);
    for (const DiagnosticNote& note : diagnostic->notes)
      print_line(Severity::Note, note.span, note.message, {}, sources, out, colours);
    if (const auto& fix = diagnostic->fix) {
      const bool removes = fix->replacement.empty();
      print_line(Severity::Note, fix->span,
                 removes ? format_message(DiagnosticCode::NoteRemove)
                         : format_message(DiagnosticCode::NoteWriteInstead, {fix->replacement}),
                 {}, sources, out, colours);
    }
  }
}

} // namespace moonshade
