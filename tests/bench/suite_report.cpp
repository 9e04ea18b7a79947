// Tables of the suite's results, as text, Markdown and JSON (suite_report.h).
#include "tests/bench/suite_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace moonshade::bench {

const Contestant* Result::best(Kind kind) const {
  const Contestant* best = nullptr;
  for (const Contestant& contestant : contestants)
    if (contestant.kind == kind && (best == nullptr || contestant.median() < best->median())) best = &contestant;
  return best;
}

const Contestant* Result::hand() const {
  const Contestant* wide = best(Kind::Hand);
  const Contestant* narrow = best(Kind::HandAvx2);
  if (wide == nullptr || narrow == nullptr) return wide != nullptr ? wide : narrow;
  return wide->median() < narrow->median() ? wide : narrow;
}

const Contestant* Result::chosen() const {
  const auto found = std::ranges::find_if(contestants, &Contestant::chosen);
  return found == contestants.end() ? nullptr : &*found;
}

const Contestant* Result::of_width(unsigned width) const {
  const auto found = std::ranges::find_if(
      contestants, [&](const Contestant& c) { return c.kind == Kind::Compiled && c.width == width; });
  return found == contestants.end() ? nullptr : &*found;
}

std::optional<double> Result::ratio(const Contestant* a, const Contestant* b) {
  if (a == nullptr || b == nullptr) return std::nullopt;
  return b->median() / a->median();
}

namespace {

template <class... Arguments> std::string format(const char* pattern, Arguments... arguments) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, pattern, arguments...);
  return buffer;
}

/// Three digits.
std::string speed(double mpoints) {
  return format(mpoints >= 99.95 ? "%.0f" : mpoints >= 9.995 ? "%.1f" : "%.2f", mpoints);
}
std::string times(std::optional<double> ratio) {
  return ratio ? format(*ratio >= 9.995 ? "%.0f" : "%.2f", *ratio) : "–";
}

const Result* find(const std::vector<Result>& results, const std::string& id) {
  const auto found = std::ranges::find_if(results, [&](const Result& result) { return id == result.workload->id; });
  return found == results.end() ? nullptr : &*found;
}

/// The workloads proper: the height is there for its gradient's sake.
bool counts(const Result& result) { return std::string(result.workload->id) != "height"; }

struct Ratio {
  const char* title;
  std::optional<double> (*of)(const Result&);
};
constexpr Ratio kRatios[] = {
    {"hand-written, the best", [](const Result& r) { return Result::ratio(r.chosen(), r.hand()); }},
    {"stock Lua", [](const Result& r) { return Result::ratio(r.chosen(), r.best(Kind::StockLua)); }},
    {"LuaJIT", [](const Result& r) { return Result::ratio(r.chosen(), r.best(Kind::LuaJit)); }},
    {"AVX2 alone: hand-written on 8 lanes",
     [](const Result& r) { return Result::ratio(r.best(Kind::CompiledAvx2), r.best(Kind::HandAvx2)); }},
};

std::optional<double> geometric_mean(const std::vector<Result>& results, const Ratio& ratio) {
  double sum = 0;
  int count = 0;
  for (const Result& result : results)
    if (const std::optional<double> value = ratio.of(result); value && counts(result)) {
      sum += std::log(*value);
      ++count;
    }
  return count != 0 ? std::optional(std::exp(sum / count)) : std::nullopt;
}

struct Gradient {
  double same_width = 0, best_width = 0; ///< time of the exact gradient by that of the height
};
std::optional<Gradient> gradient_cost(const std::vector<Result>& results) {
  const Result *slope = find(results, "W8ad"), *height = find(results, "height");
  if (slope == nullptr || height == nullptr || slope->chosen() == nullptr) return std::nullopt;
  const Contestant* same = height->of_width(slope->chosen()->width);
  const Contestant* best = height->best(Kind::Compiled);
  if (same == nullptr || best == nullptr) return std::nullopt;
  return Gradient{slope->chosen()->median() / same->median(), slope->chosen()->median() / best->median()};
}

std::string escaped(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

} // namespace

std::string text_table(const std::vector<Result>& results, const Summary& summary) {
  std::string out = summary.machine + format("; %u repetitions of at least %g s, interleaved; medians\n\n",
                                             summary.repetitions, summary.seconds);
  for (const Result& result : results) {
    out += format("%-7s %s (%s, %s)\n", result.workload->id, result.workload->title, result.workload->shader,
                  result.workload->entry);
    for (const Contestant& c : result.contestants)
      out += format("    %-17s %9s Mpoints/s  +-%4.1f %%  max diff %-8.2g %s%s%s\n", c.name.c_str(),
                    speed(c.mpoints()).c_str(), c.spread() * 100, c.max_difference,
                    c.compile_ms > 0 ? format("compiled in %.1f ms ", c.compile_ms).c_str() : "",
                    c.chosen ? "<- chosen " : "", c.agrees ? "" : format("DIFFERS at %zu points", c.differing).c_str());
  }
  out += "\nthe chosen width against:\n";
  for (const Ratio& ratio : kRatios) {
    out += format("  %-36s", ratio.title);
    for (const Result& result : results)
      if (counts(result)) out += format(" %s %-6s", result.workload->id, times(ratio.of(result)).c_str());
    out += format(" | geometric mean %s\n", times(geometric_mean(results, ratio)).c_str());
  }
  if (const auto gradient = gradient_cost(results))
    out += format("an exact gradient takes %.2f times one height at the same width, %.2f times at its best width\n",
                  gradient->same_width, gradient->best_width);
  return out;
}

std::string markdown(const std::vector<Result>& results, const Summary& summary) {
  std::string out =
      summary.machine + format(". %u repetitions of at least %g s by turns, medians; one thread, f32.\n\n",
                               summary.repetitions, summary.seconds);
  out += "Million points a second:\n\n| implementation |";
  std::string rule = "|---|";
  for (const Result& result : results) {
    out += format(" %s |", result.workload->id);
    rule += "---|";
  }
  out += "\n" + rule + "\n";
  std::vector<std::string> names;
  for (const Result& result : results)
    for (const Contestant& contestant : result.contestants)
      if (std::ranges::find(names, contestant.name) == names.end()) names.push_back(contestant.name);
  for (const std::string& name : names) {
    out += "| " + escaped(name) + " |";
    for (const Result& result : results) {
      const auto found = std::ranges::find(result.contestants, name, &Contestant::name);
      const bool none = found == result.contestants.end();
      const char* mark = !none && found->chosen ? "**" : "";
      out += none ? " – |" : " " + std::string(mark) + speed(found->mpoints()) + mark + " |";
    }
    out += "\n";
  }
  out += "\nIn bold the width that the compiler chooses. It is, as a multiple of the speed of\n\n| |";
  rule = "|---|";
  for (const Result& result : results)
    if (counts(result)) {
      out += format(" %s |", result.workload->id);
      rule += "---|";
    }
  out += " geometric mean |\n" + rule + "---|\n";
  for (const Ratio& ratio : kRatios) {
    out += format("| %s |", ratio.title);
    for (const Result& result : results)
      if (counts(result)) out += " " + times(ratio.of(result)) + " |";
    out += " " + times(geometric_mean(results, ratio)) + " |\n";
  }
  double widest = 0;
  for (const Result& result : results)
    for (const Contestant& contestant : result.contestants)
      widest = std::max(widest, contestant.spread());
  if (const auto gradient = gradient_cost(results))
    out += format("\nThe exact gradient takes %.2f times one height at the same width and %.2f times the height at its "
                  "best width.",
                  gradient->same_width, gradient->best_width);
  out += format(" The middle half of the repetitions lies within ±%.0f %% of the median everywhere.\n",
                std::ceil(widest * 100));
  return out;
}

std::string json(const std::vector<Result>& results, const Summary& summary) {
  nlohmann::ordered_json root;
  root["machine"] = summary.machine;
  root["repetitions"] = summary.repetitions;
  root["workloads"] = nlohmann::ordered_json::array();
  for (const Result& result : results) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Contestant& c : result.contestants)
      rows.push_back({{"name", c.name},
                      {"width", c.width},
                      {"chosen", c.chosen},
                      {"mpoints_per_second", c.mpoints()},
                      {"spread", c.spread()},
                      {"compile_ms", c.compile_ms},
                      {"max_difference", c.max_difference},
                      {"differing_points", c.differing},
                      {"agrees", c.agrees}});
    nlohmann::ordered_json ratios;
    for (const Ratio& ratio : kRatios)
      if (const auto value = ratio.of(result)) ratios[ratio.title] = *value;
    root["workloads"].push_back({{"id", result.workload->id},
                                 {"title", result.workload->title},
                                 {"shader", result.workload->shader},
                                 {"entry", result.workload->entry},
                                 {"implementations", std::move(rows)},
                                 {"ratios", std::move(ratios)}});
  }
  if (const auto gradient = gradient_cost(results))
    root["gradient"] = {{"same_width", gradient->same_width}, {"best_width", gradient->best_width}};
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace moonshade::bench
