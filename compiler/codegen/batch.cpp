// Drives kernels over batches of any count (batch.h).
#include "compiler/codegen/batch.h"

#include <cstring>
#include <memory>
#include <utility>

namespace moonshade::codegen {

namespace {

constexpr unsigned kMaxWidth = 32;
constexpr size_t kColumn = kMaxWidth * sizeof(uint64_t);

/// The state of one call of a kernel; KernelBatch::context leads to it.
struct Context {
  Kernel kernel;
  const KernelInfo* info;
  BatchFaults* faults;
  uint8_t* fault_codes; ///< of the call's first point, or null
  uint64_t base;        ///< index in the whole batch of the call's first point
  unsigned valid;       ///< how many lanes of a block are points (the others repeat one)
  bool alone;           ///< all lanes are one point
};

/// Buffers for one block, one column a component.
struct Block {
  explicit Block(const KernelInfo& info)
      : bytes(new std::byte[(info.inputs.size() + info.outputs.size()) * kColumn]), inputs(info.inputs.size()),
        outputs(info.outputs.size()) {
    std::byte* column = bytes.get();
    for (const void*& input : inputs)
      input = std::exchange(column, column + kColumn);
    for (void*& output : outputs)
      output = std::exchange(column, column + kColumn);
  }

  /// Fills the input columns with points [first, first + count) and repeats the last of them up to the width.
  void gather(const KernelInfo& info, const KernelBatch& batch, uint64_t first, unsigned count) {
    for (size_t i = 0; i < inputs.size(); ++i) {
      const auto [size, uniform] = info.inputs[i];
      if (uniform) {
        inputs[i] = batch.inputs[i];
        continue;
      }
      auto* column = bytes.get() + i * kColumn;
      std::memcpy(column, static_cast<const std::byte*>(batch.inputs[i]) + first * size, size_t{count} * size);
      for (unsigned lane = count; lane < info.width; ++lane)
        std::memcpy(column + size_t{lane} * size, column + size_t{count - 1} * size, size);
    }
  }

  void scatter(const KernelInfo& info, const KernelBatch& batch, uint64_t first, unsigned count) const {
    for (size_t i = 0; i < outputs.size(); ++i) {
      const size_t size = info.outputs[i].size;
      std::memcpy(static_cast<std::byte*>(batch.outputs[i]) + first * size, outputs[i], count * size);
    }
  }

  std::unique_ptr<std::byte[]> bytes;
  std::vector<const void*> inputs;
  std::vector<void*> outputs;
};

void run_block(Context context, const KernelBatch& batch, uint64_t first, unsigned count) {
  Block block(*context.info);
  block.gather(*context.info, batch, first, count);
  context.base += first;
  context.valid = count;
  if (context.fault_codes != nullptr) context.fault_codes += first;
  const KernelBatch call{context.info->width, block.inputs.data(), block.outputs.data(), batch.constants, &context};
  call_kernel(context.kernel, call);
  block.scatter(*context.info, batch, first, count);
}

void record(const Context& context, const KernelBatch& batch, uint64_t point, uint32_t site) {
  for (size_t i = 0; i < context.info->outputs.size(); ++i) {
    const size_t size = context.info->outputs[i].size;
    std::memset(static_cast<std::byte*>(batch.outputs[i]) + point * size, 0, size);
  }
  if (context.fault_codes != nullptr) context.fault_codes[point] = static_cast<uint8_t>(context.info->site_codes[site]);
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
  const bool again = overflowed != 0 && !context.alone && context.info->width > 1;
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

void run_batch(Kernel kernel, const KernelInfo& info, const KernelBatch& batch, BatchFaults& faults,
               uint8_t* fault_codes) {
  if (fault_codes != nullptr) std::memset(fault_codes, 0, batch.count);
  Context context{kernel, &info, &faults, fault_codes, 0, info.width, false};
  const uint64_t whole = batch.count - batch.count % info.width;
  if (whole != 0) {
    KernelBatch call = batch;
    call.count = whole;
    call.context = &context;
    call_kernel(kernel, call);
  }
  if (whole != batch.count) run_block(context, batch, whole, static_cast<unsigned>(batch.count - whole));
}

} // namespace moonshade::codegen
