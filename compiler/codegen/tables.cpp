// Look-ups in registers by AVX-512: vpermi2b over 128 bytes twice for a table of 256, vpermps for one of 16 floats.
#include "compiler/codegen/tables.h"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/IntrinsicsX86.h>

#include <array>

namespace moonshade::codegen {

namespace {

using Builder = llvm::IRBuilder<>;
constexpr unsigned kRegister = 64; ///< bytes

/// For a body anew.
llvm::BasicBlock* empty(llvm::Function& function) {
  function.deleteBody();
  function.setLinkage(llvm::GlobalValue::InternalLinkage); // which the line above takes away
  return llvm::BasicBlock::Create(function.getContext(), "entry", &function);
}

llvm::Value* load(Builder& builder, llvm::Type* type, llvm::Value* from, unsigned index) {
  return builder.CreateAlignedLoad(
      type, builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), from, index * kRegister), llvm::Align(1));
}

/// result[i] = look_up(indices[i]) for each register of `lanes` lanes of 4 bytes.
template <class LookUp> void define(llvm::Function& function, unsigned lanes, llvm::Type* element, LookUp look_up) {
  Builder builder(empty(function));
  llvm::Type* bytes = llvm::FixedVectorType::get(element, kRegister * 8 / element->getScalarSizeInBits());
  for (unsigned i = 0; i < lanes * 4 / kRegister; ++i) {
    llvm::Value* result = look_up(builder, load(builder, bytes, function.getArg(2), i));
    llvm::Value* to = builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), function.getArg(0), i * kRegister);
    builder.CreateAlignedStore(result, to, llvm::Align(1));
  }
  builder.CreateRetVoid();
}

void define_256(llvm::Function& function, unsigned lanes) {
  llvm::Type* byte = llvm::Type::getInt8Ty(function.getContext());
  define(function, lanes, byte, [&](Builder& builder, llvm::Value* indices) {
    std::array<llvm::Value*, 4> part{};
    for (unsigned i = 0; i < part.size(); ++i)
      part[i] = load(builder, indices->getType(), function.getArg(1), i);
    const auto pair = [&](llvm::Value* low, llvm::Value* high) {
      return builder.CreateIntrinsic(llvm::Intrinsic::x86_avx512_vpermi2var_qi_512, {}, {low, indices, high});
    };
    llvm::Value* upper = builder.CreateICmpSLT(indices, llvm::Constant::getNullValue(indices->getType()));
    return builder.CreateSelect(upper, pair(part[2], part[3]), pair(part[0], part[1]));
  });
}

void define_16(llvm::Function& function, unsigned lanes) {
  llvm::Type* integer = llvm::Type::getInt32Ty(function.getContext());
  define(function, lanes, integer, [&](Builder& builder, llvm::Value* indices) {
    llvm::Type* floats = llvm::FixedVectorType::get(builder.getFloatTy(), kRegister / 4);
    llvm::Value* table = load(builder, floats, function.getArg(1), 0);
    return builder.CreateIntrinsic(llvm::Intrinsic::x86_avx512_permvar_sf_512, {}, {table, indices});
  });
}

} // namespace

bool has_tables(const Target& target) { return target.vector_bits == 512 && has_feature(target, "avx512vbmi"); }

void define_tables(llvm::Module& module, const Target& target) {
  llvm::Function* question = module.getFunction("moonshade_target_has_tables");
  if (question == nullptr || !has_tables(target)) return;
  {
    Builder builder(empty(*question));
    builder.CreateRet(builder.getTrue());
  }
  for (const unsigned lanes : {16U, 32U}) {
    const std::string width = "_w" + std::to_string(lanes);
    if (llvm::Function* function = module.getFunction("moonshade_table_of_256" + width)) define_256(*function, lanes);
    if (llvm::Function* function = module.getFunction("moonshade_table_of_16" + width)) define_16(*function, lanes);
  }
}

} // namespace moonshade::codegen
