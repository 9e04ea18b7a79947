// Names: Z, N and P as in Nuke, Arnold and pbrt; albedo as denoisers and pbrt call it; ids as a layer of their own.
#include "renderer/film/aov.h"

#include "renderer/scene/nearest_name.h"

#include <algorithm>
#include <array>
#include <bit>

namespace moonshade::renderer {

namespace {

constexpr const char* kAlbedo[] = {"albedo.R", "albedo.G", "albedo.B"};
constexpr const char* kNormal[] = {"N.X", "N.Y", "N.Z"};
constexpr const char* kDepth[] = {"Z"};
constexpr const char* kPosition[] = {"P.X", "P.Y", "P.Z"};
constexpr const char* kObject[] = {"id.object"};
constexpr const char* kMaterial[] = {"id.material"};
constexpr const char* kVariance[] = {"variance.R", "variance.G", "variance.B"};
constexpr const char* kSamples[] = {"sampleCount"};
constexpr const char* kFaults[] = {"faults"};

constexpr FilmContents kFirst{.squares = false, .first = true}, kSquares{.squares = true, .first = false};

constexpr std::array<AovInfo, kAovCount> kAovs = {{
    {"albedo", kAlbedo, false, kFirst, "colour of the surface, mirror-like reflection included; mean of the samples"},
    {"normal", kNormal, false, kFirst, "bumped normal in world space, to the viewer; mean, shorter at edges"},
    {"depth", kDepth, false, kFirst, "along the camera's axis, of the nearest sample; 1e10 where nothing is"},
    {"position", kPosition, false, kFirst, "in world space, of the nearest sample"},
    {"object", kObject, true, kFirst, "number of the object, from 1, of the nearest sample; 0 where nothing is"},
    {"material", kMaterial, true, kFirst, "number of the material, likewise"},
    {"variance", kVariance, false, kSquares, "estimated variance of the pixel's mean"},
    {"samples", kSamples, true, {}, "samples of the pixel"},
    {"faults", kFaults, false, {}, "share of the samples that met a fault of a shader"},
}};

uint32_t* put(uint32_t* out, float value) {
  *out = std::bit_cast<uint32_t>(value);
  return out + 1;
}
uint32_t* put(uint32_t* out, const Vec3& v) { return put(put(put(out, v.x), v.y), v.z); }
uint32_t* put(uint32_t* out, uint32_t number) {
  *out = number;
  return out + 1;
}

} // namespace

const AovInfo& aov_info(Aov aov) { return kAovs[size_t(aov)]; }

std::string parse_aovs(std::string_view text, AovList& aovs) {
  std::array<bool, kAovCount> chosen{};
  for (bool more = true; more;) {
    size_t comma = text.find(',');
    std::string_view word = text.substr(0, comma);
    more = comma != std::string_view::npos;
    text.remove_prefix(more ? comma + 1 : text.size());
    bool known = false;
    for (size_t k = 0; k < kAovCount; ++k) {
      bool is_id = k == size_t(Aov::Object) || k == size_t(Aov::Material);
      if (word != kAovs[k].word && word != "all" && !(word == "id" && is_id)) continue;
      chosen[k] = known = true;
    }
    if (known) continue;
    std::vector<std::string_view> words;
    for (const AovInfo& info : kAovs)
      words.push_back(info.word);
    words.insert(words.end(), {"id", "all"});
    return "--aov: unknown '" + std::string(word) + "'" + did_you_mean(word, words) + " (known: " + join_names(words) +
           ")";
  }
  aovs.clear();
  for (size_t k = 0; k < kAovCount; ++k)
    if (chosen[k]) aovs.push_back(Aov(k));
  return "";
}

FilmContents contents_for(const AovList& aovs) {
  FilmContents contents;
  for (Aov aov : aovs) {
    contents.squares |= aov_info(aov).needs.squares;
    contents.first |= aov_info(aov).needs.first;
  }
  return contents;
}

uint32_t* put_aov(Aov aov, const Film& film, size_t pixel, uint32_t* out) {
  switch (aov) {
  case Aov::Albedo:
    return put(out, Vec3(film.first(pixel).albedo));
  case Aov::Normal:
    return put(out, Vec3(film.first(pixel).normal));
  case Aov::Depth:
    return put(out, film.first(pixel).depth);
  case Aov::Position:
    return put(out, film.first(pixel).position);
  case Aov::Object:
    return put(out, film.first(pixel).object);
  case Aov::Material:
    return put(out, film.first(pixel).material);
  case Aov::Variance:
    return put(out, film.variance(pixel));
  case Aov::Samples:
    return put(out, film.samples(pixel));
  case Aov::Faults:
    break;
  }
  uint32_t samples = film.samples(pixel);
  return put(out, samples ? float(film.faults(pixel)) / float(samples) : 0.0f);
}

} // namespace moonshade::renderer
