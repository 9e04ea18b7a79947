// Kernels: the loop over blocks of W points, inputs and outputs, and what becomes of faults.
#include "compiler/codegen/entry.h"

#include <llvm/IR/MDBuilder.h>

namespace moonshade::codegen {

namespace {

/// Emission of one kernel. The parts of its function, in order:
///   start:  pointers and uniform inputs are loaded
///   block:  one block of points: inputs are loaded, the entry's function is emitted in place, outputs are stored
///   report: calls moonshade_block_faulted where a lane has faulted
///   next:   to the next block
class KernelEmitter {
public:
  KernelEmitter(ModuleEmitter& owner, const ir::Entry& entry, llvm::Function* function,
                const std::vector<bool>& uniform_inputs)
      : owner_(owner), domain_(owner.domain), entry_(entry), code_(owner.module.functions[entry.function]),
        faults_(owner.fault_facts[entry.function].faults || owner.fault_facts[entry.function].steps),
        function_(function), uniform_(uniform_inputs), emitter_(owner, function, nullptr, nullptr, FaultState{}),
        builder_(emitter_.builder) {
    uniform_.resize(code_.parameters.size());
  }

  KernelInfo emit() {
    KernelInfo info;
    info.width = domain_.width;
    describe(code_.parameters, info.inputs, true);
    describe(code_.results, info.outputs, false);
    start(info);
    llvm::BasicBlock* origin = builder_.GetInsertBlock();
    llvm::BasicBlock* block = new_block("block");
    llvm::BasicBlock* next = new_block("next");
    llvm::BasicBlock* done = new_block("done");
    builder_.CreateBr(block);
    builder_.SetInsertPoint(block);
    llvm::Type* i64 = builder_.getInt64Ty();
    llvm::PHINode* point = builder_.CreatePHI(i64, 2, "point");
    point->addIncoming(builder_.getInt64(0), origin);
    shade(info, point, next);
    builder_.SetInsertPoint(next);
    llvm::Value* following = builder_.CreateAdd(point, builder_.getInt64(domain_.width));
    point->addIncoming(following, next);
    builder_.CreateCondBr(builder_.CreateICmpULT(following, count_), block, done);
    builder_.SetInsertPoint(done);
    builder_.CreateRetVoid();
    emitter_.finish();
    return info;
  }

private:
  llvm::BasicBlock* new_block(const char* name) { return llvm::BasicBlock::Create(domain_.context, name, function_); }

  void describe(const std::vector<ValueType>& types, std::vector<Component>& components, bool inputs) const {
    for (size_t i = 0; i < types.size(); ++i) {
      const Component component{static_cast<uint8_t>(domain_.memory_size(types[i])), inputs && uniform_[i]};
      components.insert(components.end(), component_count(types[i]), component);
    }
  }

  /// Field `index` of KernelBatch, all of which are 8 bytes on the machines that we know.
  llvm::Value* field(unsigned index, llvm::Type* type) {
    return builder_.CreateLoad(type, builder_.CreateConstInBoundsGEP1_64(builder_.getInt64Ty(), batch_, index));
  }

  void start(const KernelInfo& info) {
    batch_ = function_->getArg(0);
    llvm::Type* pointer = builder_.getPtrTy();
    count_ = field(0, builder_.getInt64Ty());
    load_pointers(field(1, pointer), info.inputs.size(), inputs_);
    load_pointers(field(2, pointer), info.outputs.size(), outputs_);
    FaultState state;
    if (faults_) {
      state.sites = emitter_.masks.allocate(domain_.lanes(builder_.getInt32Ty()), "sites");
      state.steps = emitter_.masks.allocate(builder_.getInt64Ty(), "steps");
      state.flag = emitter_.masks.allocate(builder_.getInt8Ty(), "flag");
    }
    emitter_.set_environment(field(3, pointer), state);
    state_ = state;
    load_uniform_inputs();
  }

  void load_pointers(llvm::Value* array, size_t count, std::vector<llvm::Value*>& pointers) {
    for (size_t i = 0; i < count; ++i)
      pointers.push_back(
          builder_.CreateLoad(builder_.getPtrTy(), builder_.CreateConstInBoundsGEP1_64(builder_.getPtrTy(), array, i)));
  }

  void load_uniform_inputs() {
    size_t pointer = 0;
    arguments_.resize(code_.parameters.size());
    for (size_t i = 0; i < arguments_.size(); ++i) {
      const ValueType type = code_.parameters[i];
      const unsigned components = component_count(type);
      if (uniform_[i])
        for (unsigned c = 0; c < components; ++c)
          arguments_[i].parts.push_back(
              from_memory(builder_, type, builder_.CreateLoad(domain_.memory(type), inputs_[pointer + c])));
      pointer += components;
    }
  }

  void load_varying_inputs(llvm::Value* point) {
    size_t pointer = 0;
    for (size_t i = 0; i < arguments_.size(); ++i) {
      const ValueType type = code_.parameters[i];
      const unsigned components = component_count(type);
      if (!uniform_[i])
        for (unsigned c = 0; c < components; ++c) {
          llvm::Value* address = builder_.CreateInBoundsGEP(domain_.memory(type), inputs_[pointer + c], point);
          const llvm::Align align(domain_.memory_size(type));
          arguments_[i].parts.push_back(
              from_memory(builder_, type, builder_.CreateAlignedLoad(domain_.memory_part(type, true), address, align)));
        }
      pointer += components;
    }
  }

  void store_outputs(llvm::Value* point, const std::vector<Lanes>& results) {
    size_t pointer = 0;
    for (size_t i = 0; i < results.size(); ++i) {
      const ValueType type = code_.results[i];
      for (llvm::Value* part : results[i].parts) {
        llvm::Value* address = builder_.CreateInBoundsGEP(domain_.memory(type), outputs_[pointer++], point);
        llvm::Value* bytes = to_memory(builder_, domain_, type, broadcast(builder_, domain_, part));
        builder_.CreateAlignedStore(bytes, address, llvm::Align(domain_.memory_size(type)));
      }
    }
  }

  void shade(const KernelInfo&, llvm::Value* point, llvm::BasicBlock* next) {
    if (faults_) {
      llvm::Type* sites = domain_.lanes(builder_.getInt32Ty());
      builder_.CreateStore(llvm::Constant::getNullValue(sites), state_.sites);
      builder_.CreateStore(builder_.getInt64(0), state_.steps);
      builder_.CreateStore(builder_.getInt8(kRunning), state_.flag);
    }
    load_varying_inputs(point);
    std::vector<bool> uniform = uniform_;
    if (domain_.width == 1) uniform.assign(uniform.size(), true);
    const ir::Signature signature = ir::entry_signature(code_, uniform);
    const std::vector<Lanes> results = emitter_.call_in_place(entry_.function, signature, arguments_, {});
    if (emitter_.masks.alive()) store_outputs(point, results);
    if (emitter_.masks.open()) {
      if (faults_)
        check_faults(point, next);
      else
        builder_.CreateBr(next);
    }
    if (!faults_) return;
    if (emitter_.has_overflow()) emitter_.abort_block();
    if (!emitter_.can_abort()) return;
    builder_.SetInsertPoint(emitter_.abort_block());
    report(point, next);
  }

  void check_faults(llvm::Value* point, llvm::BasicBlock* next) {
    llvm::Type* type = domain_.lanes(builder_.getInt32Ty());
    llvm::Value* sites = builder_.CreateLoad(type, state_.sites);
    llvm::Value* any = any_lane(builder_, builder_.CreateICmpNE(sites, llvm::Constant::getNullValue(type)));
    llvm::MDNode* unlikely = llvm::MDBuilder(domain_.context).createBranchWeights(1, 1 << 20);
    llvm::BasicBlock* reporting = new_block("report");
    builder_.CreateCondBr(any, reporting, next, unlikely);
    builder_.SetInsertPoint(reporting);
    report(point, next);
  }

  void report(llvm::Value* point, llvm::BasicBlock* next) {
    llvm::Type* pointer = builder_.getPtrTy();
    auto* type = llvm::FunctionType::get(builder_.getVoidTy(),
                                         {pointer, builder_.getInt64Ty(), pointer, builder_.getInt32Ty()}, false);
    const llvm::FunctionCallee handler = owner_.llvm_module.getOrInsertFunction("moonshade_block_faulted", type);
    llvm::Value* flag = builder_.CreateLoad(builder_.getInt8Ty(), state_.flag);
    llvm::Value* overflowed =
        builder_.CreateZExt(builder_.CreateICmpEQ(flag, builder_.getInt8(kOverflowed)), builder_.getInt32Ty());
    builder_.CreateCall(handler, {batch_, point, state_.sites, overflowed});
    builder_.CreateBr(next);
  }

  ModuleEmitter& owner_;
  const Domain& domain_;
  const ir::Entry& entry_;
  const ir::Function& code_;
  const bool faults_;
  llvm::Function* function_;
  std::vector<bool> uniform_;
  FunctionEmitter emitter_;
  Builder& builder_;
  FaultState state_;
  llvm::Value* batch_ = nullptr;
  llvm::Value* count_ = nullptr;
  std::vector<llvm::Value*> inputs_, outputs_;
  std::vector<Lanes> arguments_;
};

} // namespace

KernelInfo emit_kernel(ModuleEmitter& owner, const ir::Entry& entry, const std::string& symbol,
                       const std::vector<bool>& uniform_inputs) {
  llvm::LLVMContext& context = owner.domain.context;
  auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context), {llvm::PointerType::get(context, 0)}, false);
  return KernelEmitter(owner, entry, owner.new_function(type, symbol, false), uniform_inputs).emit();
}

void emit_init(ModuleEmitter& owner, const std::string& symbol) {
  llvm::LLVMContext& context = owner.domain.context;
  llvm::Type* pointer = llvm::PointerType::get(context, 0);
  auto* type = llvm::FunctionType::get(llvm::Type::getVoidTy(context), {pointer, pointer}, false);
  llvm::Function* function = owner.new_function(type, symbol, false);
  owner.constants_are_final = false;
  FunctionEmitter emitter(owner, function, nullptr, nullptr, FaultState{});
  Builder& builder = emitter.builder;
  FaultState state;
  state.sites = function->getArg(1);
  state.steps = emitter.masks.allocate(builder.getInt64Ty(), "steps");
  state.flag = emitter.masks.allocate(builder.getInt8Ty(), "flag");
  builder.CreateStore(builder.getInt32(0), state.sites);
  builder.CreateStore(builder.getInt64(0), state.steps);
  builder.CreateStore(builder.getInt8(kRunning), state.flag);
  emitter.set_environment(function->getArg(0), state);
  const ir::Function& code = owner.module.functions[owner.module.init];
  emitter.store_data();
  emitter.call_in_place(owner.module.init, ir::entry_signature(code, std::vector<bool>(code.parameters.size(), true)),
                        {}, {});
  if (emitter.masks.open()) builder.CreateRetVoid();
  emitter.finish();
  if (emitter.can_abort()) {
    builder.SetInsertPoint(emitter.abort_block());
    builder.CreateRetVoid();
  }
}

} // namespace moonshade::codegen
