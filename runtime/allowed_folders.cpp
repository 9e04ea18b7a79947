#include "runtime/allowed_folders.h"

#include <algorithm>
#include <system_error>

namespace moonshade {

namespace fs = std::filesystem;

std::string folder_of(const std::string& file) {
  const fs::path parent = fs::path(file).parent_path();
  return parent.empty() ? "." : parent.string();
}

void AllowedFolders::allow(const std::string& folder) {
  std::error_code error;
  fs::path root = fs::canonical(folder.empty() ? "." : folder, error);
  if (!error && std::ranges::find(roots_, root) == roots_.end()) roots_.push_back(std::move(root));
}

static bool lies_in(const fs::path& path, const fs::path& root) {
  const auto [end, unused] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return end == root.end();
}

ResolvedPath AllowedFolders::resolve(const std::string& base_folder, const std::string& name) const {
  if (name.empty()) return {"", "an empty file name"};
  if (name.find('\0') != std::string::npos) return {"", "a file name with a zero byte"};
  // Windows exporters write backslashes; a file of that very name wins.
  std::string portable = name;
  std::error_code error;
  fs::path path = fs::path(base_folder) / portable;
  if (!fs::exists(path, error)) {
    std::ranges::replace(portable, '\\', '/');
    path = fs::path(base_folder) / portable;
  }
  const fs::path real = fs::weakly_canonical(path, error);
  const bool inside = !error && std::ranges::any_of(roots_, [&](const fs::path& root) { return lies_in(real, root); });
  if (!inside) return {"", "'" + name + "' lies outside the folders that may be read"};
  if (!fs::exists(real, error)) return {"", "there is no file '" + name + "'"};
  if (!fs::is_regular_file(real, error)) return {"", "'" + name + "' is not a file"};
  return {path.lexically_normal().string(), ""};
}

} // namespace moonshade
