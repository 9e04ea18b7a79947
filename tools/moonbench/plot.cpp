// A bar chart of measurements as SVG. Rows of one shader and entry stand side by side and form a group.
#include "tools/moonbench/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace moonshade::moonbench {

namespace {

constexpr double kBar = 22, kGap = 24, kLeft = 64, kTop = 44, kHeight = 300, kBottom = 110;

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

const char* colour(const std::string& mode) {
  if (mode == "lua") return "#9aa4b1";
  if (mode == "luajit") return "#c9a227";
  return mode == "scalar" ? "#5b8fd9" : "#1f4e9c";
}

/// SVG text is built from pieces of printf's.
template <class... Arguments> void print(std::string& out, const char* format, Arguments... arguments) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, arguments...);
  out += buffer;
}

/// Decades of the logarithmic axis.
struct Axis {
  double low, high;
  explicit Axis(const std::vector<Row>& rows) {
    double least = INFINITY, most = 1e-9;
    for (const Row& row : rows) {
      least = std::min(least, row.mpoints_per_second);
      most = std::max(most, row.mpoints_per_second);
    }
    low = std::floor(std::log10(std::max(std::min(least, most), 1e-6)) - 0.1);
    high = std::ceil(std::log10(most) + 0.05);
  }
  double y(double value) const {
    const double part = (std::log10(std::max(value, 1e-9)) - low) / (high - low);
    return kTop + kHeight * (1 - std::clamp(part, 0.0, 1.0));
  }
};

void draw_axis(std::string& out, const Axis& axis, double width) {
  for (double decade = axis.low; decade <= axis.high; ++decade) {
    const double y = axis.y(std::pow(10, decade));
    print(out, "<line x1=\"%g\" y1=\"%.1f\" x2=\"%g\" y2=\"%.1f\" stroke=\"#d8dde3\"/>\n", kLeft, y, width - kGap, y);
    print(out, "<text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", kLeft - 8, y + 4, std::pow(10, decade));
  }
  print(out, "<text x=\"%g\" y=\"20\">million points a second (logarithmic)</text>\n", kLeft);
}

void draw_key(std::string& out, const std::vector<Row>& rows, double width) {
  double x = width - kGap;
  for (const char* mode : {"simd", "scalar", "luajit", "lua"}) {
    if (std::none_of(rows.begin(), rows.end(), [&](const Row& row) { return row.mode == mode; })) continue;
    x -= 70;
    print(out, "<rect x=\"%.1f\" y=\"10\" width=\"12\" height=\"12\" fill=\"%s\"/>\n", x, colour(mode));
    print(out, "<text x=\"%.1f\" y=\"20\">%s</text>\n", x + 16, mode);
  }
}

} // namespace

std::string plot(const std::vector<Row>& rows) {
  const Axis axis(rows);
  std::string bars;
  double x = kLeft;
  for (size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const bool starts_group = i == 0 || rows[i - 1].shader != row.shader || rows[i - 1].entry != row.entry;
    if (starts_group) {
      x += kGap;
      const std::string label = escaped(std::filesystem::path(row.shader).stem().string() + "." + row.entry);
      print(bars, "<text transform=\"translate(%.1f %.1f) rotate(40)\">%s</text>\n", x + 4, kTop + kHeight + 16,
            label.substr(0, 60).c_str());
    }
    const double y = axis.y(row.mpoints_per_second);
    print(bars, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%g\" height=\"%.1f\" fill=\"%s\"/>\n", x, y, kBar - 2,
          kTop + kHeight - y, colour(row.mode));
    print(bars, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"9\">%.3g</text>\n", x + kBar / 2 - 1,
          y - 3, row.mpoints_per_second);
    x += kBar;
  }
  const double width = std::max(x + 2 * kGap, 520.0), height = kTop + kHeight + kBottom;
  std::string svg;
  print(svg, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" ", width,
        height, width, height);
  svg += "font-family=\"sans-serif\" font-size=\"12\" fill=\"#20262e\">\n";
  print(svg, "<rect width=\"%g\" height=\"%g\" fill=\"white\"/>\n", width, height);
  draw_axis(svg, axis, width);
  draw_key(svg, rows, width);
  return svg + bars + "</svg>\n";
}

} // namespace moonshade::moonbench
