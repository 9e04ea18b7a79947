// The hand-written workloads on eight lanes, with AVX2 and FMA alone (the flags are set in CMakeLists.txt).
#include "tests/bench/hand/workloads.h"

hand::Kernel hand::avx2_kernel(const char* workload) { return kernel_of<8>(workload); }
