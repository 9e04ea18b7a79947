// A thread of its own looks at the counters; workers only count.
#include "tools/moonrender/progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace moonshade::moonrender {

namespace {

std::string duration(double seconds) {
  int total = int(std::clamp(seconds + 0.5, 0.0, 1e8));
  char text[40];
  if (total >= 3600)
    std::snprintf(text, sizeof text, "%d:%02d:%02d", total / 3600, total / 60 % 60, total % 60);
  else
    std::snprintf(text, sizeof text, "%d:%02d", total / 60, total % 60);
  return text;
}

} // namespace

ProgressDisplay::ProgressDisplay(const renderer::RenderProgress& progress, uint32_t samples, double time_limit,
                                 std::string what)
    : progress_(progress), samples_(samples), time_limit_(time_limit), what_(std::move(what)),
      terminal_(::isatty(STDERR_FILENO) == 1), thread_([this] { run(); }) {}

ProgressDisplay::~ProgressDisplay() {
  {
    std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressDisplay::run() {
  auto start = std::chrono::steady_clock::now();
  double next_line = 5;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(terminal_ ? 150 : 500), [this] { return done_; })) {
    double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (progress_.paths_total == 0) continue;
    double share = this->share(elapsed);
    if (terminal_) {
      draw_bar(share, elapsed);
    } else if (elapsed >= next_line) {
      print_line(share, elapsed);
      next_line = elapsed + std::clamp(elapsed, 5.0, 60.0);
    }
  }
}

double ProgressDisplay::share(double elapsed) const {
  double share = double(progress_.paths_done) / double(progress_.paths_total);
  if (time_limit_ > 0) share = std::max(share, elapsed / time_limit_);
  return std::min(share, 1.0);
}

std::string ProgressDisplay::facts(double share, double elapsed) const {
  // What an earlier run has done says nothing about how fast this one is.
  double before = double(progress_.paths_resumed) / double(progress_.paths_total);
  if (time_limit_ > 0) before = 0;
  std::string left = share > before ? duration(elapsed * (1 - share) / (share - before)) : "?";
  char text[120];
  std::snprintf(text, sizeof text, "%u/%u samples, %.2f M rays/s, ", unsigned(progress_.samples_done), samples_,
                double(progress_.rays_done - progress_.rays_resumed) / elapsed * 1e-6);
  return text + left + " left";
}

void ProgressDisplay::draw_bar(double share, double elapsed) const {
  constexpr int kCells = 32;
  std::string bar(size_t(share * kCells), '#');
  bar.resize(kCells, '.');
  std::fprintf(stderr, "\r%s[%s] %3.0f %%  %s\033[K", what_.c_str(), bar.c_str(), 100 * share,
               facts(share, elapsed).c_str());
  std::fflush(stderr);
}

void ProgressDisplay::print_line(double share, double elapsed) const {
  std::fprintf(stderr, "moonrender: %s%.0f %%, %s\n", what_.c_str(), 100 * share, facts(share, elapsed).c_str());
}

} // namespace moonshade::moonrender
