// A reader of comma-separated values that streams.
#include "tools/support/csv.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace moonshade::tools {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

} // namespace

CsvReader::CsvReader(const std::string& path) {
  file_.reset(path == "-" ? fdopen(dup(STDIN_FILENO), "rb") : std::fopen(path.c_str(), "rb"));
  if (!file_) error_ = std::strerror(errno);
}

bool CsvReader::read_line() {
  if (!file_) return false;
  char* buffer = nullptr;
  size_t capacity = 0;
  const ssize_t length = getline(&buffer, &capacity, file_.get());
  if (length >= 0) text_.assign(buffer, size_t(length));
  std::free(buffer);
  if (length < 0) {
    if (std::ferror(file_.get())) error_ = std::strerror(errno);
    return false;
  }
  ++line_;
  if (line_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  while (!text_.empty() && (text_.back() == '\n' || text_.back() == '\r'))
    text_.pop_back();
  return true;
}

bool CsvReader::next() {
  while (read_line()) {
    if (text_.find_first_not_of(" \t") == std::string::npos) continue;
    split();
    return true;
  }
  return false;
}

void CsvReader::split() {
  fields_.clear();
  size_t at = 0;
  for (;;) {
    std::string field;
    while (at < text_.size() && is_blank(text_[at]))
      ++at;
    if (at < text_.size() && text_[at] == '"') {
      for (++at; at < text_.size(); ++at) {
        if (text_[at] != '"')
          field += text_[at];
        else if (at + 1 < text_.size() && text_[at + 1] == '"')
          field += text_[++at];
        else
          break;
      }
      if (at < text_.size()) ++at; // the closing quote
    }
    while (at < text_.size() && text_[at] != ',')
      field += text_[at++];
    while (!field.empty() && is_blank(field.back()))
      field.pop_back();
    fields_.push_back(std::move(field));
    if (at == text_.size()) return;
    ++at; // the comma
  }
}

} // namespace moonshade::tools
