// The part of a batch call that is the same for every shader (batch.h says what it does), in a form that needs neither
// C++'s library nor LLVM: driver.cpp is compiled twice, to native code for compiled shaders in this process, and to
// bitcode that goes into the objects that C programs link (c_interface.h). Layouts here are known to both.
#pragma once

#include <cstddef>
#include <cstdint>

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

/// A kernel and what is known of it.
struct KernelView {
  Kernel kernel;
  uint32_t width, input_count, output_count;
  const Component *inputs, *outputs;
  const uint8_t* site_codes; ///< the FaultCode of each fault site
};

struct BatchFaults {
  uint64_t count = 0;
  uint64_t first_point = UINT64_MAX;
  uint32_t first_site = 0;
};

/// Shades a whole batch of any count. `fault_codes` is null or has `count` bytes.
extern "C" void moonshade_run_batch(const KernelView* kernel, const KernelBatch* batch, BatchFaults* faults,
                                    uint8_t* fault_codes);

/// What a kernel calls for a block with faults: for each lane the number of its fault's site plus 1, or 0.
/// `overflowed`: the block was given up because it took too many steps.
extern "C" void moonshade_block_faulted(const KernelBatch* batch, uint64_t first_point, const uint32_t* sites,
                                        uint32_t overflowed);

} // namespace moonshade::codegen
