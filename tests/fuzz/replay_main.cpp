// Runs a fuzz target over kept inputs, without libFuzzer: ms_fuzz_TARGET FILE-OR-FOLDER...
//
// Each file's name is printed before it is run, so that the last line names the one that crashes.
#include "tests/fuzz/target.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool run_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path.c_str());
    return false;
  }
  std::ostringstream whole;
  whole << file.rdbuf();
  const std::string text = whole.str();
  std::printf("%s", path.c_str());
  std::fflush(stdout);
  const auto start = std::chrono::steady_clock::now();
  LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(text.data()), text.size());
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf(": %.3f s\n", time.count());
  return true;
}

} // namespace

int main(int argc, char** argv) {
  size_t count = 0;
  for (int i = 1; i < argc; ++i)
    for (const fs::path& file : files_of(argv[i])) {
      if (!run_file(file)) return 2;
      ++count;
    }
  if (count == 0) std::fprintf(stderr, "no inputs\n");
  return count == 0 ? 2 : 0;
}
