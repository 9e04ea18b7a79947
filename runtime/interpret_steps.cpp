// Step counting and checked tables for stock Lua, by insertions: of steps at places that the syntax tree gives (a body
// begins behind a keyword or a `)` that ends a parameter list, where `(` cannot be read as a call's arguments), of
// checks around the tokens `{` and `}`, which stand in table constructors alone.
#include "runtime/interpret_steps.h"

#include "compiler/syntax/lexer.h"

#include <algorithm>
#include <vector>

namespace moonshade {

namespace {

using namespace syntax;

constexpr std::string_view kStep = "(\"\")();";

class Insertions {
public:
  void add_functions(const Chunk& chunk, CountedSteps steps) {
    for (const Function* function : chunk.functions) {
      if (function != chunk.main && steps == CountedSteps::All) add_body(*function->body, function->end_span.begin);
      add_loops(*function->body);
    }
  }

  std::string apply(std::string_view text) {
    // Where two meet, the one that was added first comes first.
    std::ranges::sort(places_, {}, [](const Place& place) { return std::pair{place.at, place.number}; });
    std::string result;
    result.reserve(text.size() + places_.size() * kStep.size());
    size_t done = 0;
    for (const Place& place : places_) {
      result.append(text.substr(done, place.at - done)).append(place.text);
      done = place.at;
    }
    return result.append(text.substr(done));
  }

  /// `{ ... }` becomes `((""){ ... })`: the constructor's table as the argument of the same call.
  void add_tables(FileId file, std::string_view text) {
    Arena arena;
    Diagnostics ignored;
    Lexer lexer(file, text, arena, ignored);
    for (Token token = lexer.next(); token.kind != TokenKind::EndOfFile; token = lexer.next()) {
      if (token.kind == TokenKind::LeftBrace) add(token.span.begin, "((\"\")");
      if (token.kind == TokenKind::RightBrace) add(token.span.end, ")");
    }
  }

private:
  /// Before the first statement; in an empty body before the keyword that ends it.
  void add_body(const Block& body, uint32_t end) {
    add(body.stats.empty() ? end : body.stats.front()->span.begin, kStep);
  }

  /// The loops of a block, but not those of functions inside: these have a turn of their own.
  void add_loops(const Block& block) {
    constexpr uint32_t kEndLength = 3, kRepeatLength = 6;
    for (const Stat* stat : block.stats)
      visit(*stat, Overloaded{
                       [&](const DoStat& s) { add_loops(*s.body); },
                       [&](const WhileStat& s) { add_loop(*s.body, s.span.end - kEndLength); },
                       [&](const NumericForStat& s) { add_loop(*s.body, s.span.end - kEndLength); },
                       [&](const GenericForStat& s) { add_loop(*s.body, s.span.end - kEndLength); },
                       [&](const RepeatStat& s) {
                         add(s.span.begin + kRepeatLength, kStep);
                         add_loops(*s.body);
                       },
                       [&](const IfStat& s) {
                         for (const IfClause& clause : s.clauses)
                           add_loops(*clause.body);
                         if (s.else_body) add_loops(*s.else_body);
                       },
                       [](const auto&) {},
                   });
  }

  void add_loop(const Block& body, uint32_t end) {
    add_body(body, end);
    add_loops(body);
  }

  struct Place {
    uint32_t at;
    std::string_view text;
    size_t number;
  };
  void add(uint32_t at, std::string_view text) { places_.push_back({at, text, places_.size()}); }

  std::vector<Place> places_;
};

} // namespace

std::string with_counted_steps(const Chunk& chunk, std::string_view text, CountedSteps steps) {
  Insertions insertions;
  insertions.add_functions(chunk, steps);
  if (steps == CountedSteps::All) insertions.add_tables(chunk.file, text);
  return insertions.apply(text);
}

} // namespace moonshade
