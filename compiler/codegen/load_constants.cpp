#include "compiler/codegen/load_constants.h"

#include <llvm/ADT/DenseMap.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/IRBuilder.h>

namespace moonshade::codegen {

namespace {

/// Numbers only: with an integer that it knows, an instruction is often another one. Zeros take no load (and are no
/// ConstantDataVector).
bool is_loaded(const llvm::Value* value) {
  const auto* vector = llvm::dyn_cast<llvm::ConstantDataVector>(value);
  return vector != nullptr && vector->getElementType()->isFloatingPointTy();
}

} // namespace

void load_constants(llvm::Module& module) {
  llvm::DenseMap<llvm::Value*, llvm::GlobalVariable*> memory;
  const auto place = [&](llvm::Constant* constant) {
    llvm::GlobalVariable*& variable = memory[constant];
    if (variable != nullptr) return variable;
    variable = new llvm::GlobalVariable(module, constant->getType(), true, llvm::GlobalValue::PrivateLinkage, constant);
    variable->setUnnamedAddr(llvm::GlobalValue::UnnamedAddr::Global);
    variable->setAlignment(module.getDataLayout().getPrefTypeAlign(constant->getType()));
    return variable;
  };
  for (llvm::Function& function : module)
    for (llvm::BasicBlock& block : function) {
      llvm::DenseMap<llvm::Value*, llvm::Value*> loaded; // in this block
      for (llvm::Instruction& instruction : block) {
        if (llvm::isa<llvm::PHINode>(instruction)) continue;
        for (llvm::Use& operand : instruction.operands()) {
          if (!is_loaded(operand)) continue;
          llvm::Value*& value = loaded[operand];
          if (value == nullptr) {
            llvm::GlobalVariable* from = place(llvm::cast<llvm::Constant>(operand));
            value = llvm::IRBuilder<>(&instruction).CreateAlignedLoad(operand->getType(), from, *from->getAlign());
          }
          operand.set(value);
        }
      }
    }
}

} // namespace moonshade::codegen
