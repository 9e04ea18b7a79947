// What the suite prints: tables, JSON, Markdown, and a plot.
#pragma once

#include "tests/bench/contestants.h"

#include <optional>
#include <string>
#include <vector>

namespace moonshade::bench {

struct Result {
  const Workload* workload = nullptr;
  std::vector<Contestant> contestants;

  /// The fastest of a kind; null where there is none.
  const Contestant* best(Kind kind) const;
  const Contestant* hand() const;   ///< the fastest written by hand, whatever its width
  const Contestant* chosen() const; ///< compiled code of the width that the compiler chose
  const Contestant* of_width(unsigned width) const;
  /// How many times as fast; nothing where one is missing.
  static std::optional<double> ratio(const Contestant* a, const Contestant* b);
};

struct Summary {
  std::string machine; ///< the processor, and what code is made for
  unsigned repetitions = 0;
  double seconds = 0; ///< of one repetition, at least
};

std::string text_table(const std::vector<Result>& results, const Summary& summary);
std::string json(const std::vector<Result>& results, const Summary& summary);
/// The measured part of docs/speed.md.
std::string markdown(const std::vector<Result>& results, const Summary& summary);
std::string plot(const std::vector<Result>& results);

} // namespace moonshade::bench
