// The driver (driver.h) for kernels that are described by vectors.
#include "compiler/codegen/batch.h"

namespace moonshade::codegen {

void run_batch(Kernel kernel, const KernelInfo& info, const KernelBatch& batch, BatchFaults& faults,
               uint8_t* fault_codes) {
  const KernelView view{kernel,
                        info.width,
                        static_cast<uint32_t>(info.inputs.size()),
                        static_cast<uint32_t>(info.outputs.size()),
                        info.inputs.data(),
                        info.outputs.data(),
                        reinterpret_cast<const uint8_t*>(info.site_codes.data())};
  moonshade_run_batch(&view, &batch, &faults, fault_codes);
}

} // namespace moonshade::codegen
