// What a scene has used of its folders; whole files as text.
#include "renderer/scene/folders.h"

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
  FileText file = moonshade::read_file(path, limit);
  if (!file.error.empty()) file.error.insert(0, path + ": ");
  return file;
}

} // namespace moonshade::renderer
