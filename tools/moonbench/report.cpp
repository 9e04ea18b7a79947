// Tables and JSON of measurements.
#include "tools/moonbench/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace moonshade::moonbench {

std::string table(const std::vector<Row>& rows) {
  size_t shader = 6, entry = 5;
  for (const Row& row : rows) {
    shader = std::max(shader, row.shader.size());
    entry = std::max(entry, row.entry.size());
  }
  char line[512];
  std::snprintf(line, sizeof line, "%-*s  %-*s  %-6s  %5s  %10s  %8s  %10s  %10s  %s\n", int(shader), "shader",
                int(entry), "entry", "mode", "width", "Mpoints/s", "x lua", "compile ms", "max diff", "differing");
  std::string text = line;
  for (const Row& row : rows) {
    std::snprintf(line, sizeof line, "%-*s  %-*s  %-6s  %5u  %10.3f  %8.1f  %10.2f  %10.3g  %llu%s\n", int(shader),
                  row.shader.c_str(), int(entry), row.entry.c_str(), row.mode.c_str(), row.width,
                  row.mpoints_per_second, row.ratio_to_lua, row.compile_ms, row.max_difference,
                  static_cast<unsigned long long>(row.differing_points), row.agrees ? "" : "  TOO MANY");
    text += line;
  }
  return text;
}

std::string json(const std::vector<Row>& rows) {
  auto array = nlohmann::ordered_json::array();
  for (const Row& row : rows)
    array.push_back({{"shader", row.shader},
                     {"entry", row.entry},
                     {"mode", row.mode},
                     {"width", row.width},
                     {"mpoints_per_second", row.mpoints_per_second},
                     {"ratio_to_lua", row.ratio_to_lua},
                     {"compile_ms", row.compile_ms},
                     {"max_difference", row.max_difference},
                     {"differing_points", row.differing_points},
                     {"faults", row.faults},
                     {"agrees", row.agrees}});
  return array.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace moonshade::moonbench
