// Cells of a grid over a box: their order in memory, x changing fastest.
#pragma once

#include "renderer/math.h"

namespace moonshade::renderer {

inline size_t cell_index(const int* at, const int* size) {
  return (size_t(at[2]) * size_t(size[1]) + size_t(at[1])) * size_t(size[0]) + size_t(at[0]);
}
inline size_t cell_count(const int* size) { return size_t(size[0]) * size_t(size[1]) * size_t(size[2]); }

/// The cell's corner nearest to the box's low one, in cells.
inline Vec3 cell_corner(size_t index, const int* size) {
  size_t row = index / size_t(size[0]), layer = row / size_t(size[1]);
  return {float(index % size_t(size[0])), float(row % size_t(size[1])), float(layer)};
}

} // namespace moonshade::renderer
