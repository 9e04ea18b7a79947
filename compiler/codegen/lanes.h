// A domain, and how values of the IR look in it: a number is a `float` or a `double`, an integer an i64, a boolean an
// i1; where it differs between lanes, a vector of W of them. A value of the IR has one part for each component, and
// whether a part is uniform is told by its LLVM type alone: a uniform part is a scalar and is broadcast on demand.
//
// In memory that the host or the library sees (inputs, outputs, constants, arguments of the library, elements of
// arrays) a boolean is a byte of 0 or 1.
#pragma once

#include "stdlib/library.h"

#include <llvm/ADT/SmallVector.h>
#include <llvm/IR/IRBuilder.h>

namespace moonshade::codegen {

using Builder = llvm::IRBuilder<>;

struct Lanes {
  llvm::SmallVector<llvm::Value*, 4> parts;
  bool varying() const {
    for (const llvm::Value* part : parts)
      if (part->getType()->isVectorTy()) return true;
    return false;
  }
};

/// Number representation × width, with the LLVM types that follow.
class Domain {
public:
  Domain(llvm::LLVMContext& context, Precision precision, unsigned width)
      : context(context), precision(precision), width(width) {}

  llvm::Type* number() const;
  /// The type of one component of a `type`.
  llvm::Type* scalar(ValueType type) const;
  /// The same in memory: i8 for booleans.
  llvm::Type* memory(ValueType type) const;
  llvm::Type* lanes(llvm::Type* scalar) const;
  llvm::Type* part(ValueType type, bool varying) const { return varying ? lanes(scalar(type)) : scalar(type); }
  llvm::Type* memory_part(ValueType type, bool varying) const { return varying ? lanes(memory(type)) : memory(type); }
  unsigned memory_size(ValueType type) const;
  /// <W x i1>; i1 for W = 1.
  llvm::Type* mask() const { return lanes(llvm::Type::getInt1Ty(context)); }

  llvm::LLVMContext& context;
  const Precision precision;
  const unsigned width;
};

/// The part in every lane.
llvm::Value* broadcast(Builder& builder, const Domain& domain, llvm::Value* part);
/// Broadcasts where exactly one of the two varies.
void unify(Builder& builder, const Domain& domain, llvm::Value*& a, llvm::Value*& b);
/// From bytes of 0 and 1 to i1 and back; other types are left alone.
llvm::Value* from_memory(Builder& builder, ValueType type, llvm::Value* loaded);
llvm::Value* to_memory(Builder& builder, const Domain& domain, ValueType type, llvm::Value* value);
/// Whether a mask has a lane, as an i1.
llvm::Value* any_lane(Builder& builder, llvm::Value* mask);

} // namespace moonshade::codegen
