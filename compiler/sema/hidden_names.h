// Globals that hide a name of the library. As in Lua, such a name is the library's until the shader gives it a value,
// and a function sees what it is when it is called. While shading that is the shader's; while the top level runs it
// depends on the place, or on that of the call that led there. A moment stands for such a place.
#pragma once

#include "compiler/sema/globals.h"

#include <utility>
#include <vector>

namespace moonshade::sema {

class HiddenNames {
public:
  /// A file whose top level runs. The modules have numbers, in the order in which they run.
  struct File {
    FileId id = kNoFile;
    size_t began = 0;       ///< how many modules had run when stock Lua began with it
    bool is_certain = true; ///< it runs whatever happens
    /// Calls of `require` that are reached whatever happens: behind its end the modules [first, last) have run.
    struct Required {
      uint32_t end;
      size_t first, last;
    };
    std::vector<Required> required = {};
  };
  enum class Meaning : uint8_t {
    Shader,
    Library,
    Open, ///< the order in which files run decides, and is not known
  };
  static constexpr unsigned kShading = 0;

  /// `files`: the modules by their numbers, and the shader's last.
  void order_by(const Globals& globals, const std::vector<File>& files);
  /// The moment at which the top level of the place's file is there.
  unsigned moment_at(Span place) const;
  bool contains(const void* global) const;
  Meaning meaning(const Global& global, unsigned moment) const;

private:
  /// Where a file's top level gets by: the global has its value from there on.
  using Begin = std::pair<uint32_t, const Global*>;
  struct Timeline {
    FileId id;
    std::vector<Begin> begins; ///< in the order of their places
  };

  std::vector<Timeline> timelines_;
  std::vector<std::pair<const Global*, bool>> hidden_; ///< and whether the file that defines it is certain to run
};

} // namespace moonshade::sema
