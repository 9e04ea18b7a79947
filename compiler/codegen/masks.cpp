// Masks and control flow for lanes (masks.h).
#include "compiler/codegen/masks.h"

#include <llvm/IR/CFG.h>
#include <llvm/IR/Module.h>

#include <cassert>

namespace moonshade::codegen {

Masks::Masks(Builder& builder, const Domain& domain, llvm::Function* function, llvm::Value* mask)
    : builder_(builder), domain_(domain), function_(function) {
  // The entry block holds the allocas alone.
  llvm::BasicBlock* entry = new_block("entry");
  llvm::BasicBlock* start = new_block("start");
  builder_.SetInsertPoint(entry);
  builder_.CreateBr(start);
  builder_.SetInsertPoint(start);
  if (mask != nullptr && domain.width > 1) active_ = {Kind::Some, mask};
}

llvm::AllocaInst* Masks::allocate(llvm::Type* type, const llvm::Twine& name) {
  return new llvm::AllocaInst(type, 0, nullptr, function_->getParent()->getDataLayout().getPrefTypeAlign(type), name,
                              function_->getEntryBlock().getTerminator());
}

llvm::BasicBlock* Masks::new_block(const char* name) {
  return llvm::BasicBlock::Create(domain_.context, name, function_);
}

llvm::Value* Masks::materialise(const Active& active) {
  switch (active.kind) {
  case Kind::Full:
    return llvm::Constant::getAllOnesValue(domain_.mask());
  case Kind::Some:
    return active.mask;
  default:
    return llvm::Constant::getNullValue(domain_.mask());
  }
}

llvm::Value* Masks::active() { return materialise(active_); }

llvm::Value* Masks::within(llvm::Value* condition) {
  if (active_.kind == Kind::Full) return condition;
  return builder_.CreateAnd(materialise(active_), broadcast(builder_, domain_, condition));
}

// ---------------------------------------------------------------------------------------------------------- Joins

void Masks::leave_to(Join& join) {
  if (active_.kind == Kind::Gone) return;
  join.edges.push_back({builder_.GetInsertBlock(), active_});
  builder_.CreateBr(join.block);
  active_ = {Kind::Gone, nullptr};
}

Masks::Active Masks::merge(Join& join) {
  if (join.edges.empty()) return {Kind::Gone, nullptr};
  const Active first = join.edges.front().second;
  bool same = true;
  for (const auto& edge : join.edges)
    same &= edge.second == first;
  if (same) return first;
  llvm::PHINode* phi = builder_.CreatePHI(domain_.mask(), join.edges.size(), "mask");
  for (const auto& [block, active] : join.edges)
    phi->addIncoming(materialise(active), block);
  return {Kind::Some, phi};
}

void Masks::finish(Join& join) {
  if (join.edges.empty()) {
    join.block->eraseFromParent();
    active_ = {Kind::Gone, nullptr};
    return;
  }
  join.block->moveAfter(builder_.GetInsertBlock());
  builder_.SetInsertPoint(join.block);
  active_ = merge(join);
}

// ------------------------------------------------------------------------------------------------------------- If

void Masks::if_else(llvm::Value* condition, Arm then_arm, Arm else_arm) {
  if (condition->getType()->isVectorTy())
    varying_if(condition, then_arm, else_arm);
  else
    uniform_if(condition, then_arm, else_arm);
}

void Masks::uniform_if(llvm::Value* condition, Arm& then_arm, Arm& else_arm) {
  const Active before = active_;
  llvm::BasicBlock* then_block = new_block("then");
  llvm::BasicBlock* else_block = new_block("else");
  Join join = open_join("endif");
  builder_.CreateCondBr(condition, then_block, else_block);
  builder_.SetInsertPoint(then_block);
  then_arm.body();
  leave_to(join);
  else_block->moveAfter(builder_.GetInsertBlock());
  builder_.SetInsertPoint(else_block);
  active_ = before;
  else_arm.body();
  leave_to(join);
  finish(join);
}

Masks::Active Masks::unite(const Active& a, const Active& b) {
  const auto empty = [](const Active& lanes) { return lanes.kind == Kind::None || lanes.kind == Kind::Gone; };
  if (empty(a)) return empty(b) ? Active{Kind::None, nullptr} : b;
  if (empty(b)) return a;
  return {Kind::Some, builder_.CreateOr(materialise(a), materialise(b))};
}

/// Emits one arm for `lanes`; afterwards active_ is what is left of them.
void Masks::varying_arm(Active lanes, Arm& arm) {
  active_ = lanes;
  if (arm.cheap) {
    arm.body();
    return;
  }
  llvm::BasicBlock* body = new_block("arm");
  llvm::BasicBlock* end = new_block("endarm");
  llvm::BasicBlock* origin = builder_.GetInsertBlock();
  builder_.CreateCondBr(any_lane(builder_, lanes.mask), body, end);
  builder_.SetInsertPoint(body);
  arm.body();
  Active left = active_;
  llvm::BasicBlock* last = builder_.GetInsertBlock();
  if (left.kind != Kind::Gone) builder_.CreateBr(end);
  end->moveAfter(last);
  builder_.SetInsertPoint(end);
  // Where the arm was skipped its mask is empty, so it may stand for whatever is left of it.
  if (left.kind == Kind::Some && left.mask != lanes.mask) {
    llvm::PHINode* phi = builder_.CreatePHI(domain_.mask(), 2, "mask");
    phi->addIncoming(materialise({Kind::None, nullptr}), origin);
    phi->addIncoming(left.mask, last);
    left.mask = phi;
  }
  if (left.kind == Kind::Gone) left = {Kind::None, nullptr};
  active_ = left;
}

void Masks::varying_if(llvm::Value* condition, Arm& then_arm, Arm& else_arm) {
  const Active before = active_;
  const Active then_lanes = {Kind::Some, within(condition)};
  frames_.push_back({.kind = FrameKind::VaryingIf});
  varying_arm(then_lanes, then_arm);
  const Active after_then = active_;
  active_ = before;
  const Active else_lanes = {Kind::Some, within(builder_.CreateNot(condition))};
  varying_arm(else_lanes, else_arm);
  frames_.pop_back();
  if (after_then == then_lanes && active_ == else_lanes)
    active_ = before;
  else
    active_ = unite(after_then, active_);
}

// --------------------------------------------------------------------------------------------------------- Targets

void Masks::push_target(FrameKind kind, ir::LabelId label, TargetFacts facts, const char* name) {
  Frame frame{kind, label, facts, active_, new_block(name), nullptr};
  if (facts.bypassed && domain_.width > 1) {
    frame.collected = allocate(domain_.mask(), "collected");
    builder_.CreateStore(llvm::Constant::getNullValue(domain_.mask()), frame.collected);
  }
  frames_.push_back(frame);
}

/// Goes on behind the innermost target, with the lanes that left to there.
void Masks::pop_target() {
  const Frame frame = frames_.back();
  frames_.pop_back();
  if (llvm::pred_empty(frame.exit)) {
    frame.exit->eraseFromParent();
    active_ = {Kind::Gone, nullptr};
    return;
  }
  frame.exit->moveAfter(builder_.GetInsertBlock());
  builder_.SetInsertPoint(frame.exit);
  active_ = frame.entry;
  if (frame.collected != nullptr) active_ = {Kind::Some, builder_.CreateLoad(domain_.mask(), frame.collected, "mask")};
}

void Masks::collect(Frame& frame) {
  if (frame.collected == nullptr || active_.kind == Kind::None) return;
  llvm::Value* old = builder_.CreateLoad(domain_.mask(), frame.collected);
  builder_.CreateStore(builder_.CreateOr(old, materialise(active_)), frame.collected);
}

void Masks::loop(ir::LabelId label, TargetFacts facts, Body body) {
  push_target(FrameKind::Loop, label, facts, "endloop");
  llvm::BasicBlock* origin = builder_.GetInsertBlock();
  llvm::BasicBlock* header = new_block("loop");
  builder_.CreateBr(header);
  builder_.SetInsertPoint(header);
  llvm::PHINode* phi = nullptr;
  if ((facts.varying || facts.bypassed) && domain_.width > 1) {
    phi = builder_.CreatePHI(domain_.mask(), 2, "mask");
    phi->addIncoming(materialise(active_), origin);
    active_ = {Kind::Some, phi};
  }
  body();
  llvm::BasicBlock* exit = frames_.back().exit;
  if (active_.kind == Kind::None) {
    builder_.CreateBr(exit);
  } else if (active_.kind != Kind::Gone) {
    llvm::BasicBlock* latch = builder_.GetInsertBlock();
    if (phi != nullptr) {
      builder_.CreateCondBr(any_lane(builder_, materialise(active_)), header, exit);
      phi->addIncoming(materialise(active_), latch);
    } else {
      builder_.CreateBr(header);
    }
  }
  pop_target();
}

void Masks::scope(ir::LabelId label, TargetFacts facts, Body body) {
  push_target(FrameKind::Scope, label, facts, "endscope");
  body();
  if (active_.kind != Kind::Gone) {
    collect(frames_.back());
    builder_.CreateBr(frames_.back().exit);
  }
  pop_target();
}

void Masks::function(TargetFacts facts, Body body) {
  push_target(FrameKind::Function, ir::kNone, facts, "endfunction");
  body();
  if (active_.kind != Kind::Gone) builder_.CreateBr(frames_.back().exit);
  pop_target();
}

/// The active lanes leave to behind frame `index`: by a branch where no lane that entered it waits further in.
void Masks::leave_to_frame(size_t index, bool varying) {
  collect(frames_[index]);
  if (varying && domain_.width > 1) {
    active_ = {Kind::None, nullptr};
    return;
  }
  builder_.CreateBr(frames_[index].exit);
  active_ = {Kind::Gone, nullptr};
}

void Masks::break_to(ir::LabelId label, bool varying) {
  for (size_t i = frames_.size(); i-- > 0;)
    if (frames_[i].label == label) return leave_to_frame(i, varying);
  assert(false && "break to a label that encloses nothing");
}

void Masks::leave_function(bool varying) {
  for (size_t i = frames_.size(); i-- > 0;)
    if (frames_[i].kind == FrameKind::Function) return leave_to_frame(i, varying);
  assert(false && "return outside of a function");
}

// ---------------------------------------------------------------------------------------------------------- Blocks

Masks::BlockState Masks::begin_block(bool loop_body) { return {rests_.size(), active_.mask, loop_body}; }

void Masks::skip_rest(BlockState& state) {
  if (active_.kind != Kind::Some || active_.mask == state.mask) return;
  state.mask = active_.mask;
  llvm::BasicBlock* next = new_block("rest");
  if (state.loop_body) {
    builder_.CreateCondBr(any_lane(builder_, active_.mask), next, frames_.back().exit);
  } else {
    Join rest = open_join("endblock");
    rest.edges.push_back({builder_.GetInsertBlock(), active_});
    builder_.CreateCondBr(any_lane(builder_, active_.mask), next, rest.block);
    rests_.push_back(std::move(rest));
  }
  builder_.SetInsertPoint(next);
}

void Masks::end_block(const BlockState& state) {
  while (rests_.size() > state.joins) {
    Join rest = std::move(rests_.back());
    rests_.pop_back();
    // Where the rest was skipped the mask was empty.
    Active& skipped = rest.edges.front().second;
    if (!(skipped == active_)) skipped = {Kind::None, nullptr};
    leave_to(rest);
    finish(rest);
  }
}

// ---------------------------------------------------------------------------------------------------------- Faults

void Masks::abort(llvm::BasicBlock* abort_block) {
  builder_.CreateBr(abort_block);
  active_ = {Kind::Gone, nullptr};
}

bool Masks::in_loop() const {
  for (const Frame& frame : frames_)
    if (frame.kind == FrameKind::Loop) return true;
  return false;
}

void Masks::leave_loop_unless(llvm::Value* live) {
  for (size_t i = frames_.size(); i-- > 0;) {
    // Lanes that are switched off here, but not in the loop, may be alive.
    const bool others_wait = frames_[i].kind == FrameKind::VaryingIf || frames_[i].facts.varying;
    if (frames_[i].kind != FrameKind::Loop && others_wait) return;
    if (frames_[i].kind != FrameKind::Loop) continue;
    llvm::BasicBlock* next = new_block("live");
    builder_.CreateCondBr(any_lane(builder_, within(live)), next, frames_[i].exit);
    builder_.SetInsertPoint(next);
    return;
  }
}

// ---------------------------------------------------------------------------------------------------------- Stores

bool Masks::plain_store(Depth home, ir::LabelId last) const {
  if (active_.kind == Kind::Full) return true;
  if (home == kOutside) return false;
  for (size_t i = home; i < frames_.size(); ++i) {
    const bool is_last = last != ir::kNone && frames_[i].kind == FrameKind::Loop && frames_[i].label == last;
    if (frames_[i].kind == FrameKind::VaryingIf || (frames_[i].facts.varying && !is_last)) return false;
  }
  return true;
}

llvm::Value* Masks::blend(llvm::Value* value, llvm::Value* old) {
  return builder_.CreateSelect(materialise(active_), broadcast(builder_, domain_, value), old);
}

} // namespace moonshade::codegen
