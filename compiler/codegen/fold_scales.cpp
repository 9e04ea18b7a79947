#include "compiler/codegen/fold_scales.h"

#include <llvm/ADT/SmallVector.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>

namespace moonshade::codegen {

namespace {

using llvm::APFloat;
using namespace llvm::PatternMatch;

/// Of integers that are numbers exactly.
bool is_exact(llvm::Value* integer, const llvm::Type* number, const llvm::DataLayout& layout) {
  const unsigned digits = APFloat::semanticsPrecision(number->getScalarType()->getFltSemantics());
  return llvm::computeKnownBits(integer, layout).countMaxActiveBits() <= digits;
}

/// The constant times the power of two; null unless that is exact, whatever the number it is multiplied by.
llvm::Constant* scaled(llvm::Value* constant, const APFloat& power) {
  const APFloat* value = nullptr;
  if (!match(constant, m_APFloat(value)) || !value->isFiniteNonZero()) return nullptr;
  APFloat product = *value;
  product.multiply(power, APFloat::rmNearestTiesToEven);
  return product.isNormal() ? llvm::ConstantFP::get(constant->getType(), product) : nullptr;
}

/// The constant by which a use multiplies; null where it does something else.
llvm::Use* factor_beside(llvm::Use& use) {
  auto* user = llvm::dyn_cast<llvm::Instruction>(use.getUser());
  if (user == nullptr || use.getOperandNo() > 1) return nullptr;
  const auto* call = llvm::dyn_cast<llvm::IntrinsicInst>(user);
  const bool multiplies = user->getOpcode() == llvm::Instruction::FMul ||
                          (call != nullptr && call->getIntrinsicID() == llvm::Intrinsic::fma);
  return multiplies ? &user->getOperandUse(1 - use.getOperandNo()) : nullptr;
}

/// Does it for all that a scaled integer is used for, or nothing.
void fold(llvm::Instruction& scaling, const llvm::DataLayout& layout) {
  llvm::Value* number = nullptr;
  llvm::Value* integer = nullptr;
  const APFloat* power = nullptr;
  if (!match(&scaling, m_FMul(m_Value(number), m_APFloat(power))) || !power->isNormal() || power->isNegative() ||
      !power->getExactInverse(nullptr) ||
      !match(number, m_CombineOr(m_UIToFP(m_Value(integer)), m_SIToFP(m_Value(integer)))) ||
      !is_exact(integer, scaling.getType(), layout))
    return;
  llvm::SmallVector<std::pair<llvm::Use*, llvm::Constant*>, 8> factors;
  for (llvm::Use& use : scaling.uses()) {
    llvm::Use* factor = factor_beside(use);
    llvm::Constant* constant = factor != nullptr ? scaled(factor->get(), *power) : nullptr;
    if (constant == nullptr) return;
    factors.emplace_back(factor, constant);
  }
  for (const auto& [factor, constant] : factors)
    factor->set(constant);
  scaling.replaceAllUsesWith(number);
  scaling.eraseFromParent();
}

} // namespace

void fold_scales(llvm::Module& module) {
  for (llvm::Function& function : module)
    for (llvm::Instruction& instruction : llvm::make_early_inc_range(llvm::instructions(function)))
      fold(instruction, module.getDataLayout());
}

} // namespace moonshade::codegen
