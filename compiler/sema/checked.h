// For tests: parses and checks a source text.
#pragma once

#include "compiler/sema/program.h"
#include "compiler/syntax/parser.h"

#include <sstream>
#include <string>
#include <vector>

namespace moonshade::sema {

struct Checked {
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  Program program;
  std::string text; ///< the diagnostics, where some is an error

  explicit Checked(const std::string& source, const std::vector<std::string>& entries = {}) {
    const FileId file = sources.add("test.lua", source);
    const syntax::Chunk* chunk = syntax::parse(sources, file, arena, diagnostics);
    if (!diagnostics.has_errors()) program = check(*chunk, {entries}, diagnostics);
    std::ostringstream out;
    print_text(diagnostics, sources, out);
    if (diagnostics.has_errors()) text = out.str();
  }

  /// "3:7 unknown-name", in order of place.
  std::vector<std::string> errors() const { return places(Severity::Error); }
  std::vector<std::string> warnings() const { return places(Severity::Warning); }

  std::vector<std::string> places(Severity severity) const {
    std::vector<std::string> list;
    for (const Diagnostic* diagnostic : diagnostics.sorted()) {
      if (diagnostic->severity != severity) continue;
      const LineColumn at = sources.position(diagnostic->span.file, diagnostic->span.begin);
      list.push_back(std::to_string(at.line) + ":" + std::to_string(at.column) + " " +
                     std::string(name_of(diagnostic->code)));
    }
    return list;
  }

  const Specialisation* find(const std::string& name) const {
    for (const auto& specialisation : program.specialisations)
      if (specialisation->name == name) return specialisation.get();
    return nullptr;
  }

  /// The type of a local of a specialisation, by its name.
  Type local_type(const std::string& specialisation, std::string_view local) const {
    const Specialisation* found = find(specialisation);
    if (found == nullptr) return {};
    for (const auto& [declaration, fact] : found->locals)
      if (declaration->name == local) return fact.type;
    return {};
  }
};

} // namespace moonshade::sema
