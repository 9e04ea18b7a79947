// The hand-written workloads on 32 lanes, two registers a value, for this machine.
#include "tests/bench/hand/workloads.h"

hand::Kernel hand::kernel_32(const char* workload) { return kernel_of<32>(workload); }
