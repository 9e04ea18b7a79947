// Failures here end no render.
#include "tools/moonrender/live.h"

#include "tools/moonrender/messages.h"
#include "tools/support/interrupt.h"

#include <iostream>

namespace moonshade::moonrender {

std::string LiveViews::open(const Options& options) {
  if (options.tev)
    if (std::string error = tev_.connect(*options.tev); !error.empty()) return "--tev: " + error;
  if (options.preview.empty()) return "";
  preview_.emplace();
  std::string error = preview_->open(options.preview);
  return error.empty() ? "" : "--preview: " + error;
}

void LiveViews::begin(std::string name, const renderer::DisplaySettings& display, renderer::ImageMetadata metadata) {
  name_ = std::move(name);
  display_ = display;
  metadata_ = std::move(metadata);
  next_ = Clock::now();
}

void LiveViews::refresh(const std::function<renderer::Picture()>& picture, uint32_t samples, bool last) {
  if (!any() || (!last && Clock::now() < next_)) return;
  constexpr double kShortest = 0.5, kShare = 20; // seconds; of which a refresh may take one part
  auto start = Clock::now();
  renderer::Picture now = picture();
  if (tev_.connected())
    if (std::string error = tev_.show(name_, now); !error.empty())
      std::cerr << "moonrender: warning: " << shown(error) << "; the render goes on without it\n";
  if (preview_ && !preview_failed_) {
    renderer::ImageMetadata metadata = metadata_;
    metadata.facts.emplace_back("samples", std::to_string(samples));
    metadata.facts.emplace_back("preview", last ? "final" : "unfinished");
    std::string error = preview_->write(now, display_, metadata, {}, {}, [](const char* file) {
      tools::set_file_to_delete(file, tools::FileSlot::Image);
    });
    preview_failed_ = !error.empty();
    if (preview_failed_)
      std::cerr << "moonrender: warning: --preview: " << shown(error) << "; the render goes on without it\n";
  }
  double cost = std::chrono::duration<double>(Clock::now() - start).count();
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                             std::chrono::duration<double>(std::max(kShortest, kShare * cost)));
}

} // namespace moonshade::moonrender
