// The verifier. See verify.h. One walk over the blocks of each function keeps the set of visible values and the stack
// of enclosing labels; a check of each instruction by itself compares its operands with what ir.h says of its
// operation.
#include "compiler/ir/verify.h"

#include "compiler/ir/builder.h"

#include <algorithm>
#include <span>
#include <sstream>

namespace moonshade::ir {
namespace {

using enum ValueType;

constexpr size_t kMaxDepth = 4000; ///< nesting of blocks beyond which something has gone wrong

class FunctionVerifier {
public:
  FunctionVerifier(const Module& module, const Function& function, std::vector<std::string>& violations)
      : module_(module), function_(function), violations_(violations), state_(function.instructions.size()) {}

  void verify() {
    if (function_.captures > function_.variables.size()) fail("more captures than variables");
    for (const Variable& variable : function_.variables)
      if (variable.count == 0) fail("variable '" + variable.name + "' of no values");
    verify_block(function_.body);
    if (!function_.results.empty() && falls_through(function_, function_.body))
      fail("the end can be reached without a return");
  }

private:
  enum class State : uint8_t { Unseen, Visible, Gone };

  void fail(const std::string& what) { violations_.push_back(function_.name + ": " + what); }
  void fail(ValueId id, const std::string& what) {
    fail(std::string(info(function_.instructions[id].op).name) + " (instruction " + std::to_string(id) + "): " + what);
  }

  void verify_block(const Block& block) {
    if (++depth_ > kMaxDepth) {
      fail("blocks nested too deeply");
    } else {
      for (size_t i = 0; i < block.instructions.size(); ++i) {
        const ValueId id = block.instructions[i];
        if (id >= function_.instructions.size()) {
          fail("a block names instruction " + std::to_string(id) + ", which does not exist");
          continue;
        }
        const Op op = function_.instructions[id].op;
        if ((op == Op::Break || op == Op::Return) && i + 1 != block.instructions.size())
          fail(id, "is followed by another instruction");
        if (state_[id] != State::Unseen) {
          fail(id, "stands in blocks twice");
          continue;
        }
        verify_instruction(id);
        state_[id] = State::Visible;
      }
    }
    for (const ValueId id : block.instructions)
      if (id < state_.size()) state_[id] = State::Gone;
    --depth_;
  }

  void verify_instruction(ValueId id) {
    const Instruction& instruction = function_.instructions[id];
    const int expected = info(instruction.op).operands;
    if (expected >= 0 && instruction.operands.size() != static_cast<size_t>(expected))
      return fail(id, "has " + std::to_string(instruction.operands.size()) + " operands");
    for (const ValueId operand : instruction.operands) {
      if (operand >= function_.instructions.size())
        return fail(id, "operand " + std::to_string(operand) + " does not exist");
      if (state_[operand] != State::Visible)
        return fail(id, "operand " + std::to_string(operand) + " is not visible here");
      if (!gives_value(operand)) return fail(id, "operand " + std::to_string(operand) + " has no value");
    }
    if (info(instruction.op).shape != OpShape::Block && !instruction.blocks.empty()) fail(id, "has blocks");
    verify_operation(id, instruction);
  }

  bool gives_value(ValueId id) const {
    const Instruction& instruction = function_.instructions[id];
    switch (instruction.op) {
    case Op::Load:
    case Op::LoadGlobal:
    case Op::LoadElement:
    case Op::LoadGlobalElement:
      return true;
    case Op::Call:
      return instruction.index < module_.functions.size() && !module_.functions[instruction.index].results.empty();
    default:
      return info(instruction.op).shape == OpShape::Value;
    }
  }

  ValueType operand_type(const Instruction& instruction, size_t i) const {
    return function_.instructions[instruction.operands[i]].type;
  }

  /// All operands from `first` on are of `type`.
  void expect_operands(ValueId id, size_t first, ValueType type) {
    const Instruction& instruction = function_.instructions[id];
    for (size_t i = first; i < instruction.operands.size(); ++i)
      if (operand_type(instruction, i) != type)
        fail(id, "operand " + std::to_string(i) + " is " + std::string(name_of(operand_type(instruction, i))) +
                     " instead of " + std::string(name_of(type)));
  }

  void expect_type(ValueId id, ValueType type) {
    if (function_.instructions[id].type != type)
      fail(id, "has type " + std::string(name_of(function_.instructions[id].type)) + " instead of " +
                   std::string(name_of(type)));
  }

  void expect_type_in(ValueId id, ValueType type, std::initializer_list<ValueType> allowed) {
    if (std::ranges::find(allowed, type) == allowed.end()) fail(id, "cannot work on " + std::string(name_of(type)));
  }

  void verify_operation(ValueId id, const Instruction& instruction) {
    switch (instruction.op) {
    case Op::ConstBoolean:
      expect_type(id, Boolean);
      if (instruction.integer != 0 && instruction.integer != 1) fail(id, "is neither 0 nor 1");
      return;
    case Op::ConstInteger:
      return expect_type(id, Integer);
    case Op::ConstNumber:
      return expect_type(id, Number);
    case Op::Argument:
      if (instruction.index >= function_.parameters.size()) return fail(id, "names no parameter");
      return expect_type(id, function_.parameters[instruction.index]);
    case Op::LoadGlobal:
    case Op::StoreGlobal:
    case Op::LoadGlobalElement:
    case Op::StoreGlobalElement:
      return verify_global(id, instruction);
    case Op::Load:
    case Op::Store:
    case Op::LoadElement:
    case Op::StoreElement:
      return verify_variable(id, instruction);
    case Op::Add:
    case Op::Sub:
    case Op::Mul:
    case Op::Neg:
      expect_type_in(id, instruction.type, {Integer, Number, Vec2, Vec3, Vec4, Mat3, Mat4});
      return expect_operands(id, 0, instruction.type);
    case Op::Div:
      expect_type_in(id, instruction.type, {Number, Vec2, Vec3, Vec4, Mat3, Mat4});
      return expect_operands(id, 0, instruction.type);
    case Op::Fma:
      expect_type_in(id, instruction.type, {Number, Vec2, Vec3, Vec4});
      return expect_operands(id, 0, instruction.type);
    case Op::And:
    case Op::Or:
    case Op::Xor:
    case Op::Not:
      expect_type_in(id, instruction.type, {Boolean, Integer});
      return expect_operands(id, 0, instruction.type);
    case Op::Eq:
    case Op::Ne:
      expect_type(id, Boolean);
      expect_type_in(id, operand_type(instruction, 0), {Boolean, Integer, Number, Vec2, Vec3, Vec4, Mat3, Mat4});
      return expect_operands(id, 1, operand_type(instruction, 0));
    case Op::Lt:
    case Op::Le:
      expect_type(id, Boolean);
      expect_type_in(id, operand_type(instruction, 0), {Integer, Number});
      return expect_operands(id, 1, operand_type(instruction, 0));
    case Op::IntegerToNumber:
      expect_type(id, Number);
      return expect_operands(id, 0, Integer);
    case Op::Select:
      if (operand_type(instruction, 0) != Boolean) fail(id, "condition is not boolean");
      return expect_operands(id, 1, instruction.type);
    case Op::Construct:
      expect_type_in(id, instruction.type, {Vec2, Vec3, Vec4, Mat3, Mat4});
      if (instruction.operands.size() != 1 && instruction.operands.size() != component_count(instruction.type))
        fail(id, "has " + std::to_string(instruction.operands.size()) + " numbers");
      return expect_operands(id, 0, Number);
    case Op::Component:
      expect_type(id, Number);
      expect_type_in(id, operand_type(instruction, 0), {Vec2, Vec3, Vec4, Mat3, Mat4});
      if (instruction.index >= component_count(operand_type(instruction, 0))) fail(id, "index out of range");
      return;
    case Op::CallLibrary:
      return verify_library_call(id, instruction);
    case Op::Call:
      return verify_call(id, instruction);
    case Op::Result:
      return verify_result(id, instruction);
    case Op::If:
      if (instruction.blocks.size() != 2) return fail(id, "has not two blocks");
      expect_operands(id, 0, Boolean);
      verify_block(instruction.blocks[0]);
      return verify_block(instruction.blocks[1]);
    case Op::Loop:
    case Op::Scope:
      return verify_labelled(id, instruction);
    case Op::Break:
      if (std::ranges::find(labels_, instruction.index) == labels_.end()) fail(id, "names no enclosing loop or scope");
      return;
    case Op::Return:
      if (instruction.operands.size() != function_.results.size()) return fail(id, "number of results is wrong");
      for (size_t i = 0; i < function_.results.size(); ++i)
        if (operand_type(instruction, i) != function_.results[i]) fail(id, "type of result " + std::to_string(i));
      return;
    case Op::Fault:
      if (instruction.fault == FaultCode::None) fail(id, "has no code");
      return expect_operands(id, 0, Boolean);
    case Op::Step:
    case Op::Print:
      return;
    }
  }

  void verify_global(ValueId id, const Instruction& instruction) {
    if (instruction.index >= module_.globals.size()) return fail(id, "names no global");
    const Global& global = module_.globals[instruction.index];
    const bool element = instruction.op == Op::LoadGlobalElement || instruction.op == Op::StoreGlobalElement;
    if (!element && global.count != 1) fail(id, "works on an array");
    if (element && operand_type(instruction, 0) != Integer) fail(id, "index is not an integer");
    if (instruction.op == Op::LoadGlobal || instruction.op == Op::LoadGlobalElement)
      return expect_type(id, global.type);
    expect_operands(id, element ? 1 : 0, global.type);
    if (module_.init >= module_.functions.size() || &module_.functions[module_.init] != &function_)
      fail(id, "stands outside init");
    if (global.parameter != kNone) fail(id, "stores a parameter");
    if (global.has_data()) fail(id, "stores data");
  }

  void verify_variable(ValueId id, const Instruction& instruction) {
    if (instruction.index >= function_.variables.size()) return fail(id, "names no variable");
    const Variable& variable = function_.variables[instruction.index];
    const bool element = instruction.op == Op::LoadElement || instruction.op == Op::StoreElement;
    if (!element && variable.count != 1) fail(id, "works on an array");
    if (element && operand_type(instruction, 0) != Integer) fail(id, "index is not an integer");
    if (instruction.op == Op::Load || instruction.op == Op::LoadElement) return expect_type(id, variable.type);
    expect_operands(id, element ? 1 : 0, variable.type);
  }

  void verify_library_call(ValueId id, const Instruction& instruction) {
    const LibraryFunction* row = instruction.library;
    if (row == nullptr) return fail(id, "names no function");
    if (row->result_count == 0) return fail(id, "function has no result");
    if (instruction.operands.size() != row->parameter_count)
      return fail(id,
                  "has " + std::to_string(instruction.operands.size()) + " operands for " + std::string(row->symbol));
    if (row->componentwise && is_vector(instruction.type)) {
      for (size_t i = 0; i < instruction.operands.size(); ++i)
        if (const ValueType type = operand_type(instruction, i); type != Number && type != instruction.type)
          fail(id, "operand " + std::to_string(i) + " of " + std::string(row->symbol) + " is " +
                       std::string(name_of(type)));
      return;
    }
    expect_type(id, row->results[0]);
    for (size_t i = 0; i < instruction.operands.size(); ++i)
      if (operand_type(instruction, i) != row->parameters[i])
        fail(id, "operand " + std::to_string(i) + " of " + std::string(row->symbol) + " is " +
                     std::string(name_of(operand_type(instruction, i))) + " instead of " +
                     std::string(name_of(row->parameters[i])));
  }

  void verify_call(ValueId id, const Instruction& instruction) {
    if (instruction.index >= module_.functions.size()) return fail(id, "names no function");
    const Function& callee = module_.functions[instruction.index];
    if (!callee.results.empty()) expect_type(id, callee.results[0]);
    if (instruction.operands.size() != callee.parameters.size())
      return fail(id, "has " + std::to_string(instruction.operands.size()) + " arguments for " + callee.name);
    for (size_t i = 0; i < callee.parameters.size(); ++i)
      if (operand_type(instruction, i) != callee.parameters[i])
        fail(id, "argument " + std::to_string(i) + " of " + callee.name + " is " +
                     std::string(name_of(operand_type(instruction, i))));
    if (instruction.variables.size() != callee.captures) return fail(id, "captures of " + callee.name + " are missing");
    for (size_t i = 0; i < callee.captures; ++i) {
      if (instruction.variables[i] >= function_.variables.size())
        return fail(id, "binds a variable that does not exist");
      const Variable& given = function_.variables[instruction.variables[i]];
      if (given.type != callee.variables[i].type || given.count != callee.variables[i].count)
        fail(id, "binds a variable of another type to capture " + std::to_string(i) + " of " + callee.name);
    }
  }

  void verify_result(ValueId id, const Instruction& instruction) {
    const Instruction& call = function_.instructions[instruction.operands[0]];
    if (call.op == Op::Call) {
      const std::vector<ValueType>& results = module_.functions[call.index].results;
      if (instruction.index >= results.size()) return fail(id, "index out of range");
      return expect_type(id, results[instruction.index]);
    }
    if (call.op != Op::CallLibrary) return fail(id, "is not of a call");
    if (call.library == nullptr || instruction.index >= call.library->result_count)
      return fail(id, "index out of range");
    const bool by_component = call.library->componentwise && is_vector(call.type);
    expect_type(id, by_component ? call.type : call.library->results[instruction.index]);
  }

  void verify_labelled(ValueId id, const Instruction& instruction) {
    if (instruction.blocks.size() != 1) return fail(id, "has not one block");
    if (instruction.index >= function_.next_label) fail(id, "label is not below next_label");
    if (std::ranges::find(labels_, instruction.index) != labels_.end()) fail(id, "label is in use outside");
    labels_.push_back(instruction.index);
    verify_block(instruction.blocks[0]);
    labels_.pop_back();
  }

  const Module& module_;
  const Function& function_;
  std::vector<std::string>& violations_;
  std::vector<State> state_;
  std::vector<LabelId> labels_;
  size_t depth_ = 0;
};

/// Calls in a circle would make every recursive walk over the call graph endless.
class RecursionFinder {
public:
  explicit RecursionFinder(const Module& module) : module_(module), state_(module.functions.size()) {}

  bool finds(FunctionId id) {
    if (id >= module_.functions.size() || state_[id] == State::Done) return false;
    if (state_[id] == State::Open) return true;
    state_[id] = State::Open;
    const bool found = finds_in(module_.functions[id], module_.functions[id].body);
    state_[id] = State::Done;
    return found;
  }

private:
  enum class State : uint8_t { Unseen, Open, Done };

  bool finds_in(const Function& function, const Block& block) {
    return std::ranges::any_of(block.instructions, [&](ValueId id) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::Call) return finds(instruction.index);
      return std::ranges::any_of(instruction.blocks, [&](const Block& inner) { return finds_in(function, inner); });
    });
  }

  const Module& module_;
  std::vector<State> state_;
};

} // namespace

std::vector<std::string> verify(const Module& module) {
  std::vector<std::string> violations;
  for (const Function& function : module.functions)
    FunctionVerifier(module, function, violations).verify();
  const auto signature_error = [&](const std::string& what) { violations.push_back("module: " + what); };
  for (const Global& global : module.globals)
    if (global.count == 0) signature_error("global '" + global.name + "' of no values");
  if (module.init >= module.functions.size())
    signature_error("there is no init function");
  else if (const Function& init = module.functions[module.init];
           !init.parameters.empty() || !init.results.empty() || init.captures != 0)
    signature_error("init has parameters, results or captures");
  for (const Entry& entry : module.entries)
    if (entry.function >= module.functions.size())
      signature_error("entry '" + entry.name + "' names no function");
    else if (module.functions[entry.function].captures != 0)
      signature_error("entry '" + entry.name + "' has captures");
  if (violations.empty()) {
    RecursionFinder finder(module);
    for (FunctionId id = 0; id < module.functions.size(); ++id)
      if (finder.finds(id)) {
        signature_error("'" + module.functions[id].name + "' is recursive");
        break;
      }
  }
  return violations;
}

} // namespace moonshade::ir
