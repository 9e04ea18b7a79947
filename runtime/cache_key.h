// What compiled code depends on, and the key that this makes.
#pragma once

#include "runtime/object_cache.h"
#include "runtime/shader.h"

#include <map>
#include <string>

namespace moonshade {

/// A shader's text and those of all modules that it can require.
struct SourceClosure {
  std::string name, text;
  std::map<std::string, ModuleText> modules; ///< by the name that is required; those that were found

  /// Gives these modules and no others.
  ModuleReader reader() const;
};

/// Reads the modules that the text, or a module's, names in a `require`. They are found by the tokens alone, so they
/// may be more than those that a shader loads; never fewer, but for calls that the checks refuse.
SourceClosure source_closure(const std::string& name, const std::string& text, const ModuleReader& reader);

/// The hash of the sources, of the options that matter, of this build of the library and of LLVM, and of the processor;
/// nothing where the build does not tell which it is.
std::optional<CacheKey> cache_key(const SourceClosure& sources, const CompileOptions& options);

} // namespace moonshade
