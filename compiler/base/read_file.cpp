// By POSIX calls: a file may be a device or a pipe, whose size nothing tells.
#include "compiler/base/read_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace moonshade {

FileText read_rest(int descriptor, uint64_t limit) {
  FileText file;
  struct stat status = {};
  if (fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && uint64_t(status.st_size) <= limit)
    file.text.reserve(size_t(status.st_size));
  char block[1 << 16];
  for (;;) {
    const ssize_t count = ::read(descriptor, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return {"", std::strerror(errno)};
    if (count == 0) return file;
    file.text.append(block, size_t(count));
    if (file.text.size() > limit) return {"", "larger than " + std::to_string(limit) + " bytes"};
  }
}

FileText read_file(const std::string& path, uint64_t limit) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {"", std::strerror(errno)};
  FileText file = read_rest(descriptor, limit);
  close(descriptor);
  return file;
}

} // namespace moonshade
