// `build`, calls: of functions, of the library, of what the language makes.
#include "compiler/ir/build_function.h"
#include "stdlib/images.h"

#include <algorithm>

namespace moonshade::ir {

using namespace syntax;
using sema::CallKind;
using sema::ExpressionFact;

const LibraryFunction* find_row(std::string_view name, std::initializer_list<ValueType> types) {
  for (const LibraryFunction& row : library_overloads(name))
    if (row.parameter_count == types.size() && std::equal(types.begin(), types.end(), row.parameters.begin()))
      return &row;
  return nullptr;
}

FunctionBuild::Values FunctionBuild::call(const Expr& expr) {
  const auto* method = try_as<MethodCallExpr>(&expr);
  if (method == nullptr) effects_of(*static_cast<const CallExpr&>(expr).callee);
  const auto args = method != nullptr ? method->args : static_cast<const CallExpr&>(expr).args;
  const ExpressionFact& known = fact(expr);
  if (known.call == CallKind::Parameter) {
    const GlobalId global = shared_.parameters[known.index];
    if (global == kNone || !known.type.is_value()) return {kNone};
    return {b_.load_global(global, shared_.module.globals[global].type)};
  }
  if (known.call == CallKind::Error) {
    evaluate_list(args);
    b_.fault(b_.boolean(true), FaultCode::Error, args.empty() ? "error" : message_of(*args[0], "error"));
    // What follows is not executed, but is translated: give it a value to go on with.
    return {known.type.is_value() ? b_.zero(known.type.value) : kNone};
  }
  if (known.call == CallKind::Texture) return {texture(known, static_cast<const CallExpr&>(expr))};
  Values arguments;
  if (method != nullptr) arguments.push_back(evaluate(*method->object));
  const Values listed = evaluate_list(args);
  arguments.insert(arguments.end(), listed.begin(), listed.end());
  switch (known.call) {
  case CallKind::Specialisation:
    return call_specialisation(known, arguments);
  case CallKind::Library:
    return call_library(known, std::move(arguments));
  case CallKind::Construct:
    return {construct(known.type.value, arguments)};
  case CallKind::Convert:
    return {converted(arguments[0], known.type.value)};
  case CallKind::Modf:
    return modf(arguments[0]);
  case CallKind::ToInteger:
    return {to_integer(known, arguments[0])};
  case CallKind::TableFunction:
    return {table_function(known, fact(*args[1]).type, arguments)};
  case CallKind::Print:
    print(args, arguments);
    return {};
  case CallKind::Gradient:
    return {gradient(known, arguments[1])};
  case CallKind::Fwidth:
    return {fwidth(known, arguments[1], arguments[2])};
  case CallKind::Assert:
    assertion(expr, known, arguments[0]);
    return arguments;
  default:
    return {kNone};
  }
}

FunctionBuild::Values FunctionBuild::call_specialisation(const ExpressionFact& known, const Values& arguments) {
  const sema::Specialisation& callee = *known.callee;
  Values passed, given = arguments;
  const size_t trailing = known.trailing.size();
  if (trailing != 0) given.resize(callee.parameters.size() - trailing);
  for (const double number : known.trailing)
    given.push_back(b_.number(number));
  for (size_t i = 0; i < callee.parameters.size(); ++i)
    if (const auto type = run_time_type(callee.parameters[i]))
      passed.push_back(converted(i < given.size() ? given[i] : kNone, *type));
  const std::vector<ValueType> results = run_time_types(callee.results);
  const ValueId call = b_.call(callee.id, results, std::move(passed), captures_of(callee));
  Values values;
  uint32_t index = 0;
  for (const sema::Type& type : callee.results) {
    const std::optional<ValueType> value = run_time_type(type);
    values.push_back(value ? b_.result(call, index++, *value) : kNone);
  }
  return values;
}

std::vector<VariableId> FunctionBuild::captures_of(const sema::Specialisation& callee) {
  std::vector<VariableId> captures;
  captures.reserve(callee.captures.size());
  for (const sema::Slot* slot : callee.captures)
    captures.push_back(variable_of(*slot));
  return captures;
}

FunctionBuild::Values FunctionBuild::call_library(const ExpressionFact& known, Values arguments) {
  const LibraryFunction& row = *known.library;
  if (row.name == "math.max" || row.name == "math.min") {
    // Of any number of arguments: from the left, as lmathlib.c does.
    ValueId best = converted(arguments[0], row.results[0]);
    for (size_t i = 1; i < arguments.size(); ++i)
      best = library_value(row, row.results[0], {best, arguments[i]});
    return {best};
  }
  if (row.name == "transpose") return {transposed(arguments[0])};
  arguments.resize(std::min<size_t>(arguments.size(), row.parameter_count));
  for (size_t i = arguments.size(); i < row.parameter_count; ++i) {
    const bool integer = row.parameters[i] == ValueType::Integer;
    arguments.push_back(integer ? b_.integer(static_cast<int64_t>(row.defaults[i])) : b_.number(row.defaults[i]));
    if (row.parameters[i] == ValueType::Boolean) arguments.back() = b_.boolean(row.defaults[i] != 0);
  }
  const bool by_component = row.componentwise && known.type.is_value() && is_vector(known.type.value);
  const ValueType first = by_component ? known.type.value : row.results[0];
  const ValueId call = library_value(row, first, std::move(arguments));
  Values values = {call};
  for (uint32_t i = 1; i < row.result_count; ++i)
    values.push_back(b_.result(call, i, by_component ? first : row.results[i]));
  return values;
}

/// A matrix of one number stands for that on the diagonal; of a matrix, for its part in common, else the identity's.
FunctionBuild::Values FunctionBuild::square_numbers(ValueType type, ValueId argument) {
  const ValueType from = b_.type_of(argument);
  const unsigned size = matrix_size(type), have = is_matrix(from) ? matrix_size(from) : 0;
  const ValueId zero = b_.number(0), diagonal = have == 0 ? converted(argument, ValueType::Number) : b_.number(1);
  Values numbers;
  for (unsigned column = 0; column < size; ++column)
    for (unsigned row = 0; row < size; ++row)
      numbers.push_back(column < have && row < have ? b_.component(argument, column * have + row)
                        : column == row             ? diagonal
                                                    : zero);
  return numbers;
}

FunctionBuild::Values FunctionBuild::column_of(ValueId matrix, unsigned column) {
  const unsigned size = matrix_size(b_.type_of(matrix));
  Values numbers;
  for (unsigned row = 0; row < size; ++row)
    numbers.push_back(b_.component(matrix, column * size + row));
  return numbers;
}

/// m * v: the columns weighted by the components, summed from the first on.
ValueId FunctionBuild::matrix_times(ValueId matrix, const Values& vector) {
  const ValueType type = vector_type(static_cast<unsigned>(vector.size()));
  ValueId sum = kNone;
  for (unsigned column = 0; column < vector.size(); ++column) {
    const ValueId part =
        b_.binary(Op::Mul, b_.construct(type, column_of(matrix, column)), b_.construct(type, {vector[column]}));
    sum = sum == kNone ? part : b_.binary(Op::Add, part, sum);
  }
  return sum;
}

/// m * v, and m * n column by column.
ValueId FunctionBuild::matrix_product(ValueId left, ValueId right) {
  const unsigned size = matrix_size(b_.type_of(left));
  const auto part = [&](ValueId value, unsigned i) { return b_.component(value, i); };
  Values numbers;
  if (is_vector(b_.type_of(right))) {
    for (unsigned i = 0; i < size; ++i)
      numbers.push_back(part(right, i));
    return matrix_times(left, numbers);
  }
  for (unsigned column = 0; column < size; ++column) {
    const ValueId product = matrix_times(left, column_of(right, column));
    for (unsigned i = 0; i < size; ++i)
      numbers.push_back(part(product, i));
  }
  return b_.construct(b_.type_of(left), numbers);
}

ValueId FunctionBuild::transposed(ValueId matrix) {
  const unsigned size = matrix_size(b_.type_of(matrix));
  Values numbers;
  for (unsigned i = 0; i < size * size; ++i)
    numbers.push_back(b_.component(matrix, i % size * size + i / size));
  return b_.construct(b_.type_of(matrix), numbers);
}

/// Numbers and vectors strung together, or one number for each component.
ValueId FunctionBuild::construct(ValueType type, const Values& arguments) {
  if (is_matrix(type) && arguments.size() == 1 && arguments[0] != kNone && !is_vector(b_.type_of(arguments[0])))
    return b_.construct(type, square_numbers(type, arguments[0]));
  Values numbers;
  for (const ValueId argument : arguments) {
    if (argument == kNone) continue;
    const unsigned count = component_count(b_.type_of(argument));
    if (count == 1)
      numbers.push_back(converted(argument, ValueType::Number));
    else
      for (uint32_t i = 0; i < count; ++i)
        numbers.push_back(b_.component(argument, i));
  }
  if (numbers.empty()) numbers.push_back(b_.number(0));
  return b_.construct(type, numbers);
}

/// The integer that equals a number; a fault where there is none.
ValueId FunctionBuild::integer_of(ValueId number) {
  const ValueId call = library_value(*find_row("math.tointeger", {ValueType::Number}), ValueType::Integer, {number});
  b_.fault(b_.unary(Op::Not, b_.result(call, 1, ValueType::Boolean)), FaultCode::IntegerRange);
  return call;
}

/// lmathlib.c's math_modf; the rest of an infinity is 0.
FunctionBuild::Values FunctionBuild::modf(ValueId argument) {
  if (b_.type_of(argument) == ValueType::Integer) return {argument, b_.number(0)};
  const ValueId whole = library_value(*find_row("trunc", {ValueType::Number}), ValueType::Number, {argument});
  const ValueId is_whole = b_.compare(Op::Eq, argument, whole);
  const ValueId rest = b_.select(is_whole, b_.number(0), b_.binary(Op::Sub, argument, whole));
  return {integer_of(whole), rest};
}

ValueId FunctionBuild::to_integer(const ExpressionFact& known, ValueId argument) {
  const ValueId call = library_value(*known.library, ValueType::Integer, {argument});
  const ValueId ok = b_.result(call, 1, ValueType::Boolean);
  b_.fault(b_.unary(Op::Not, ok), FaultCode::IntegerRange);
  return call;
}

ValueId FunctionBuild::texture(const ExpressionFact& known, const CallExpr& expr) {
  const Values operands = evaluate_list(sema::texture_operands(expr));
  const ValueId width = operands.size() > 2 ? converted(operands[2], ValueType::Number) : b_.number(0);
  return b_.call_library(texture_row(), ValueType::Vec4, {b_.integer(known.index), operands[1], width});
}

void FunctionBuild::assertion(const Expr& expr, const ExpressionFact& known, ValueId condition) {
  // Anything but false and nil holds.
  if (condition == kNone || b_.type_of(condition) != ValueType::Boolean) return;
  const At at(b_, expr.span);
  const sema::Type second = known.results.size() > 1 ? known.results[1] : sema::Type{};
  const bool has_message = second.kind == sema::Type::Kind::String && !second.is_parameter;
  const std::string_view message = has_message ? second.text : "assertion failed!";
  b_.fault(b_.unary(Op::Not, condition), FaultCode::Assert, std::string(message));
}

/// The arguments as the text of the line: strings are in it, values have their places there.
void FunctionBuild::print(std::span<Expr* const> args, const Values& arguments) {
  std::vector<sema::Type> types;
  for (const Expr* arg : args)
    types.push_back(fact(*arg).type);
  if (!args.empty() && (args.back()->kind == ExprKind::Call || args.back()->kind == ExprKind::MethodCall)) {
    types.pop_back();
    const std::vector<sema::Type>& results = fact(*args.back()).results;
    types.insert(types.end(), results.begin(), results.end());
  }
  Instruction line{};
  line.op = Op::Print;
  for (size_t i = 0; i < types.size() && i < arguments.size(); ++i) {
    if (i != 0) line.text += '\t';
    if (types[i].kind != sema::Type::Kind::String) {
      line.text += kPrintValue;
      line.operands.push_back(types[i].is_value() ? converted(arguments[i], types[i].value) : b_.boolean(false));
      continue;
    }
    for (const char c : types[i].text) {
      if (c == kPrintValue || c == kPrintEscape) line.text += kPrintEscape;
      line.text += c;
    }
  }
  b_.append(std::move(line));
}

std::string FunctionBuild::message_of(const Expr& argument, std::string_view otherwise) const {
  const Expr& expr = strip_parentheses(argument);
  if (const auto* literal = try_as<StringExpr>(&expr)) return std::string(literal->value);
  const sema::Type& type = fact(expr).type;
  return std::string(type.kind == sema::Type::Kind::String ? type.text : otherwise);
}

} // namespace moonshade::ir
