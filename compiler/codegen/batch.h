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

#include <cstddef>
#include <cstdint>
#include <vector>

namespace moonshade::codegen {

/// What a kernel is given. Its layout is known to entry.cpp.
struct KernelBatch {
  uint64_t count;
  const void* const* inputs;
  void* const* outputs;
  const void* constants;
  void* context; ///< handed through to moonshade_block_faulted
};

using Kernel = void (*)(const KernelBatch*);
/// Fills an instance's constants; *fault is 0, or the fault's site plus 1.
using Init = void (*)(void* constants, uint32_t* fault);

/// Calls compiled code. (The sanitizer's check of a call's type reads what stands before a function: nothing, here.)
[[clang::no_sanitize("function")]] inline void call_kernel(Kernel kernel, const KernelBatch& batch) { kernel(&batch); }
[[clang::no_sanitize("function")]] inline void call_init(Init init, void* constants, uint32_t& fault) {
  init(constants, &fault);
}

/// One component of an input or an output.
struct Component {
  uint8_t size = 0;     ///< of an element in bytes: 1, 4 or 8
  bool uniform = false; ///< one value for the whole batch (inputs only)
};

/// What is known of a kernel besides its address.
struct KernelInfo {
  unsigned width = 1;
  std::vector<Component> inputs, outputs;
  std::vector<FaultCode> site_codes; ///< by fault site
};

struct BatchFaults {
  uint64_t count = 0;
  uint64_t first_point = UINT64_MAX;
  uint32_t first_site = 0;
};

/// Shades a whole batch of any count. `fault_codes` is null or has `count` bytes.
void run_batch(Kernel kernel, const KernelInfo& info, const KernelBatch& batch, BatchFaults& faults,
               uint8_t* fault_codes);

/// What a kernel calls for a block with faults: for each lane the number of its fault's site plus 1, or 0.
/// `overflowed`: the block was given up because it took too many steps.
extern "C" void moonshade_block_faulted(const KernelBatch* batch, uint64_t first_point, const uint32_t* sites,
                                        uint32_t overflowed);

} // namespace moonshade::codegen
