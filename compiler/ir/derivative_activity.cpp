// Activity by iteration to the least fixed point: variables only ever gain (derivative_activity.h).
#include "compiler/ir/derivative_activity.h"

#include "compiler/ir/walk.h"

namespace moonshade::ir {

bool FunctionActivity::any() const {
  const auto is_any = [](const Activity& activity) { return activity.any(); };
  return std::ranges::any_of(results, is_any) || std::ranges::any_of(variables, is_any) ||
         std::ranges::any_of(values, is_any);
}

const FunctionActivity& ActivityAnalysis::of(const ActivityKey& key) {
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  return known_.emplace(key, analyse(key)).first->second;
}

ActivityKey ActivityAnalysis::key_of(const Instruction& call, const FunctionActivity& activity) {
  ActivityKey key{call.index, {}, {}};
  for (const ValueId operand : call.operands)
    key.arguments.push_back(activity.values[operand]);
  for (const VariableId variable : call.variables)
    key.captures.push_back(activity.variables[variable]);
  return key;
}

unsigned ActivityAnalysis::active_parameters(const Instruction& call, const FunctionActivity& activity) {
  unsigned parameters = 0;
  for (size_t i = 0; i < call.operands.size(); ++i)
    if (activity.values[call.operands[i]].any()) parameters |= 1u << i;
  return parameters;
}

SecondCall::SecondCall(const LibraryFunction& derivative, unsigned parameters) {
  if (export_order(derivative.symbol) != 1) return;
  first = &derivative_of(derivative);
  whole = library_derivative(*first->row, first->parameters | parameters);
  if (whole == nullptr || (whole->parameters & parameters) == 0) return;
  second = library_second_derivative(*whole);
  is_missing = second == nullptr;
  unsigned column = 0;
  for (unsigned i = 0; i < first->row->parameter_count; ++i) {
    if ((whole->parameters >> i & 1) == 0) continue;
    for (unsigned c = 0; c < component_count(first->row->parameters[i]); ++c, ++column)
      if ((first->parameters >> i & 1) != 0) columns.push_back(column);
  }
}

unsigned SecondCall::used(uint32_t index, unsigned k) const {
  const unsigned results = first->row->result_count, result = index % results, list = index / results;
  const unsigned by_k = whole->used[whole->index(k, result)];
  return list == 0 ? by_k : by_k & whole->used[whole->index(columns[list - 1], result)];
}

FunctionActivity ActivityAnalysis::analyse(const ActivityKey& key) {
  const Function& function = module_.functions[key.function];
  FunctionActivity activity;
  activity.values.resize(function.instructions.size());
  activity.variables.resize(function.variables.size());
  activity.results.resize(function.results.size());
  std::ranges::copy(key.captures, activity.variables.begin());
  for (bool changed = true; changed;) {
    changed = false;
    for_each_instruction(function, [&](ValueId id) {
      const Instruction& instruction = function.instructions[id];
      switch (instruction.op) {
      case Op::Store:
      case Op::StoreElement:
        changed |= activity.variables[instruction.index].add(activity.values[instruction.operands.back()]);
        break;
      case Op::Return:
        for (size_t i = 0; i < instruction.operands.size(); ++i)
          activity.results[i].add(activity.values[instruction.operands[i]]);
        break;
      default:
        activity.values[id] = value(function, id, key, activity, changed);
      }
    });
    // Two captures may be one variable; what one gains the caller gives to both, and calls again.
  }
  return activity;
}

namespace {

/// Of one of the results of a call of a derivative.
Activity derivative_call(const Function& function, const Instruction& call, const FunctionActivity& activity,
                         uint32_t index) {
  Activity result;
  const SecondCall second(*call.library, ActivityAnalysis::active_parameters(call, activity));
  if (second.second == nullptr) return result;
  unsigned column = 0;
  for (size_t i = 0; i < call.operands.size(); ++i) {
    if ((second.whole->parameters >> i & 1) == 0) continue;
    const ValueId operand = call.operands[i];
    for (unsigned c = 0; c < component_count(function.instructions[operand].type); ++c, ++column)
      for (unsigned r = 0; r < component_count(second.first->function.results[index]); ++r)
        if ((second.used(index, column) >> r & 1) != 0) result.add_component(r, activity.values[operand], c);
  }
  return result;
}

/// Of one of the call's results, by the library's derivative.
Activity library_call(const Function& function, const Instruction& call, const FunctionActivity& activity,
                      uint32_t index) {
  if (is_derivative_export(call.library->symbol)) return derivative_call(function, call, activity, index);
  Activity result;
  if (call.library->name == "inverse") { // by the product rule (derivative.cpp)
    const unsigned count = component_count(call.type);
    for (unsigned r = 0; r < count; ++r)
      for (unsigned c = 0; c < count; ++c)
        result.add_component(r, activity.values[call.operands[0]], c);
    return result;
  }
  const LibraryDerivative* derivative =
      library_derivative(*call.library, ActivityAnalysis::active_parameters(call, activity));
  if (derivative == nullptr) return result;
  const bool by_component = call.library->componentwise && is_vector(call.type);
  const unsigned components = component_count(index == 0 ? call.type : call.library->results[index]);
  unsigned column = 0;
  for (size_t i = 0; i < call.operands.size(); ++i) {
    if ((derivative->parameters >> i & 1) == 0) continue;
    const ValueId operand = call.operands[i];
    for (unsigned c = 0; c < component_count(call.library->parameters[i]); ++c, ++column)
      for (unsigned r = 0; r < components; ++r)
        if (by_component)
          result.add_component(r, activity.values[operand], operand_component(function, operand, r));
        else if ((derivative->used[derivative->index(column, index)] >> r & 1) != 0)
          result.add_component(r, activity.values[operand], c);
  }
  return result;
}

bool has_numbers(ValueType type) { return type != ValueType::Boolean && type != ValueType::Integer; }

} // namespace

Activity ActivityAnalysis::value(const Function& function, ValueId id, const ActivityKey& key,
                                 FunctionActivity& activity, bool& changed) {
  const Instruction& instruction = function.instructions[id];
  const auto operand = [&](size_t i) -> const Activity& { return activity.values[instruction.operands[i]]; };
  Activity result;
  switch (instruction.op) {
  case Op::Argument:
    return key.arguments[instruction.index];
  case Op::Load:
  case Op::LoadElement:
    return activity.variables[instruction.index];
  case Op::Add:
  case Op::Sub:
  case Op::Mul:
  case Op::Div:
  case Op::Neg:
  case Op::Fma:
    for (size_t i = 0; i < instruction.operands.size(); ++i)
      result.add(operand(i));
    return result;
  case Op::Select:
    result.add(operand(1));
    result.add(operand(2));
    return result;
  case Op::Construct:
    for (unsigned c = 0; c < component_count(instruction.type); ++c)
      result.add_component(c, operand(instruction.operands.size() == 1 ? 0 : c), 0);
    return result;
  case Op::Component:
    result.add_component(0, operand(0), instruction.index);
    return result;
  case Op::CallLibrary:
    return has_numbers(instruction.type) ? library_call(function, instruction, activity, 0) : result;
  case Op::Call: {
    const FunctionActivity& callee = of(key_of(instruction, activity));
    for (size_t i = 0; i < instruction.variables.size(); ++i)
      changed |= activity.variables[instruction.variables[i]].add(callee.variables[i]);
    return callee.results.empty() ? result : callee.results[0];
  }
  case Op::Result:
    if (const Instruction& call = function.instructions[instruction.operands[0]]; call.op == Op::Call)
      return of(key_of(call, activity)).results[instruction.index];
    else if (call.op == Op::CallLibrary && has_numbers(instruction.type))
      return library_call(function, call, activity, instruction.index);
    return result;
  default:
    return result;
  }
}

} // namespace moonshade::ir
