// Resolution of file names against the folders that a scene may use; whole files as text.
#include "renderer/scene/folders.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace moonshade::renderer {

namespace fs = std::filesystem;

std::string folder_of(const std::string& file) {
  fs::path parent = fs::path(file).parent_path();
  return parent.empty() ? "." : parent.string();
}

void Folders::allow_folder_of(const std::string& file) {
  std::error_code error;
  fs::path root = fs::canonical(folder_of(file), error);
  if (!error && std::find(roots_.begin(), roots_.end(), root) == roots_.end()) roots_.push_back(root);
}

static bool lies_in(const fs::path& path, const fs::path& root) {
  auto [end, unused] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  return end == root.end();
}

ResolvedPath Folders::resolve(const std::string& base_folder, const std::string& name) const {
  if (name.empty()) return {"", "an empty file name"};
  if (name.find('\0') != std::string::npos) return {"", "a file name with a zero byte"};
  // Windows exporters write backslashes; a file of that very name wins.
  std::string portable = name;
  std::error_code error;
  fs::path path = fs::path(base_folder) / portable;
  if (!fs::exists(path, error)) {
    std::replace(portable.begin(), portable.end(), '\\', '/');
    path = fs::path(base_folder) / portable;
  }
  fs::path real = fs::weakly_canonical(path, error);
  bool inside =
      !error && std::any_of(roots_.begin(), roots_.end(), [&](const fs::path& r) { return lies_in(real, r); });
  if (!inside) return {"", "'" + name + "' lies outside the folders of the scene"};
  if (!fs::exists(real, error)) return {"", "there is no file '" + name + "'"};
  if (!fs::is_regular_file(real, error)) return {"", "'" + name + "' is not a file"};
  std::string normal = path.lexically_normal().string();
  used_.insert(normal);
  return {std::move(normal), ""};
}

FileText read_file(const std::string& path, uint64_t limit) {
  std::error_code error;
  if (fs::is_directory(path, error)) return {"", path + ": is a folder"};
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return {"", path + ": " + std::strerror(errno)};
  std::string text;
  uint64_t size = fs::file_size(path, error);
  if (!error && size <= limit) text.reserve(size);
  char block[1 << 16];
  size_t count = sizeof block;
  while (count == sizeof block && text.size() <= limit) {
    count = std::fread(block, 1, sizeof block, file);
    text.append(block, count);
  }
  bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) return {"", path + ": cannot be read"};
  if (text.size() > limit) return {"", path + ": larger than " + std::to_string(limit) + " bytes"};
  return {std::move(text), ""};
}

} // namespace moonshade::renderer
