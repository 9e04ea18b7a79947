// Whatever can be refused is refused before the work; what fails afterwards keeps it.
#include "tools/moonrender/render_picture.h"

#include "renderer/checkpoint/checkpoint_file.h"
#include "renderer/film/image_file.h"
#include "renderer/scene/read_scene.h"
#include "tools/moonrender/messages.h"
#include "tools/moonrender/progress.h"
#include "tools/moonrender/stats.h"
#include "tools/support/exit_status.h"
#include "tools/support/interrupt.h"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace moonshade::moonrender {

using namespace tools;

namespace {

void warn(const std::string& message) { std::cerr << "moonrender: warning: " << shown_lines(message); }

void list_faults(const renderer::RenderResult& result) {
  if (result.faults.empty()) return;
  std::cerr << "moonrender: " << result.fault_count
            << " points without a value (magenta where the camera sees them):\n";
  size_t listed = 0;
  for (const auto& [key, count] : result.faults) {
    if (++listed > 20) {
      std::cerr << "  and " << result.faults.size() - 20 << " more places\n";
      break;
    }
    const char* kind = key.code == renderer::kNotFinite ? "not finite" : fault_name(FaultCode(key.code));
    if (!key.file.empty()) std::cerr << shown(key.file) << (key.line ? ":" + std::to_string(key.line) : "") << ": ";
    std::cerr << "fault: " << kind << " in '" << key.entry << "'"
              << (key.message.empty() ? "" : ": " + shown(key.message)) << ", " << count
              << (count == 1 ? " point\n" : " points\n");
  }
}

/// What certainly does not fit is refused at once: systems that promise more memory than there is would end the program
/// later, without a word.
std::string check_memory(const Options& options, const renderer::Settings& settings) {
  auto crop = options.render.crop.value_or(renderer::Crop{0, 0, settings.width, settings.height});
  double needed = double(renderer::render_bytes_per_pixel(options.render.contents)) * crop.width * crop.height;
  double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
  if (needed <= memory) return "";
  return "not enough memory: " + std::to_string(crop.width) + "x" + std::to_string(crop.height) + " pixels take some " +
         std::to_string(uint64_t(needed / 1e9)) + " GB; --crop renders a part";
}

std::string plain(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// Numbers of the id channels to names, as JSON.
template <typename Things> std::string names_of(const Things& things) {
  constexpr size_t kMost = 10000;
  nlohmann::ordered_json names = nlohmann::ordered_json::object();
  for (size_t k = 0; k < std::min<size_t>(things.size(), kMost); ++k)
    names[std::to_string(k + 1)] = things[k].name;
  return names.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

class PictureJob {
public:
  PictureJob(const Options& options, std::optional<int64_t> frame, Session& session)
      : options_(options), frame_(frame), session_(session),
        output_(frame ? frame_name(options.output, *frame) : options.output) {}

  int run();

private:
  int read();
  int prepare();
  bool is_done_already() const;
  int open_checkpoint();
  void render();
  void after_pass(renderer::RenderState& state, bool ended);
  int write();
  int keep_elsewhere(const std::string& error, const renderer::ImageMetadata& metadata);
  renderer::ImageMetadata metadata() const;

  const renderer::Settings& settings() const { return prepared_->scene.settings; }

  const Options& options_;
  std::optional<int64_t> frame_;
  Session& session_;
  std::string output_;
  renderer::Scene scene_;
  renderer::ImageFile image_;
  std::unique_ptr<renderer::PreparedScene> prepared_;
  renderer::Identity identity_;
  renderer::OpenedCheckpoint resumed_;
  std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
  bool checkpoint_failed_ = false, checkpoint_lies_there_ = false;
  renderer::RenderResult result_;
  double read_seconds_ = 0;
};

int PictureJob::read() {
  Timer timer;
  renderer::Animation animation;
  animation.frame = frame_;
  if (frame_ && options_.frames) animation.time = options_.frames->time_of(*frame_);
  renderer::SceneReading reading = renderer::read_scene(options_.scene, animation);
  for (const std::string& warning : reading.warnings)
    std::cerr << shown(of_kind("warning", warning)) << "\n";
  if (!reading.scene) return fail(kInputAtFault, shown(of_kind("error", reading.error)));
  scene_ = std::move(*reading.scene);
  if (std::string error = apply(options_, scene_.settings); !error.empty())
    return fail(kCallAtFault, "moonrender: error: " + error);
  std::string error = check_memory(options_, scene_.settings);
  if (error.empty()) error = image_.open(output_);
  if (error.empty()) error = check_stats_place(options_);
  if (!error.empty()) return fail(kMachineAtFault, "moonrender: error: " + error);
  read_seconds_ = timer.lap();
  return kDone;
}

int PictureJob::prepare() {
  renderer::RecordingShaders recording(*session_.shaders);
  renderer::Preparation preparation = renderer::prepare(std::move(scene_), recording, options_.overrides);
  std::cerr << shown_lines(preparation.warnings);
  if (!preparation.prepared)
    return fail(preparation.machine_at_fault ? kMachineAtFault : kInputAtFault, of_kind("error", preparation.error));
  prepared_ = std::move(preparation.prepared);
  identity_ =
      renderer::identify(prepared_->scene, recording.files(), options_.render, options_.shaders, options_.overrides);
  return kDone;
}

/// A frame that an earlier run has finished.
bool PictureJob::is_done_already() const {
  return options_.resume && frame_ && renderer::read_fact(output_, "digest") == identity_.digest() &&
         renderer::read_fact(output_, "interrupted") == "no";
}

int PictureJob::open_checkpoint() {
  if (!options_.resume) return kDone;
  resumed_ = renderer::open_checkpoint(renderer::checkpoint_path(output_), identity_);
  checkpoint_lies_there_ = resumed_.state != nullptr;
  return resumed_.error.empty() ? kDone : fail(kInputAtFault, "moonrender: error: " + resumed_.error);
}

void PictureJob::after_pass(renderer::RenderState& state, bool ended) {
  session_.live.refresh([&] { return state.picture(); }, state.samples(), false);
  if (!options_.checkpoint && !(options_.resume && ended)) return;
  auto now = std::chrono::steady_clock::now();
  double since = std::chrono::duration<double>(now - last_checkpoint_).count();
  bool finished = state.samples() >= settings().samples;
  if (!ended && (finished || since < *options_.checkpoint)) return;
  std::string error = renderer::write_checkpoint(renderer::checkpoint_path(output_), identity_, state);
  if (!error.empty() && !checkpoint_failed_) warn("checkpoint: " + error + "; the render goes on");
  checkpoint_failed_ = !error.empty();
  checkpoint_lies_there_ |= error.empty();
  last_checkpoint_ = std::chrono::steady_clock::now();
}

void PictureJob::render() {
  renderer::RenderOptions render_options = options_.render;
  render_options.resume = resumed_.state.get();
  render_options.after_pass = [&](renderer::RenderState& state, bool ended) { after_pass(state, ended); };
  session_.live.begin(output_, {settings().exposure, settings().tonemap}, metadata());
  last_checkpoint_ = std::chrono::steady_clock::now();
  cancel_on_interrupt(&session_.progress->cancel); // until here an interrupt ends the program: there is nothing to save
  std::string what = frame_ ? "frame " + std::to_string(*frame_) + ": " : "";
  ProgressDisplay display(*session_.progress, settings().samples, options_.render.seconds, what);
  result_ = renderer::render(*prepared_, render_options, *session_.progress);
}

renderer::ImageMetadata PictureJob::metadata() const {
  const renderer::Settings& s = settings();
  renderer::ImageMetadata m{version(), {}};
  auto fact = [&](const char* name, std::string value) { m.facts.emplace_back(name, std::move(value)); };
  fact("scene", options_.scene);
  fact("seed", std::to_string(s.seed));
  if (result_.film) {
    fact("samples", std::to_string(result_.samples));
    if (options_.render.noise > 0) fact("meanSamples", plain(result_.mean_samples));
    fact("seconds", plain(result_.seconds));
    fact("interrupted", result_.interrupted ? "yes" : "no");
    fact("faults", std::to_string(result_.fault_count));
  }
  fact("integrator", std::string(renderer::kIntegratorNames[size_t(s.integrator)]));
  fact("depth", std::to_string(s.depth));
  fact("clamp", s.clamp > 0 ? plain(double(s.clamp)) : "none");
  if (options_.render.noise > 0) fact("noise", plain(options_.render.noise));
  if (s.exposure != 0) fact("exposure", plain(double(s.exposure)));
  fact("tonemap", std::string(renderer::kTonemapNames[size_t(s.tonemap)]));
  if (frame_) fact("frame", std::to_string(s.frame)), fact("time", plain(s.time));
  fact("digest", identity_.digest());
  for (renderer::Aov aov : options_.aovs) {
    if (aov == renderer::Aov::Object) fact("objects", names_of(prepared_->scene.objects));
    if (aov == renderer::Aov::Material) fact("materials", names_of(prepared_->scene.materials));
  }
  return m;
}

/// The image cannot be written where it belongs: the work goes to a checkpoint that is there, or to a folder for
/// temporary files.
int PictureJob::keep_elsewhere(const std::string& error, const renderer::ImageMetadata& metadata) {
  fail(kMachineAtFault, "moonrender: error: " + error);
  std::error_code ignored;
  std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
  std::string rescue =
      (folder / ("moonrender-" + std::to_string(::getpid()) + (frame_ ? "-" + std::to_string(*frame_) : "") + ".exr"))
          .string();
  renderer::ImageFile file;
  std::string second = file.open(rescue);
  if (second.empty()) second = file.write(result_.picture, {}, metadata, {result_.film.get(), options_.aovs});
  if (second.empty()) std::cerr << "moonrender: the picture is kept as " << shown(rescue) << "\n";
  if (checkpoint_lies_there_) std::cerr << "moonrender: the checkpoint is kept; --resume goes on from it\n";
  return kMachineAtFault;
}

int PictureJob::write() {
  Timer timer;
  renderer::ImageMetadata facts = metadata();
  renderer::Window window;
  if (const auto& crop = options_.render.crop) window = {crop->x, crop->y, settings().width, settings().height};
  renderer::DisplaySettings display{settings().exposure, settings().tonemap};
  std::string error = image_.write(result_.picture, display, facts, {result_.film.get(), options_.aovs}, window,
                                   [](const char* file) { set_file_to_delete(file, FileSlot::Image); });
  if (!error.empty()) return keep_elsewhere(error, facts);
  session_.live.refresh([&] { return result_.picture; }, result_.samples, true);
  if (result_.finished && (options_.checkpoint || options_.resume))
    ::unlink(renderer::checkpoint_path(output_).c_str());
  result_.stats.film_seconds += timer.lap();
  error = write_stats(options_, *prepared_, result_, read_seconds_ + prepared_->geometry_seconds);
  if (!error.empty()) return fail(kMachineAtFault, "moonrender: error: " + error);
  if (!result_.interrupted) return kDone;
  std::cerr << "moonrender: interrupted; the image has " << result_.samples << " of " << settings().samples
            << " samples\n";
  return kInterrupted;
}

int PictureJob::run() {
  if (int status = read(); status != kDone) return status;
  if (int status = prepare(); status != kDone) return status;
  if (is_done_already()) {
    std::cerr << "moonrender: frame " << settings().frame << " is done already\n";
    return kDone;
  }
  if (int status = open_checkpoint(); status != kDone) return status;
  render();
  list_faults(result_);
  if (!result_.film)
    return fail(kInputAtFault, "moonrender: error: the checkpoint does not fit; delete it to begin anew");
  if (result_.samples == 0)
    return fail(kInterrupted, "moonrender: interrupted before the first pass was done; no image");
  return write();
}

} // namespace

int fail(int status, const std::string& message) {
  // Messages that name a place of a file begin with it, as compilers' do.
  std::cerr << shown_lines(message);
  return status;
}

int render_picture(const Options& options, std::optional<int64_t> frame, Session& session) {
  return PictureJob(options, frame, session).run();
}

} // namespace moonshade::moonrender
