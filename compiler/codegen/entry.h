// The functions that a host calls: a kernel for each entry point (batch.h), and the init function of an instance.
#pragma once

#include "compiler/codegen/batch.h"
#include "compiler/codegen/emitter.h"

namespace moonshade::codegen {

/// Emits `void symbol(const KernelBatch*)`. `uniform_inputs`: by parameter of the entry's function.
KernelInfo emit_kernel(ModuleEmitter& owner, const ir::Entry& entry, const std::string& symbol,
                       const std::vector<bool>& uniform_inputs);

/// Emits `void symbol(void* constants, uint32_t* fault)`: runs the module's init function; *fault is 0 or the number of
/// the fault's place plus 1. The domain of `owner` must have one lane.
void emit_init(ModuleEmitter& owner, const std::string& symbol);

} // namespace moonshade::codegen
