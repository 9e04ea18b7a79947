// For tests: parses a text and keeps what comes of it.
#pragma once

#include "compiler/syntax/parser.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace moonshade::syntax {

struct Parsed {
  explicit Parsed(std::string text) {
    file = sources.add("t.lua", std::move(text));
    chunk = parse(sources, file, arena, diagnostics);
  }

  /// The tree, without its first line.
  std::string tree() const {
    std::ostringstream out;
    print_ast(*chunk, out);
    return out.str().substr(out.str().find('\n') + 1);
  }

  /// Each diagnostic as "line:column code", a blank between them.
  std::string errors() const {
    std::string result;
    for (const Diagnostic* diagnostic : diagnostics.sorted()) {
      const LineColumn place = sources.position(file, diagnostic->span.begin);
      if (!result.empty()) result += ' ';
      result += std::to_string(place.line) + ':' + std::to_string(place.column) + ' ' +
                std::string(name_of(diagnostic->code));
    }
    return result;
  }

  /// The first diagnostic's message.
  std::string message() const { return diagnostics.empty() ? "" : diagnostics.sorted().front()->message; }

  std::string_view text_of(Span span) const { return sources.text(span); }

  template <class T> const T& stat(size_t index) const {
    const T* found = try_as<T>(static_cast<const Stat*>(chunk->main->body->stats[index]));
    if (found == nullptr) throw std::logic_error("the statement is of another kind");
    return *found;
  }

  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  FileId file;
  Chunk* chunk;
};

} // namespace moonshade::syntax
