// forward_constant_globals: `local COPPER <const> = rgb(0.72, 0.43, 0.20)` is a constant wherever it is used. A global
// that init stores once, in its own body (so always), a constant or a construct of constants, is replaced by it in all
// functions. Globals that nothing loads any more go, except parameters, which the host fills.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <optional>

namespace moonshade::ir {
namespace {

bool is_constant(Op op) { return op == Op::ConstBoolean || op == Op::ConstInteger || op == Op::ConstNumber; }

/// The stored value: one instruction, and its operands where it is a construct.
struct ConstantValue {
  Instruction value;
  std::vector<Instruction> operands;
};

std::optional<ConstantValue> constant_value(const Function& function, ValueId id) {
  const Instruction& value = function.instructions[id];
  if (is_constant(value.op)) return ConstantValue{value, {}};
  if (value.op != Op::Construct) return {};
  ConstantValue result{value, {}};
  for (const ValueId operand : value.operands) {
    if (!is_constant(function.instructions[operand].op)) return {};
    result.operands.push_back(function.instructions[operand]);
  }
  return result;
}

std::vector<std::optional<ConstantValue>> find_constants(const Module& module) {
  std::vector<std::optional<ConstantValue>> constants(module.globals.size());
  std::vector<unsigned> stores(module.globals.size());
  const Function& init = module.functions[module.init];
  for_each_instruction(init, [&](ValueId id) {
    if (init.instructions[id].op == Op::StoreGlobal) ++stores[init.instructions[id].index];
  });
  for (const ValueId id : init.body.instructions) {
    const Instruction& instruction = init.instructions[id];
    if (instruction.op == Op::StoreGlobal && stores[instruction.index] == 1 &&
        module.globals[instruction.index].count == 1 && module.globals[instruction.index].parameter == kNone)
      constants[instruction.index] = constant_value(init, instruction.operands[0]);
  }
  return constants;
}

Instruction plain(Op op, ValueType type) {
  Instruction instruction;
  instruction.op = op;
  instruction.type = type;
  return instruction;
}

Instruction number(double value) {
  Instruction instruction = plain(Op::ConstNumber, ValueType::Number);
  instruction.number = value;
  return instruction;
}

/// Element `index` of a global's data.
ConstantValue datum(const Global& global, size_t index) {
  if (!global.integers.empty()) {
    Instruction value = plain(global.type == ValueType::Boolean ? Op::ConstBoolean : Op::ConstInteger, global.type);
    value.integer = global.integers[index];
    return {std::move(value), {}};
  }
  const size_t components = component_count(global.type);
  if (components == 1) return {number(global.numbers[index]), {}};
  ConstantValue result{plain(Op::Construct, global.type), {}};
  for (size_t i = 0; i < components; ++i)
    result.operands.push_back(number(global.numbers[index * components + i]));
  return result;
}

/// What a load is known to give: of a global that is a constant, or of data at a constant index.
std::optional<ConstantValue> known_load(const Module& module, const Function& function, const Instruction& load,
                                        const std::vector<std::optional<ConstantValue>>& constants) {
  if (load.op != Op::LoadGlobal && load.op != Op::LoadGlobalElement) return {};
  const Global& global = module.globals[load.index];
  if (load.op == Op::LoadGlobal) return global.has_data() ? datum(global, 0) : constants[load.index];
  const Instruction& index = function.instructions[load.operands[0]];
  const bool is_inside = index.op == Op::ConstInteger && index.integer >= 0 && index.integer < int64_t{global.count};
  if (!global.has_data() || !is_inside) return {};
  return datum(global, static_cast<size_t>(index.integer));
}

void replace_loads(const Module& module, Function& function,
                   const std::vector<std::optional<ConstantValue>>& constants) {
  rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
    const auto known = known_load(module, function, function.instructions[id], constants);
    if (!known) {
      result.push_back(id);
      return true;
    }
    const ConstantValue& constant = *known;
    Instruction value = constant.value;
    value.span = function.instructions[id].span;
    value.operands.clear();
    for (Instruction operand : constant.operands) {
      operand.span = value.span;
      function.instructions.push_back(std::move(operand));
      value.operands.push_back(static_cast<ValueId>(function.instructions.size() - 1));
      result.push_back(value.operands.back());
    }
    function.instructions[id] = std::move(value); // in place: its uses stay right
    result.push_back(id);
    return true;
  });
}

void remove_unread_globals(Module& module) {
  std::vector<bool> read(module.globals.size());
  for (const Function& function : module.functions)
    for_each_instruction(function, [&](ValueId id) {
      const Op op = function.instructions[id].op;
      if (op == Op::LoadGlobal || op == Op::LoadGlobalElement) read[function.instructions[id].index] = true;
    });
  std::vector<GlobalId> renumbered(module.globals.size(), kNone);
  std::vector<Global> kept;
  for (GlobalId i = 0; i < module.globals.size(); ++i) {
    if (!read[i] && module.globals[i].parameter == kNone) continue;
    renumbered[i] = static_cast<GlobalId>(kept.size());
    kept.push_back(std::move(module.globals[i]));
  }
  module.globals = std::move(kept);
  for (Function& function : module.functions)
    rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
      Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::LoadGlobal || instruction.op == Op::StoreGlobal ||
          instruction.op == Op::LoadGlobalElement || instruction.op == Op::StoreGlobalElement) {
        if (renumbered[instruction.index] == kNone) return true;
        instruction.index = renumbered[instruction.index];
      }
      result.push_back(id);
      return true;
    });
}

} // namespace

void forward_constant_globals(Module& module) {
  const std::vector<std::optional<ConstantValue>> constants = find_constants(module);
  for (Function& function : module.functions)
    replace_loads(module, function, constants);
  remove_unread_globals(module);
}

} // namespace moonshade::ir
