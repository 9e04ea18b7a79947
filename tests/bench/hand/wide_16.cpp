// The hand-written workloads on sixteen lanes, for this machine. Without byte permutations there is no Perlin noise.
#include "tests/bench/hand/workloads.h"

hand::Kernel hand::kernel_16(const char* workload) { return kernel_of<16>(workload); }
