// `build`, derivatives: gradient and fwidth become calls of a function that is made only once all bodies are translated
// (a derivative is made from its function's body). Until then its place among the module's functions is reserved.
#include "compiler/ir/build_calculus.h"

#include "compiler/ir/build_function.h"
#include "compiler/ir/derivative.h"
#include "compiler/ir/expand_vectors.h"
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <algorithm>
#include <set>

namespace moonshade::ir {

namespace {

/// A function of one parameter around a row of the library.
Function around(const LibraryFunction& row, Span span) {
  Function function;
  function.name = row.name;
  function.span = span;
  function.parameters = {row.parameters[0]};
  function.parameter_names = {"p"};
  function.results = {row.results[0]};
  Builder b(function);
  b.set_span(span);
  std::vector<ValueId> arguments = {b.argument(0)};
  for (size_t i = 1; i < row.parameter_count; ++i) {
    const double value = row.defaults[i];
    arguments.push_back(row.parameters[i] == ValueType::Integer   ? b.integer(static_cast<int64_t>(value))
                        : row.parameters[i] == ValueType::Boolean ? b.boolean(value != 0)
                                                                  : b.number(value));
  }
  b.return_values({b.call_library(row, row.results[0], std::move(arguments))});
  return function;
}

/// Whether a derivative that is still to be made is called, in whatever depth.
bool calls_any(const Module& module, FunctionId from, const std::set<FunctionId>& missing) {
  std::vector<FunctionId> pending{from};
  std::set<FunctionId> seen{from};
  while (!pending.empty()) {
    const Function& function = module.functions[pending.back()];
    pending.pop_back();
    bool found = false;
    for_each_instruction(function, [&](ValueId id) {
      if (function.instructions[id].op != Op::Call) return;
      const FunctionId callee = function.instructions[id].index;
      found = found || missing.contains(callee);
      if (seen.insert(callee).second) pending.push_back(callee);
    });
    if (found) return true;
  }
  return false;
}

} // namespace

FunctionId Derivatives::reserve(Function function) {
  reserved_.push_back(std::move(function));
  return first_ + static_cast<FunctionId>(reserved_.size() - 1);
}

FunctionId Derivatives::of(FunctionId function, const Function& declared) {
  if (const auto known = by_function_.find(function); known != by_function_.end()) return known->second;
  Function derivative;
  derivative.name = declared.name + "'";
  derivative.span = declared.span;
  derivative.parameters = declared.parameters;
  derivative.parameter_names = declared.parameter_names;
  derivative.results = {ValueType::Number, declared.parameters[0]};
  const FunctionId id = reserve(std::move(derivative));
  by_function_.emplace(function, id);
  return id;
}

FunctionId Derivatives::of(const LibraryFunction& row, Span span) {
  if (const auto known = by_row_.find(&row); known != by_row_.end()) return known->second;
  const Function wrapper = around(row, span);
  const FunctionId id = of(reserve(wrapper), wrapper);
  by_row_.emplace(&row, id);
  return id;
}

void Derivatives::make(Module& module) {
  for (Function& function : reserved_)
    module.functions.push_back(std::move(function));
  if (by_function_.empty()) return;
  // Values in place of variables: the fewer variables, the fewer derivatives to keep.
  simplify(module);
  std::set<FunctionId> missing;
  for (const auto& [function, derivative] : by_function_)
    missing.insert(derivative);
  VectorExpander vectors(module);
  // Innermost first: a derivative is made of what is there. There is no recursion, so each round makes some.
  while (!missing.empty()) {
    const size_t before = missing.size();
    for (const auto& [function, derivative] : by_function_) {
      if (!missing.contains(derivative) || calls_any(module, function, missing)) continue;
      constexpr uint32_t kFirst[] = {0};
      const FunctionId made = add_gradient(module, vectors.expanded(function), kFirst);
      module.functions[derivative] = std::move(module.functions[made]);
      module.functions.erase(module.functions.begin() + made);
      missing.erase(derivative);
    }
    if (missing.size() == before) return; // sema has refused recursion
  }
}

/// The gradient of a call's first argument, by which the function is differentiated.
ValueId FunctionBuild::gradient(const sema::ExpressionFact& known, ValueId point) {
  const ValueType type = b_.type_of(point) == ValueType::Integer ? ValueType::Number : b_.type_of(point);
  point = converted(point, type);
  if (known.callee == nullptr) {
    const LibraryFunction& row = *known.library;
    if (row.results[0] != ValueType::Number) return b_.zero(type);
    const FunctionId derivative = shared_.derivatives.of(row, b_.span());
    const ValueType results[] = {ValueType::Number, type};
    return b_.result(b_.call(derivative, results, {point}), 1, type);
  }
  const sema::Specialisation& callee = *known.callee;
  const Function& function = shared_.module.functions[callee.id];
  const bool is_constant = function.parameters.empty() || function.results[0] != ValueType::Number;
  if (is_constant) { // called for its faults alone
    Values arguments(function.parameters.size(), point);
    b_.call(callee.id, function.results, std::move(arguments), captures_of(callee));
    return b_.zero(type);
  }
  const FunctionId derivative = shared_.derivatives.of(callee.id, function);
  const ValueType results[] = {ValueType::Number, type};
  return b_.result(b_.call(derivative, results, {point}, captures_of(callee)), 1, type);
}

ValueId FunctionBuild::fwidth(const sema::ExpressionFact& known, ValueId point, ValueId width) {
  const ValueId slopes = gradient(known, point);
  const unsigned count = component_count(b_.type_of(slopes));
  ValueId square = kNone;
  for (unsigned i = 0; i < count; ++i) {
    const ValueId slope = count == 1 ? slopes : b_.component(slopes, i);
    const ValueId term = b_.binary(Op::Mul, slope, slope);
    square = square == kNone ? term : b_.binary(Op::Add, square, term);
  }
  const auto of_number = [&](std::string_view name, ValueId x) {
    return b_.call_library(library_overloads(name).front(), ValueType::Number, {x});
  };
  return b_.binary(Op::Mul, of_number("sqrt", square), of_number("abs", converted(width, ValueType::Number)));
}

} // namespace moonshade::ir
