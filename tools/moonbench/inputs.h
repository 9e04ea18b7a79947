// The points of a benchmark: the same for every mode.
#pragma once

#include "tools/support/points.h"

namespace moonshade::moonbench {

/// Fills row after row with a grid over the unit square (u, v): p = P = (8u, 8v, 0.37), uv = (u, v), a unit normal and
/// viewing direction that vary with them, and constants for the rest. All are floats, so that both precisions see the
/// same points.
void fill_inputs(const EntryInfo& entry, tools::Points& points);

} // namespace moonshade::moonbench
