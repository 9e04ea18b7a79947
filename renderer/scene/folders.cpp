// What a scene has used of its folders; whole files as text.
#include "renderer/scene/folders.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace moonshade::renderer {

namespace fs = std::filesystem;

void Folders::allow_folder_of(const std::string& file) { allowed_.allow(folder_of(file)); }

ResolvedPath Folders::resolve(const std::string& base_folder, const std::string& name) const {
  ResolvedPath resolved = allowed_.resolve(base_folder, name);
  if (resolved.error.empty()) used_.insert(resolved.path);
  return resolved;
}

ResolvedPath Folders::resolve_or_beside(const std::string& base_folder, const std::string& name) const {
  ResolvedPath resolved = resolve(base_folder, name);
  const size_t separator = name.find_last_of("/\\");
  if (resolved.error.empty() || separator == std::string::npos) return resolved;
  const ResolvedPath beside = resolve(base_folder, name.substr(separator + 1));
  return beside.error.empty() ? beside : resolved;
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
