// `load`, `compile` and `render` are wall-clock seconds; `shade`, `trace`, `film` and `shaders` (the part of `shade`
// within shaders) are sums over the threads.
#include "tools/moonrender/stats.h"

#include "tools/support/files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace moonshade::moonrender {

static uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return uint64_t(usage.ru_maxrss) * 1024;
}

std::string check_stats_place(const Options& options) {
  if (options.stats.empty() || options.stats == "-") return "";
  std::filesystem::path path(options.stats);
  std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return options.stats + ": is a folder";
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return options.stats + ": " + std::strerror(errno);
  return "";
}

std::string write_stats(const Options& options, const renderer::PreparedScene& scene,
                        const renderer::RenderResult& result, double load_seconds) {
  if (options.stats.empty()) return "";
  const renderer::WorkerStats& s = result.stats;
  nlohmann::ordered_json json;
  json["seconds"] = {{"load", load_seconds},       {"compile", scene.compile_seconds}, {"render", result.seconds},
                     {"shade", s.shade_seconds},   {"trace", s.trace_seconds},         {"film", s.film_seconds},
                     {"shaders", s.shader_seconds}};
  json["paths"] = s.paths;
  json["rays"] = s.rays;
  json["shading_points"] = s.shading_points;
  json["faults"] = result.fault_count;
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["threads"] = result.threads;
  json["width"] = scene.materials.width();
  json["samples"] = result.samples;
  json["mean_samples"] = result.mean_samples;
  json["interrupted"] = result.interrupted;
  json["backend"] = options.shaders.backend == renderer::Backend::Jit ? "jit" : "interp";
  std::string text = json.dump(2) + "\n";
  std::string error = tools::write_file(options.stats, text);
  return error.empty() ? "" : (options.stats == "-" ? "standard output" : options.stats) + ": " + error;
}

} // namespace moonshade::moonrender
