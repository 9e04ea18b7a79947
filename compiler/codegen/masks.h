// Masks and control flow for lanes: the one place that knows which lanes execute. The emitter says "if", "loop",
// "break"; here it is decided which of them are branches and which are masks.
//
// The active lanes are known at every point of emission as one of
//   Full   all W lanes, statically: no mask exists, stores are plain
//   Some   those of a mask, an SSA value <W x i1>
//   None   statically none: all that were here have left by a varying break or return; nothing more need be emitted
//   Gone   the same, and the LLVM block is closed by a branch
//
// Constructs. A uniform `if` is a branch. A varying `if` narrows the mask for each arm; an arm is skipped by a branch
// where its mask is empty, unless it is so cheap (and so harmless) that it is better executed. A varying loop runs
// until its mask is empty. Lanes that leave a loop or scope wait for it to end: behind it the mask is what it was
// before. Only where lanes may leave it for further out ("bypassed") the lanes that left to just behind it are
// collected in a mask of their own.
//
// Faulted lanes are no matter of masks: they go on as zombies whose results nobody sees (faults.h), so that a shader
// with a check in it is still straight code under a full mask.
//
// Stores. A variable belongs to its home, the innermost block that holds all its accesses. A store must spare the lanes
// that are switched off only where these can come back within that block: where a varying `if` or a varying loop stands
// between the store and the home. Elsewhere it is a plain store.
#pragma once

#include "compiler/codegen/lanes.h"
#include "compiler/ir/ir.h"

#include <llvm/ADT/STLFunctionalExtras.h>

namespace moonshade::codegen {

/// What is known of a loop, scope or function before it is emitted.
struct TargetFacts {
  bool varying = false;  ///< some lanes may leave it while others stay
  bool bypassed = false; ///< some of its lanes may leave it for further out, without the others
};

class Masks {
public:
  using Body = llvm::function_ref<void()>;
  /// A place in the nesting of constructs.
  using Depth = size_t;

  /// Control flow of `function`, which has no block yet. `mask`: null = all lanes.
  Masks(Builder& builder, const Domain& domain, llvm::Function* function, llvm::Value* mask);

  /// Whether anything needs to be emitted here.
  bool alive() const { return active_.kind == Kind::Full || active_.kind == Kind::Some; }
  /// Whether the LLVM block can still be appended to.
  bool open() const { return active_.kind != Kind::Gone; }
  /// The active lanes as an LLVM value.
  llvm::Value* active();
  bool full() const { return active_.kind == Kind::Full; }
  /// `condition` (i1 or <W x i1>) restricted to the active lanes; scalar only where all lanes are active.
  llvm::Value* within(llvm::Value* condition);

  // --- Constructs
  struct Arm {
    Body body;
    bool cheap = false; ///< cheap and harmless: may be executed by no lane at all
  };
  void if_else(llvm::Value* condition, Arm then_arm, Arm else_arm);
  void loop(ir::LabelId label, TargetFacts facts, Body body);
  void scope(ir::LabelId label, TargetFacts facts, Body body);
  /// The body of a function that is emitted in place: a scope that `leave_function` leaves; hides the labels outside.
  void function(TargetFacts facts, Body body);
  /// The active lanes go on behind the construct. `varying`: others of its lanes may still be in it, so they wait.
  void break_to(ir::LabelId label, bool varying);
  void leave_function(bool varying);

  /// To be called between the statements of a block: where lanes have left since `mark`, the rest of the block is
  /// skipped if none is left. `end_block` closes what `skip_rest` opened since `begin_block`.
  struct BlockState {
    size_t joins;
    llvm::Value* mask;
    bool loop_body; ///< the rest is then skipped by leaving the loop
  };
  BlockState begin_block(bool loop_body = false);
  void skip_rest(BlockState& state);
  void end_block(const BlockState& state);

  // --- Faults
  /// Leaves everything: the block of points is finished. Branches to `abort_block` from here.
  void abort(llvm::BasicBlock* abort_block);
  /// Leaves the innermost loop where none of its lanes is in `live`; does nothing where lanes of the loop are switched
  /// off here.
  void leave_loop_unless(llvm::Value* live);
  bool in_loop() const;
  /// Whether nothing that lanes wait in stands between here and the loop `label`.
  bool is_innermost_loop(ir::LabelId label) const {
    return !frames_.empty() && frames_.back().kind == FrameKind::Loop && frames_.back().label == label;
  }

  // --- Stores
  /// The home of what may be seen by lanes that are not known here.
  static constexpr Depth kOutside = SIZE_MAX;
  Depth depth() const { return frames_.size(); }
  /// Whether a store here to a variable whose home was entered at `home` may overwrite all lanes.
  /// Lanes that have left the loop `last` are none that could see it.
  bool plain_store(Depth home, ir::LabelId last = ir::kNone) const;
  /// What to store so that switched-off lanes keep `old`.
  llvm::Value* blend(llvm::Value* value, llvm::Value* old);

  /// An alloca in the entry block.
  llvm::AllocaInst* allocate(llvm::Type* type, const llvm::Twine& name = "");

private:
  enum class Kind : uint8_t { Full, Some, None, Gone };
  struct Active {
    Kind kind = Kind::Full;
    llvm::Value* mask = nullptr;
    bool operator==(const Active&) const = default;
  };
  /// Where several branches meet, each with its active lanes.
  struct Join {
    llvm::BasicBlock* block;
    llvm::SmallVector<std::pair<llvm::BasicBlock*, Active>, 4> edges;
  };
  enum class FrameKind : uint8_t { VaryingIf, Loop, Scope, Function };
  struct Frame {
    FrameKind kind;
    ir::LabelId label = ir::kNone;
    TargetFacts facts = {};
    Active entry = {};
    llvm::BasicBlock* exit = nullptr;
    llvm::AllocaInst* collected = nullptr;
  };

  llvm::BasicBlock* new_block(const char* name);
  llvm::Value* materialise(const Active& active);
  Join open_join(const char* name) { return {new_block(name), {}}; }
  /// Branches to the join with the active lanes; what follows is Gone.
  void leave_to(Join& join);
  void finish(Join& join);
  Active merge(Join& join);
  void uniform_if(llvm::Value* condition, Arm& then_arm, Arm& else_arm);
  void varying_if(llvm::Value* condition, Arm& then_arm, Arm& else_arm);
  void varying_arm(Active lanes, Arm& arm);
  Active unite(const Active& a, const Active& b);
  void push_target(FrameKind kind, ir::LabelId label, TargetFacts facts, const char* name);
  void pop_target();
  void collect(Frame& frame);
  void leave_to_frame(size_t index, bool varying);

  Builder& builder_;
  const Domain& domain_;
  llvm::Function* function_;
  Active active_;
  std::vector<Frame> frames_;
  std::vector<Join> rests_; ///< of skip_rest
};

} // namespace moonshade::codegen
