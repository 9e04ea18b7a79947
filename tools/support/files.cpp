// Files read and written whole; on POSIX calls, because a rename must follow a complete and checked write.
#include "tools/support/files.h"

#include "tools/support/exit_status.h"
#include "tools/support/interrupt.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <sys/stat.h>
#include <unistd.h>

namespace moonshade::tools {

namespace {

std::string system_error() { return std::strerror(errno); }

bool write_all(int descriptor, const std::string& bytes) {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += size_t(count);
  }
  return true;
}

/// The mode that a plain open() would have given the file: mkstemp makes it readable by its owner alone.
mode_t usual_mode() {
  const mode_t mask = umask(0);
  umask(mask);
  return mode_t(0666) & ~mask;
}

bool is_special(const std::string& path) {
  struct stat status = {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

std::string write_directly(const std::string& path, const std::string& bytes) {
  const int descriptor = open(path.c_str(), O_WRONLY);
  if (descriptor < 0) return system_error();
  const bool written = write_all(descriptor, bytes);
  const std::string error = written ? "" : system_error();
  close(descriptor);
  return error;
}

} // namespace

void keep_standard_files_apart() {
  // The wrong way round, so that whoever reads or writes there gets an error, as from what is closed.
  constexpr int kModes[] = {O_WRONLY, O_RDONLY, O_RDONLY};
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0)
      static_cast<void>(open("/dev/null", kModes[descriptor])); // the lowest that is free
}

FileText read_file(const std::string& path, uint64_t limit) {
  return path == "-" ? read_rest(STDIN_FILENO, limit) : moonshade::read_file(path, limit);
}

std::string write_file(const std::string& path, const std::string& bytes) {
  if (path == "-") return write_all(STDOUT_FILENO, bytes) ? "" : system_error();
  if (is_special(path)) return write_directly(path, bytes); // /dev/null, a pipe: nothing to rename
  std::string temporary = path + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) return system_error();
  set_file_to_delete(temporary.c_str());
  const bool written = write_all(descriptor, bytes) && fchmod(descriptor, usual_mode()) == 0;
  std::string error = written ? "" : system_error();
  if (close(descriptor) != 0 && error.empty()) error = system_error();
  if (error.empty() && rename(temporary.c_str(), path.c_str()) != 0) error = system_error();
  if (!error.empty()) unlink(temporary.c_str());
  set_file_to_delete(nullptr);
  return error;
}

int finish_output(const char* program) {
  std::cout.flush();
  std::fflush(stdout);
  if (std::cout && std::ferror(stdout) == 0) return kDone;
  std::cerr << program << ": error: cannot write to standard output\n";
  return kMachineAtFault;
}

ModuleReader modules_of(const std::string& shader, const std::vector<std::string>& folders) {
  std::vector<std::string> all;
  if (shader != "-") all.push_back(std::filesystem::path(shader).parent_path().string());
  all.insert(all.end(), folders.begin(), folders.end());
  return folder_modules(std::move(all));
}

} // namespace moonshade::tools
