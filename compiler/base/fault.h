// What can make a point fault. The names are part of the command line's contract ("fault: index").
#pragma once

#include <cstdint>

namespace moonshade {

enum class FaultCode : uint8_t { None, Index, DivideByZero, Assert, Error, ForStepZero, StepLimit, IntegerRange };

constexpr const char* fault_name(FaultCode code) {
  switch (code) {
  case FaultCode::None:
    return "none";
  case FaultCode::Index:
    return "index";
  case FaultCode::DivideByZero:
    return "division";
  case FaultCode::Assert:
    return "assert";
  case FaultCode::Error:
    return "error";
  case FaultCode::ForStepZero:
    return "for-step";
  case FaultCode::StepLimit:
    return "step-limit";
  case FaultCode::IntegerRange:
    return "integer-range";
  }
  return "?";
}

} // namespace moonshade
