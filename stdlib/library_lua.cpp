// The text of sums.lua, as data.
#include "stdlib/sums.h"

#pragma clang diagnostic ignored "-Wc23-extensions"

namespace moonshade {
namespace {

constexpr char text[] = {
#embed "sums.lua"
};

} // namespace

std::string_view library_lua() { return {text, sizeof text}; }

} // namespace moonshade
