// The command line by CLI11, with the exit status and messages that all programs share.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>

namespace moonshade::tools {

/// Parses; prints what --help and --version ask for, or the error of the call. A value is the status to exit with.
std::optional<int> parse_arguments(CLI::App& app, int argc, char** argv, const char* program);

} // namespace moonshade::tools
