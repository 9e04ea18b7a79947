// Which files a scene may name: those in the folders of the files that the user named, and in folders below them.
// Symbolic links are followed before the check, so they lead nowhere else either.
#pragma once

#include "compiler/base/read_file.h"
#include "runtime/allowed_folders.h"

#include <set>
#include <string>

namespace moonshade::renderer {

class Folders {
public:
  /// The folder of a file that the user named.
  void allow_folder_of(const std::string& file);

  /// The file `name` as written in a file that lies in `base_folder`.
  ResolvedPath resolve(const std::string& base_folder, const std::string& name) const;

  /// The same, but a name that leads nowhere ("C:\\models\\wood.png", from another machine) may be that of a file which
  /// came along: the last part of it, in `base_folder`.
  ResolvedPath resolve_or_beside(const std::string& base_folder, const std::string& name) const;

  /// Every file that was resolved so far.
  const std::set<std::string>& used() const { return used_; }

private:
  AllowedFolders allowed_;
  mutable std::set<std::string> used_; ///< a record only: decides nothing
};

/// moonshade::read_file's, with the file's name in the error.
FileText read_file(const std::string& path, uint64_t limit = uint64_t(8) << 30);

} // namespace moonshade::renderer
