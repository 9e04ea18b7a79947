// Options are declared in groups, as --help shows them. Those that the contract has and the renderer not yet are known,
// too, so that they get an honest answer.
#include "tools/moonrender/options.h"

#include "renderer/film/image_file.h"
#include "renderer/scene/nearest_name.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>

namespace moonshade::moonrender {

namespace {

constexpr const char* kExamples = R"(Examples:
  moonrender teapot.obj -o teapot.png                     a bare model: framed, under sun and sky
  moonrender copper.lua --size=640x360 --spp=16 -o a.png  a quick look
  moonrender copper.lua --integrator=whitted -o b.png     direct light and mirrors only
  moonrender copper.lua --time=60 --spp=9999 -o c.exr     what a minute gives, as linear floats
  moonrender copper.lua -D copper.scale=12 -o d.png       a parameter of the material 'copper'
  moonrender copper.lua --backend=interp -o e.png         the same shaders in stock Lua

Exit status: 0 done, 1 the scene is at fault, 2 the call is, 3 the machine is, 130 interrupted (the picture then holds
the passes done).)";

constexpr const char* kNotYet[] = {"--noise",    "--frames", "--fps", "--preview", "--tev",       "--cache-dir",
                                   "--no-cache", "--bake",   "--aov", "--resume",  "--checkpoint"};

struct UsageError {
  std::string message;
};

template <typename T> T number(std::string_view text, const char* what) {
  T value{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw UsageError{std::string(what) + ": '" + std::string(text) + "' is no number that fits"};
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t at; (at = text.find(separator)) != std::string_view::npos; text.remove_prefix(at + 1))
    parts.push_back(text.substr(0, at));
  parts.push_back(text);
  return parts;
}

size_t one_of(const std::string& text, const char* option, std::span<const std::string_view> words, size_t available) {
  for (size_t i = 0; i < words.size(); ++i) {
    if (text != words[i]) continue;
    if (i >= available) throw UsageError{std::string(option) + "=" + text + ": not available yet"};
    return i;
  }
  throw UsageError{std::string(option) + ": unknown '" + text + "'" + renderer::did_you_mean(text, words) +
                   " (known: " + renderer::join_names(words) + ")"};
}

/// Texts of options, as given.
struct Given {
  std::string size, crop, integrator, tonemap, backend, precision, width;
  std::optional<int64_t> samples, seed, threads, depth;
  std::optional<double> time, exposure, clamp;
  std::vector<std::string> defines;
};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  return text;
}

template <typename T> T in_range(double value, double low, double high, const char* option) {
  if (!(value >= low && value <= high))
    throw UsageError{std::string(option) + " lies between " + short_text(low) + " and " + short_text(high)};
  return T(value);
}

void define(Options& options, const std::string& text) {
  size_t equals = text.find('=');
  size_t dot = text.rfind('.', equals);
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals)
    throw UsageError{"-D " + text + ": expected MATERIAL.NAME=VALUE"};
  options.overrides[text.substr(0, dot)][text.substr(dot + 1, equals - dot - 1)] = text.substr(equals + 1);
}

void size_and_crop(const Given& given, Options& options) {
  if (!given.size.empty()) {
    auto parts = split(given.size, 'x');
    if (parts.size() != 2) throw UsageError{"--size: expected WxH, as in 1280x720"};
    options.width = in_range<int>(number<int>(parts[0], "--size"), 1, 65536, "--size");
    options.height = in_range<int>(number<int>(parts[1], "--size"), 1, 65536, "--size");
  }
  if (!given.crop.empty()) {
    auto parts = split(given.crop, ',');
    if (parts.size() != 4) throw UsageError{"--crop: expected X,Y,W,H"};
    options.render.crop = {number<int>(parts[0], "--crop"), number<int>(parts[1], "--crop"),
                           number<int>(parts[2], "--crop"), number<int>(parts[3], "--crop")};
  }
}

void shader_options(const Given& given, Options& options) {
  static constexpr std::string_view kBackends[] = {"jit", "interp"};
  static constexpr std::string_view kPrecisions[] = {"f32", "f64"};
  if (!given.backend.empty())
    options.shaders.backend = renderer::Backend(one_of(given.backend, "--backend", kBackends, 2));
  if (!given.precision.empty())
    options.shaders.precision =
        one_of(given.precision, "--precision", kPrecisions, 2) ? Precision::F64 : Precision::F32;
  if (given.width.empty() || given.width == "auto") return;
  options.shaders.width = number<unsigned>(given.width, "--width");
  if (std::find(kWidths.begin(), kWidths.end(), options.shaders.width) == kWidths.end())
    throw UsageError{"--width: expected auto, 1, 4, 8, 16 or 32"};
}

/// Texts to values.
void convert(const Given& given, Options& options) {
  static constexpr std::string_view kIntegrators[] = {"path", "whitted", "sppm", "irradiance"};
  static constexpr std::string_view kTonemaps[] = {"none", "filmic"};
  size_and_crop(given, options);
  shader_options(given, options);
  if (!given.integrator.empty())
    options.integrator = renderer::IntegratorKind(one_of(given.integrator, "--integrator", kIntegrators, 2));
  if (!given.tonemap.empty()) options.tonemap = renderer::Tonemap(one_of(given.tonemap, "--tonemap", kTonemaps, 2));
  if (given.samples) options.samples = in_range<uint32_t>(double(*given.samples), 1, 1 << 24, "--spp");
  if (given.seed) options.seed = in_range<uint32_t>(double(*given.seed), 0, UINT32_MAX, "--seed");
  if (given.depth) options.depth = in_range<uint32_t>(double(*given.depth), 1, 1024, "--depth");
  if (given.threads) options.render.threads = in_range<unsigned>(double(*given.threads), 1, 1024, "--threads");
  if (given.time) options.render.seconds = in_range<double>(*given.time, 0, 1e9, "--time");
  if (given.exposure) options.exposure = in_range<float>(*given.exposure, -100, 100, "--exposure");
  if (given.clamp) options.clamp = in_range<float>(*given.clamp, 0, 1e30, "--clamp");
  for (const std::string& text : given.defines)
    define(options, text);
}

void refuse_what_is_not_there(int argc, char** argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    std::string_view name = std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    for (const char* option : kNotYet)
      if (name == option) throw UsageError{std::string(option) + ": not available yet"};
  }
}

void check(const Options& options) {
  if (options.scene.empty()) throw UsageError{"no scene: moonrender SCENE.lua|MODEL.obj [options] -o IMAGE"};
  if (options.output.empty()) throw UsageError{"no output: give -o IMAGE (png, exr, jpg, tif or hdr)"};
  if (renderer::ImageFile::format_of(options.output).empty())
    throw UsageError{options.output + ": the ending is none of png, exr, jpg, tif, hdr"};
}

} // namespace

ParsedOptions parse_options(int argc, char** argv) {
  Options options;
  Given given;
  CLI::App app{"moonrender SCENE.lua|MODEL.obj [options] -o IMAGE: renders a scene with compiled Lua shaders",
               "moonrender"};
  app.footer(kExamples);
  app.set_help_flag("--help,-h", "show this help");
  app.set_version_flag("--version", version(), "show the version");
  app.option_defaults()->take_last(); // of an option given twice, as compilers do
  app.add_option("scene", options.scene, "a Lua scene, or an OBJ model")->type_name("SCENE");

  app.add_option("-o", options.output, "image to write: png, exr, jpg, tif, hdr")->type_name("FILE")->group("Output");
  app.add_option("--size", given.size, "extent in pixels (1280x720)")->type_name("WxH")->group("Output");
  app.add_option("--crop", given.crop, "render this part of the image only")->type_name("X,Y,W,H")->group("Output");
  app.add_option("--exposure", given.exposure, "brighten 8- and 16-bit files")->type_name("STOPS")->group("Output");
  app.add_option("--tonemap", given.tonemap, "of 8- and 16-bit files: none or filmic")
      ->type_name("CURVE")
      ->group("Output");
  app.add_option("--stats", options.stats, "times and counts as JSON (- = standard output)")
      ->type_name("FILE.json")
      ->group("Output");

  app.add_option("--spp", given.samples, "samples a pixel (64)")->type_name("N")->group("Rendering");
  app.add_option("--time", given.time, "stop after this time")->type_name("SECONDS")->group("Rendering");
  app.add_option("--seed", given.seed, "of the random numbers (0)")->type_name("N")->group("Rendering");
  app.add_option("--threads", given.threads, "threads (all)")->type_name("N")->group("Rendering");
  app.add_option("--integrator", given.integrator, "path or whitted")->type_name("NAME")->group("Rendering");
  app.add_option("--depth", given.depth, "segments a path may have (8)")->type_name("N")->group("Rendering");
  app.add_option("--clamp", given.clamp, "bound of a sample's radiance (none)")->type_name("L")->group("Rendering");

  app.add_option("--backend", given.backend, "jit: compiled; interp: in stock Lua 5.4")
      ->type_name("NAME")
      ->group("Shaders");
  app.add_option("--precision", given.precision, "f32 or f64")->type_name("P")->group("Shaders");
  app.add_option("--width", given.width, "lanes: auto, 1, 4, 8, 16 or 32")->type_name("N")->group("Shaders");
  app.add_option("-D", given.defines, "set a parameter of a material's shader")
      ->type_name("MATERIAL.NAME=VALUE")
      ->allow_extra_args(false)
      ->take_all()
      ->group("Shaders");

  try {
    refuse_what_is_not_there(argc, argv);
    app.parse(argc, argv);
    convert(given, options);
    check(options);
  } catch (const UsageError& error) {
    std::cerr << "moonrender: error: " << error.message << "\n";
    return {std::nullopt, 2};
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return {std::nullopt, app.exit(error)};
    std::cerr << "moonrender: error: " << error.what() << "\n";
    return {std::nullopt, 2};
  }
  return {options, 0};
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
