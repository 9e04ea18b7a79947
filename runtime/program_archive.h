// A compiled program as bytes, for the object cache: its object code and everything that is known of it.
#pragma once

#include "compiler/codegen/codegen.h"
#include "runtime/compiled.h"

#include <optional>
#include <string>
#include <string_view>

namespace moonshade {

struct ArchivedProgram {
  ShaderInfo info;
  codegen::CodeInfo code;
  std::vector<ParameterSlot> slots;
  std::vector<FaultSite> sites;
  bool has_prints = false;
  std::string diagnostics; ///< warnings, as text
  std::string object;
};

std::string to_bytes(const ArchivedProgram& program);
/// Nothing where the bytes are none of to_bytes, or do not fit together.
std::optional<ArchivedProgram> archived_program(std::string_view bytes);

} // namespace moonshade
