// Places in files are compared, so a name in a loop that assigns it counts as the shader's from the loop's beginning
// on; whether it has a value there is the matter of assigned.cpp.
#include "compiler/sema/hidden_names.h"

#include "compiler/sema/names.h"

#include <algorithm>

namespace moonshade::sema {

namespace {

/// A name that stock Lua knows beside the library. `require` is no such name: what it loads is found before anything is
/// walked.
bool is_hiding(std::string_view name) {
  return name != "require" && (name == "math" || is_library_function(name) || find_refused_name(name) != nullptr);
}

/// From where on in a file the module has run for sure.
uint32_t begin_in(const HiddenNames::File& file, size_t module) {
  if (module < file.began) return 0;
  for (const HiddenNames::File::Required& required : file.required)
    if (module >= required.first && module < required.last) return required.end;
  return UINT32_MAX;
}

} // namespace

void HiddenNames::order_by(const Globals& globals, const std::vector<File>& files) {
  std::vector<std::pair<const Global*, size_t>> hiding; // and the number of the file that defines it
  for (const auto& [name, global] : globals.by_name) {
    if (!is_hiding(name)) continue;
    const auto file = std::ranges::find(files, global.definition.file, &File::id);
    hiding.emplace_back(&global, static_cast<size_t>(file - files.begin()));
    hidden_.emplace_back(&global, file == files.end() || file->is_certain);
  }
  if (hiding.empty()) return;
  for (const File& file : files) {
    Timeline& timeline = timelines_.emplace_back(Timeline{file.id, {}});
    for (const auto& [global, number] : hiding) {
      const bool is_own = global->definition.file == file.id;
      const bool is_certain = number < files.size() && files[number].is_certain;
      timeline.begins.emplace_back(is_own ? global->begins : is_certain ? begin_in(file, number) : UINT32_MAX, global);
    }
    std::ranges::sort(timeline.begins, {},
                      [](const Begin& begin) { return std::pair(begin.first, begin.second->name); });
  }
}

unsigned HiddenNames::moment_at(Span place) const {
  const auto timeline = std::ranges::find(timelines_, place.file, &Timeline::id);
  if (timeline == timelines_.end()) return kShading;
  const auto end = std::ranges::upper_bound(timeline->begins, place.begin, {}, &Begin::first);
  const size_t number = static_cast<size_t>(timeline - timelines_.begin());
  return static_cast<unsigned>(1 + number * (hidden_.size() + 1) + static_cast<size_t>(end - timeline->begins.begin()));
}

bool HiddenNames::contains(const void* global) const {
  return std::ranges::any_of(hidden_, [&](const auto& entry) { return entry.first == global; });
}

HiddenNames::Meaning HiddenNames::meaning(const Global& global, unsigned moment) const {
  const auto hidden = std::ranges::find(hidden_, &global, [](const auto& entry) { return entry.first; });
  if (hidden == hidden_.end()) return Meaning::Shader;
  if (moment == kShading) return hidden->second ? Meaning::Shader : Meaning::Open;
  const Timeline& timeline = timelines_[(moment - 1) / (hidden_.size() + 1)];
  const auto begun = timeline.begins.begin() + static_cast<std::ptrdiff_t>((moment - 1) % (hidden_.size() + 1));
  if (std::any_of(timeline.begins.begin(), begun, [&](const Begin& begin) { return begin.second == &global; }))
    return Meaning::Shader;
  return global.definition.file == timeline.id ? Meaning::Library : Meaning::Open;
}

} // namespace moonshade::sema
