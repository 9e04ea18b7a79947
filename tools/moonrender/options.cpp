// Options are declared in groups, as --help shows them, taken as texts and converted once all are there. Those that the
// contract has and the renderer not yet are known, too, so that they get an honest answer.
#include "tools/moonrender/options.h"

#include "renderer/film/image_file.h"
#include "renderer/scene/nearest_name.h"
#include "renderer/scene/scene_reference.h"
#include "runtime/allowed_folders.h"
#include "tools/support/arguments.h"
#include "tools/support/cache_options.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"

#include <charconv>
#include <iostream>

namespace moonshade::moonrender {

namespace {

using tools::UsageError;

constexpr const char* kExamples = R"(Examples:
  moonrender teapot.obj -o teapot.png                     a bare model: framed, under sun and sky
  moonrender copper.lua --size=640x360 --spp=16 -o a.png  a quick look
  moonrender copper.lua --integrator=whitted -o b.png     direct light and mirrors only
  moonrender copper.lua --time=60 --spp=9999 -o c.exr     what a minute gives, as linear floats
  moonrender copper.lua --noise=0.005 --spp=4096 -o c.png until the noise is half a per cent of white
  moonrender copper.lua --aov=albedo,normal -o c.exr      with what a denoiser needs
  moonrender waves.lua --frames=1-240 -o waves.%04d.png   an animation, 24 frames a second
  moonrender copper.lua --checkpoint=60 --resume -o c.exr goes on where it was, whatever ended it
  moonrender copper.lua -D copper.scale=12 -o d.png       a parameter of the material 'copper'
  moonrender copper.lua --backend=interp -o e.png         the same shaders in stock Lua

Exit status: 0 done, 1 the scene is at fault, 2 the call is, 3 the machine is, 130 interrupted (the picture then holds
the passes done).)";

template <typename T> T number(std::string_view text, const char* what) {
  T value{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw UsageError(std::string(what) + ": '" + std::string(text) + "' is no number that fits");
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t at; (at = text.find(separator)) != std::string_view::npos; text.remove_prefix(at + 1))
    parts.push_back(text.substr(0, at));
  parts.push_back(text);
  return parts;
}

size_t one_of(const std::string& text, const char* option, std::span<const std::string_view> words,
              std::span<const std::string_view> later = {}) {
  for (size_t i = 0; i < words.size(); ++i)
    if (text == words[i]) return i;
  for (std::string_view word : later)
    if (text == word) throw UsageError(std::string(option) + "=" + text + ": not available yet");
  throw UsageError(std::string(option) + ": unknown '" + text + "'" + renderer::did_you_mean(text, words) +
                   " (known: " + renderer::join_names(words) + ")");
}

/// Texts of options, as given.
struct Given {
  std::string size, crop, integrator, tonemap, backend, precision, width, aovs, frames, tev;
  std::optional<int64_t> samples, seed, threads, depth;
  std::optional<double> time, exposure, clamp, noise, checkpoint, fps;
  std::vector<std::string> defines;
  tools::CacheOptions cache;
};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  return text;
}

template <typename T> T in_range(double value, double low, double high, const char* option) {
  if (!(value >= low && value <= high))
    throw UsageError(std::string(option) + " lies between " + short_text(low) + " and " + short_text(high));
  return T(value);
}

void define(Options& options, const std::string& text) {
  size_t equals = text.find('=');
  size_t dot = text.rfind('.', equals);
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals)
    throw UsageError("-D " + text + ": expected MATERIAL.NAME=VALUE");
  options.overrides[text.substr(0, dot)][text.substr(dot + 1, equals - dot - 1)] = text.substr(equals + 1);
}

void size_and_crop(const Given& given, Options& options) {
  if (!given.size.empty()) {
    auto parts = split(given.size, 'x');
    if (parts.size() != 2) throw UsageError("--size: expected WxH, as in 1280x720");
    options.width = in_range<int>(number<int>(parts[0], "--size"), 1, 65536, "--size");
    options.height = in_range<int>(number<int>(parts[1], "--size"), 1, 65536, "--size");
  }
  if (!given.crop.empty()) {
    auto parts = split(given.crop, ',');
    if (parts.size() != 4) throw UsageError("--crop: expected X,Y,W,H");
    options.render.crop = {number<int>(parts[0], "--crop"), number<int>(parts[1], "--crop"),
                           number<int>(parts[2], "--crop"), number<int>(parts[3], "--crop")};
  }
}

void shader_options(const Given& given, Options& options) {
  static constexpr std::string_view kBackends[] = {"jit", "interp"};
  static constexpr std::string_view kPrecisions[] = {"f32", "f64"};
  options.shaders.folders = {folder_of(options.scene)};
  if (!given.backend.empty())
    options.shaders.backend = renderer::Backend(one_of(given.backend, "--backend", kBackends));
  if (!given.precision.empty())
    options.shaders.precision = one_of(given.precision, "--precision", kPrecisions) ? Precision::F64 : Precision::F32;
  if (given.width.empty() || given.width == "auto") return;
  options.shaders.width = number<unsigned>(given.width, "--width");
  if (std::find(kWidths.begin(), kWidths.end(), options.shaders.width) == kWidths.end())
    throw UsageError("--width: expected auto, 1, 4, 8, 16 or 32");
}

/// Compiled shaders are kept, and optimised while rendering goes on already.
void compilation(const Given& given, Options& options) {
  if (options.shaders.backend != renderer::Backend::Jit) return;
  options.shaders.cache = tools::open_cache(given.cache);
  options.shaders.background = std::make_shared<BackgroundCompiler>();
}

void animation(const Given& given, Options& options) {
  if (given.fps && given.frames.empty()) throw UsageError("--fps stands with --frames");
  if (given.frames.empty()) return;
  Frames frames;
  if (std::string error = parse_frames(given.frames, frames); !error.empty()) throw UsageError(error);
  if (given.fps) frames.per_second = in_range<double>(*given.fps, 1e-6, 1e6, "--fps");
  options.frames = frames;
}

/// Texts to values.
void convert(const Given& given, Options& options) {
  size_and_crop(given, options);
  shader_options(given, options);
  compilation(given, options);
  animation(given, options);
  if (!given.integrator.empty())
    options.integrator = renderer::IntegratorKind(one_of(given.integrator, "--integrator", renderer::kIntegratorNames));
  if (!given.tonemap.empty())
    options.tonemap = renderer::Tonemap(one_of(given.tonemap, "--tonemap", renderer::kTonemapNames));
  if (given.samples) options.samples = in_range<uint32_t>(double(*given.samples), 1, 1 << 24, "--spp");
  if (given.seed) options.seed = in_range<uint32_t>(double(*given.seed), 0, UINT32_MAX, "--seed");
  if (given.depth) options.depth = in_range<uint32_t>(double(*given.depth), 1, 1024, "--depth");
  if (given.threads) options.render.threads = in_range<unsigned>(double(*given.threads), 1, 1024, "--threads");
  if (given.time) options.render.seconds = in_range<double>(*given.time, 0, 1e9, "--time");
  if (given.noise) options.render.noise = in_range<double>(*given.noise, 0, 1, "--noise");
  if (given.checkpoint) options.checkpoint = in_range<double>(*given.checkpoint, 0, 1e9, "--checkpoint");
  if (given.exposure) options.exposure = in_range<float>(*given.exposure, -100, 100, "--exposure");
  if (given.clamp) options.clamp = in_range<float>(*given.clamp, 0, 1e30, "--clamp");
  if (!given.aovs.empty())
    if (std::string error = renderer::parse_aovs(given.aovs, options.aovs); !error.empty()) throw UsageError(error);
  options.render.contents = renderer::contents_for(options.aovs);
  for (const std::string& text : given.defines)
    define(options, text);
}

void check_image(const std::string& option, const std::string& name) {
  if (renderer::ImageFile::format_of(name).empty())
    throw UsageError(option + name + ": the ending is none of png, exr, jpg, tif, hdr");
}

void check(const Options& options) {
  if (options.scene.empty()) throw UsageError("no scene: moonrender SCENE.lua|MODEL.obj [options] -o IMAGE");
  if (options.output.empty()) throw UsageError("no output: give -o IMAGE (png, exr, jpg, tif or hdr)");
  check_image("", options.output);
  if (!options.preview.empty()) check_image("--preview=", options.preview);
  if (!options.aovs.empty() && renderer::ImageFile::format_of(options.output) != "exr")
    throw UsageError("--aov: only EXR holds such channels; give -o FILE.exr");
  if (options.frames && options.frames->first != options.frames->last && !has_frame_number(options.output))
    throw UsageError("--frames: the images need a place for their number; give -o NAME.%04d.png, say");
  if (options.preview == options.output) throw UsageError("--preview: the preview is another file than the image");
}

void add_output_options(CLI::App& app, Options& options, Given& given) {
  const char* group = "Output";
  app.add_option("-o", options.output, "Image to write: png, exr, jpg, tif, hdr; %04d is the frame's number")
      ->option_text("FILE")
      ->group(group);
  app.add_option("--size", given.size, "Extent in pixels (1280x720)")->option_text("WxH")->group(group);
  app.add_option("--crop", given.crop, "Render this part of the image only")->option_text("X,Y,W,H")->group(group);
  app.add_option("--aov", given.aovs,
                 "More channels in EXR: albedo, normal, depth, position, id (object, material), variance, samples, "
                 "faults; or all")
      ->option_text("NAME,...")
      ->group(group);
  app.add_option("--exposure", given.exposure, "Brighten 8- and 16-bit files")->option_text("STOPS")->group(group);
  app.add_option("--tonemap", given.tonemap, "Of 8- and 16-bit files")->option_text("none|filmic")->group(group);
  app.add_option("--stats", options.stats, "Times and counts as JSON (- = standard output)")
      ->option_text("FILE.json")
      ->group(group);
}

void add_render_options(CLI::App& app, Given& given) {
  const char* group = "Rendering";
  app.add_option("--spp", given.samples, "Samples a pixel (64), at most")->option_text("N")->group(group);
  app.add_option("--time", given.time, "Stop after this time")->option_text("SECONDS")->group(group);
  app.add_option("--noise", given.noise, "Stop where the estimated error is less; 0.01 is a hundredth of white")
      ->option_text("LEVEL")
      ->group(group);
  app.add_option("--seed", given.seed, "Of the random numbers (0)")->option_text("N")->group(group);
  app.add_option("--threads", given.threads, "Threads (all)")->option_text("N")->group(group);
  app.add_option("--integrator", given.integrator, "How light is followed (path)")
      ->option_text("path|whitted|sppm|irradiance")
      ->group(group);
  app.add_option("--depth", given.depth, "Segments a path may have (8)")->option_text("N")->group(group);
  app.add_option("--clamp", given.clamp, "Bound of a sample's radiance (none)")->option_text("L")->group(group);
  group = "Animation";
  app.add_option("--frames", given.frames, "Render these frames of the scene")->option_text("A[-B]")->group(group);
  app.add_option("--fps", given.fps, "Frames a second (24): `time` is frame / fps")->option_text("N")->group(group);
}

void add_long_render_options(CLI::App& app, Options& options, Given& given) {
  const char* group = "Long renders";
  app.add_option("--checkpoint", given.checkpoint, "Save the work every so often, to FILE.checkpoint beside the image")
      ->option_text("SECONDS")
      ->group(group);
  app.add_flag("--resume", options.resume, "Go on from the checkpoint, where there is one")->group(group);
  app.add_option("--preview", options.preview, "Refresh this image while rendering")->option_text("FILE")->group(group);
  app.add_flag("--tev{}", given.tev, "Show the picture in the viewer tev while it renders (127.0.0.1:14158)")
      ->option_text("[=HOST:PORT]")
      ->group(group);
}

void add_shader_options(CLI::App& app, Options& options, Given& given) {
  const char* group = "Shaders";
  app.add_option("--backend", given.backend, "jit: compiled; interp: in stock Lua 5.4")
      ->option_text("jit|interp")
      ->group(group);
  app.add_option("--precision", given.precision, "Of numbers (f32)")->option_text("f32|f64")->group(group);
  app.add_option("--width", given.width, "Lanes (auto)")->option_text("auto|1|4|8|16|32")->group(group);
  app.add_option("-D", given.defines, "Set a parameter of a material's shader")
      ->option_text("MATERIAL.NAME=VALUE")
      ->allow_extra_args(false)
      ->take_all()
      ->group(group);
  app.add_flag("--bake", options.shaders.bake, "Compile parameters as constants")->group(group);
  tools::add_cache_options(app, given.cache, group);
}

} // namespace

ParsedOptions parse_options(int argc, char** argv) {
  Options options;
  Given given;
  CLI::App app{"moonrender SCENE.lua|MODEL.obj [options] -o IMAGE: renders a scene with compiled Lua shaders",
               "moonrender"};
  app.footer(kExamples);
  app.set_help_flag("--help,-h", "Print this help");
  app.set_version_flag("--version", version(), "Print the version");
  app.option_defaults()->take_last(); // of an option given twice, as compilers do
  app.add_option("SCENE", options.scene, "A Lua scene, or a model")->option_text("SCENE.lua|MODEL.obj");
  add_output_options(app, options, given);
  add_render_options(app, given);
  add_long_render_options(app, options, given);
  add_shader_options(app, options, given);
  bool help_scene = false;
  app.add_flag("--help-scene", help_scene, "Print what a scene can say, as Markdown");
  app.parse_complete_callback([&] {
    if (help_scene) return;
    if (app.count("--tev") > 0) options.tev = given.tev == "true" ? "" : given.tev;
    convert(given, options);
    check(options);
  });
  if (const auto status = tools::parse_arguments(app, argc, argv, "moonrender")) return {std::nullopt, *status};
  if (help_scene) {
    std::cout << renderer::scene_reference();
    return {std::nullopt, tools::finish_output("moonrender")};
  }
  return {options, tools::kDone};
}

std::string apply(const Options& options, renderer::Settings& settings) {
  settings.width = options.width.value_or(settings.width);
  settings.height = options.height.value_or(settings.height);
  settings.samples = options.samples.value_or(settings.samples);
  settings.seed = options.seed.value_or(settings.seed);
  settings.depth = options.depth.value_or(settings.depth);
  settings.integrator = options.integrator.value_or(settings.integrator);
  settings.tonemap = options.tonemap.value_or(settings.tonemap);
  settings.exposure = options.exposure.value_or(settings.exposure);
  settings.clamp = options.clamp.value_or(settings.clamp);
  if (const auto& crop = options.render.crop) {
    bool inside = crop->x >= 0 && crop->y >= 0 && crop->width > 0 && crop->height > 0 &&
                  crop->width <= settings.width - crop->x && crop->height <= settings.height - crop->y;
    if (!inside)
      return "--crop lies outside the image of " + std::to_string(settings.width) + "x" +
             std::to_string(settings.height);
  }
  return "";
}

} // namespace moonshade::moonrender
