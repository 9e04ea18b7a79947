// Rendering a prepared scene: passes over all pixels, each spread over the threads and finished before the next begins,
// so that a render may stop, be looked at or be saved after any pass, with a whole picture.
#pragma once

#include "renderer/checkpoint/archive.h"
#include "renderer/film/film.h"
#include "renderer/integrators/task.h"
#include "renderer/prepared_scene.h"

#include <atomic>
#include <functional>
#include <optional>

namespace moonshade::renderer {

struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

/// A render between two passes.
class RenderState {
public:
  virtual ~RenderState() = default;
  virtual Picture picture() const = 0;
  virtual uint32_t samples() const = 0;
  /// Of rendering so far, that before a resumption included.
  virtual double seconds() const = 0;
  /// All that the passes to come depend on.
  virtual void exchange(Archive& archive) = 0;
};

struct RenderOptions {
  unsigned threads = 0;                    ///< 0: as many as the machine has
  double seconds = 0;                      ///< stop after the pass in hand; 0: no limit
  std::optional<Crop> crop = std::nullopt; ///< within the image
  double noise = 0;                        ///< stop where the estimated error is less (adaptive.h); 0: never
  /// Paths that are carried together, at least 256. Changes no pixel: a batch's working set of this size stays within a
  /// core's own cache.
  size_t batch_paths = 2048;
  FilmContents contents = {};
  /// Called after each pass by the thread that called render(), and, with `ended`, where it stops before its end.
  std::function<void(RenderState&, bool ended)> after_pass = nullptr;
  /// Where to go on from: what RenderState::exchange wrote. A failed archive ends the render without a sample.
  Archive* resume = nullptr;
};

/// Shared with the thread that shows progress or interrupts.
struct RenderProgress {
  std::atomic<uint64_t> paths_done{0};
  std::atomic<uint64_t> paths_total{0};
  std::atomic<uint64_t> paths_resumed{0}; ///< those of `paths_done` that an earlier run did
  std::atomic<uint64_t> rays_done{0}, rays_resumed{0};
  std::atomic<uint32_t> samples_done{0};
  std::atomic<bool> cancel{false};
};

struct RenderResult {
  Picture picture;
  std::unique_ptr<Film> film; ///< with what `contents` asked for
  uint32_t samples = 0;       ///< of every pixel, or, with `noise`, of those that took the most
  double mean_samples = 0;
  bool interrupted = false;
  bool finished = false; ///< nothing is left to do: neither interrupted nor out of time
  double seconds = 0;
  WorkerStats stats;
  FaultLog faults;
  uint64_t fault_count = 0;
  unsigned threads = 1;
};

/// Memory that rendering takes for each pixel, the picture and its encoding included.
size_t render_bytes_per_pixel(FilmContents contents);

RenderResult render(const PreparedScene& scene, const RenderOptions& options, RenderProgress& progress);

} // namespace moonshade::renderer
