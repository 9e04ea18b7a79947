// --cache-dir and --no-cache, which programs that compile share.
#pragma once

#include "runtime/shader.h"
#include "tools/support/arguments.h"

#include <string>

namespace moonshade::tools {

struct CacheOptions {
  std::string folder; ///< empty: the user's own (default_cache_folder)
  bool none = false;
};
void add_cache_options(CLI::App& app, CacheOptions& options, const char* group);
/// Null where there is to be none, or where no folder is known.
std::shared_ptr<ObjectCache> open_cache(const CacheOptions& options);

} // namespace moonshade::tools
