// Types and small conversions of a domain (lanes.h).
#include "compiler/codegen/lanes.h"

namespace moonshade::codegen {

llvm::Type* Domain::number() const {
  return precision == Precision::F32 ? llvm::Type::getFloatTy(context) : llvm::Type::getDoubleTy(context);
}

llvm::Type* Domain::scalar(ValueType type) const {
  if (type == ValueType::Boolean) return llvm::Type::getInt1Ty(context);
  if (type == ValueType::Integer) return llvm::Type::getInt64Ty(context);
  return number();
}

llvm::Type* Domain::memory(ValueType type) const {
  return type == ValueType::Boolean ? llvm::Type::getInt8Ty(context) : scalar(type);
}

llvm::Type* Domain::lanes(llvm::Type* scalar) const {
  return width == 1 ? scalar : llvm::FixedVectorType::get(scalar, width);
}

unsigned Domain::memory_size(ValueType type) const {
  if (type == ValueType::Boolean) return 1;
  return type == ValueType::Integer || precision == Precision::F64 ? 8 : 4;
}

llvm::Value* broadcast(Builder& builder, const Domain& domain, llvm::Value* part) {
  if (domain.width == 1 || part->getType()->isVectorTy()) return part;
  const auto count = llvm::ElementCount::getFixed(domain.width);
  if (auto* constant = llvm::dyn_cast<llvm::Constant>(part)) return llvm::ConstantVector::getSplat(count, constant);
  return builder.CreateVectorSplat(count, part);
}

void unify(Builder& builder, const Domain& domain, llvm::Value*& a, llvm::Value*& b) {
  if (a->getType() == b->getType()) return;
  a = broadcast(builder, domain, a);
  b = broadcast(builder, domain, b);
}

llvm::Value* from_memory(Builder& builder, ValueType type, llvm::Value* loaded) {
  if (type != ValueType::Boolean) return loaded;
  return builder.CreateICmpNE(loaded, llvm::Constant::getNullValue(loaded->getType()));
}

llvm::Value* to_memory(Builder& builder, const Domain& domain, ValueType type, llvm::Value* value) {
  if (type != ValueType::Boolean) return value;
  return builder.CreateZExt(value, domain.memory_part(type, value->getType()->isVectorTy()));
}

llvm::Value* any_lane(Builder& builder, llvm::Value* mask) {
  auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(mask->getType());
  if (vector == nullptr) return mask;
  llvm::Type* bits = builder.getIntNTy(vector->getNumElements());
  return builder.CreateICmpNE(builder.CreateBitCast(mask, bits), llvm::ConstantInt::get(bits, 0));
}

} // namespace moonshade::codegen
