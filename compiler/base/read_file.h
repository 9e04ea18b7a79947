// Files read whole.
#pragma once

#include <cstdint>
#include <string>

namespace moonshade {

struct FileText {
  std::string text;
  std::string error; ///< why it cannot be read, without its name; empty where it can
};

/// A file of more than `limit` bytes, or without an end, is an error.
FileText read_file(const std::string& path, uint64_t limit);
/// What is left of an open one, which stays open.
FileText read_rest(int descriptor, uint64_t limit);

} // namespace moonshade
