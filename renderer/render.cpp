// The order of pixels (small blocks, so that neighbouring rays stay together), passes, tasks, threads.
#include "renderer/render.h"

#include "renderer/film/adaptive.h"
#include "renderer/geometry/float_environment.h"
#include "renderer/integrators/pass_setup.h"
#include "renderer/integrators/wavefront.h"

#include <chrono>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace moonshade::renderer {

namespace {

constexpr size_t kPassPaths = size_t(1) << 20; // a pass buffer of some 12 MB
constexpr int kBlock = Adaptive::kBlock;       // pixels

/// All pixels of the crop, block by block, in these group by group (task.h). `whole`: no group is cut by the crop's
/// edge, so that a crop's bits are those of the whole.
std::vector<uint32_t> pixel_order(Crop crop, const Settings& settings, bool whole) {
  int right = crop.x + crop.width, bottom = crop.y + crop.height;
  if (whole) {
    auto up = [](int x) { return (x + kGroupSide - 1) / kGroupSide * kGroupSide; };
    crop.x -= crop.x % kGroupSide, crop.y -= crop.y % kGroupSide;
    right = std::min(up(right), settings.width), bottom = std::min(up(bottom), settings.height);
  }
  std::vector<uint32_t> order;
  order.reserve(size_t(right - crop.x) * size_t(bottom - crop.y));
  for (int by = crop.y; by < bottom; by += kBlock)
    for (int bx = crop.x; bx < right; bx += kBlock)
      for (int gy = by; gy < std::min(by + kBlock, bottom); gy += kGroupSide)
        for (int gx = bx; gx < std::min(bx + kBlock, right); gx += kGroupSide)
          for (int y = gy; y < std::min(gy + kGroupSide, bottom); ++y)
            for (int x = gx; x < std::min(gx + kGroupSide, right); ++x)
              order.push_back(uint32_t(y) * uint32_t(settings.width) + uint32_t(x));
  return order;
}

size_t concurrency_for(unsigned threads) {
  size_t now = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::max<size_t>(now, threads);
}

class Render : public RenderState {
public:
  Render(const PreparedScene& scene, const RenderOptions& options, RenderProgress& progress)
      : scene_(scene), settings_(scene.scene.settings), options_(options), progress_(progress),
        crop_(options.crop.value_or(Crop{0, 0, settings_.width, settings_.height})),
        order_(pixel_order(crop_, settings_, options.noise <= 0)),
        film_(std::make_unique<Film>(crop_.width, crop_.height, contents(options))),
        adaptive_(crop_.width, crop_.height, options.noise), controls_(*scene.volumes),
        concurrency_(tbb::global_control::max_allowed_parallelism, concurrency_for(options.threads)),
        arena_(options.threads ? int(options.threads) : tbb::task_arena::automatic),
        start_(std::chrono::steady_clock::now()) {
    pass_samples_ = uint32_t(std::clamp<size_t>(kPassPaths / order_.size(), 1, 8));
    if (PassSetup::needed(settings_.integrator)) {
      setup_ = std::make_unique<PassSetup>(scene, controls_, arena_, 2 * options.batch_paths);
      if (settings_.integrator == IntegratorKind::Sppm) pass_samples_ = 1; // each sample has photons of its own
    }
    make_groups();
    workers_.resize(size_t(arena_.max_concurrency()));
    radiance_.resize(order_.size() * pass_samples_);
    faulted_.resize(radiance_.size());
    if (film_->contents().first) first_.resize(radiance_.size());
  }

  RenderResult run() {
    if (options_.resume) {
      exchange(*options_.resume);
      if (!options_.resume->ok()) return {};
      choose_pixels();
    }
    progress_.paths_resumed = totals_.paths;
    progress_.rays_resumed = totals_.rays;
    resumed_samples_ = film_->samples();
    show_progress();
    while (!finished()) {
      uint32_t samples = std::min(pass_samples_, settings_.samples - film_->samples());
      if (options_.noise > 0) samples = std::min(samples, Adaptive::to_next_decision(film_->samples()));
      if (!pass(film_->samples(), samples)) break;
      add_to_film(samples);
      controls_.raise();
      collect();
      if (options_.noise > 0 && Adaptive::is_decision(film_->samples())) {
        adaptive_.decide(*film_);
        choose_pixels();
      }
      show_progress();
      if (options_.after_pass) options_.after_pass(*this, false);
      if (progress_.cancel || time_is_up()) break;
    }
    if (!finished() && options_.after_pass) options_.after_pass(*this, true);
    return result();
  }

  Picture picture() const override { return film_->picture(); }
  uint32_t samples() const override { return film_->samples(); }
  double seconds() const override { return earlier_seconds_ + elapsed(); }

  void exchange(Archive& archive) override {
    archive.expect<uint32_t>(uint32_t(crop_.width));
    archive.expect<uint32_t>(uint32_t(crop_.height));
    uint32_t samples = film_->samples();
    archive.value(samples);
    if (samples > settings_.samples) return archive.fail();
    film_->set_samples(samples);
    for (auto [data, size] : film_->blocks())
      archive.bytes(data, size);
    adaptive_.exchange(archive);
    controls_.exchange(archive);
    double spent = seconds();
    archive.value(spent);
    if (archive.reading()) earlier_seconds_ = spent;
    exchange_totals(archive);
  }

private:
  static FilmContents contents(const RenderOptions& options) {
    FilmContents contents = options.contents;
    contents.squares |= options.noise > 0;
    return contents;
  }
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool time_is_up() const { return options_.seconds > 0 && elapsed() >= options_.seconds; }
  /// The first pass is finished whatever the time, of a render that goes on, too: else it might never get further.
  bool should_stop() const { return progress_.cancel || (film_->samples() > resumed_samples_ && time_is_up()); }
  bool finished() const { return film_->samples() >= settings_.samples || order_.empty(); }

  /// Only those whose blocks go on.
  void choose_pixels() {
    if (options_.noise <= 0) return;
    std::erase_if(order_, [&](uint32_t pixel) {
      return !adaptive_.active(int(pixel % uint32_t(settings_.width)) - crop_.x,
                               int(pixel / uint32_t(settings_.width)) - crop_.y);
    });
    make_groups();
  }

  /// Cuts `order_` into groups, and these into the pieces that tasks are.
  void make_groups() {
    groups_.clear(), pieces_.clear();
    uint32_t width = uint32_t(settings_.width), before = UINT32_MAX;
    for (uint32_t pixel : order_) {
      uint32_t group =
          pixel / width / kGroupSide * ((width + kGroupSide - 1) / kGroupSide) + pixel % width / kGroupSide;
      if (group == before)
        ++groups_.back();
      else
        groups_.push_back(1);
      before = group;
    }
    size_t chunk = std::min(std::max<size_t>(order_.size() / 64, 64), options_.batch_paths / pass_samples_);
    for (size_t group = 0, pixel = 0; group < groups_.size(); ++group) {
      if (pieces_.empty() || pixel + groups_[group] - pieces_.back().pixel > chunk) pieces_.push_back({pixel, group});
      pixel += groups_[group];
    }
    pieces_.push_back({order_.size(), groups_.size()});
  }

  void show_progress() {
    progress_.samples_done = film_->samples();
    progress_.rays_done = totals_.rays;
    progress_.paths_done = totals_.paths;
    progress_.paths_total = totals_.paths + uint64_t(order_.size()) * (settings_.samples - film_->samples());
  }

  /// One pass into `radiance_`; false where it was given up.
  bool pass(uint32_t first_sample, uint32_t samples) {
    size_t tasks = pieces_.size() - 1;
    std::atomic<bool> complete{true};
    if (setup_ && !should_stop()) setup_->prepare(first_sample);
    auto run_task = [&](size_t index) {
      if (should_stop()) {
        complete = false;
        return;
      }
      DefaultFloatEnvironment environment;
      auto& worker = workers_[size_t(tbb::this_task_arena::current_thread_index())];
      if (!worker) worker = std::make_unique<Wavefront>(scene_, controls_, options_.batch_paths);
      uint64_t rays_before = worker->stats().rays;
      const Piece &piece = pieces_[index], &next = pieces_[index + 1];
      size_t begin = piece.pixel, end = next.pixel, at = begin * samples;
      worker->run({std::span(order_).subspan(begin, end - begin),
                   std::span(groups_).subspan(piece.group, next.group - piece.group), first_sample, samples,
                   setup_ ? &setup_->photons() : nullptr, setup_ ? setup_->cache() : nullptr},
                  {radiance_.data() + at, faulted_.data() + at, first_.empty() ? nullptr : first_.data() + at});
      progress_.paths_done += (end - begin) * samples;
      progress_.rays_done += worker->stats().rays - rays_before;
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
    SampleOutputs outputs{radiance_.data(), faulted_.data(), first_.data()};
    bool whole = crop_.width == settings_.width && crop_.height == settings_.height;
    auto add = [&](const tbb::blocked_range<size_t>& range) {
      for (size_t k = range.begin(); k < range.end(); ++k) {
        if (whole) {
          film_->add(order_[k], outputs, k * samples, samples);
          continue;
        }
        int x = int(order_[k] % uint32_t(settings_.width)) - crop_.x;
        int y = int(order_[k] / uint32_t(settings_.width)) - crop_.y;
        if (x < 0 || y < 0 || x >= crop_.width || y >= crop_.height) continue;
        film_->add(size_t(y) * size_t(crop_.width) + size_t(x), outputs, k * samples, samples);
      }
    };
    arena_.execute([&] { tbb::parallel_for(tbb::blocked_range<size_t>(0, order_.size(), 4096), add); });
    film_->finish_pass(samples);
    film_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// What the workers have counted, after a whole pass: that of one given up counts no more than its samples do.
  void collect() {
    totals_ = earlier_;
    totals_.film_seconds += film_seconds_;
    faults_ = earlier_faults_;
    if (setup_) setup_->collect(totals_, faults_);
    for (const auto& worker : workers_) {
      if (!worker) continue;
      totals_ += worker->stats();
      for (const auto& [key, count] : worker->faults())
        faults_[key] += count;
    }
  }

  void exchange_totals(Archive& archive) {
    archive.value(totals_.paths), archive.value(totals_.rays), archive.value(totals_.shading_points);
    archive.value(totals_.trace_seconds), archive.value(totals_.shade_seconds);
    archive.value(totals_.shader_seconds), archive.value(totals_.film_seconds);
    std::vector<std::pair<FaultKey, uint64_t>> faults(faults_.begin(), faults_.end());
    uint32_t count = uint32_t(faults.size());
    archive.value(count);
    for (uint32_t k = 0; k < count && archive.ok(); ++k) {
      if (archive.reading()) faults.emplace_back();
      auto& [key, points] = faults[k];
      archive.text(key.file), archive.text(key.entry), archive.text(key.message);
      archive.value(key.code), archive.value(key.line), archive.value(points);
    }
    if (!archive.reading()) return;
    earlier_ = totals_;
    faults_ = earlier_faults_ = FaultLog(faults.begin(), faults.end());
  }

  RenderResult result() {
    RenderResult r;
    r.picture = film_->picture();
    r.samples = film_->samples();
    r.mean_samples = film_->mean_samples();
    r.finished = finished();
    r.interrupted = progress_.cancel && !r.finished;
    r.threads = unsigned(workers_.size());
    r.stats = totals_;
    r.faults = faults_;
    for (const auto& [key, count] : faults_)
      r.fault_count += count;
    r.seconds = seconds();
    r.film = std::move(film_);
    return r;
  }

  const PreparedScene& scene_;
  const Settings& settings_;
  const RenderOptions& options_;
  RenderProgress& progress_;
  Crop crop_;
  std::vector<uint32_t> order_; ///< of the pixels that are sampled
  std::vector<uint8_t> groups_; ///< sizes of those that belong together
  struct Piece {
    size_t pixel, group;
  };
  std::vector<Piece> pieces_; ///< where tasks begin, and the end
  std::unique_ptr<Film> film_;
  Adaptive adaptive_;
  VolumeControls controls_;
  tbb::global_control concurrency_; ///< more threads than cores, where asked for
  tbb::task_arena arena_;
  std::chrono::steady_clock::time_point start_;
  uint32_t pass_samples_ = 1;
  uint32_t resumed_samples_ = 0; ///< of an earlier run
  std::unique_ptr<PassSetup> setup_;
  std::vector<std::unique_ptr<Wavefront>> workers_;
  // Of the pass in hand, pixel by pixel in `order_`.
  std::vector<Vec3> radiance_;
  std::vector<uint8_t> faulted_;
  std::vector<FirstHit> first_;
  double film_seconds_ = 0;
  WorkerStats totals_, earlier_; ///< of all passes; of those before a resumption
  FaultLog faults_, earlier_faults_;
  double earlier_seconds_ = 0;
};

} // namespace

size_t render_bytes_per_pixel(FilmContents contents) {
  size_t sample = sizeof(Vec3) + 1 + (contents.first ? sizeof(FirstHit) : 0); // of the pass in hand
  return Film::bytes_per_pixel(contents) + sample + sizeof(uint32_t) + sizeof(Vec3) + 6;
}

RenderResult render(const PreparedScene& scene, const RenderOptions& options, RenderProgress& progress) {
  return Render(scene, options, progress).run();
}

} // namespace moonshade::renderer
