// split_lanes: a vector of all lanes becomes two of half as many (split_lanes.h). Whatever works lane by lane is cloned
// for each half, with the same flags; nothing else is changed. Where a whole vector must remain (arguments and results
// of calls, shuffles), the halves are joined, or taken from it.
#include "compiler/codegen/split_lanes.h"

#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/Analysis/VectorUtils.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/Transforms/Utils/Local.h>

#include <array>
#include <numeric>

namespace moonshade::codegen {

namespace {

using Builder = llvm::IRBuilder<>;
using Halves = std::array<llvm::Value*, 2>;

class Splitting {
public:
  Splitting(llvm::Function& function, unsigned lanes) : function_(function), lanes_(lanes), half_(lanes / 2) {}

  void run() {
    const llvm::ReversePostOrderTraversal<llvm::Function*> order(&function_);
    for (llvm::BasicBlock* block : order)
      for (llvm::Instruction& instruction : llvm::make_early_inc_range(*block))
        visit(instruction);
    for (llvm::PHINode* phi : phis_)
      fill(*phi);
    remove_replaced();
  }

private:
  bool is_wide(const llvm::Type* type) const {
    const auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(type);
    return vector != nullptr && vector->getNumElements() == lanes_;
  }
  bool is_wide(const llvm::Value* value) const { return is_wide(value->getType()); }
  llvm::Type* half_of(llvm::Type* type) const {
    return is_wide(type) ? llvm::FixedVectorType::get(type->getScalarType(), half_) : type;
  }

  // ------------------------------------------------------------------------------------------------------- Halves

  llvm::Constant* half_of(llvm::Constant* constant, unsigned which) const {
    if (llvm::Constant* splat = constant->getSplatValue())
      return llvm::ConstantVector::getSplat(llvm::ElementCount::getFixed(half_), splat);
    llvm::SmallVector<llvm::Constant*, 32> elements;
    for (unsigned i = 0; i < half_; ++i)
      elements.push_back(constant->getAggregateElement(which * half_ + i));
    return llvm::is_contained(elements, nullptr) ? nullptr : llvm::ConstantVector::get(elements);
  }

  /// Half of a whole vector, taken where it is made.
  Halves& taken(llvm::Value* value) {
    Halves& halves = halves_[value];
    if (halves[0] != nullptr) return halves;
    Builder builder(function_.getContext());
    builder.SetInsertPoint(&*function_.getEntryBlock().getFirstInsertionPt());
    if (auto* instruction = llvm::dyn_cast<llvm::Instruction>(value))
      if (const auto behind = instruction->getInsertionPointAfterDef()) builder.SetInsertPoint(*behind);
    for (unsigned which : {0U, 1U}) {
      llvm::SmallVector<int, 32> from(half_);
      std::iota(from.begin(), from.end(), static_cast<int>(which * half_));
      halves[which] = builder.CreateShuffleVector(value, from);
    }
    return halves;
  }

  /// For the half of lanes `which`; what is one value for all lanes is itself.
  llvm::Value* half(llvm::Value* value, unsigned which) {
    if (!is_wide(value)) return value;
    if (auto* constant = llvm::dyn_cast<llvm::Constant>(value))
      if (llvm::Constant* part = half_of(constant, which)) return part;
    return taken(value)[which];
  }

  /// The whole of what has been split, put together where it was.
  llvm::Value* whole(llvm::Instruction& split) {
    llvm::Value*& joined = joined_[&split];
    if (joined == nullptr) {
      Builder builder(&split);
      if (llvm::isa<llvm::PHINode>(split)) builder.SetInsertPoint(&*split.getParent()->getFirstInsertionPt());
      llvm::SmallVector<int, 32> all(lanes_);
      std::iota(all.begin(), all.end(), 0);
      const Halves halves = halves_.lookup(&split);
      joined = builder.CreateShuffleVector(halves[0], halves[1], all);
    }
    return joined;
  }

  // ------------------------------------------------------------------------------------------------- Instructions

  void visit(llvm::Instruction& instruction) {
    const auto touches = [&](const llvm::Use& use) { return is_wide(use.get()); };
    const bool wide = is_wide(&instruction) || llvm::any_of(instruction.operands(), touches);
    if ((wide && split(instruction)) || replace_test(instruction)) {
      replaced_.push_back(&instruction);
      return;
    }
    for (llvm::Use& use : instruction.operands())
      if (auto* operand = llvm::dyn_cast<llvm::Instruction>(use.get()); operand != nullptr && split_.contains(operand))
        use.set(whole(*operand));
  }

  void give(llvm::Instruction& instruction, const Halves& halves) {
    split_.insert(&instruction);
    halves_[&instruction] = halves;
  }

  bool split(llvm::Instruction& instruction) {
    if (auto* phi = llvm::dyn_cast<llvm::PHINode>(&instruction)) return split_phi(*phi);
    if (auto* load = llvm::dyn_cast<llvm::LoadInst>(&instruction)) return split_load(*load);
    if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&instruction)) return split_store(*store);
    if (auto* call = llvm::dyn_cast<llvm::IntrinsicInst>(&instruction)) return split_intrinsic(*call);
    if (auto* shuffle = llvm::dyn_cast<llvm::ShuffleVectorInst>(&instruction)) return split_splat(*shuffle);
    if (llvm::isa<llvm::BitCastInst>(instruction) && !is_wide(&instruction))
      return llvm::all_of(instruction.users(), is_test); // replaced each for itself
    const bool by_lane = llvm::isa<llvm::BinaryOperator, llvm::UnaryOperator, llvm::CmpInst, llvm::SelectInst,
                                   llvm::FreezeInst, llvm::GetElementPtrInst>(instruction);
    const bool is_cast = llvm::isa<llvm::CastInst>(instruction) && is_wide(instruction.getOperand(0));
    return (by_lane || is_cast) && is_wide(&instruction) && clone_halves(instruction);
  }

  bool clone_halves(llvm::Instruction& instruction) {
    Halves halves{};
    for (unsigned which : {0U, 1U}) {
      llvm::Instruction* clone = instruction.clone();
      for (llvm::Use& use : clone->operands())
        use.set(half(use.get(), which));
      clone->mutateType(half_of(instruction.getType()));
      clone->insertBefore(&instruction);
      halves[which] = clone;
    }
    give(instruction, halves);
    return true;
  }

  bool split_phi(llvm::PHINode& phi) {
    Builder builder(&phi);
    Halves halves{};
    for (llvm::Value*& part : halves)
      part = builder.CreatePHI(half_of(phi.getType()), phi.getNumIncomingValues(), phi.getName());
    give(phi, halves);
    phis_.push_back(&phi);
    return true;
  }

  void fill(llvm::PHINode& phi) {
    const Halves halves = halves_.lookup(&phi);
    for (unsigned which : {0U, 1U})
      for (unsigned i = 0; i < phi.getNumIncomingValues(); ++i)
        llvm::cast<llvm::PHINode>(halves[which])
            ->addIncoming(half(phi.getIncomingValue(i), which), phi.getIncomingBlock(i));
  }

  /// Bytes of half a vector in memory; 0 where lanes are no whole bytes.
  uint64_t bytes_of_half(llvm::Type* type) const {
    const uint64_t bits = function_.getParent()->getDataLayout().getTypeSizeInBits(type->getScalarType());
    return bits % 8 != 0 ? 0 : bits / 8 * half_;
  }

  llvm::Value* address(Builder& builder, llvm::Value* pointer, uint64_t offset) const {
    return offset == 0 ? pointer : builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), pointer, offset);
  }

  bool split_load(llvm::LoadInst& load) {
    const uint64_t bytes = bytes_of_half(load.getType());
    if (!load.isSimple() || bytes == 0) return false;
    Builder builder(&load);
    Halves halves{};
    for (unsigned which : {0U, 1U}) {
      auto* part =
          builder.CreateAlignedLoad(half_of(load.getType()), address(builder, load.getPointerOperand(), which * bytes),
                                    llvm::commonAlignment(load.getAlign(), which * bytes));
      part->copyMetadata(load);
      halves[which] = part;
    }
    give(load, halves);
    return true;
  }

  bool split_store(llvm::StoreInst& store) {
    const uint64_t bytes = bytes_of_half(store.getValueOperand()->getType());
    if (!store.isSimple() || bytes == 0) return false;
    Builder builder(&store);
    for (unsigned which : {0U, 1U})
      builder
          .CreateAlignedStore(half(store.getValueOperand(), which),
                              address(builder, store.getPointerOperand(), which * bytes),
                              llvm::commonAlignment(store.getAlign(), which * bytes))
          ->copyMetadata(store);
    return true;
  }

  /// One value in every lane.
  bool split_splat(llvm::ShuffleVectorInst& shuffle) {
    using namespace llvm::PatternMatch;
    llvm::Value* scalar = nullptr;
    if (!is_wide(&shuffle) ||
        !match(&shuffle, m_Shuffle(m_InsertElt(m_Value(), m_Value(scalar), m_ZeroInt()), m_Value(), m_ZeroMask())))
      return false;
    llvm::Value* splat = Builder(&shuffle).CreateVectorSplat(half_, scalar);
    give(shuffle, {splat, splat});
    return true;
  }

  bool split_intrinsic(llvm::IntrinsicInst& call) {
    const llvm::Intrinsic::ID id = call.getIntrinsicID();
    const bool gather = id == llvm::Intrinsic::masked_gather, scatter = id == llvm::Intrinsic::masked_scatter;
    const bool by_lane = is_wide(&call) && llvm::isTriviallyVectorizable(id);
    if (!by_lane && !gather && !scatter) return replace_reduction(call);
    Builder builder(&call);
    Halves halves{};
    for (unsigned which : {0U, 1U}) {
      llvm::SmallVector<llvm::Value*, 4> arguments;
      for (const llvm::Use& argument : call.args())
        arguments.push_back(half(argument.get(), which));
      llvm::SmallVector<llvm::Type*, 2> types;
      if (gather || (by_lane && llvm::isVectorIntrinsicWithOverloadTypeAtArg(id, -1)))
        types.push_back(half_of(call.getType()));
      for (unsigned i = 0; i < arguments.size(); ++i)
        if (by_lane ? llvm::isVectorIntrinsicWithOverloadTypeAtArg(id, static_cast<int>(i)) : i < (gather ? 1U : 2U))
          types.push_back(arguments[i]->getType());
      llvm::CallInst* part = builder.CreateIntrinsic(id, types, arguments);
      part->copyIRFlags(&call);
      halves[which] = part;
    }
    if (!scatter) give(call, halves);
    return true;
  }

  // ------------------------------------------------------------------------------------------- All lanes in one bit

  /// The or, and, exclusive or of all lanes.
  bool replace_reduction(llvm::IntrinsicInst& call) {
    llvm::Instruction::BinaryOps operation;
    switch (call.getIntrinsicID()) {
    case llvm::Intrinsic::vector_reduce_or:
      operation = llvm::Instruction::Or;
      break;
    case llvm::Intrinsic::vector_reduce_and:
      operation = llvm::Instruction::And;
      break;
    case llvm::Intrinsic::vector_reduce_xor:
      operation = llvm::Instruction::Xor;
      break;
    default:
      return false;
    }
    llvm::Value* operand = call.getArgOperand(0);
    Builder builder(&call);
    llvm::Value* both = builder.CreateBinOp(operation, half(operand, 0), half(operand, 1));
    call.replaceAllUsesWith(builder.CreateIntrinsic(call.getIntrinsicID(), {both->getType()}, {both}));
    return true;
  }

  /// A comparison of a mask's bits with 0 or -1: whether it has any lane, or all.
  static bool is_test(const llvm::User* user) {
    using namespace llvm::PatternMatch;
    const auto* compare = llvm::dyn_cast<llvm::ICmpInst>(user);
    return compare != nullptr && compare->isEquality() && match(compare->getOperand(0), m_BitCast(m_Value())) &&
           match(compare->getOperand(1), m_CombineOr(m_Zero(), m_AllOnes()));
  }

  bool replace_test(llvm::Instruction& instruction) {
    if (!is_test(&instruction)) return false;
    llvm::Value* mask = llvm::cast<llvm::BitCastInst>(instruction.getOperand(0))->getOperand(0);
    if (!is_wide(mask) || !mask->getType()->getScalarType()->isIntegerTy(1)) return false;
    Builder builder(&instruction);
    const bool any = llvm::cast<llvm::Constant>(instruction.getOperand(1))->isNullValue();
    llvm::Value *low = half(mask, 0), *high = half(mask, 1);
    llvm::Value* bits = builder.CreateBitCast(any ? builder.CreateOr(low, high) : builder.CreateAnd(low, high),
                                              builder.getIntNTy(half_));
    llvm::Constant* constant =
        any ? llvm::Constant::getNullValue(bits->getType()) : llvm::Constant::getAllOnesValue(bits->getType());
    instruction.replaceAllUsesWith(
        builder.CreateICmp(llvm::cast<llvm::ICmpInst>(instruction).getPredicate(), bits, constant));
    return true;
  }

  void remove_replaced() {
    for (llvm::Instruction* instruction : replaced_)
      instruction->dropAllReferences();
    for (llvm::Instruction* instruction : replaced_) {
      instruction->replaceAllUsesWith(llvm::PoisonValue::get(instruction->getType()));
      instruction->eraseFromParent();
    }
    // What a splat was made of, and joins and parts that nobody took.
    for (llvm::BasicBlock& block : function_)
      for (llvm::Instruction& instruction : llvm::make_early_inc_range(llvm::reverse(block)))
        if (llvm::isInstructionTriviallyDead(&instruction)) instruction.eraseFromParent();
  }

  llvm::Function& function_;
  const unsigned lanes_, half_;
  llvm::DenseMap<llvm::Value*, Halves> halves_; ///< of what is split, and of what is whole and taken apart
  llvm::DenseSet<llvm::Instruction*> split_;
  llvm::DenseMap<llvm::Instruction*, llvm::Value*> joined_;
  llvm::SmallVector<llvm::PHINode*, 16> phis_;
  llvm::SmallVector<llvm::Instruction*, 64> replaced_;
};

} // namespace

void split_lanes(llvm::Module& module, unsigned lanes, unsigned register_lanes) {
  for (; lanes > register_lanes; lanes /= 2)
    for (llvm::Function& function : module)
      if (!function.isDeclaration()) Splitting(function, lanes).run();
}

} // namespace moonshade::codegen
