// The hand-written workloads as functions over arrays, by the workload's name; null where there is none.
#pragma once

#include <cstddef>

namespace hand {

/// x, y, z of the points; one array a component of the result. The count is a multiple of 32.
using Kernel = void (*)(const float* const* in, float* const* out, size_t count);

Kernel scalar_kernel(const char* workload);
Kernel avx2_kernel(const char* workload); ///< 8 lanes, AVX2 and FMA alone
Kernel kernel_16(const char* workload);   ///< this machine's
Kernel kernel_32(const char* workload);

} // namespace hand
