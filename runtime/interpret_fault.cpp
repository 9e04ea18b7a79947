// Where a fault stands, from what stock Lua tells of it: a line, and the kind of the fault, by which the line is
// searched.
#include "runtime/interpret_fault.h"

#include <algorithm>
#include <array>

namespace moonshade {

namespace {

constexpr size_t kNone = std::string_view::npos;

/// What an expression or statement that can fault so looks like.
std::array<std::string_view, 3> spellings(FaultCode code) {
  switch (code) {
  case FaultCode::DivideByZero:
    return {"//", "%", "fmod"};
  case FaultCode::Assert:
    return {"assert", "assert", "assert"};
  case FaultCode::Error:
    return {"error", "error", "error"};
  case FaultCode::ForStepZero:
    return {"for ", "for ", "for "};
  case FaultCode::Index:
    return {"[", "[", "["};
  case FaultCode::IntegerRange:
    return {"floor", "ceil", "tointeger"};
  default:
    return {"", "", ""};
  }
}

/// The first of the spellings in the line, comments aside.
size_t find_spelling(std::string_view line, FaultCode code) {
  line = line.substr(0, line.find("--"));
  size_t first = kNone;
  for (std::string_view spelling : spellings(code))
    if (!spelling.empty()) first = std::min(first, line.find(spelling));
  return first;
}

} // namespace

LineColumn place_of_fault(std::string_view text, FaultCode code, uint32_t told_line) {
  LineColumn fallback{std::max(told_line, 1u), 1};
  uint32_t number = 1;
  for (size_t begin = 0; begin < text.size(); ++number) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (number < told_line) continue;
    if (number == told_line)
      if (const size_t first = line.find_first_not_of(" \t"); first != kNone) fallback.column = uint32_t(first + 1);
    if (const size_t at = find_spelling(line, code); at != kNone) return {number, uint32_t(at + 1)};
    // Lua 5.4.4 does not save where it is before // and % of integers, and tells the line of something that ran
    // earlier: the division is the next one in the text. Other lines are right.
    if (code != FaultCode::DivideByZero) break;
  }
  return fallback;
}

std::string describe_top_level_fault(const InterpretFault& fault) {
  std::string text = fault.file + ":" + std::to_string(fault.place.line) + ":" + std::to_string(fault.place.column) +
                     ": the top level faults: " + fault_name(fault.code);
  if (!fault.message.empty()) text += ": " + fault.message;
  return text;
}

} // namespace moonshade
