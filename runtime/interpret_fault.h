// Where a fault stands, from what stock Lua tells of it.
#pragma once

#include "compiler/base/fault.h"
#include "compiler/base/source.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace moonshade {

/// How one call of stock Lua ended.
struct InterpretFault {
  FaultCode code = FaultCode::None;
  std::string file;
  LineColumn place;
  std::string message; ///< of assert and error
};

/// The place of a fault in the shader's text, as well as it can be told: Lua knows lines only, and of integer divisions
/// the line of something before them.
LineColumn place_of_fault(std::string_view text, FaultCode code, uint32_t told_line);

/// "copper.lua:3:7: the top level faults: assert: message".
std::string describe_top_level_fault(const InterpretFault& fault);

} // namespace moonshade
