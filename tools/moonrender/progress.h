// Progress on standard error: a bar with the time left on a terminal, a line now and then elsewhere.
#pragma once

#include "renderer/render.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace moonshade::moonrender {

class ProgressDisplay {
public:
  ProgressDisplay(const renderer::RenderProgress& progress, uint32_t samples, double time_limit);
  /// Stops and, on a terminal, clears the bar.
  ~ProgressDisplay();

private:
  void run();
  void draw_bar(double share, double elapsed) const;
  void print_line(double share, double elapsed) const;

  const renderer::RenderProgress& progress_;
  uint32_t samples_;
  double time_limit_;
  bool terminal_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

} // namespace moonshade::moonrender
