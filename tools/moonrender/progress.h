// Progress on standard error: a bar with the time left on a terminal, a line now and then elsewhere.
#pragma once

#include "renderer/render.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace moonshade::moonrender {

class ProgressDisplay {
public:
  /// `what`: said before each line, "frame 3: ".
  ProgressDisplay(const renderer::RenderProgress& progress, uint32_t samples, double time_limit, std::string what = "");
  /// Stops and, on a terminal, clears the bar.
  ~ProgressDisplay();

private:
  void run();
  /// Of the render, in [0, 1].
  double share(double elapsed) const;
  /// "3/64 samples, 5.10 M rays/s, 0:12 left".
  std::string facts(double share, double elapsed) const;
  void draw_bar(double share, double elapsed) const;
  void print_line(double share, double elapsed) const;

  const renderer::RenderProgress& progress_;
  uint32_t samples_;
  double time_limit_;
  std::string what_;
  bool terminal_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

} // namespace moonshade::moonrender
