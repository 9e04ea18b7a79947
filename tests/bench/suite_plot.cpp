// The suite's plot as SVG: a row of marks for each workload on a logarithmic axis, from stock Lua to the fastest.
#include "tests/bench/suite_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace moonshade::bench {

namespace {

constexpr double kLeft = 150, kRight = 30, kTop = 64, kRow = 34, kBottom = 40, kWidth = 860;

struct Series {
  const char* title;
  const char* colour;
  double size; ///< radius of the mark
  const Contestant* (*of)(const Result&);
};
constexpr Series kSeries[] = {
    {"stock Lua", "#9aa4b1", 5, [](const Result& r) { return r.best(Kind::StockLua); }},
    {"LuaJIT", "#c9a227", 5, [](const Result& r) { return r.best(Kind::LuaJit); }},
    {"compiled, one lane", "#8fb4e8", 5, [](const Result& r) { return r.of_width(1); }},
    {"hand-written SIMD", "#d1495b", 7, [](const Result& r) { return r.hand(); }},
    {"compiled", "#1f4e9c", 4.5, [](const Result& r) { return r.chosen(); }},
};

template <class... Arguments> void print(std::string& out, const char* pattern, Arguments... arguments) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, pattern, arguments...);
  out += buffer;
}

struct Axis {
  double low = INFINITY, high = 0;
  explicit Axis(const std::vector<Result>& results) {
    for (const Result& result : results)
      for (const Series& series : kSeries)
        if (const Contestant* contestant = series.of(result)) {
          low = std::min(low, contestant->mpoints());
          high = std::max(high, contestant->mpoints());
        }
    low = std::floor(std::log10(low));
    high = std::ceil(std::log10(high) + 0.02);
  }
  double x(double mpoints) const {
    return kLeft + (std::log10(mpoints) - low) / (high - low) * (kWidth - kLeft - kRight);
  }
};

} // namespace

std::string plot(const std::vector<Result>& results) {
  const Axis axis(results);
  const double height = kTop + kRow * static_cast<double>(results.size()) + kBottom;
  std::string out;
  print(out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" "
        "font-family=\"sans-serif\" font-size=\"12\" fill=\"#20262e\">\n",
        kWidth, height, kWidth, height);
  print(out, "<rect width=\"%g\" height=\"%g\" fill=\"white\"/>\n", kWidth, height);
  double x = kLeft;
  for (const Series& series : kSeries) {
    print(out, "<circle cx=\"%.1f\" cy=\"22\" r=\"%g\" fill=\"%s\"/>\n", x, series.size, series.colour);
    print(out, "<text x=\"%.1f\" y=\"26\">%s</text>\n", x + 12, series.title);
    x += 34 + 6.6 * static_cast<double>(std::string(series.title).size());
  }
  const double bottom = height - kBottom;
  for (double decade = axis.low; decade <= axis.high; ++decade) {
    const double at = axis.x(std::pow(10, decade));
    print(out, "<line x1=\"%.1f\" y1=\"%g\" x2=\"%.1f\" y2=\"%g\" stroke=\"#d8dde3\"/>\n", at, kTop - 16, at, bottom);
    print(out, "<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%g</text>\n", at, bottom + 18, std::pow(10, decade));
  }
  print(out, "<text x=\"%g\" y=\"%g\" text-anchor=\"end\">million points a second</text>\n", kWidth - kRight,
        height - 6);
  double y = kTop;
  for (const Result& result : results) {
    print(out, "<text x=\"%g\" y=\"%g\" text-anchor=\"end\">%s</text>\n", kLeft - 14, y + 4, result.workload->title);
    double least = INFINITY, most = 0;
    std::string marks;
    for (const Series& series : kSeries)
      if (const Contestant* contestant = series.of(result)) {
        const double at = axis.x(contestant->mpoints());
        least = std::min(least, at);
        most = std::max(most, at);
        print(marks, "<circle cx=\"%.1f\" cy=\"%g\" r=\"%g\" fill=\"%s\"/>\n", at, y, series.size, series.colour);
      }
    if (most > 0)
      print(out, "<line x1=\"%.1f\" y1=\"%g\" x2=\"%.1f\" y2=\"%g\" stroke=\"#b9c2cc\"/>\n", least, y, most, y);
    out += marks;
    y += kRow;
  }
  return out + "</svg>\n";
}

} // namespace moonshade::bench
