// Files read and written whole.
#pragma once

#include "compiler/base/read_file.h"
#include "runtime/shader.h"

#include <string>
#include <vector>

namespace moonshade::tools {

/// First of all: where a program is started with standard input, output or error closed, the next file that it opens
/// would take the number, and messages would go into an image.
void keep_standard_files_apart();

using moonshade::FileText;
/// moonshade::read_file's, but "-" is standard input.
FileText read_file(const std::string& path, uint64_t limit = uint64_t{64} << 20);

/// Writes to a temporary file beside `path` and renames it: the file is there whole or not at all. "-" is standard
/// output. Gives the error, or an empty text.
std::string write_file(const std::string& path, const std::string& bytes);

/// The status to exit with when all is printed: whether it has reached standard output. Says so if not.
int finish_output(const char* program);

/// Where a shader's modules are looked for: in its own folder, then in these.
ModuleReader modules_of(const std::string& shader, const std::vector<std::string>& folders = {});

} // namespace moonshade::tools
