// Drives kernels over batches of any count (driver.h). Uses nothing of C++'s library.
#include "compiler/codegen/driver.h"

#include "compiler/codegen/stack_place.h"

#include <stdlib.h>
#include <string.h>

namespace moonshade::codegen {

namespace {

constexpr unsigned kMaxWidth = 32;
constexpr size_t kColumn = kMaxWidth * sizeof(uint64_t);
/// Up to this many components, buffers lie on the stack.
constexpr uint32_t kColumnsOnStack = 64;

using Byte = unsigned char;

/// The state of one call of a kernel; KernelBatch::context leads to it.
struct Context {
  const KernelView* kernel;
  BatchFaults* faults;
  uint8_t* fault_codes; ///< of the call's first point, or null
  uint64_t base;        ///< index in the whole batch of the call's first point
  unsigned valid;       ///< how many lanes of a block are points (the others repeat one)
  bool alone;           ///< all lanes are one point
};

/// Buffers for one block, one column a component, and the arrays of pointers to them.
class Block {
public:
  explicit Block(const KernelView& kernel) {
    const uint32_t columns = kernel.input_count + kernel.output_count;
    if (columns > kColumnsOnStack) {
      bytes_ = static_cast<Byte*>(malloc(columns * (kColumn + sizeof(void*))));
      if (bytes_ == nullptr) abort();
    }
    auto* pointers = reinterpret_cast<Byte**>(bytes_ + columns * kColumn);
    for (uint32_t i = 0; i < columns; ++i)
      pointers[i] = bytes_ + i * kColumn;
    inputs = const_cast<const void**>(reinterpret_cast<void**>(pointers));
    outputs = reinterpret_cast<void**>(pointers + kernel.input_count);
  }
  ~Block() {
    if (bytes_ != own_) free(bytes_);
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  /// Fills the input columns with points [first, first + count) and repeats the last of them up to the width.
  void gather(const KernelView& kernel, const KernelBatch& batch, uint64_t first, unsigned count) {
    for (uint32_t i = 0; i < kernel.input_count; ++i) {
      const Component component = kernel.inputs[i];
      const size_t size = component.size;
      if (component.uniform) {
        inputs[i] = batch.inputs[i];
        continue;
      }
      Byte* column = bytes_ + i * kColumn;
      memcpy(column, static_cast<const Byte*>(batch.inputs[i]) + first * size, count * size);
      for (unsigned lane = count; lane < kernel.width; ++lane)
        memcpy(column + lane * size, column + (count - 1) * size, size);
    }
  }

  void scatter(const KernelView& kernel, const KernelBatch& batch, uint64_t first, unsigned count) const {
    for (uint32_t i = 0; i < kernel.output_count; ++i) {
      const size_t size = kernel.outputs[i].size;
      memcpy(static_cast<Byte*>(batch.outputs[i]) + first * size, outputs[i], count * size);
    }
  }

  const void** inputs;
  void** outputs;

private:
  alignas(uint64_t) Byte own_[kColumnsOnStack * (kColumn + sizeof(void*))];
  Byte* bytes_ = own_;
};

void run_block(Context context, const KernelBatch& batch, uint64_t first, unsigned count) {
  const KernelView& kernel = *context.kernel;
  Block block(kernel);
  block.gather(kernel, batch, first, count);
  context.base += first;
  context.valid = count;
  if (context.fault_codes != nullptr) context.fault_codes += first;
  const KernelBatch call{kernel.width, block.inputs, block.outputs, batch.constants, &context};
  call_kernel(kernel.kernel, call);
  block.scatter(kernel, batch, first, count);
}

void record(const Context& context, const KernelBatch& batch, uint64_t point, uint32_t site) {
  const KernelView& kernel = *context.kernel;
  for (uint32_t i = 0; i < kernel.output_count; ++i) {
    const size_t size = kernel.outputs[i].size;
    memset(static_cast<Byte*>(batch.outputs[i]) + point * size, 0, size);
  }
  if (context.fault_codes != nullptr) context.fault_codes[point] = kernel.site_codes[site];
  ++context.faults->count;
  if (context.base + point < context.faults->first_point) {
    context.faults->first_point = context.base + point;
    context.faults->first_site = site;
  }
}

} // namespace

extern "C" void moonshade_block_faulted(const KernelBatch* batch, uint64_t first_point, const uint32_t* sites,
                                        uint32_t overflowed) {
  const Context& context = *static_cast<const Context*>(batch->context);
  const bool again = overflowed != 0 && !context.alone && context.kernel->width > 1;
  for (unsigned lane = 0; lane < context.valid; ++lane) {
    if (again) {
      Context alone = context;
      alone.alone = true;
      run_block(alone, *batch, first_point + lane, 1);
    } else if (sites[lane] != 0) {
      record(context, *batch, first_point + lane, sites[lane] - 1);
    }
  }
}

extern "C" void moonshade_run_batch(const KernelView* kernel, const KernelBatch* batch, BatchFaults* faults,
                                    uint8_t* fault_codes) {
  if (fault_codes != nullptr && batch->count != 0) memset(fault_codes, 0, batch->count);
  Context context{kernel, faults, fault_codes, 0, kernel->width, false};
  const uint64_t whole = batch->count - batch->count % kernel->width;
  if (whole != 0) {
    KernelBatch call = *batch;
    call.count = whole;
    call.context = &context;
    // Away from the constants, which stand at the beginning of a page.
    call_with_stack_at(0, [&] { call_kernel(kernel->kernel, call); });
  }
  if (whole != batch->count) run_block(context, *batch, whole, static_cast<unsigned>(batch->count - whole));
}

} // namespace moonshade::codegen
