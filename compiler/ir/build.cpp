// `build`, the module and its functions. See build.h.
#include "compiler/ir/build.h"

#include "compiler/ir/build_function.h"

#include <algorithm>

namespace moonshade::ir {
namespace {

/// The function's outside, from which calls are made: known before any body is translated.
Function declare(const sema::Specialisation& specialisation) {
  Function function;
  function.name = specialisation.id == 0 ? "top_level" : specialisation.name;
  function.span = specialisation.function->span;
  for (size_t i = 0; i < specialisation.parameters.size(); ++i) {
    const std::optional<ValueType> type = run_time_type(specialisation.parameters[i]);
    if (!type) continue;
    function.parameters.push_back(*type);
    function.parameter_names.emplace_back(specialisation.function->params[i]->name);
  }
  function.results = run_time_types(specialisation.results);
  function.captures = static_cast<uint32_t>(specialisation.captures.size());
  return function;
}

/// Constants in the type of the global; an integer among numbers is one.
void fill(Global& global, const std::vector<Constant>& data) {
  for (const Constant& constant : data) {
    if (const auto* vector = std::get_if<std::vector<double>>(&constant)) {
      global.numbers.insert(global.numbers.end(), vector->begin(), vector->end());
    } else if (global.type == ValueType::Boolean) {
      global.integers.push_back(std::get<bool>(constant) ? 1 : 0);
    } else if (global.type == ValueType::Integer) {
      global.integers.push_back(std::get<int64_t>(constant));
    } else {
      const auto* integer = std::get_if<int64_t>(&constant);
      global.numbers.push_back(integer != nullptr ? static_cast<double>(*integer) : std::get<double>(constant));
    }
  }
}

void declare_globals(ModuleBuild& shared) {
  const sema::Program& program = shared.program;
  shared.parameters.assign(program.info.parameters.size(), kNone);
  for (const sema::GlobalSlot& slot : program.globals) {
    const auto id = static_cast<GlobalId>(shared.module.globals.size());
    Global global{.name = slot.name, .type = slot.type, .count = slot.count};
    if (slot.data != nullptr) fill(global, *slot.data);
    if (slot.parameter != kNone && program.info.parameters[slot.parameter].type == slot.type) {
      global.parameter = slot.parameter;
      shared.parameters[slot.parameter] = id;
    }
    shared.module.globals.push_back(std::move(global));
  }
  for (uint32_t i = 0; i < program.info.parameters.size(); ++i) {
    const ParameterInfo& parameter = program.info.parameters[i];
    if ((!parameter.type && parameter.compared.empty()) || shared.parameters[i] != kNone) continue;
    shared.parameters[i] = static_cast<GlobalId>(shared.module.globals.size());
    // A string is known by its index among those that it is compared with.
    const ValueType type = parameter.type.value_or(ValueType::Integer);
    shared.module.globals.push_back({.name = parameter.name, .type = type, .parameter = i});
  }
}

/// An entry whose results the host gets in other types (integers as numbers) is a wrapper that converts them.
FunctionId entry_function(Module& module, FunctionId callee, const EntryInfo& entry) {
  // A copy: pushing the wrapper moves the functions.
  const std::vector<ValueType> results = module.functions[callee].results;
  if (entry.results == results || entry.results.size() != results.size()) return callee;
  Function wrapper;
  wrapper.name = module.functions[callee].name + ".entry";
  wrapper.span = module.functions[callee].span;
  wrapper.parameters = module.functions[callee].parameters;
  wrapper.parameter_names = module.functions[callee].parameter_names;
  wrapper.results = entry.results;
  {
    Builder b(wrapper);
    b.set_span(wrapper.span);
    std::vector<ValueId> arguments;
    arguments.reserve(wrapper.parameters.size());
    for (uint32_t i = 0; i < wrapper.parameters.size(); ++i)
      arguments.push_back(b.argument(i));
    const ValueId call = b.call(callee, results, arguments);
    std::vector<ValueId> converted;
    converted.reserve(results.size());
    for (uint32_t i = 0; i < results.size(); ++i)
      converted.push_back(b.convert(b.result(call, i, results[i]), entry.results[i]));
    b.return_values(converted);
  }
  module.functions.push_back(std::move(wrapper));
  return static_cast<FunctionId>(module.functions.size() - 1);
}

} // namespace

std::optional<ValueType> run_time_type(const sema::Type& type) {
  if (type.kind == sema::Type::Kind::Value) return type.value;
  if (type.kind == sema::Type::Kind::Table && type.table->is_element()) return ValueType::Integer;
  return {};
}

std::vector<ValueType> run_time_types(const std::vector<sema::Type>& types) {
  std::vector<ValueType> result;
  for (const sema::Type& type : types)
    if (const auto value = run_time_type(type)) result.push_back(*value);
  return result;
}

FunctionBuild::FunctionBuild(ModuleBuild& shared, const sema::Specialisation& specialisation, Function& function)
    : shared_(shared), specialisation_(specialisation), function_(function), b_(function) {
  b_.set_span(function.span);
  for (const sema::Slot* slot : specialisation.captures)
    variables_.emplace(slot, b_.variable(slot->name, slot->type, slot->count));
}

void FunctionBuild::run() {
  const syntax::Function& source = *specialisation_.function;
  find_goto_targets(*source.body);
  // Each call of a shader's function is a step of the point; the run of a file is none, nor one of the library's.
  if (source.parent != nullptr && !specialisation_.is_library) b_.step();
  receive_parameters();
  statements(*source.body);
  if (specialisation_.id == 0 && !b_.terminated()) store_globals();
  if (!function_.results.empty() && !b_.terminated()) {
    // Sema has seen that execution cannot come here (behind error(), say).
    Values zeros;
    for (const ValueType type : function_.results)
      zeros.push_back(b_.zero(type));
    b_.return_values(zeros);
  }
}

void FunctionBuild::store_globals() {
  for (GlobalId id = 0; id < shared_.program.globals.size(); ++id) {
    const sema::GlobalSlot& global = shared_.program.globals[id];
    if (shared_.module.globals[id].parameter != kNone) continue; // filled by the host
    if (global.slot == nullptr) continue;                        // data
    const VariableId variable = variable_of(*global.slot);
    if (global.count == 1) {
      b_.store_global(id, b_.load(variable));
      continue;
    }
    const VariableId counter = b_.variable("", ValueType::Integer);
    const LabelId label = b_.label();
    b_.store(counter, b_.integer(0));
    b_.loop(label, b_.block([&] {
      const ValueId index = b_.load(counter);
      b_.store_global_element(id, index, b_.load_element(variable, index));
      const ValueId next = b_.binary(Op::Add, index, b_.integer(1));
      b_.store(counter, next);
      break_if(b_.compare(Op::Le, b_.integer(global.count), next), label);
    }));
  }
}

void FunctionBuild::receive_parameters() {
  uint32_t argument = 0;
  for (size_t i = 0; i < specialisation_.parameters.size(); ++i) {
    if (!run_time_type(specialisation_.parameters[i])) continue;
    const syntax::Local& local = *specialisation_.function->params[i];
    const At at(b_, local.span);
    store_local(local, b_.argument(argument++), specialisation_.parameters[i]);
  }
}

const sema::LocalFact* FunctionBuild::local_fact(const syntax::Local& local) const {
  const auto found = specialisation_.locals.find(&local);
  return found == specialisation_.locals.end() ? nullptr : &found->second;
}

VariableId FunctionBuild::variable_of(const sema::Slot& slot) {
  const auto [found, is_new] = variables_.try_emplace(&slot, kNone);
  if (is_new) found->second = b_.variable(slot.name, slot.type, slot.count);
  return found->second;
}

void FunctionBuild::store_slot(const sema::Slot& slot, ValueId value) {
  if (value != kNone) b_.store(variable_of(slot), converted(value, slot.type));
}

void FunctionBuild::store_local(const syntax::Local& local, ValueId value, const sema::Type& type) {
  const sema::LocalFact* fact = local_fact(local);
  if (fact == nullptr) return;
  if (fact->type.kind == sema::Type::Kind::Table) value = as_table(fact->type, value, type);
  if (fact->slot != nullptr) store_slot(*fact->slot, value);
}

const sema::ExpressionFact& FunctionBuild::fact(const syntax::Expr& expr) const {
  static const sema::ExpressionFact kNothing;
  const auto found = specialisation_.expressions.find(expr.id);
  return found == specialisation_.expressions.end() ? kNothing : found->second;
}

void FunctionBuild::defect(std::string_view what) {
  b_.fault(b_.boolean(true), FaultCode::Error, "defect of the compiler: " + std::string(what));
}

Module build(const sema::Program& program, const BuildOptions& options) {
  Module module;
  module.step_limit = options.step_limit;
  const auto functions = static_cast<FunctionId>(program.specialisations.size());
  ModuleBuild shared{.program = program, .module = module, .parameters = {}, .derivatives = Derivatives(functions)};
  declare_globals(shared);
  for (const auto& specialisation : program.specialisations)
    module.functions.push_back(declare(*specialisation));
  module.init = 0;
  for (const auto& specialisation : program.specialisations)
    FunctionBuild(shared, *specialisation, module.functions[specialisation->id]).run();
  shared.derivatives.make(module);
  for (const sema::EntryPoint& entry : program.entries) {
    FunctionId function = entry.specialisation->id;
    if (const EntryInfo* described = program.info.find_entry(entry.name))
      function = entry_function(module, function, *described);
    module.entries.push_back({entry.name, function});
  }
  return module;
}

} // namespace moonshade::ir
