// The hand-written workloads on one lane.
#include "tests/bench/hand/workloads.h"

hand::Kernel hand::scalar_kernel(const char* workload) { return kernel_of<1>(workload); }
