// Modules as files below some folders. A name has letters, digits, '_' and '-' between its dots (sema sees to that), so
// a path cannot climb; links that lead outside are not followed.
#include "compiler/base/read_file.h"
#include "runtime/shader.h"

#include <filesystem>
#include <system_error>

namespace moonshade {

namespace {

constexpr uintmax_t kMaxModuleBytes = uintmax_t(16) << 20;

bool lies_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

ModuleText read_module(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  if (!error && !lies_below(real, std::filesystem::canonical(folder, error)))
    return {path.string(), "", "'" + path.string() + "' leads outside of the module path"};
  if (!std::filesystem::is_regular_file(real, error)) return {path.string(), "", "'" + path.string() + "' is no file"};
  if (std::filesystem::file_size(real, error) > kMaxModuleBytes)
    return {path.string(), "", "'" + path.string() + "' is larger than 16 MiB"};
  FileText file = read_file(real.string(), kMaxModuleBytes);
  if (!file.error.empty()) return {path.string(), "", "'" + path.string() + "' cannot be read"};
  return {path.string(), std::move(file.text), ""};
}

} // namespace

ModuleReader folder_modules(std::vector<std::string> folders) {
  return [folders = std::move(folders)](const std::string& name) -> ModuleText {
    std::string file = name;
    for (char& c : file)
      if (c == '.') c = '/';
    file += ".lua";
    std::string looked;
    for (const std::string& folder : folders) {
      const std::filesystem::path path = std::filesystem::path(folder.empty() ? "." : folder) / file;
      std::error_code error;
      if (std::filesystem::exists(path, error))
        return read_module(path.lexically_normal(), folder.empty() ? "." : folder);
      looked += (looked.empty() ? "" : ", ") + ("'" + path.lexically_normal().string() + "'");
    }
    return {"", "", "looked for " + looked};
  };
}

} // namespace moonshade
