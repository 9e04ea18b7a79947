// Step counting for stock Lua, by insertions at places that the syntax tree gives. A body begins behind a keyword or a
// `)` that ends a parameter list, where `(` cannot be read as a call's arguments.
#include "runtime/interpret_steps.h"

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
    std::sort(places_.begin(), places_.end());
    std::string result;
    result.reserve(text.size() + places_.size() * kStep.size());
    size_t done = 0;
    for (uint32_t place : places_) {
      result.append(text.substr(done, place - done)).append(kStep);
      done = place;
    }
    return result.append(text.substr(done));
  }

private:
  /// Before the first statement; in an empty body before the keyword that ends it.
  void add_body(const Block& body, uint32_t end) {
    places_.push_back(body.stats.empty() ? end : body.stats.front()->span.begin);
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
                         places_.push_back(s.span.begin + kRepeatLength);
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

  std::vector<uint32_t> places_;
};

} // namespace

std::string with_counted_steps(const Chunk& chunk, std::string_view text, CountedSteps steps) {
  Insertions insertions;
  insertions.add_functions(chunk, steps);
  return insertions.apply(text);
}

} // namespace moonshade
