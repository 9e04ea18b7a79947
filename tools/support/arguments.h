// The command line by CLI11, with the exit status and messages that all programs share.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>

namespace moonshade::tools {

/// What is wrong with a call: thrown in a callback of the app, or while its values are converted there, it is worded as
/// the parser's own errors are.
class UsageError : public CLI::ParseError {
public:
  explicit UsageError(std::string message)
      : CLI::ParseError("UsageError", std::move(message), CLI::ExitCodes::ValidationError) {}
};

/// Parses; prints what --help and --version ask for, or the error of the call. A value is the status to exit with.
std::optional<int> parse_arguments(CLI::App& app, int argc, char** argv, const char* program);

} // namespace moonshade::tools
