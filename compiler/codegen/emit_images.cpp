// Look-ups of images (emitter.h): one call for all lanes of a block, of what the host gives (images.h).
#include "compiler/codegen/emitter.h"

#include "compiler/codegen/images.h"
#include "stdlib/images.h"

namespace moonshade::codegen {

/// The image's number, uv and width as the host reads them, and its results: lanes side by side, number after number.
std::vector<Lanes> FunctionEmitter::texture(const ir::Instruction& instruction) {
  const bool slopes = instruction.library->result_count > 1;
  std::vector<llvm::Value*> numbers = {value(instruction.operands[1]).parts[0], value(instruction.operands[1]).parts[1],
                                       value(instruction.operands[2]).parts[0]};
  bool varying = false;
  for (const llvm::Value* number : numbers)
    varying |= number->getType()->isVectorTy();
  llvm::Type* part = domain_.part(ValueType::Number, varying);
  const unsigned results = slopes ? kTextureSlopes : kTextureValues;
  llvm::Value* given = masks.allocate(llvm::ArrayType::get(part, numbers.size()), "texture.at");
  llvm::Value* gives = masks.allocate(llvm::ArrayType::get(part, results), "texture.is");
  const auto place = [&](llvm::Value* array, unsigned i) { return builder.CreateConstInBoundsGEP1_64(part, array, i); };
  for (unsigned i = 0; i < numbers.size(); ++i)
    builder.CreateStore(varying ? broadcast(builder, domain_, numbers[i]) : numbers[i], place(given, i));

  llvm::PointerType* pointer = builder.getPtrTy();
  llvm::Value* active = llvm::ConstantPointerNull::get(pointer);
  if (varying && !masks.full()) { // the others need no look-up
    llvm::Type* bytes = domain_.lanes(builder.getInt8Ty());
    active = masks.allocate(bytes, "texture.active");
    builder.CreateStore(builder.CreateZExt(masks.active(), bytes), active);
  }
  const char* name = domain_.precision == Precision::F32 ? "moonshade_texture_f32" : "moonshade_texture_f64";
  auto* type = llvm::FunctionType::get(
      builder.getVoidTy(),
      {pointer, builder.getInt64Ty(), builder.getInt32Ty(), builder.getInt32Ty(), pointer, pointer, pointer}, false);
  llvm::Value* images = builder.CreateLoad(
      pointer, builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), constants_, owner_.image_slot));
  llvm::CallInst* call = builder.CreateCall(owner_.llvm_module.getOrInsertFunction(name, type),
                                            {images, value(instruction.operands[0]).parts[0],
                                             builder.getInt32(varying ? domain_.width : 1), builder.getInt32(results),
                                             active, given, gives});
  call->addFnAttr(llvm::Attribute::NoUnwind);

  std::vector<Lanes> made(instruction.library->result_count);
  for (unsigned i = 0; i < results; ++i)
    made[i / kTextureValues].parts.push_back(builder.CreateLoad(part, place(gives, i)));
  return made;
}

} // namespace moonshade::codegen
