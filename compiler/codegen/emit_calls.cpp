// Calls of the library's exports and of functions of the module (emitter.h).
#include "compiler/codegen/emitter.h"

#include "stdlib/images.h"

namespace moonshade::codegen {

// --------------------------------------------------------------------------------------------------------- Library

namespace {

/// All results of a row, as bits.
constexpr uint32_t kAllResults = ~0U;
bool is_wanted(uint32_t wanted, unsigned result) { return result >= 32 || (wanted >> result & 1) != 0; }

/// Which results the code asks for: those of `wanted`, or all.
uint32_t asked_results(const LibraryFunction& row, uint32_t wanted) {
  const uint32_t all = row.result_count < 32 ? (1U << row.result_count) - 1 : kAllResults;
  if ((wanted & all) == all || is_derivative_export(row.symbol)) return kAllResults; // derivatives take no null
  return wanted & all;
}

/// Calls an export, which takes pointers (library.h): the parts of its results. Those that nobody wants are zero.
llvm::SmallVector<llvm::Value*, 4> call_export(Builder& builder, llvm::function_ref<llvm::Value*(llvm::Type*)> allocate,
                                               llvm::Function& body, const LibraryFunction& row, const Domain& domain,
                                               bool varying, uint32_t wanted, llvm::ArrayRef<llvm::Value*> arguments) {
  const auto memory = [&](ValueType type) {
    llvm::Type* part = domain.memory_part(type, varying);
    const unsigned count = component_count(type);
    return allocate(count == 1 ? part : llvm::ArrayType::get(part, count)); // one is soon a register
  };
  const auto element = [&](ValueType type, llvm::Value* array, unsigned component) {
    if (component == 0) return array;
    return builder.CreateConstInBoundsGEP1_64(domain.memory_part(type, varying), array, component);
  };
  llvm::SmallVector<llvm::Value*, 8> pointers;
  for (unsigned i = 0; i < row.result_count; ++i)
    if (is_wanted(wanted, i))
      pointers.push_back(memory(row.results[i]));
    else
      pointers.push_back(llvm::ConstantPointerNull::get(builder.getPtrTy()));
  const auto* argument = arguments.begin();
  for (unsigned i = 0; i < row.parameter_count; ++i) {
    const ValueType type = row.parameters[i];
    pointers.push_back(memory(type));
    for (unsigned c = 0; c < component_count(type); ++c)
      builder.CreateStore(to_memory(builder, domain, type, *argument++), element(type, pointers.back(), c));
  }
  builder.CreateCall(&body, pointers);
  llvm::SmallVector<llvm::Value*, 4> parts;
  for (unsigned i = 0; i < row.result_count; ++i) {
    const ValueType type = row.results[i];
    for (unsigned c = 0; c < component_count(type); ++c) {
      if (!is_wanted(wanted, i)) {
        parts.push_back(llvm::Constant::getNullValue(domain.part(type, varying)));
        continue;
      }
      llvm::Value* loaded = builder.CreateLoad(domain.memory_part(type, varying), element(type, pointers[i], c));
      parts.push_back(from_memory(builder, type, loaded));
    }
  }
  return parts;
}

/// The body of a function by value around an export.
void write_wrapper(llvm::Function& wrapper, llvm::Function& body, const LibraryFunction& row, const Domain& domain,
                   bool varying, uint32_t wanted) {
  Builder builder(llvm::BasicBlock::Create(domain.context, "entry", &wrapper));
  llvm::SmallVector<llvm::Value*, 8> arguments;
  for (llvm::Argument& argument : wrapper.args())
    arguments.push_back(&argument);
  const auto allocate = [&](llvm::Type* type) { return builder.CreateAlloca(type); };
  const auto parts = call_export(builder, allocate, body, row, domain, varying, wanted, arguments);
  llvm::Value* result = llvm::Constant::getNullValue(wrapper.getReturnType());
  for (unsigned part = 0; part < parts.size(); ++part)
    if (!llvm::isa<llvm::Constant>(parts[part])) result = builder.CreateInsertValue(result, parts[part], part);
  builder.CreateRet(result);
}

/// The same around the export of a second derivative, which is for one lane and takes one pointer to its results: it is
/// called for one lane after the other.
void write_lane_loop(llvm::Function& wrapper, llvm::Function& body, const LibraryFunction& row, const Domain& domain,
                     bool varying) {
  Builder builder(llvm::BasicBlock::Create(domain.context, "entry", &wrapper));
  struct Memory {
    ValueType type;
    llvm::Value *lanes, *one; ///< of all lanes; of the lane at work
    llvm::Value* at(Builder& builder, const Domain& domain, bool varying, unsigned component) const {
      return builder.CreateConstInBoundsGEP1_64(domain.memory_part(type, varying), lanes, component);
    }
  };
  const auto memory = [&](ValueType type, unsigned count) {
    const auto allocate = [&](bool wide) {
      return builder.CreateAlloca(llvm::ArrayType::get(domain.memory_part(type, wide), count));
    };
    return Memory{type, allocate(varying), allocate(false)};
  };
  unsigned numbers = 0;
  for (unsigned i = 0; i < row.result_count; ++i)
    numbers += component_count(row.results[i]);
  const Memory results = memory(ValueType::Number, numbers);
  std::vector<Memory> arguments;
  llvm::Argument* argument = wrapper.arg_begin();
  for (unsigned i = 0; i < row.parameter_count; ++i) {
    const ValueType type = row.parameters[i];
    arguments.push_back(memory(type, component_count(type)));
    for (unsigned c = 0; c < component_count(type); ++c)
      builder.CreateStore(to_memory(builder, domain, type, argument++), arguments[i].at(builder, domain, varying, c));
  }

  llvm::BasicBlock* before = builder.GetInsertBlock();
  llvm::BasicBlock* loop = llvm::BasicBlock::Create(domain.context, "lane", &wrapper);
  llvm::BasicBlock* end = llvm::BasicBlock::Create(domain.context, "end", &wrapper);
  builder.CreateBr(loop);
  builder.SetInsertPoint(loop);
  llvm::PHINode* lane = builder.CreatePHI(builder.getInt64Ty(), 2);
  lane->addIncoming(builder.getInt64(0), before);
  // One component of the lane, in the memory of all and in its own.
  const auto places = [&](const Memory& of, unsigned c) {
    llvm::Type* type = domain.memory_part(of.type, false);
    return std::pair(builder.CreateInBoundsGEP(type, of.at(builder, domain, varying, c), lane),
                     builder.CreateConstInBoundsGEP1_64(type, of.one, c));
  };
  const auto copy = [&](ValueType type, llvm::Value* from, llvm::Value* to) {
    builder.CreateStore(builder.CreateLoad(domain.memory_part(type, false), from), to);
  };
  std::vector<llvm::Value*> pointers{results.one};
  for (const Memory& of : arguments) {
    for (unsigned c = 0; c < component_count(of.type); ++c) {
      const auto [all, one] = places(of, c);
      copy(of.type, all, one);
    }
    pointers.push_back(of.one);
  }
  pointers.resize(1 + LibraryFunction::kMaxParameters,
                  llvm::ConstantPointerNull::get(llvm::PointerType::get(domain.context, 0)));
  builder.CreateCall(&body, pointers);
  for (unsigned c = 0; c < numbers; ++c) {
    const auto [all, one] = places(results, c);
    copy(ValueType::Number, one, all);
  }
  llvm::Value* next = builder.CreateAdd(lane, builder.getInt64(1));
  lane->addIncoming(next, loop);
  builder.CreateCondBr(builder.CreateICmpEQ(next, builder.getInt64(varying ? domain.width : 1)), end, loop);

  builder.SetInsertPoint(end);
  llvm::Value* result = llvm::Constant::getNullValue(wrapper.getReturnType());
  for (unsigned c = 0; c < numbers; ++c) {
    llvm::Value* loaded =
        builder.CreateLoad(domain.memory_part(ValueType::Number, varying), results.at(builder, domain, varying, c));
    result = builder.CreateInsertValue(result, from_memory(builder, ValueType::Number, loaded), c);
  }
  builder.CreateRet(result);
}

} // namespace

llvm::Function* ModuleEmitter::library_export(const LibraryFunction& row, bool varying) {
  const bool lane_by_lane = export_order(row.symbol) == 2;
  const std::string name =
      "ms_" + std::string(row.symbol) + export_ending(domain.precision, varying && !lane_by_lane ? domain.width : 1);
  if (llvm::Function* known = llvm_module.getFunction(name)) return known;
  const size_t count =
      lane_by_lane ? 1 + LibraryFunction::kMaxParameters : size_t{row.result_count} + row.parameter_count;
  const std::vector<llvm::Type*> pointers(count, llvm::PointerType::get(domain.context, 0));
  return new_function(llvm::FunctionType::get(llvm::Type::getVoidTy(domain.context), pointers, false), name, false);
}

llvm::Function* ModuleEmitter::library_function(const LibraryFunction& row, bool varying, uint32_t wanted) {
  wanted = asked_results(row, wanted);
  const bool lane_by_lane = export_order(row.symbol) == 2;
  const std::string own_name = "moonshade_" + std::string(row.symbol) +
                               export_ending(domain.precision, varying ? domain.width : 1) +
                               (wanted == kAllResults ? "" : "_" + std::to_string(wanted));
  if (llvm::Function* known = llvm_module.getFunction(own_name)) return known;
  llvm::Function* body = library_export(row, varying);
  std::vector<llvm::Type*> results, parameters;
  for (unsigned i = 0; i < row.result_count; ++i)
    results.insert(results.end(), component_count(row.results[i]), domain.part(row.results[i], varying));
  for (unsigned i = 0; i < row.parameter_count; ++i)
    parameters.insert(parameters.end(), component_count(row.parameters[i]), domain.part(row.parameters[i], varying));
  llvm::Type* result = returned_struct(domain, std::move(results));
  llvm::Function* wrapper = new_function(llvm::FunctionType::get(result, parameters, false), own_name, true);
  // Pure and total, so calls of it can be merged and moved before anything is inlined.
  wrapper->setDoesNotAccessMemory();
  wrapper->setWillReturn();
  wrapper->setSpeculatable();
  if (lane_by_lane) {
    wrapper->addFnAttr(llvm::Attribute::NoInline); // it is long, and not worth repeating
    write_lane_loop(*wrapper, *body, row, domain, varying);
  } else {
    write_wrapper(*wrapper, *body, row, domain, varying, wanted);
  }
  return wrapper;
}

/// One call of a library function; on one lane where nothing varies.
std::vector<Lanes> FunctionEmitter::library_call(const LibraryFunction& row, const std::vector<Lanes>& arguments,
                                                 uint32_t wanted) {
  bool varying = false;
  for (const Lanes& argument : arguments)
    varying |= argument.varying();
  std::vector<llvm::Value*> operands;
  for (const Lanes& argument : arguments)
    for (llvm::Value* part : argument.parts)
      operands.push_back(varying ? broadcast(builder, domain_, part) : part);
  llvm::SmallVector<llvm::Value*, 4> parts;
  if (owner_.calls_exports && export_order(row.symbol) < 2) {
    const auto allocate = [&](llvm::Type* type) { return masks.allocate(type, "memory"); };
    parts = call_export(builder, allocate, *owner_.library_export(row, varying), row, domain_, varying,
                        asked_results(row, wanted), operands);
  } else {
    llvm::Value* result = builder.CreateCall(owner_.library_function(row, varying, wanted), operands);
    unsigned count = 0; // the struct may have more (returned_struct)
    for (unsigned i = 0; i < row.result_count; ++i)
      count += component_count(row.results[i]);
    for (unsigned part = 0; part < count; ++part)
      parts.push_back(builder.CreateExtractValue(result, part));
  }
  std::vector<Lanes> results(row.result_count);
  const auto* part = parts.begin();
  for (unsigned i = 0; i < row.result_count; ++i)
    for (unsigned c = 0; c < component_count(row.results[i]); ++c)
      results[i].parts.push_back(*part++);
  return results;
}

std::vector<Lanes> FunctionEmitter::call_library(ir::ValueId id, const ir::Instruction& instruction) {
  const LibraryFunction& row = *instruction.library;
  if (is_texture(row)) return texture(instruction);
  const auto further = activation_->facts->further_results.find(id);
  const uint32_t wanted = further == activation_->facts->further_results.end() ? 1 : further->second | 1;
  std::vector<Lanes> arguments;
  for (const ir::ValueId operand : instruction.operands)
    arguments.push_back(value(operand));
  if (!row.componentwise || !is_vector(instruction.type)) return library_call(row, arguments, wanted);
  // By component: a number beside a vector counts for each.
  Lanes result;
  for (unsigned c = 0; c < component_count(instruction.type); ++c) {
    std::vector<Lanes> components;
    for (const Lanes& argument : arguments)
      components.push_back({{argument.parts[argument.parts.size() == 1 ? 0 : c]}});
    result.parts.push_back(library_call(row, components, wanted)[0].parts[0]);
  }
  return {result};
}

// ----------------------------------------------------------------------------------------------- Functions of the IR

std::vector<Lanes> FunctionEmitter::call(ir::ValueId id, const ir::Instruction& instruction) {
  const ir::FunctionId callee = instruction.index;
  const ir::Signature& signature = activation_->facts->uniformity->calls.at(id);
  std::vector<Lanes> arguments;
  for (size_t i = 0; i < instruction.operands.size(); ++i) {
    Lanes argument = value(instruction.operands[i]);
    if (signature.arguments_varying[i])
      for (llvm::Value*& part : argument.parts)
        part = broadcast(builder, domain_, part);
    arguments.push_back(std::move(argument));
  }
  std::vector<Slot> captures;
  for (const ir::VariableId variable : instruction.variables)
    captures.push_back(activation_->variables[variable]);
  if (owner_.sizes.outlined[callee]) return call_outlined(callee, signature, arguments, captures);
  return call_in_place(callee, signature, std::move(arguments), std::move(captures));
}

std::vector<Lanes> FunctionEmitter::call_outlined(ir::FunctionId callee, const ir::Signature& signature,
                                                  const std::vector<Lanes>& arguments,
                                                  const std::vector<Slot>& captures) {
  const ir::Function& function = owner_.module.functions[callee];
  std::vector<llvm::Value*> operands;
  operands.push_back(constants_);
  if (domain_.width > 1) operands.push_back(masks.active());
  const FaultFacts& facts = owner_.fault_facts[callee];
  if (facts.faults || facts.steps)
    for (llvm::Value* pointer : {faults_.sites, faults_.steps, faults_.flag})
      operands.push_back(pointer);
  for (const Lanes& argument : arguments)
    operands.insert(operands.end(), argument.parts.begin(), argument.parts.end());
  for (const Slot& slot : captures)
    operands.insert(operands.end(), slot.parts.begin(), slot.parts.end());
  llvm::CallInst* result = builder.CreateCall(owner_.outlined(callee, signature), operands);
  if (facts.faults || facts.steps) check_abort();
  std::vector<Lanes> results;
  unsigned part = 0;
  for (const ValueType type : function.results) {
    Lanes lanes;
    for (unsigned c = 0; c < component_count(type); ++c)
      lanes.parts.push_back(builder.CreateExtractValue(result, part++));
    results.push_back(std::move(lanes));
  }
  return results;
}

/// The LLVM function of `id` for one signature: constants, mask, fault state, arguments, captures -> results.
llvm::Function* ModuleEmitter::outlined(ir::FunctionId id, const ir::Signature& signature) {
  if (const auto known = outlined_.find({id, signature}); known != outlined_.end()) return known->second;
  const ir::Function& function = module.functions[id];
  const ir::Uniformity& uniformity = *facts(id, signature).uniformity;
  const bool wide = domain.width > 1;
  const bool can_fault = fault_facts[id].faults || fault_facts[id].steps;
  llvm::Type* pointer = llvm::PointerType::get(domain.context, 0);
  std::vector<llvm::Type*> types{pointer};
  if (wide) types.push_back(domain.mask());
  if (can_fault) types.insert(types.end(), 3, pointer);
  for (size_t i = 0; i < function.parameters.size(); ++i)
    types.insert(types.end(), component_count(function.parameters[i]),
                 domain.part(function.parameters[i], wide && signature.arguments_varying[i]));
  for (uint32_t i = 0; i < function.captures; ++i)
    types.insert(types.end(), component_count(function.variables[i].type), pointer);
  llvm::Type* results = results_type(function, uniformity);
  llvm::Function* made = new_function(llvm::FunctionType::get(results, types, false), function.name, true);
  made->addFnAttr(llvm::Attribute::NoInline);
  outlined_[{id, signature}] = made;

  llvm::Argument* next = made->arg_begin();
  llvm::Value* constants = next++;
  llvm::Value* mask = wide ? next++ : nullptr;
  FaultState state;
  if (can_fault)
    for (llvm::Value** field : {&state.sites, &state.steps, &state.flag})
      *field = next++;
  std::vector<Lanes> arguments;
  for (const ValueType type : function.parameters) {
    arguments.emplace_back();
    for (unsigned c = 0; c < component_count(type); ++c)
      arguments.back().parts.push_back(next++);
  }
  std::vector<Slot> captures;
  for (uint32_t i = 0; i < function.captures; ++i) {
    const ir::Variable& variable = function.variables[i];
    captures.push_back({variable.type, variable.count, wide && signature.captures_varying[i], Masks::kOutside, {}});
    for (unsigned c = 0; c < component_count(variable.type); ++c)
      captures.back().parts.push_back(next++);
  }
  FunctionEmitter emitter(*this, made, mask, constants, state);
  const std::vector<Lanes> values = emitter.call_in_place(id, signature, std::move(arguments), std::move(captures));
  emitter.return_from_llvm(results, values);
  return made;
}

void FunctionEmitter::return_from_llvm(llvm::Type* type, const std::vector<Lanes>& values) {
  const auto give_back = [&](llvm::Value* result) {
    if (type->isVoidTy())
      builder.CreateRetVoid();
    else
      builder.CreateRet(result);
  };
  if (masks.open()) {
    llvm::Value* result = type->isVoidTy() ? nullptr : llvm::PoisonValue::get(type); // of what is filled in below
    unsigned part = 0;
    for (const Lanes& lanes : values)
      for (llvm::Value* value : lanes.parts)
        result = builder.CreateInsertValue(result, value, part++);
    give_back(result);
  }
  finish();
  if (!can_abort()) return;
  builder.SetInsertPoint(abort_block());
  give_back(type->isVoidTy() ? nullptr : llvm::Constant::getNullValue(type));
}

} // namespace moonshade::codegen
