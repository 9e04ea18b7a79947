// The emitter's frame: modules, functions, blocks, and the way from an instruction to what emits it (emitter.h).
#include "compiler/codegen/emitter.h"

#include <algorithm>

namespace moonshade::codegen {

using ir::Op;

ConstantsLayout layout_constants(const ir::Module& module, Precision precision) {
  ConstantsLayout layout;
  for (const ir::Global& global : module.globals) {
    const bool byte = global.type == ValueType::Boolean;
    const bool wide = global.type == ValueType::Integer || precision == Precision::F64;
    const uint64_t size = byte ? 1 : wide ? 8 : 4;
    layout.size = (layout.size + 7) / 8 * 8;
    layout.offsets.push_back(layout.size);
    layout.size += size * component_count(global.type) * global.count;
  }
  layout.size = (layout.size + 63) / 64 * 64;
  return layout;
}

FaultPlaces::FaultPlaces(const ir::Module& module) {
  for (const ir::Function& function : module.functions)
    each_instruction(function, function.body, [&](const ir::Instruction& instruction) {
      if (instruction.op != Op::Fault && instruction.op != Op::Step) return;
      numbers[&instruction] = static_cast<uint32_t>(places.size());
      places.push_back(&instruction);
    });
}

void FunctionAttributes::apply(llvm::Function& function) const {
  for (const char* name : {"target-cpu", "target-features", "tune-cpu", "prefer-vector-width", "min-legal-vector-width",
                           "stack-protector-buffer-size", "frame-pointer", "no-trapping-math", "uwtable"})
    function.removeFnAttr(name);
  function.removeFnAttr(llvm::Attribute::UWTable);
  function.removeFnAttr(llvm::Attribute::MustProgress);
  function.addFnAttr(llvm::Attribute::NoUnwind);
  function.addFnAttr("target-cpu", cpu);
  if (!features.empty()) function.addFnAttr("target-features", features);
  if (wide) function.addFnAttr("prefer-vector-width", "512");
  function.addFnAttr("no-builtins");
  // Without one the stack is not aligned to vectors that spill, and each of them may lie across two cache lines.
  function.addFnAttr("frame-pointer", "all");
  function.addFnAttr("warn-stack-size", std::to_string(max_stack));
}

// --------------------------------------------------------------------------------------------------------- Modules

ModuleEmitter::ModuleEmitter(llvm::Module& llvm_module, const ir::Module& module, const Domain& domain,
                             const FunctionAttributes& attributes, const FaultPlaces& places)
    : llvm_module(llvm_module), module(module), domain(domain), layout(layout_constants(module, domain.precision)),
      sizes(plan_sizes(module)), fault_facts(codegen::fault_facts(module)), attributes_(attributes), places_(places) {
  for (const FaultFacts& facts : fault_facts)
    has_faults |= facts.faults;
}

const FunctionFacts& ModuleEmitter::facts(ir::FunctionId function, const ir::Signature& signature) {
  auto& facts = facts_[{function, signature}];
  if (facts == nullptr) {
    const ir::Uniformity& uniformity = ir::analyse_uniformity(module, function, signature, uniformity_);
    facts = std::make_unique<FunctionFacts>(function_facts(module.functions[function], uniformity, module.step_limit));
  }
  return *facts;
}

llvm::Function* ModuleEmitter::new_function(llvm::FunctionType* type, const std::string& name, bool internal) {
  const auto linkage = internal ? llvm::Function::InternalLinkage : llvm::Function::ExternalLinkage;
  llvm::Function* function = llvm::Function::Create(type, linkage, name, llvm_module);
  attributes_.apply(*function);
  return function;
}

llvm::Type* ModuleEmitter::results_type(const ir::Function& function, const ir::Uniformity& uniformity) const {
  std::vector<llvm::Type*> parts;
  for (size_t i = 0; i < function.results.size(); ++i)
    for (unsigned c = 0; c < component_count(function.results[i]); ++c)
      parts.push_back(domain.part(function.results[i], uniformity.results_varying[i] && domain.width > 1));
  return parts.empty() ? llvm::Type::getVoidTy(domain.context) : returned_struct(domain, std::move(parts));
}

llvm::StructType* returned_struct(const Domain& domain, std::vector<llvm::Type*> parts) {
  const auto is_scalar = [](llvm::Type* part) { return part->isFloatingPointTy(); };
  const auto scalars = std::ranges::count_if(parts, is_scalar);
  if (scalars > 2)
    for (auto count = scalars; count < 5; ++count)
      parts.push_back(domain.part(ValueType::Number, false));
  return llvm::StructType::get(domain.context, parts);
}

// ------------------------------------------------------------------------------------------------------- Functions

FunctionEmitter::FunctionEmitter(ModuleEmitter& owner, llvm::Function* function, llvm::Value* mask,
                                 llvm::Value* constants, FaultState faults)
    : builder(owner.domain.context), masks(builder, owner.domain, function, mask), owner_(owner), domain_(owner.domain),
      function_(function), constants_(constants), faults_(faults) {}

std::vector<Lanes> FunctionEmitter::call_in_place(ir::FunctionId id, const ir::Signature& signature,
                                                  std::vector<Lanes> arguments, std::vector<Slot> captures) {
  const ir::Function& function = owner_.module.functions[id];
  const FunctionFacts& facts = owner_.facts(id, signature);
  Activation activation{
      &function,           &facts, std::vector<Lanes>(function.instructions.size()), {}, std::move(captures), {},
      std::move(arguments)};
  Activation* caller = std::exchange(activation_, &activation);
  activation.variables.resize(function.variables.size());
  for (size_t i = 0; i < function.results.size(); ++i) {
    activation.results.push_back(make_slot(function.results[i], 1, facts.uniformity->results_varying[i], "result"));
    activation.results.back().home = masks.depth();
    if (facts.function.varying) zero_slot(activation.results.back());
  }
  masks.function(facts.function, [&] { emit_block(function.body); });
  std::vector<Lanes> results;
  if (masks.alive())
    for (const Slot& slot : activation.results)
      results.push_back(load_slot(slot));
  activation_ = caller;
  return results;
}

llvm::BasicBlock* FunctionEmitter::abort_block() {
  if (abort_block_ == nullptr) abort_block_ = llvm::BasicBlock::Create(domain_.context, "abort", function_);
  return abort_block_;
}

/// Variables whose home begins here: their slots are made, and cleared so that no lane holds anything undefined.
void FunctionEmitter::enter_homes(const ir::Block& block) {
  for (ir::VariableId id = activation_->function->captures; id < activation_->variables.size(); ++id) {
    if (activation_->facts->homes[id] != &block) continue;
    const ir::Variable& variable = activation_->function->variables[id];
    Slot& slot = activation_->variables[id];
    slot = make_slot(variable.type, variable.count, activation_->facts->uniformity->variable_varying[id], variable.name,
                     activation_->facts->narrow[id]);
    slot.home = masks.depth();
    slot.last_loop = activation_->facts->last_loops[id];
    zero_slot(slot);
  }
}

void FunctionEmitter::emit_block(const ir::Block& block, bool loop_body) {
  enter_homes(block);
  Masks::BlockState state = masks.begin_block(loop_body);
  for (size_t i = 0; i < block.instructions.size() && masks.alive(); ++i) {
    if (!is_cheap(block, i)) masks.skip_rest(state);
    const ir::ValueId id = block.instructions[i];
    emit(id, activation_->function->instructions[id]);
  }
  masks.end_block(state);
}

void FunctionEmitter::emit(ir::ValueId id, const ir::Instruction& instruction) {
  const auto operand = [&](size_t i) -> Lanes& { return value(instruction.operands[i]); };
  const TargetFacts* facts = nullptr;
  if (instruction.op == Op::Loop || instruction.op == Op::Scope) facts = &activation_->facts->labels[instruction.index];
  switch (instruction.op) {
  case Op::ConstBoolean:
    return set(id, {{builder.getInt1(instruction.integer != 0)}});
  case Op::ConstInteger:
    return set(id, {{builder.getInt64(static_cast<uint64_t>(instruction.integer))}});
  case Op::ConstNumber:
    return set(id, {{llvm::ConstantFP::get(domain_.number(), instruction.number)}});
  case Op::Argument:
    return set(id, activation_->arguments[instruction.index]);
  case Op::LoadGlobal:
    return set(id, load_global(instruction.index));
  case Op::StoreGlobal:
    return store_global(instruction.index, operand(0));
  case Op::LoadGlobalElement:
    return set(id, load_global_element(instruction.index, operand(0)));
  case Op::StoreGlobalElement:
    return store_global_element(instruction.index, operand(0), operand(1));
  case Op::Load:
    return set(id, load_slot(activation_->variables[instruction.index]));
  case Op::Store:
    return store_slot(activation_->variables[instruction.index], operand(0));
  case Op::LoadElement:
    return set(id, load_element(activation_->variables[instruction.index], operand(0)));
  case Op::StoreElement:
    return store_element(activation_->variables[instruction.index], operand(0), operand(1));
  case Op::Add:
  case Op::Sub:
  case Op::Mul:
  case Op::Div:
  case Op::Neg:
  case Op::Fma:
  case Op::And:
  case Op::Or:
  case Op::Xor:
  case Op::Not:
  case Op::IntegerToNumber:
    return set(id, arithmetic(instruction));
  case Op::Eq:
  case Op::Ne:
  case Op::Lt:
  case Op::Le:
    return set(id, comparison(instruction));
  case Op::Select:
    return set(id, select(instruction));
  case Op::Construct:
    return set(id, construct(instruction));
  case Op::Component:
    return set(id, {{operand(0).parts[instruction.index]}});
  case Op::CallLibrary:
  case Op::Call: {
    std::vector<Lanes> results = instruction.op == Op::Call ? call(id, instruction) : call_library(id, instruction);
    if (!results.empty()) set(id, results[0]);
    activation_->call_results[id] = std::move(results);
    return;
  }
  case Op::Result:
    return set(id, activation_->call_results[instruction.operands[0]].at(instruction.index));
  case Op::If:
    return if_else(instruction);
  case Op::Loop:
    return masks.loop(instruction.index, *facts, [&] { emit_block(instruction.blocks[0], true); });
  case Op::Scope:
    return masks.scope(instruction.index, *facts, [&] { emit_block(instruction.blocks[0]); });
  case Op::Break:
    return masks.break_to(instruction.index, activation_->facts->uniformity->control_varying[id]);
  case Op::Return:
    return return_values(id, instruction);
  case Op::Fault:
    return fault(instruction);
  case Op::Step:
    return step(instruction);
  case Op::Print:
    return print(instruction);
  }
}

} // namespace moonshade::codegen
