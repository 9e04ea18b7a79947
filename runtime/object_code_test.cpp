// Object code: the same bytes each time, whatever was compiled before, on whatever thread.
#include "runtime/frontend_parts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace moonshade {
namespace {

std::string object_code(const std::filesystem::path& file, const CompileOptions& options) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  const CheckedShader checked(file.filename().string(), text.str(), {});
  if (!checked.ok()) return {};
  codegen::Generated generated = codegen::generate(build_module(checked, options), codegen_options(options));
  return generated.error.empty() ? generated.object() : std::string();
}

std::vector<std::filesystem::path> gallery() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(MOONSHADE_SHADERS))
    if (entry.path().extension() == ".lua" && entry.path().stem().extension() != ".scene")
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST(ObjectCode, IsTheSameBytesEachTime) {
  size_t compiled = 0;
  for (const unsigned width : {0U, 8U})
    for (const auto& file : gallery()) {
      CompileOptions options;
      options.width = width;
      const std::string first = object_code(file, options);
      if (first.empty()) continue;
      ++compiled;
      std::string second;
      CompileOptions quick;
      quick.optimization = 0;
      std::thread([&] {
        object_code(file, quick);
        second = object_code(file, options);
      }).join();
      EXPECT_TRUE(first == second) << file << " on " << width << " lanes";
    }
  EXPECT_GT(compiled, 20U);
}

} // namespace
} // namespace moonshade
