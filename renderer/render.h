// Rendering a prepared scene: passes over all pixels, each spread over the threads and finished before the next begins,
// so that a render may stop after any pass with a whole picture.
#pragma once

#include "renderer/film/film.h"
#include "renderer/integrators/task.h"
#include "renderer/prepared_scene.h"

#include <atomic>
#include <optional>

namespace moonshade::renderer {

struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

struct RenderOptions {
  unsigned threads = 0;                    ///< 0: as many as the machine has
  double seconds = 0;                      ///< stop after the pass in hand; 0: no limit
  std::optional<Crop> crop = std::nullopt; ///< within the image
};

/// Shared with the thread that shows progress or interrupts.
struct RenderProgress {
  std::atomic<uint64_t> paths_done{0};
  std::atomic<uint64_t> paths_total{0};
  std::atomic<uint32_t> samples_done{0};
  std::atomic<bool> cancel{false};
};

struct RenderResult {
  Picture picture;
  uint32_t samples = 0; ///< of every pixel
  bool interrupted = false;
  double seconds = 0;
  WorkerStats stats;
  FaultLog faults;
  uint64_t fault_count = 0;
  unsigned threads = 1;
};

RenderResult render(const PreparedScene& scene, const RenderOptions& options, RenderProgress& progress);

} // namespace moonshade::renderer
