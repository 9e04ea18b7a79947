// A seeded generator of well-typed shaders over the dialect: every program it writes should be accepted, and should
// mean the same in stock Lua and compiled. One statement a line, so that the reducer can work on lines.
#pragma once

#include <cstdint>
#include <string>

namespace moonshade::oracle {

/// The program of this seed. Its entry is `probe`; same seed, same text, on every machine.
std::string generate_program(uint64_t seed);

} // namespace moonshade::oracle
