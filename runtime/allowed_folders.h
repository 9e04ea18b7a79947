// Which files may be named in what somebody else wrote: those in some folders and in folders below them. Symbolic links
// are followed before the check, so they lead nowhere else either.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace moonshade {

/// A path, or why it may not be used.
struct ResolvedPath {
  std::string path;
  std::string error;
};

class AllowedFolders {
public:
  /// A folder that there is not allows nothing.
  void allow(const std::string& folder);

  /// The file `name` as written in a file that lies in `base_folder`; it is there and a file.
  ResolvedPath resolve(const std::string& base_folder, const std::string& name) const;

  const std::vector<std::filesystem::path>& roots() const { return roots_; } ///< canonical

private:
  std::vector<std::filesystem::path> roots_;
};

/// The folder part of a path; "." where there is none.
std::string folder_of(const std::string& file);

} // namespace moonshade
