// What an object for C programs (c_interface.h) brings along besides the shader's code: c_support.cpp, compiled to
// bitcode with the driver and the C library's functions under names of ours. Layouts here are known to
// c_interface_code.cpp, which makes the tables.
#pragma once

#include "compiler/codegen/driver.h"

#include <span>

namespace moonshade::codegen {

/// How a parameter's components go from the C struct to the instance's constants.
enum CKind : uint32_t { kCBoolean, kCInteger, kCFloat, kCDouble, kCString };

/// Of a string parameter: the constants that the shader compares it with, by whose index the code knows its value, and
/// its choices (none: any text).
struct CStrings {
  const char* const* compared;
  uint64_t compared_count;
  const char* const* choices;
  uint64_t choice_count;
  const char* default_value; ///< where the C struct has NULL
};

struct CParameterRow {
  uint32_t source; ///< offset in the struct of parameters
  uint32_t target; ///< offset in the constants, or kCNoTarget where nothing reads it
  uint32_t count;  ///< components
  uint32_t kind;
  double min, max;
  const char* error;       ///< where a component is outside min..max, or a string no choice; null: any value is right
  const CStrings* strings; ///< of a string parameter
};
inline constexpr uint32_t kCNoTarget = UINT32_MAX;

/// A shader's table.
struct CShader {
  const CParameterRow* parameters;
  uint64_t parameter_count;
  const void* defaults; ///< a struct of parameters
  Init init;            ///< null: nothing to run
  const char* const* site_errors;
};

/// Both are called by the functions that a C program calls: they set the floating-point environment first.
extern "C" const char* moonshade_c_instantiate(const CShader* shader, void* constants, const void* parameters);
/// `batch` begins with the count, the pointers to inputs, those to outputs, to the record of faults and to the codes.
extern "C" void moonshade_c_run(const KernelView* kernel, const void* constants, const uint64_t* batch);

/// The bitcode of all this. Static storage.
std::span<const char> c_support_bitcode();

} // namespace moonshade::codegen
