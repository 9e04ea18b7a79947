// Precisions in the messages and names of tests.
#pragma once

#include "stdlib/library.h"

#include <ostream>

namespace moonshade {

inline void PrintTo(Precision precision, std::ostream* out) { *out << name_of(precision); }

} // namespace moonshade
