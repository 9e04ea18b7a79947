// Reads the directives: comment lines of the form "-- word: rest".
#include "tests/lang/directives.h"

#include <sstream>

namespace moonshade::lang_test {

namespace {

/// The rest of a line behind "-- word:", if it begins so.
bool take(const std::string& line, const std::string& word, std::string& rest) {
  const std::string prefix = "-- " + word;
  if (!line.starts_with(prefix)) return false;
  rest = line.substr(prefix.size());
  const size_t begin = rest.find_first_not_of(' ');
  rest = begin == std::string::npos ? "" : rest.substr(begin);
  while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\r'))
    rest.pop_back();
  return true;
}

bool split(const std::string& word, std::vector<std::pair<std::string, std::string>>& out) {
  const size_t equals = word.find('=');
  if (equals == std::string::npos) return false;
  out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  return true;
}

bool read_run(const std::string& text, Run& run) {
  std::istringstream words(text);
  if (!(words >> run.entry)) return false;
  for (std::string word; words >> word;) {
    const bool is_parameter = word == "-D" && words >> word;
    if (!split(word, is_parameter ? run.parameters : run.inputs)) return false;
  }
  return true;
}

} // namespace

Directives read_directives(const std::string& text) {
  Directives directives;
  std::istringstream lines(text);
  std::string line, rest;
  const auto fail = [&](unsigned number) {
    if (directives.problem.empty()) directives.problem = "line " + std::to_string(number) + ": " + line;
  };
  for (unsigned number = 1; std::getline(lines, line); ++number) {
    if (take(line, "run:", rest)) {
      directives.runs.emplace_back();
      directives.runs.back().line = number;
      if (!read_run(rest, directives.runs.back())) fail(number);
    } else if (take(line, "expect:", rest)) {
      if (directives.runs.empty() || !directives.runs.back().expected.empty())
        fail(number);
      else
        directives.runs.back().expected.push_back(rest);
    } else if (const bool is_error = take(line, "error:", rest); is_error || take(line, "warning:", rest)) {
      std::istringstream words(rest);
      ExpectedError error;
      if (!(words >> error.place >> error.code)) fail(number);
      (is_error ? directives.errors : directives.warnings).push_back(error);
    } else if (line == "-- no warnings") {
      directives.no_warnings = true;
    } else if (take(line, "steps:", rest)) {
      directives.step_limit = std::stoull(rest);
    } else if (take(line, "near:", rest)) {
      directives.near = std::stod(rest);
    } else if (line == "-- mild") {
      directives.mild = true;
    }
  }
  for (const Run& run : directives.runs)
    if (run.expected.empty() && directives.problem.empty())
      directives.problem = "line " + std::to_string(run.line) + ": a run without 'expect'";
  return directives;
}

} // namespace moonshade::lang_test
