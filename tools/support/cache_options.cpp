// Options of the object cache (cache_options.h).
#include "tools/support/cache_options.h"

namespace moonshade::tools {

void add_cache_options(CLI::App& app, CacheOptions& options, const char* group) {
  app.add_option("--cache-dir", options.folder, "Folder of compiled code (default $XDG_CACHE_HOME/moonshade)")
      ->option_text("DIR")
      ->group(group);
  app.add_flag("--no-cache", options.none, "Neither use nor keep compiled code")->group(group);
}

std::shared_ptr<ObjectCache> open_cache(const CacheOptions& options) {
  if (options.none) return nullptr;
  return open_object_cache(options.folder.empty() ? default_cache_folder() : options.folder);
}

} // namespace moonshade::tools
