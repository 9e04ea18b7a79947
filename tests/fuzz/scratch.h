// A file of a fuzz target, for what reads files by their names.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace moonshade::fuzz {

/// A file that is deleted when the target is done with it.
class Scratch {
public:
  explicit Scratch(const char* ending)
      : path_((std::filesystem::temp_directory_path() / ("moonshade-fuzz-" + std::to_string(::getpid()))).string() +
              ending) {}
  ~Scratch() { std::remove(path_.c_str()); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::string& path() const { return path_; }
  const std::string& write(std::string_view bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
    return path_;
  }

private:
  std::string path_;
};

} // namespace moonshade::fuzz
