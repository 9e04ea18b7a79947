// A reader of comma-separated values that streams: memory is bounded by the longest line, not by the file.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::tools {

/// Takes LF and CRLF, a byte order mark, blank lines (skipped), blanks around fields and quoted fields ("" is a quote).
class CsvReader {
public:
  /// "-" is standard input. `error()` tells why it cannot be read.
  explicit CsvReader(const std::string& path);

  /// The next line that is not blank, split; false at the end of the file or on an error.
  bool next();
  const std::vector<std::string>& fields() const { return fields_; }
  /// The line of the current fields, from 1.
  size_t line() const { return line_; }
  const std::string& error() const { return error_; }

private:
  bool read_line();
  void split();

  struct Close {
    void operator()(FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<FILE, Close> file_;
  std::string text_;
  std::vector<std::string> fields_;
  size_t line_ = 0;
  std::string error_;
};

} // namespace moonshade::tools
