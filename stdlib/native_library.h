// The library's exports as machine code of this program, made by the build from the same bitcode that compiled shaders
// link, so of the same bits.
#pragma once

#include "stdlib/library.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace moonshade {

/// An export as machine code of this program. Its layout is known to split_exports.cpp.
struct NativeExport {
  const char* name; ///< as in the bitcode
  const void* address;
  uint32_t instructions; ///< in the bitcode
  /// 0 or 1: it gathers from memory here, where bitcode on a processor with tables in registers looks up there.
  uint32_t asks_for_tables;
};
/// The machine code of a domain's exports, and the processor that it takes ("x86-64-v4", a name of LLVM's; empty: any
/// of this architecture): what is slow to compile with a shader and loses little by a call, shaders may call here.
struct NativeExports {
  std::string_view processor;
  std::span<const NativeExport> exports; ///< sorted by name

  const NativeExport* find(std::string_view name) const;
};
/// Of the row's exports or, with `derivatives`, of the derivatives'; without exports where the build made none.
NativeExports native_exports(Precision precision, unsigned width, bool derivatives);

/// Of the row's exports or the derivatives', those that are too small to be called as machine code, as bitcode: a part
/// of the above that takes little time to read. Empty for domains without machine code.
std::span<const char> small_bitcode(Precision precision, unsigned width, bool derivatives);

} // namespace moonshade
