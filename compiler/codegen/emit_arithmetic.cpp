// Arithmetic, comparisons, conversions, composition (emitter.h). Strict: no fast-math flag, no nsw, nothing that is
// poison for some input.
#include "compiler/codegen/emitter.h"

namespace moonshade::codegen {

using ir::Op;

llvm::Value* FunctionEmitter::binary(Op op, bool integer, llvm::Value* a, llvm::Value* b) {
  switch (op) {
  case Op::Add:
    return integer ? builder.CreateAdd(a, b) : builder.CreateFAdd(a, b);
  case Op::Sub:
    return integer ? builder.CreateSub(a, b) : builder.CreateFSub(a, b);
  case Op::Mul:
    return integer ? builder.CreateMul(a, b) : builder.CreateFMul(a, b);
  case Op::Div:
    return builder.CreateFDiv(a, b);
  case Op::And:
    return builder.CreateAnd(a, b);
  case Op::Or:
    return builder.CreateOr(a, b);
  default:
    return builder.CreateXor(a, b);
  }
}

Lanes FunctionEmitter::arithmetic(const ir::Instruction& instruction) {
  const Lanes& first = value(instruction.operands[0]);
  const bool integer = instruction.type == ValueType::Integer || instruction.type == ValueType::Boolean;
  Lanes lanes;
  for (size_t c = 0; c < first.parts.size(); ++c) {
    llvm::Value* a = first.parts[c];
    switch (instruction.op) {
    case Op::Neg:
      lanes.parts.push_back(integer ? builder.CreateNeg(a) : builder.CreateFNeg(a));
      continue;
    case Op::Not:
      lanes.parts.push_back(builder.CreateNot(a));
      continue;
    case Op::IntegerToNumber:
      if (const auto* wide = llvm::dyn_cast<llvm::SExtInst>(a)) a = wide->getOperand(0); // of a narrow variable
      lanes.parts.push_back(builder.CreateSIToFP(a, domain_.part(ValueType::Number, a->getType()->isVectorTy())));
      continue;
    default:
      break;
    }
    llvm::Value* b = value(instruction.operands[1]).parts[c];
    unify(builder, domain_, a, b);
    if (instruction.op == Op::Fma) {
      llvm::Value* addend = value(instruction.operands[2]).parts[c];
      unify(builder, domain_, a, addend);
      unify(builder, domain_, b, addend);
      lanes.parts.push_back(builder.CreateIntrinsic(llvm::Intrinsic::fma, {a->getType()}, {a, b, addend}));
    } else {
      lanes.parts.push_back(binary(instruction.op, integer, a, b));
    }
  }
  return lanes;
}

llvm::Value* FunctionEmitter::compare(Op op, ValueType type, llvm::Value* a, llvm::Value* b) {
  unify(builder, domain_, a, b);
  const bool integer = type == ValueType::Integer || type == ValueType::Boolean;
  switch (op) {
  case Op::Eq:
    return integer ? builder.CreateICmpEQ(a, b) : builder.CreateFCmpOEQ(a, b);
  case Op::Ne:
    return integer ? builder.CreateICmpNE(a, b) : builder.CreateFCmpUNE(a, b);
  case Op::Lt:
    return integer ? builder.CreateICmpSLT(a, b) : builder.CreateFCmpOLT(a, b);
  default:
    return integer ? builder.CreateICmpSLE(a, b) : builder.CreateFCmpOLE(a, b);
  }
}

Lanes FunctionEmitter::comparison(const ir::Instruction& instruction) {
  const ValueType type = activation_->function->instructions[instruction.operands[0]].type;
  const Lanes &a = value(instruction.operands[0]), &b = value(instruction.operands[1]);
  llvm::Value* all = nullptr;
  for (size_t c = 0; c < a.parts.size(); ++c) {
    llvm::Value* part = compare(instruction.op, type, a.parts[c], b.parts[c]);
    if (all != nullptr) {
      unify(builder, domain_, all, part);
      part = instruction.op == Op::Ne ? builder.CreateOr(all, part) : builder.CreateAnd(all, part);
    }
    all = part;
  }
  return {{all}};
}

Lanes FunctionEmitter::select(const ir::Instruction& instruction) {
  llvm::Value* condition = value(instruction.operands[0]).parts[0];
  const Lanes &a = value(instruction.operands[1]), &b = value(instruction.operands[2]);
  Lanes lanes;
  for (size_t c = 0; c < a.parts.size(); ++c) {
    llvm::Value *yes = a.parts[c], *no = b.parts[c];
    unify(builder, domain_, yes, no);
    if (condition->getType()->isVectorTy()) {
      yes = broadcast(builder, domain_, yes);
      no = broadcast(builder, domain_, no);
    }
    lanes.parts.push_back(builder.CreateSelect(condition, yes, no));
  }
  return lanes;
}

Lanes FunctionEmitter::construct(const ir::Instruction& instruction) {
  Lanes lanes;
  const size_t last = instruction.operands.size() - 1;
  for (unsigned c = 0; c < component_count(instruction.type); ++c)
    lanes.parts.push_back(value(instruction.operands[std::min<size_t>(c, last)]).parts[0]);
  return lanes;
}

} // namespace moonshade::codegen
