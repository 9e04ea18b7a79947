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

ProgressDisplay::ProgressDisplay(const renderer::RenderProgress& progress, uint32_t samples, double time_limit)
    : progress_(progress), samples_(samples), time_limit_(time_limit), terminal_(::isatty(STDERR_FILENO) == 1),
      thread_([this] { run(); }) {}

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
    uint64_t total = progress_.paths_total;
    if (total == 0) continue;
    double share = double(progress_.paths_done) / double(total);
    if (time_limit_ > 0) share = std::max(share, std::min(1.0, elapsed / time_limit_));
    if (terminal_) {
      draw_bar(share, elapsed);
    } else if (elapsed >= next_line) {
      print_line(share, elapsed);
      next_line = elapsed + std::clamp(elapsed, 5.0, 60.0);
    }
  }
}

void ProgressDisplay::draw_bar(double share, double elapsed) const {
  constexpr int kCells = 32;
  int filled = std::clamp(int(share * kCells), 0, kCells);
  std::string bar(size_t(filled), '#');
  bar.resize(kCells, '.');
  std::string left = share > 0 ? duration(elapsed / share - elapsed) : "?";
  std::fprintf(stderr, "\r[%s] %3.0f %%  %u/%u samples  %.2f M paths/s  %s left\033[K", bar.c_str(), 100 * share,
               unsigned(progress_.samples_done), samples_, double(progress_.paths_done) / elapsed * 1e-6, left.c_str());
  std::fflush(stderr);
}

void ProgressDisplay::print_line(double share, double elapsed) const {
  std::string left = share > 0 ? duration(elapsed / share - elapsed) : "?";
  std::fprintf(stderr, "moonrender: %.0f %%, %u/%u samples, %.2f M paths/s, %s left\n", 100 * share,
               unsigned(progress_.samples_done), samples_, double(progress_.paths_done) / elapsed * 1e-6, left.c_str());
}

} // namespace moonshade::moonrender
