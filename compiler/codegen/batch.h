// How compiled code is called, in plain C terms, and the part of a batch call that is the same for every shader and so
// needs no compiling: tails, faulted points, points that must be shaded alone.
//
// A kernel shades `count` points, a multiple of its width W, block by block. What is left of a batch (the tail) is
// copied to W-sized buffers whose free lanes repeat the last point, so that they cannot do anything that it does not;
// hence the compiled code needs no mask for tails.
//
// Steps. A kernel counts the steps of a block, not of a lane: an upper bound for each lane. Where the bound passes the
// limit, it gives the block up, and each of its points is shaded again alone, in every lane of a block: there the count
// of the block is exactly that of the point. So the same points fault at every width.
#pragma once

#include "compiler/base/fault.h"
#include "compiler/codegen/driver.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace moonshade::codegen {

/// What is known of a kernel besides its address.
struct KernelInfo {
  unsigned width = 1;
  std::vector<Component> inputs, outputs;
  std::vector<FaultCode> site_codes; ///< by fault site
};

/// Shades a whole batch of any count. `fault_codes` is null or has `count` bytes.
void run_batch(Kernel kernel, const KernelInfo& info, const KernelBatch& batch, BatchFaults& faults,
               uint8_t* fault_codes);

} // namespace moonshade::codegen
