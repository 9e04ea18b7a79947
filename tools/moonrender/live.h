// Looking at a picture while it grows: the image of --preview and the viewer of --tev, refreshed between two passes, as
// often as costs no more than a twentieth of the time.
#pragma once

#include "renderer/film/image_file.h"
#include "renderer/film/tev_display.h"
#include "renderer/render.h"
#include "tools/moonrender/options.h"

#include <chrono>
#include <optional>

namespace moonshade::moonrender {

class LiveViews {
public:
  /// Connects, and checks that the preview can be written. Error, or empty.
  std::string open(const Options& options);
  bool any() const { return preview_ || tev_.connected(); }
  /// A new picture of this name begins.
  void begin(std::string name, const renderer::DisplaySettings& display, renderer::ImageMetadata metadata);
  /// Shows where it is time to; `last` always does. What cannot be shown is said once on standard error.
  void refresh(const std::function<renderer::Picture()>& picture, uint32_t samples, bool last);

private:
  using Clock = std::chrono::steady_clock;

  renderer::TevDisplay tev_;
  std::optional<renderer::ImageFile> preview_;
  bool preview_failed_ = false;
  std::string name_;
  renderer::DisplaySettings display_;
  renderer::ImageMetadata metadata_;
  Clock::time_point next_ = Clock::now();
};

} // namespace moonshade::moonrender
