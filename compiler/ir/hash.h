// Hashes of what passes look up, part by part.
#pragma once

#include <cstddef>
#include <cstdint>

namespace moonshade::ir {

/// The hash of all parts so far, and one more.
inline size_t hash_with(size_t hash, uint64_t part) { return (hash ^ part) * 0x9e3779b97f4a7c15u + (hash >> 29); }

} // namespace moonshade::ir
