// moonrender SCENE.lua|MODEL.obj [options] -o IMAGE: reads, prepares, renders, writes. The work is the library's.
#include "renderer/film/image_file.h"
#include "renderer/scene/read_scene.h"
#include "tools/moonrender/options.h"
#include "tools/moonrender/progress.h"
#include "tools/moonrender/stats.h"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <unistd.h>

namespace moonshade::moonrender {

namespace {

enum Exit { kDone = 0, kInputAtFault = 1, kCallAtFault = 2, kMachineAtFault = 3, kInterrupted = 130 };

/// What the signal handler may touch.
struct Interruptible {
  std::atomic<std::atomic<bool>*> cancel = nullptr; ///< set while there is a render to end in order
  char temporary[4096] = "";                        ///< the image file not in place yet
  std::atomic<bool> has_temporary = false;
};
Interruptible g_interruptible;

/// While rendering, the first Ctrl-C asks for an end with the passes done. At any other time, and the second time, the
/// program ends at once.
void interrupt(int) {
  std::atomic<bool>* cancel = g_interruptible.cancel;
  if (cancel && !cancel->exchange(true)) return;
  if (g_interruptible.has_temporary) ::unlink(g_interruptible.temporary);
  ::_exit(kInterrupted);
}

/// For as long as a render can be ended in order.
struct OrderlyInterrupts {
  explicit OrderlyInterrupts(std::atomic<bool>& cancel) { g_interruptible.cancel = &cancel; }
  ~OrderlyInterrupts() { g_interruptible.cancel = nullptr; }
};

void remove_when_interrupted(const std::string& temporary) {
  if (temporary.size() >= sizeof g_interruptible.temporary) return;
  std::strcpy(g_interruptible.temporary, temporary.c_str());
  g_interruptible.has_temporary = true;
}

void catch_interrupts() {
  struct sigaction action{};
  action.sa_handler = interrupt;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int fail(int code, const std::string& message) {
  // Messages that name a place of a file begin with it, as compilers' do.
  std::cerr << message << (message.ends_with('\n') ? "" : "\n");
  return code;
}

/// "FILE:LINE: message" as "FILE:LINE: error: message"; what the compiler has worded stays.
std::string of_kind(const std::string& kind, const std::string& message) {
  size_t colon = message.find(": ");
  if (colon == std::string::npos || message.find(": error: ") != std::string::npos) return message;
  std::string text = message.substr(0, colon);
  return text.append(": ").append(kind).append(message.substr(colon));
}

void list_faults(const renderer::RenderResult& result) {
  if (result.faults.empty()) return;
  std::cerr << "moonrender: " << result.fault_count
            << " points without a value (magenta where the camera sees them):\n";
  size_t shown = 0;
  for (const auto& [key, count] : result.faults) {
    if (++shown > 20) {
      std::cerr << "  and " << result.faults.size() - 20 << " more places\n";
      break;
    }
    const char* kind = key.code == renderer::kNotFinite ? "not finite" : fault_name(FaultCode(key.code));
    if (!key.file.empty()) std::cerr << key.file << (key.line ? ":" + std::to_string(key.line) : "") << ": ";
    std::cerr << "fault: " << kind << " in '" << key.entry << "'" << (key.message.empty() ? "" : ": " + key.message)
              << ", " << count << (count == 1 ? " point\n" : " points\n");
  }
}

/// What certainly does not fit is refused at once: systems that promise more memory than there is would end the program
/// later, without a word.
std::string check_memory(const Options& options, const renderer::Settings& settings) {
  constexpr double kBytesAPixel = 64; // sums, the pass in hand, the picture, its encoding
  auto crop = options.render.crop.value_or(renderer::Crop{0, 0, settings.width, settings.height});
  double needed = kBytesAPixel * crop.width * crop.height;
  double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
  if (needed <= memory) return "";
  return "not enough memory: " + std::to_string(crop.width) + "x" + std::to_string(crop.height) + " pixels take some " +
         std::to_string(uint64_t(needed / 1e9)) + " GB; --crop renders a part";
}

int run(const Options& options) {
  Timer timer;
  renderer::SceneReading reading = renderer::read_scene(options.scene);
  for (const std::string& warning : reading.warnings)
    std::cerr << of_kind("warning", warning) << "\n";
  if (!reading.scene) return fail(kInputAtFault, of_kind("error", reading.error));
  if (std::string error = apply(options, reading.scene->settings); !error.empty())
    return fail(kCallAtFault, "moonrender: error: " + error);
  if (std::string error = check_memory(options, reading.scene->settings); !error.empty())
    return fail(kMachineAtFault, "moonrender: error: " + error);
  renderer::ImageFile image;
  if (std::string error = image.open(options.output); !error.empty())
    return fail(kMachineAtFault, "moonrender: error: " + error);
  remove_when_interrupted(image.temporary());
  if (std::string error = check_stats_place(options); !error.empty())
    return fail(kMachineAtFault, "moonrender: error: " + error);
  double read_seconds = timer.lap();

  auto shaders = renderer::runtime_shaders(options.shaders);
  renderer::Preparation preparation = renderer::prepare(std::move(*reading.scene), *shaders, options.overrides);
  std::cerr << preparation.warnings;
  if (!preparation.prepared)
    return fail(preparation.machine_at_fault ? kMachineAtFault : kInputAtFault, of_kind("error", preparation.error));
  const renderer::PreparedScene& prepared = *preparation.prepared;
  const renderer::Settings& settings = prepared.scene.settings;

  renderer::RenderProgress progress;
  renderer::RenderResult result;
  OrderlyInterrupts orderly(progress.cancel);
  {
    ProgressDisplay display(progress, settings.samples, options.render.seconds);
    result = renderer::render(prepared, options.render, progress);
  }
  list_faults(result);
  if (result.samples == 0)
    return fail(kInterrupted, "moonrender: interrupted before the first pass was done; no image");

  Timer writing;
  renderer::ImageMetadata metadata{version(),      options.scene,      settings.seed, result.samples,
                                   result.seconds, result.interrupted, settings.clamp};
  std::string error = image.write(result.picture, {settings.exposure, settings.tonemap}, metadata);
  if (!error.empty()) return fail(kMachineAtFault, "moonrender: error: " + error);
  result.stats.film_seconds += writing.lap();
  error = write_stats(options, prepared, result, read_seconds + prepared.geometry_seconds);
  if (!error.empty()) return fail(kMachineAtFault, "moonrender: error: " + error);
  if (result.interrupted)
    std::cerr << "moonrender: interrupted; the image has " << result.samples << " of " << settings.samples
              << " samples\n";
  return result.interrupted ? kInterrupted : kDone;
}

} // namespace

} // namespace moonshade::moonrender

int main(int argc, char** argv) {
  using namespace moonshade::moonrender;
  catch_interrupts();
  ParsedOptions parsed = parse_options(argc, argv);
  if (!parsed.options) return parsed.exit_code;
  try {
    return run(*parsed.options);
  } catch (const std::bad_alloc&) {
    return fail(kMachineAtFault, "moonrender: error: not enough memory");
  }
}
