// Runs one program in stock Lua and compiled, over a few hundred points, and says where they disagree.
#pragma once

#include "runtime/shader.h"

#include <cstdint>
#include <string>
#include <vector>

namespace moonshade::oracle {

/// One way to compile: a precision, a width and an optimisation level.
struct Variant {
  Precision precision;
  unsigned width;
  int optimization;
};
std::string name_of(const Variant& variant); ///< "f64 w16 O2"

/// Every precision, width and level (0 and 2).
std::vector<Variant> all_variants();

enum class Verdict : uint8_t {
  Agrees,  ///< in every variant
  Refused, ///< the compiler refused the program: the generator's fault or sema's
  Differs, ///< a result or fault is another one than the reference's
  Broken,  ///< the oracle or the compiler failed in a way that no program should cause
  Crashed, ///< the process died
};

struct Outcome {
  Verdict verdict = Verdict::Agrees;
  std::string detail;               ///< which variant, point and values; the diagnostics of a refusal
  uint64_t points = 0, faulted = 0; ///< that the reference ran, and those of them that faulted
};

/// f64 variants must give stock Lua's bits; f32 variants those of one lane at -O0 (which is compiled as well). All NaNs
/// count as equal. A point that faults must fault in both with the same code (stock Lua's tables, conversions and steps
/// are checked as the compiler's: runtime/interpret.h). `point_seed` draws the points.
Outcome compare(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed);

/// The verdict of `compare` in a process of its own: Crashed where that dies.
Verdict verdict_in_child(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed);

/// The shortest program found by leaving out lines and blocks whose outcome still has this verdict.
std::string reduce(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed, Verdict verdict);

} // namespace moonshade::oracle
