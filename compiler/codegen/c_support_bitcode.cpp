// The bitcode of c_support.cpp as data. The build makes the file (CMakeLists.txt).
#include "compiler/codegen/c_support.h"

#pragma clang diagnostic ignored "-Wc23-extensions"

namespace moonshade::codegen {

namespace {
alignas(8) constexpr char kBitcode[] = {
#embed "c_support.bc"
};
} // namespace

std::span<const char> c_support_bitcode() { return kBitcode; }

} // namespace moonshade::codegen
