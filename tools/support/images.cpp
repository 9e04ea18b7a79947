#include "tools/support/images.h"

#include "runtime/allowed_folders.h"

#include <dlfcn.h>
#include <mutex>

namespace moonshade::tools {

namespace {

using MakeOpener = void (*)(const AllowedFolders&, ImageOpener&);

/// What the library that reads images makes, once it is asked for.
class LateOpener {
public:
  explicit LateOpener(AllowedFolders folders) : folders_(std::move(folders)) {}

  OpenedImage open(const std::string& file, const std::string& from, bool raw) {
    std::call_once(loaded_, [this] { load(); });
    return opener_ ? opener_(file, from, raw) : OpenedImage{nullptr, error_, ""};
  }

private:
  /// It lies beside the programs, in ../lib, where their run path leads; it stays loaded.
  void load() {
    void* library = dlopen("moonshade_images.so", RTLD_NOW | RTLD_LOCAL);
    void* make = library != nullptr ? dlsym(library, "moonshade_file_images") : nullptr;
    if (make != nullptr)
      reinterpret_cast<MakeOpener>(make)(folders_, opener_);
    else
      error_ = std::string("what reads images cannot be loaded: ") + dlerror();
  }

  AllowedFolders folders_;
  std::once_flag loaded_;
  ImageOpener opener_;
  std::string error_;
};

} // namespace

ImageOpener images_of(const std::string& shader, const std::vector<std::string>& folders) {
  AllowedFolders allowed;
  allowed.allow(shader == "-" ? "." : folder_of(shader));
  for (const std::string& folder : folders)
    allowed.allow(folder);
  const auto late = std::make_shared<LateOpener>(std::move(allowed));
  return [late](const std::string& file, const std::string& from, bool raw) { return late->open(file, from, raw); };
}

} // namespace moonshade::tools
