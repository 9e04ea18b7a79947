// The order of pixels (small blocks, so that neighbouring rays stay together), passes, tasks, threads.
#include "renderer/render.h"

#include "renderer/geometry/float_environment.h"
#include "renderer/integrators/wavefront.h"

#include <chrono>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace moonshade::renderer {

namespace {

constexpr size_t kBatchPaths = 8192;           // a batch's working set stays within a core's own cache
constexpr size_t kPassPaths = size_t(1) << 20; // a pass buffer of some 12 MB
constexpr int kBlock = 16;                     // pixels

/// All pixels of the crop, block by block.
std::vector<uint32_t> pixel_order(const Crop& crop, int width) {
  std::vector<uint32_t> order;
  order.reserve(size_t(crop.width) * size_t(crop.height));
  for (int by = 0; by < crop.height; by += kBlock)
    for (int bx = 0; bx < crop.width; bx += kBlock)
      for (int y = by; y < std::min(by + kBlock, crop.height); ++y)
        for (int x = bx; x < std::min(bx + kBlock, crop.width); ++x)
          order.push_back(uint32_t(crop.y + y) * uint32_t(width) + uint32_t(crop.x + x));
  return order;
}

size_t concurrency_for(unsigned threads) {
  size_t now = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::max<size_t>(now, threads);
}

class Render {
public:
  Render(const PreparedScene& scene, const RenderOptions& options, RenderProgress& progress)
      : scene_(scene), settings_(scene.scene.settings), options_(options), progress_(progress),
        crop_(options.crop.value_or(Crop{0, 0, settings_.width, settings_.height})),
        order_(pixel_order(crop_, settings_.width)), film_(crop_.width, crop_.height),
        concurrency_(tbb::global_control::max_allowed_parallelism, concurrency_for(options.threads)),
        arena_(options.threads ? int(options.threads) : tbb::task_arena::automatic),
        start_(std::chrono::steady_clock::now()) {
    pass_samples_ = uint32_t(std::clamp<size_t>(kPassPaths / order_.size(), 1, 8));
    workers_.resize(size_t(arena_.max_concurrency()));
    radiance_.resize(order_.size() * pass_samples_);
  }

  RenderResult run() {
    progress_.paths_total = uint64_t(order_.size()) * settings_.samples;
    while (film_.samples() < settings_.samples) {
      uint32_t samples = std::min(pass_samples_, settings_.samples - film_.samples());
      if (!pass(film_.samples(), samples)) break;
      add_to_film(samples);
      progress_.samples_done = film_.samples();
      if (time_is_up()) break;
    }
    return result();
  }

private:
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool time_is_up() const { return options_.seconds > 0 && elapsed() >= options_.seconds; }
  /// The first pass is finished whatever the time.
  bool should_stop() const { return progress_.cancel || (film_.samples() > 0 && time_is_up()); }

  /// One pass into `radiance_`; false where it was given up.
  bool pass(uint32_t first_sample, uint32_t samples) {
    size_t chunk = std::clamp<size_t>(order_.size() / 64, 64, kBatchPaths / pass_samples_);
    size_t tasks = (order_.size() + chunk - 1) / chunk;
    std::atomic<bool> complete{true};
    auto run_task = [&](size_t index) {
      if (should_stop()) {
        complete = false;
        return;
      }
      DefaultFloatEnvironment environment;
      auto& worker = workers_[size_t(tbb::this_task_arena::current_thread_index())];
      if (!worker) worker = std::make_unique<Wavefront>(scene_, kBatchPaths);
      size_t begin = index * chunk, end = std::min(begin + chunk, order_.size());
      worker->run({std::span(order_).subspan(begin, end - begin), first_sample, samples},
                  radiance_.data() + begin * samples);
      progress_.paths_done += (end - begin) * samples;
    };
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<size_t>(0, tasks, 1),
          [&](const tbb::blocked_range<size_t>& range) {
            for (size_t index = range.begin(); index < range.end(); ++index)
              run_task(index);
          },
          tbb::simple_partitioner());
    });
    return complete;
  }

  void add_to_film(uint32_t samples) {
    auto start = std::chrono::steady_clock::now();
    for (size_t k = 0; k < order_.size(); ++k) {
      uint32_t x = order_[k] % uint32_t(settings_.width) - uint32_t(crop_.x);
      uint32_t y = order_[k] / uint32_t(settings_.width) - uint32_t(crop_.y);
      film_.add(size_t(y) * size_t(crop_.width) + x, radiance_.data() + k * samples, samples);
    }
    film_.finish_pass(samples);
    film_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  RenderResult result() {
    RenderResult r;
    r.picture = film_.picture();
    r.samples = film_.samples();
    r.interrupted = progress_.cancel && film_.samples() < settings_.samples;
    r.threads = unsigned(workers_.size());
    r.stats.film_seconds = film_seconds_;
    for (const auto& worker : workers_) {
      if (!worker) continue;
      const WorkerStats& w = worker->stats();
      r.stats.paths += w.paths, r.stats.rays += w.rays, r.stats.shading_points += w.shading_points;
      r.stats.trace_seconds += w.trace_seconds, r.stats.shade_seconds += w.shade_seconds;
      r.stats.shader_seconds += w.shader_seconds, r.stats.film_seconds += w.film_seconds;
      for (const auto& [key, count] : worker->faults())
        r.faults[key] += count, r.fault_count += count;
    }
    r.seconds = elapsed();
    return r;
  }

  const PreparedScene& scene_;
  const Settings& settings_;
  const RenderOptions& options_;
  RenderProgress& progress_;
  Crop crop_;
  std::vector<uint32_t> order_;
  Film film_;
  tbb::global_control concurrency_; ///< more threads than cores, where asked for
  tbb::task_arena arena_;
  std::chrono::steady_clock::time_point start_;
  uint32_t pass_samples_ = 1;
  std::vector<std::unique_ptr<Wavefront>> workers_;
  std::vector<Vec3> radiance_; ///< of the pass in hand, pixel by pixel in `order_`
  double film_seconds_ = 0;
};

} // namespace

RenderResult render(const PreparedScene& scene, const RenderOptions& options, RenderProgress& progress) {
  return Render(scene, options, progress).run();
}

} // namespace moonshade::renderer
