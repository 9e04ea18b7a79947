// Variables, elements of arrays, and the instance's globals (emitter.h).
#include "compiler/codegen/emitter.h"

namespace moonshade::codegen {

namespace {

/// Slots of up to this many parts in memory are cleared where their home begins.
constexpr uint64_t kClearedParts = 32;

} // namespace

// ------------------------------------------------------------------------------------------------------- Variables

Slot FunctionEmitter::make_slot(ValueType type, uint32_t count, bool varying, const std::string& name, bool narrow) {
  Slot slot{type, count, varying && domain_.width > 1, 0, {}};
  slot.narrow = narrow && slot.varying;
  llvm::Type* element = element_type(slot);
  llvm::Type* memory = count == 1 ? element : llvm::ArrayType::get(element, count);
  for (unsigned c = 0; c < component_count(type); ++c)
    slot.parts.push_back(masks.allocate(memory, name));
  return slot;
}

/// Plain variables mostly become registers and hold booleans as i1; arrays have addressable elements.
llvm::Type* FunctionEmitter::element_type(const Slot& slot) const {
  if (slot.narrow) return domain_.lanes(llvm::Type::getInt32Ty(domain_.context));
  return slot.count == 1 ? domain_.part(slot.type, slot.varying) : domain_.memory_part(slot.type, slot.varying);
}

void FunctionEmitter::zero_slot(const Slot& slot) {
  if (uint64_t{slot.count} * slot.parts.size() > kClearedParts) return;
  llvm::Type* element = element_type(slot);
  llvm::Type* memory = slot.count == 1 ? element : llvm::ArrayType::get(element, slot.count);
  for (llvm::Value* part : slot.parts)
    builder.CreateStore(llvm::Constant::getNullValue(memory), part);
}

Lanes FunctionEmitter::load_slot(const Slot& slot) {
  Lanes lanes;
  for (llvm::Value* part : slot.parts) {
    llvm::Value* loaded = builder.CreateLoad(element_type(slot), part);
    if (slot.narrow) loaded = builder.CreateSExt(loaded, domain_.lanes(builder.getInt64Ty()));
    lanes.parts.push_back(loaded);
  }
  return lanes;
}

void FunctionEmitter::store_slot(const Slot& slot, const Lanes& lanes) {
  for (size_t c = 0; c < slot.parts.size(); ++c) {
    llvm::Value* part = lanes.parts[c];
    if (slot.varying) {
      part = broadcast(builder, domain_, part);
      if (slot.narrow) part = builder.CreateTrunc(part, element_type(slot));
      if (!masks.plain_store(slot.home, slot.last_loop))
        part = masks.blend(part, builder.CreateLoad(element_type(slot), slot.parts[c]));
    }
    builder.CreateStore(part, slot.parts[c]);
  }
}

// -------------------------------------------------------------------------------------------------------- Elements

/// An index that is in range whatever it was: lanes that are switched off or have faulted hold anything.
llvm::Value* FunctionEmitter::clamp_index(llvm::Value* index, uint32_t count) {
  if (llvm::isa<llvm::ConstantInt>(index)) {
    const uint64_t constant = llvm::cast<llvm::ConstantInt>(index)->getZExtValue();
    return builder.getInt64(constant < count ? constant : 0);
  }
  llvm::Value* last = llvm::ConstantInt::get(index->getType(), count - 1);
  return builder.CreateBinaryIntrinsic(llvm::Intrinsic::umin, index, last);
}

/// For each lane the address of its own element `index` (a clamped <W x i64>).
llvm::Value* FunctionEmitter::lane_pointers(const Slot& slot, llvm::Value* array, llvm::Value* index) {
  llvm::Type* narrow = domain_.lanes(builder.getInt32Ty());
  llvm::Value* offset = builder.CreateTrunc(index, narrow);
  if (slot.varying) {
    llvm::SmallVector<llvm::Constant*, 32> lane_numbers;
    for (unsigned lane = 0; lane < domain_.width; ++lane)
      lane_numbers.push_back(builder.getInt32(lane));
    offset = builder.CreateMul(offset, llvm::ConstantInt::get(narrow, domain_.width));
    offset = builder.CreateAdd(offset, llvm::ConstantVector::get(lane_numbers));
  }
  return builder.CreateGEP(domain_.memory(slot.type), array, offset);
}

Lanes FunctionEmitter::load_element(const Slot& slot, const Lanes& index) {
  if (slot.count == 1) return load_slot(slot);
  llvm::Value* clamped = clamp_index(index.parts[0], slot.count);
  const bool gather = clamped->getType()->isVectorTy();
  const llvm::Align align(domain_.memory_size(slot.type));
  Lanes lanes;
  for (llvm::Value* array : slot.parts) {
    llvm::Value* loaded;
    if (gather) {
      llvm::Type* type = domain_.memory_part(slot.type, true);
      loaded = builder.CreateMaskedGather(type, lane_pointers(slot, array, clamped), align);
    } else {
      llvm::Type* type = element_type(slot);
      loaded = builder.CreateLoad(type, builder.CreateInBoundsGEP(type, array, clamped));
    }
    lanes.parts.push_back(from_memory(builder, slot.type, loaded));
  }
  return lanes;
}

void FunctionEmitter::store_element(const Slot& slot, const Lanes& index, const Lanes& lanes) {
  if (slot.count == 1) return store_slot(slot, lanes);
  llvm::Value* clamped = clamp_index(index.parts[0], slot.count);
  const bool scatter = clamped->getType()->isVectorTy();
  const llvm::Align align(domain_.memory_size(slot.type));
  for (size_t c = 0; c < slot.parts.size(); ++c) {
    llvm::Value* part = lanes.parts[c];
    if (slot.varying) part = broadcast(builder, domain_, part);
    part = to_memory(builder, domain_, slot.type, part);
    if (scatter) {
      builder.CreateMaskedScatter(part, lane_pointers(slot, slot.parts[c], clamped), align, masks.active());
      continue;
    }
    llvm::Type* type = element_type(slot);
    llvm::Value* address = builder.CreateInBoundsGEP(type, slot.parts[c], clamped);
    if (slot.varying && !masks.plain_store(slot.home, slot.last_loop))
      part = masks.blend(part, builder.CreateLoad(type, address));
    builder.CreateStore(part, address);
  }
}

// --------------------------------------------------------------------------------------------------------- Globals

llvm::Value* FunctionEmitter::global_pointer(ir::GlobalId global, unsigned component) {
  const unsigned size = domain_.memory_size(owner_.module.globals[global].type);
  return builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), constants_,
                                            owner_.layout.offsets[global] + uint64_t{component} * size);
}

Lanes FunctionEmitter::load_global(ir::GlobalId global) {
  const ValueType type = owner_.module.globals[global].type;
  Lanes lanes;
  for (unsigned c = 0; c < component_count(type); ++c) {
    llvm::LoadInst* load = builder.CreateLoad(domain_.memory(type), global_pointer(global, c));
    if (owner_.constants_are_final)
      load->setMetadata(llvm::LLVMContext::MD_invariant_load, llvm::MDNode::get(domain_.context, {}));
    lanes.parts.push_back(from_memory(builder, type, load));
  }
  return lanes;
}

void FunctionEmitter::store_global(ir::GlobalId global, const Lanes& lanes) {
  const ValueType type = owner_.module.globals[global].type;
  for (unsigned c = 0; c < component_count(type); ++c)
    builder.CreateStore(to_memory(builder, domain_, type, lanes.parts[c]), global_pointer(global, c));
}

void FunctionEmitter::store_data() {
  for (ir::GlobalId id = 0; id < owner_.module.globals.size(); ++id) {
    const ir::Global& global = owner_.module.globals[id];
    if (!global.has_data()) continue;
    llvm::Type* element = domain_.memory(global.type);
    std::vector<llvm::Constant*> values;
    for (const int64_t integer : global.integers)
      values.push_back(llvm::ConstantInt::get(element, static_cast<uint64_t>(integer)));
    for (const double number : global.numbers)
      values.push_back(llvm::ConstantFP::get(element, number));
    auto* type = llvm::ArrayType::get(element, values.size());
    auto* data = new llvm::GlobalVariable(owner_.llvm_module, type, true, llvm::GlobalValue::PrivateLinkage,
                                          llvm::ConstantArray::get(type, values), "data." + global.name);
    const llvm::Align align(domain_.memory_size(global.type));
    data->setAlignment(align);
    builder.CreateMemCpy(global_pointer(id, 0), align, data, align, values.size() * domain_.memory_size(global.type));
  }
}

/// Of the element `index` (clamped), for one value or for each lane.
llvm::Value* FunctionEmitter::global_element_pointer(ir::GlobalId global, llvm::Value* index, unsigned component) {
  const ValueType type = owner_.module.globals[global].type;
  llvm::Value* stride = llvm::ConstantInt::get(index->getType(), component_count(type));
  llvm::Value* number =
      builder.CreateAdd(builder.CreateMul(index, stride), llvm::ConstantInt::get(index->getType(), component));
  if (number->getType()->isVectorTy()) number = builder.CreateTrunc(number, domain_.lanes(builder.getInt32Ty()));
  return builder.CreateGEP(domain_.memory(type), global_pointer(global, 0), number);
}

Lanes FunctionEmitter::load_global_element(ir::GlobalId global, const Lanes& index) {
  const ir::Global& variable = owner_.module.globals[global];
  llvm::Value* clamped = clamp_index(index.parts[0], variable.count);
  const llvm::Align align(domain_.memory_size(variable.type));
  Lanes lanes;
  for (unsigned c = 0; c < component_count(variable.type); ++c) {
    llvm::Value* address = global_element_pointer(global, clamped, c);
    llvm::Instruction* load;
    if (clamped->getType()->isVectorTy())
      load = builder.CreateMaskedGather(domain_.memory_part(variable.type, true), address, align);
    else
      load = builder.CreateLoad(domain_.memory(variable.type), address);
    if (owner_.constants_are_final && llvm::isa<llvm::LoadInst>(load))
      load->setMetadata(llvm::LLVMContext::MD_invariant_load, llvm::MDNode::get(domain_.context, {}));
    lanes.parts.push_back(from_memory(builder, variable.type, load));
  }
  return lanes;
}

/// The init function alone stores globals, for one point: everything in it is uniform.
void FunctionEmitter::store_global_element(ir::GlobalId global, const Lanes& index, const Lanes& lanes) {
  const ir::Global& variable = owner_.module.globals[global];
  llvm::Value* clamped = clamp_index(index.parts[0], variable.count);
  for (unsigned c = 0; c < component_count(variable.type); ++c)
    builder.CreateStore(to_memory(builder, domain_, variable.type, lanes.parts[c]),
                        global_element_pointer(global, clamped, c));
}

} // namespace moonshade::codegen
