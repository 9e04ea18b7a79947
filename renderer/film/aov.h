// What a picture can hold beside radiance ("arbitrary output variables"), one table: the word for --aov, the channels'
// names in EXR as compositing programs and denoisers expect them, and where the values come from.
#pragma once

#include "renderer/film/film.h"

#include <span>
#include <string_view>

namespace moonshade::renderer {

enum class Aov : uint8_t { Albedo, Normal, Depth, Position, Object, Material, Variance, Samples, Faults };
inline constexpr size_t kAovCount = 9;

struct AovInfo {
  std::string_view word; ///< in --aov
  std::span<const char* const> channels;
  bool integers; ///< EXR's UINT, else FLOAT
  FilmContents needs;
  std::string_view doc;
};
const AovInfo& aov_info(Aov aov);

/// In the order of the enumeration, each once.
using AovList = std::vector<Aov>;

/// Reads "albedo,depth,id" ("id" is object and material, "all" everything); an error, or empty.
std::string parse_aovs(std::string_view text, AovList& aovs);

/// What the film must keep for them.
FilmContents contents_for(const AovList& aovs);

/// The channels of one pixel, each a float or an unsigned integer in 32 bits, to `out`; gives the end.
uint32_t* put_aov(Aov aov, const Film& film, size_t pixel, uint32_t* out);

} // namespace moonshade::renderer
