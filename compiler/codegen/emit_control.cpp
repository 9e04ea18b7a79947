// Control flow, faults and steps (emitter.h).
#include "compiler/codegen/emitter.h"

#include <llvm/IR/MDBuilder.h>

namespace moonshade::codegen {

using ir::Op;

namespace {

/// An arm of a varying `if` with fewer instructions than this, none of them a call, is executed without a branch.
constexpr uint64_t kCheapArm = 8;

} // namespace

/// Whether the block, from instruction `from` on, may and should be executed even where no lane is active.
bool FunctionEmitter::is_cheap(const ir::Block& block, size_t from) const {
  if (block.instructions.size() - from >= kCheapArm) return false;
  for (size_t i = from; i < block.instructions.size(); ++i) {
    switch (activation_->function->instructions[block.instructions[i]].op) {
    case Op::Call:
    case Op::CallLibrary:
    case Op::If:
    case Op::Loop:
    case Op::Scope:
    case Op::Step:
    case Op::Div:
    case Op::StoreElement:
    case Op::LoadGlobalElement:
    case Op::StoreGlobalElement:
    case Op::Print:
      return false;
    default:
      break;
    }
  }
  return true;
}

/// Lanes leave the innermost loop where either of two conditions holds, one of which is the same for all of them: that
/// one is a branch of its own, where it would have to be spread over a mask.
bool FunctionEmitter::break_in_two(const ir::Instruction& instruction) {
  const auto& instructions = activation_->function->instructions;
  const ir::Block& block = instruction.blocks[0];
  if (block.instructions.size() != 1 || (instruction.blocks.size() > 1 && !instruction.blocks[1].instructions.empty()))
    return false;
  const ir::Instruction& leaving = instructions[block.instructions[0]];
  if (leaving.op != Op::Break || !masks.is_innermost_loop(leaving.index)) return false;
  const ir::Instruction* condition = &instructions[instruction.operands[0]];
  const bool negated = condition->op == Op::Not; // of both
  if (negated) condition = &instructions[condition->operands[0]];
  if (condition->op != (negated ? Op::And : Op::Or)) return false;
  llvm::Value *uniform = value(condition->operands[0]).parts[0], *varying = value(condition->operands[1]).parts[0];
  if (uniform->getType()->isVectorTy()) std::swap(uniform, varying);
  if (uniform->getType()->isVectorTy() || !varying->getType()->isVectorTy()) return false;
  for (llvm::Value* one : {uniform, varying}) {
    const bool by_lane = one == varying;
    const auto leave = [&] { masks.break_to(leaving.index, by_lane); };
    masks.if_else(negated ? builder.CreateNot(one) : one, {leave, true}, {[] {}, true});
  }
  return true;
}

void FunctionEmitter::if_else(const ir::Instruction& instruction) {
  if (break_in_two(instruction)) return;
  const auto arm = [&](size_t i) -> Masks::Arm {
    if (i >= instruction.blocks.size()) return {[] {}, true};
    return {[] {}, is_cheap(instruction.blocks[i])};
  };
  Masks::Arm then_arm = arm(0), else_arm = arm(1);
  const auto then_body = [&] { emit_block(instruction.blocks[0]); };
  const auto else_body = [&] {
    if (instruction.blocks.size() > 1) emit_block(instruction.blocks[1]);
  };
  then_arm.body = then_body;
  else_arm.body = else_body;
  masks.if_else(value(instruction.operands[0]).parts[0], then_arm, else_arm);
}

void FunctionEmitter::return_values(ir::ValueId id, const ir::Instruction& instruction) {
  for (size_t i = 0; i < instruction.operands.size(); ++i)
    store_slot(activation_->results[i], value(instruction.operands[i]));
  masks.leave_function(activation_->facts->uniformity->control_varying[id]);
}

// ---------------------------------------------------------------------------------------------------------- Faults

/// Keeps the fault's place for the lanes that had none, and leaves the block of points where that were all.
void FunctionEmitter::fault(const ir::Instruction& instruction) {
  llvm::Value* hit = masks.within(value(instruction.operands[0]).parts[0]);
  if (const auto* constant = llvm::dyn_cast<llvm::Constant>(hit); constant != nullptr && constant->isNullValue())
    return;
  llvm::Value* number = builder.getInt32(owner_.place(instruction) + 1);
  auto* cold = llvm::BasicBlock::Create(domain_.context, "fault", function_);
  auto* next = llvm::BasicBlock::Create(domain_.context, "nofault", function_);
  next->moveAfter(builder.GetInsertBlock());
  builder.CreateCondBr(any_lane(builder, hit), cold, next, unlikely());
  builder.SetInsertPoint(cold);
  if (domain_.width == 1) {
    builder.CreateStore(number, faults_.sites);
    builder.CreateStore(builder.getInt8(kAllFaulted), faults_.flag);
    builder.CreateBr(abort_block());
  } else {
    llvm::Type* type = domain_.lanes(builder.getInt32Ty());
    llvm::Value* zero = llvm::Constant::getNullValue(type);
    llvm::Value* old = builder.CreateLoad(type, faults_.sites);
    llvm::Value* first = builder.CreateAnd(broadcast(builder, domain_, hit), builder.CreateICmpEQ(old, zero));
    llvm::Value* sites = builder.CreateSelect(first, broadcast(builder, domain_, number), old);
    builder.CreateStore(sites, faults_.sites);
    llvm::Value* running = any_lane(builder, builder.CreateICmpEQ(sites, zero));
    auto* finished = llvm::BasicBlock::Create(domain_.context, "finished", function_);
    builder.CreateCondBr(running, next, finished);
    builder.SetInsertPoint(finished);
    builder.CreateStore(builder.getInt8(kAllFaulted), faults_.flag);
    builder.CreateBr(abort_block());
  }
  builder.SetInsertPoint(next);
}

/// A call of the host's moonshade_print, on one lane.
void FunctionEmitter::print(const ir::Instruction& instruction) {
  if (owner_.prints == nullptr || domain_.width != 1) return;
  PrintPlaceInfo place{instruction.text, {}};
  std::vector<llvm::Value*> components;
  for (const ir::ValueId operand : instruction.operands) {
    place.types.push_back(activation_->function->instructions[operand].type);
    for (llvm::Value* part : value(operand).parts) {
      if (part->getType()->isFloatTy()) part = builder.CreateFPExt(part, builder.getDoubleTy());
      if (part->getType()->isDoubleTy()) part = builder.CreateBitCast(part, builder.getInt64Ty());
      components.push_back(builder.CreateZExt(part, builder.getInt64Ty()));
    }
  }
  llvm::Value* memory =
      masks.allocate(llvm::ArrayType::get(builder.getInt64Ty(), std::max<size_t>(components.size(), 1)), "print");
  for (size_t i = 0; i < components.size(); ++i)
    builder.CreateStore(components[i],
                        builder.CreateConstInBoundsGEP1_64(builder.getInt64Ty(), memory, static_cast<uint64_t>(i)));
  llvm::Value* sink = builder.CreateLoad(
      builder.getPtrTy(), builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), constants_, owner_.print_slot));
  auto* type = llvm::FunctionType::get(builder.getVoidTy(),
                                       {builder.getPtrTy(), builder.getInt32Ty(), builder.getPtrTy()}, false);
  builder.CreateCall(owner_.llvm_module.getOrInsertFunction("moonshade_print", type),
                     {sink, builder.getInt32(static_cast<uint32_t>(owner_.prints->size())), memory});
  owner_.prints->push_back(std::move(place));
}

void FunctionEmitter::step(const ir::Instruction& instruction) {
  llvm::Value* count = builder.CreateLoad(builder.getInt64Ty(), faults_.steps);
  count = builder.CreateAdd(count, builder.getInt64(1));
  builder.CreateStore(count, faults_.steps);
  if (overflow_block_ == nullptr) {
    overflow_block_ = llvm::BasicBlock::Create(domain_.context, "overflow", function_);
    overflow_place_ = llvm::PHINode::Create(builder.getInt32Ty(), 0, "place", overflow_block_);
  }
  auto* next = llvm::BasicBlock::Create(domain_.context, "step", function_);
  next->moveAfter(builder.GetInsertBlock());
  overflow_place_->addIncoming(builder.getInt32(owner_.place(instruction) + 1), builder.GetInsertBlock());
  llvm::Value* over = builder.CreateICmpUGT(count, builder.getInt64(owner_.module.step_limit));
  builder.CreateCondBr(over, overflow_block_, next, unlikely());
  builder.SetInsertPoint(next);
  // A loop whose lanes have all faulted need not end by itself.
  if (domain_.width > 1 && owner_.has_faults && masks.in_loop()) {
    llvm::Type* type = domain_.lanes(builder.getInt32Ty());
    llvm::Value* sites = builder.CreateLoad(type, faults_.sites);
    masks.leave_loop_unless(builder.CreateICmpEQ(sites, llvm::Constant::getNullValue(type)));
  }
}

/// The path of steps over the limit, for all places of this LLVM function: every lane that has not faulted before does.
void FunctionEmitter::finish() {
  if (overflow_block_ == nullptr) return;
  builder.SetInsertPoint(overflow_block_);
  llvm::Type* type = domain_.lanes(builder.getInt32Ty());
  llvm::Value* old = builder.CreateLoad(type, faults_.sites);
  llvm::Value* fresh = builder.CreateICmpEQ(old, llvm::Constant::getNullValue(type));
  llvm::Value* sites = builder.CreateSelect(fresh, broadcast(builder, domain_, overflow_place_), old);
  builder.CreateStore(sites, faults_.sites);
  builder.CreateStore(builder.getInt8(kOverflowed), faults_.flag);
  builder.CreateBr(abort_block());
}

/// Behind a call of an LLVM function that may have left the block of points.
void FunctionEmitter::check_abort() {
  auto* next = llvm::BasicBlock::Create(domain_.context, "returned", function_);
  next->moveAfter(builder.GetInsertBlock());
  llvm::Value* flag = builder.CreateLoad(builder.getInt8Ty(), faults_.flag);
  builder.CreateCondBr(builder.CreateICmpNE(flag, builder.getInt8(kRunning)), abort_block(), next, unlikely());
  builder.SetInsertPoint(next);
}

llvm::MDNode* FunctionEmitter::unlikely() { return llvm::MDBuilder(domain_.context).createBranchWeights(1, 1 << 20); }

} // namespace moonshade::codegen
