// What compiled code calls for `print` (codegen.h, Options::prints).
#pragma once

#include <cstdint>

namespace moonshade::codegen {

/// Takes what one `print` gives: the sink that stands at CodeInfo::print_slot of the instance's constants, the number
/// of the place (CodeInfo::prints), and the values' components one after the other: a number as the bits of a double,
/// an integer, a boolean as 0 or 1. Written by the host; a null sink ignores it.
extern "C" void moonshade_print(void* sink, uint32_t place, const uint64_t* components);

} // namespace moonshade::codegen
