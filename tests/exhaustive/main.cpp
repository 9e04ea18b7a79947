// exhaustive [floats|pairs|ranges] [NAME...] [--samples=N] [--stride=N] [--threads=N]: the long tests of the standard
// library. Exits 1 where a bound is exceeded.
#include "tests/exhaustive/exhaustive.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace moonshade::exhaustive {

bool Options::wants(const std::string& name) const { return names.empty() || std::ranges::count(names, name) > 0; }

void on_threads(unsigned threads, const std::function<void(unsigned)>& part) {
  std::vector<std::thread> running;
  for (unsigned i = 0; i < threads; ++i)
    running.emplace_back(part, i);
  for (std::thread& thread : running)
    thread.join();
}

} // namespace moonshade::exhaustive

int main(int argc, char** argv) {
  using namespace moonshade::exhaustive;
  Options options;
  options.threads = std::max(1u, std::thread::hardware_concurrency());
  std::string which;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto value = [&](const char* option, auto& into) {
      const std::string begin = std::string("--") + option + "=";
      if (!argument.starts_with(begin)) return false;
      into = std::max(1ull, std::strtoull(argument.c_str() + begin.size(), nullptr, 10));
      return true;
    };
    if (value("samples", options.samples) || value("stride", options.stride) || value("threads", options.threads))
      continue;
    if (argument.starts_with("--")) {
      std::fprintf(stderr, "exhaustive: no option %s\n", argument.c_str());
      return 2;
    }
    if (which.empty() && (argument == "floats" || argument == "pairs" || argument == "ranges"))
      which = argument;
    else
      options.names.push_back(argument);
  }
  bool holds = true;
  if (which.empty() || which == "floats") holds &= check_floats(options);
  if (which.empty() || which == "pairs") holds &= check_pairs(options);
  if (which.empty() || which == "ranges") holds &= check_ranges(options);
  return holds ? 0 : 1;
}
