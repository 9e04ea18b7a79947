// From IR to LLVM, for every precision and width: one emitter. It speaks of values (lanes.h) and leaves masks and
// control flow to masks.h.
//
//   ModuleEmitter    one LLVM module for one domain: constants, fault sites, functions that are not emitted in place
//   FunctionEmitter  one LLVM function. Functions of the IR are emitted in place, at each call, where the mask is often
//                    known to be full and captures are the caller's own variables; too big ones (facts.h) are LLVM
//                    functions that take the mask, pointers to captures, and pointers to the fault state.
//
// FAULTS. A point that faults goes on as a zombie: its first fault's site is kept for its lane, it cannot hurt anything
// (element indices are clamped where they are used), and its outputs are zeroed when its block is finished. So a check
// costs a comparison and a branch that is never taken, and no mask. Where all lanes of the block have faulted (at
// W = 1, at once) the rest of the block is left by a branch, the `abort`; a loop is left when its lanes are all
// zombies. Steps are counted for the block, as an upper bound for each of its lanes; see batch.h.
#pragma once

#include "compiler/codegen/codegen.h"
#include "compiler/codegen/facts.h"
#include "compiler/codegen/lanes.h"
#include "compiler/codegen/masks.h"
#include "compiler/ir/ir.h"
#include "compiler/ir/uniformity.h"

#include <llvm/IR/Module.h>

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace moonshade::codegen {

/// Where the instance's globals lie in its block of constants: element i, component c of global g at
/// offset(g) + (i * components + c) * size of the component.
struct ConstantsLayout {
  std::vector<uint64_t> offsets;
  uint64_t size = 0;
};
ConstantsLayout layout_constants(const ir::Module& module, Precision precision);

/// The places of a module that can fault, numbered in its order: the same numbers at every width.
struct FaultPlaces {
  explicit FaultPlaces(const ir::Module& module);
  std::vector<const ir::Instruction*> places;
  std::unordered_map<const ir::Instruction*, uint32_t> numbers;
};

/// Attributes that every function of the module gets.
struct FunctionAttributes {
  std::string cpu, features;
  bool wide = false;      ///< keep 512-bit registers
  uint64_t max_stack = 0; ///< bytes of stack beyond which LLVM is to complain
  void apply(llvm::Function& function) const;
};

/// A variable: for each component an array of `count` scalars or lane vectors in memory.
struct Slot {
  ValueType type = ValueType::Number;
  uint32_t count = 1;
  bool varying = false;
  Masks::Depth home = 0;
  llvm::SmallVector<llvm::Value*, 4> parts;
  ir::LabelId last_loop = ir::kNone; ///< FunctionFacts::last_loops
  bool narrow = false;               ///< lanes of 32 bits for 64 (FunctionFacts::narrow)
};

/// Memory for the faults of a block of points; null pointers where the program cannot fault.
struct FaultState {
  llvm::Value* sites = nullptr; ///< <W x i32>: 0, or the fault's place plus 1
  llvm::Value* steps = nullptr; ///< i64
  llvm::Value* flag = nullptr;  ///< i8: 0, or why the block was left
};
enum BlockFlag : uint8_t { kRunning = 0, kAllFaulted = 1, kOverflowed = 2 };

/// The type of results that are not inlined away. Of more than two scalars, the third and fourth would come back in
/// registers of the x87, which LLVM 19's fast path reads with an instruction that cannot name xmm16 and up; with some
/// to spare, all come back in memory.
llvm::StructType* returned_struct(const Domain& domain, std::vector<llvm::Type*> parts);

class ModuleEmitter {
public:
  ModuleEmitter(llvm::Module& llvm_module, const ir::Module& module, const Domain& domain,
                const FunctionAttributes& attributes, const FaultPlaces& places);

  const FunctionFacts& facts(ir::FunctionId function, const ir::Signature& signature);
  /// The LLVM function of an outlined function of the IR.
  llvm::Function* outlined(ir::FunctionId function, const ir::Signature& signature);
  /// The library function for lanes or, with `varying` false, for one value: by value, pure.
  /// `wanted`: a bit for each of the row's results that is used.
  llvm::Function* library_function(const LibraryFunction& row, bool varying, uint32_t wanted);
  /// The export behind it, by pointers: declared only.
  llvm::Function* library_export(const LibraryFunction& row, bool varying);
  /// The type of the results, as outlined functions give them back.
  llvm::Type* results_type(const ir::Function& function, const ir::Uniformity& uniformity) const;
  uint32_t place(const ir::Instruction& instruction) const { return places_.numbers.at(&instruction); }
  llvm::Function* new_function(llvm::FunctionType* type, const std::string& name, bool internal);

  llvm::Module& llvm_module;
  const ir::Module& module;
  const Domain& domain;
  const ConstantsLayout layout;
  const SizePlan sizes;
  const std::vector<FaultFacts> fault_facts;
  /// Some function faults for another reason than its steps.
  bool has_faults = false;
  /// Prints are emitted: where they are collected, and where code finds the sink.
  std::vector<PrintPlaceInfo>* prints = nullptr;
  uint64_t print_slot = 0;
  uint64_t image_slot = 0; ///< where code finds the instance's images
  /// Exports are called at once, without a function by value around them: for code that nobody optimises.
  bool calls_exports = false;
  /// While the init function is emitted, globals are not constant.
  bool constants_are_final = true;

private:
  using Key = std::pair<ir::FunctionId, ir::Signature>;
  const FunctionAttributes& attributes_;
  const FaultPlaces& places_;
  ir::UniformityTable uniformity_;
  std::map<Key, std::unique_ptr<FunctionFacts>> facts_;
  std::map<Key, llvm::Function*> outlined_;
};

class FunctionEmitter {
public:
  FunctionEmitter(ModuleEmitter& owner, llvm::Function* function, llvm::Value* mask, llvm::Value* constants,
                  FaultState faults);

  /// Emits a function of the IR in place and gives its results.
  std::vector<Lanes> call_in_place(ir::FunctionId function, const ir::Signature& signature,
                                   std::vector<Lanes> arguments, std::vector<Slot> captures);
  /// Where control goes when nothing is left to do for the block of points; created when first asked for.
  llvm::BasicBlock* abort_block();
  bool can_abort() const { return abort_block_ != nullptr; }
  bool has_overflow() const { return overflow_block_ != nullptr; }
  /// Where the instance's constants and the block's faults are; to be told before anything is emitted.
  /// Fills the globals that have data: the first thing that init does.
  void store_data();
  void set_environment(llvm::Value* constants, FaultState faults) {
    constants_ = constants;
    faults_ = faults;
  }
  /// Ends an outlined function with the results of its body.
  void return_from_llvm(llvm::Type* type, const std::vector<Lanes>& values);
  /// Emits what comes last: the cold path of steps.
  void finish();

  Builder builder;
  Masks masks;

private:
  /// A function of the IR that is being emitted.
  struct Activation {
    const ir::Function* function;
    const FunctionFacts* facts;
    std::vector<Lanes> values;
    std::map<ir::ValueId, std::vector<Lanes>> call_results;
    std::vector<Slot> variables;
    std::vector<Slot> results;
    std::vector<Lanes> arguments;
  };

  // emit.cpp
  void emit_block(const ir::Block& block, bool loop_body = false);
  bool is_cheap(const ir::Block& block, size_t from = 0) const;
  void emit(ir::ValueId id, const ir::Instruction& instruction);
  void enter_homes(const ir::Block& block);
  Lanes& value(ir::ValueId id) { return activation_->values[id]; }
  void set(ir::ValueId id, Lanes lanes) { activation_->values[id] = std::move(lanes); }

  // emit_memory.cpp
  Slot make_slot(ValueType type, uint32_t count, bool varying, const std::string& name, bool narrow = false);
  llvm::Type* element_type(const Slot& slot) const;
  Lanes load_slot(const Slot& slot);
  void store_slot(const Slot& slot, const Lanes& lanes);
  Lanes load_element(const Slot& slot, const Lanes& index);
  void store_element(const Slot& slot, const Lanes& index, const Lanes& lanes);
  llvm::Value* clamp_index(llvm::Value* index, uint32_t count);
  llvm::Value* lane_pointers(const Slot& slot, llvm::Value* array, llvm::Value* index);
  void zero_slot(const Slot& slot);
  llvm::Value* global_pointer(ir::GlobalId global, unsigned component);
  Lanes load_global(ir::GlobalId global);
  void store_global(ir::GlobalId global, const Lanes& lanes);
  Lanes load_global_element(ir::GlobalId global, const Lanes& index);
  void store_global_element(ir::GlobalId global, const Lanes& index, const Lanes& lanes);
  llvm::Value* global_element_pointer(ir::GlobalId global, llvm::Value* index, unsigned component);

  // emit_arithmetic.cpp
  Lanes arithmetic(const ir::Instruction& instruction);
  Lanes comparison(const ir::Instruction& instruction);
  Lanes select(const ir::Instruction& instruction);
  Lanes construct(const ir::Instruction& instruction);
  llvm::Value* binary(ir::Op op, bool integer, llvm::Value* a, llvm::Value* b);
  llvm::Value* compare(ir::Op op, ValueType type, llvm::Value* a, llvm::Value* b);

  // emit_calls.cpp
  std::vector<Lanes> call_library(ir::ValueId id, const ir::Instruction& instruction);
  std::vector<Lanes> texture(const ir::Instruction& instruction); // emit_images.cpp
  std::vector<Lanes> library_call(const LibraryFunction& row, const std::vector<Lanes>& arguments, uint32_t wanted);
  std::vector<Lanes> call(ir::ValueId id, const ir::Instruction& instruction);
  std::vector<Lanes> call_outlined(ir::FunctionId callee, const ir::Signature& signature,
                                   const std::vector<Lanes>& arguments, const std::vector<Slot>& captures);

  // emit_control.cpp
  void if_else(const ir::Instruction& instruction);
  bool break_in_two(const ir::Instruction& instruction);
  void return_values(ir::ValueId id, const ir::Instruction& instruction);
  void print(const ir::Instruction& instruction);
  void fault(const ir::Instruction& instruction);
  void step(const ir::Instruction& instruction);
  void check_abort();
  llvm::MDNode* unlikely();

  ModuleEmitter& owner_;
  const Domain& domain_;
  llvm::Function* function_;
  llvm::Value* constants_;
  FaultState faults_;
  Activation* activation_ = nullptr;
  llvm::BasicBlock* abort_block_ = nullptr;
  /// Where a step over the limit goes: its place comes as an operand of the phi.
  llvm::BasicBlock* overflow_block_ = nullptr;
  llvm::PHINode* overflow_place_ = nullptr;
};

} // namespace moonshade::codegen
