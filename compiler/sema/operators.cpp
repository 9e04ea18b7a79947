// Operators but for `and` and `or`. Integers and numbers follow Lua: `/` and `^` give a number, the other arithmetic of
// two integers an integer; vectors work by component, a scalar beside one counts for each component.
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

bool is_bitwise(BinaryOp op) {
  return op == BinaryOp::BitAnd || op == BinaryOp::BitOr || op == BinaryOp::BitXor || op == BinaryOp::Shl ||
         op == BinaryOp::Shr;
}

bool is_ordering(BinaryOp op) {
  return op == BinaryOp::Lt || op == BinaryOp::Le || op == BinaryOp::Gt || op == BinaryOp::Ge;
}

/// The library's row "op.*" for two operands of these types; vectors take the row of numbers, component by component.
const LibraryFunction* operator_row(std::string_view name, ValueType left, ValueType right) {
  const auto scalar = [](ValueType type) { return is_vector(type) ? ValueType::Number : type; };
  for (const LibraryFunction& row : library_overloads(name))
    if (row.parameter_count == 2 && row.parameters[0] == scalar(left) && row.parameters[1] == scalar(right))
      return &row;
  return nullptr;
}

std::string_view row_name(BinaryOp op) {
  switch (op) {
  case BinaryOp::Mod:
    return "op.mod";
  case BinaryOp::FloorDiv:
    return "op.idiv";
  case BinaryOp::Pow:
    return "op.pow";
  case BinaryOp::Shl:
    return "op.shl";
  case BinaryOp::Shr:
    return "op.shr";
  case BinaryOp::Lt:
  case BinaryOp::Gt:
    return "op.lt";
  case BinaryOp::Le:
  case BinaryOp::Ge:
    return "op.le";
  default:
    return "op.eq";
  }
}

} // namespace

Type Walker::unary(const UnaryExpr& expr) {
  const std::string op(spelling_of(expr.op));
  const Type operand = expression(*expr.operand);
  ExpressionFact fact;
  fact.type = operand;
  switch (expr.op) {
  case UnaryOp::Not:
    require_condition(*expr.operand, operand);
    fact.type = boolean_type();
    fact.form = OperatorForm::Logical;
    fact.operand_type = ValueType::Boolean;
    return record(expr, std::move(fact));
  case UnaryOp::Neg:
    if (!takes_arithmetic(*expr.operand, operand, op)) return unknown_type();
    fact.operand_type = operand.value;
    return record(expr, std::move(fact));
  case UnaryOp::BitNot:
    if (!takes_integer(*expr.operand, operand, op)) return integer_type();
    fact.operand_type = ValueType::Integer;
    return record(expr, std::move(fact));
  case UnaryOp::Len:
    return length_operator(expr, operand);
  }
  return unknown_type();
}

Type Walker::length_operator(const UnaryExpr& expr, const Type& operand) {
  ExpressionFact fact;
  fact.type = integer_type();
  if (operand.kind == Type::Kind::String && !operand.is_parameter) {
    fact.form = OperatorForm::Constant;
    fact.integer_constant = static_cast<int64_t>(operand.text.size());
    return record(expr, std::move(fact));
  }
  if (is_table(operand) && operand.table->kind == Table::Kind::Array) {
    fact.form = OperatorForm::Constant;
    fact.integer_constant = operand.table->length;
    return record(expr, std::move(fact));
  }
  if (operand.kind == Type::Kind::String) {
    error(Code::StringParameter, expr.operand->span);
  } else if (!is_unknown(operand)) {
    type_error(Code::OperandType, expr.operand->span, {"#", describe(operand)});
  }
  return integer_type();
}

Type Walker::binary(const BinaryExpr& expr) {
  if (expr.op == BinaryOp::And) return and_expression(expr);
  if (expr.op == BinaryOp::Or) return or_expression(expr);
  const Type left = expression(*expr.left);
  const Type right = expression(*expr.right);
  if (expr.op == BinaryOp::Concat) {
    error(Code::StringBuilding, expr.span, {"'..'"});
    return unknown_type();
  }
  if (expr.op == BinaryOp::Eq || expr.op == BinaryOp::Ne) return equality(expr, left, right);
  if (is_ordering(expr.op)) return ordering(expr, left, right);
  if (is_bitwise(expr.op)) return bitwise(expr, left, right);
  return arithmetic(expr, left, right);
}

bool Walker::takes_arithmetic(const Expr& operand, const Type& type, std::string_view op) {
  if (is_scalar(type) || is_vector(type) || is_matrix(type)) return true;
  if (!is_unknown(type)) type_error(Code::OperandType, operand.span, {std::string(op), describe(type)});
  return false;
}

bool Walker::takes_integer(const Expr& operand, const Type& type, std::string_view op) {
  if (type.is(ValueType::Integer)) return true;
  if (type.is(ValueType::Number)) {
    type_error(Code::BitwiseNumber, operand.span, {std::string(op)});
  } else if (!is_unknown(type)) {
    type_error(Code::OperandType, operand.span, {std::string(op), describe(type)});
  }
  return false;
}

void Walker::refuse_mixed(const Expr& operand, std::string_view op) {
  if (!context_.report) return;
  const auto* name = try_as<NameExpr>(&strip_parentheses(operand));
  const Variable* variable = name != nullptr && name->local != nullptr ? &variable_of(*name->local) : nullptr;
  const Expr* given = variable != nullptr ? variable->integer_given : nullptr;
  const auto* literal = given != nullptr ? try_as<IntegerExpr>(given) : nullptr;
  const std::string better = literal != nullptr ? std::to_string(literal->value) + ".0" : "0.0";
  Diagnostic& diagnostic =
      type_error(Code::MixedNumber, operand.span, {std::string(op), ", as by writing " + better + " for the integer"});
  if (given != nullptr) diagnostic.note(Code::NoteIntegerGiven, given->span);
  if (literal != nullptr) diagnostic.suggest(literal->span, better);
}

Type Walker::arithmetic(const BinaryExpr& expr, const Type& left, const Type& right) {
  const std::string op(spelling_of(expr.op));
  const bool left_fits = takes_arithmetic(*expr.left, left, op);
  const bool right_fits = takes_arithmetic(*expr.right, right, op);
  if (!left_fits || !right_fits) return unknown_type();
  if (is_matrix(left) || is_matrix(right)) return matrix_arithmetic(expr, left, right);

  const bool by_component = is_vector(left) || is_vector(right);
  if (is_vector(left) && is_vector(right) && left != right) {
    type_error(Code::OperandsDoNotFit, expr.span, {op, describe(left), describe(right)});
    return unknown_type();
  }
  const bool is_division = expr.op == BinaryOp::Div || expr.op == BinaryOp::Pow;
  const bool is_floored = expr.op == BinaryOp::FloorDiv || expr.op == BinaryOp::Mod;
  if (is_floored && !by_component && (left.mixed || right.mixed)) {
    refuse_mixed(left.mixed ? *expr.left : *expr.right, op);
    return number_type();
  }

  ExpressionFact fact;
  if (by_component) {
    fact.type = is_vector(left) ? left : right;
  } else if (is_division) {
    fact.type = number_type();
  } else if (left.is(ValueType::Integer) && right.is(ValueType::Integer)) {
    fact.type = integer_type();
  } else {
    const auto may_be_integer = [](const Type& type) { return type.mixed || type.is(ValueType::Integer); };
    fact.type = may_be_integer(left) && may_be_integer(right) ? mixed_type() : number_type();
  }
  fact.operand_type = fact.type.value;
  if (is_floored || expr.op == BinaryOp::Pow)
    fact.library = operator_row(row_name(expr.op), fact.operand_type, fact.operand_type);
  return record(expr, std::move(fact));
}

Type Walker::bitwise(const BinaryExpr& expr, const Type& left, const Type& right) {
  const std::string op(spelling_of(expr.op));
  const bool left_fits = takes_integer(*expr.left, left, op);
  const bool right_fits = takes_integer(*expr.right, right, op);
  if (!left_fits || !right_fits) return integer_type();
  ExpressionFact fact;
  fact.type = integer_type();
  fact.operand_type = ValueType::Integer;
  if (expr.op == BinaryOp::Shl || expr.op == BinaryOp::Shr)
    fact.library = operator_row(row_name(expr.op), ValueType::Integer, ValueType::Integer);
  return record(expr, std::move(fact));
}

/// A constant that the parameter's choices do not have: a typing error, probably.
void Walker::warn_of_choice(const ParameterInfo& parameter, std::string_view constant, Span span) {
  if (parameter.choices.empty()) return;
  std::vector<std::string_view> choices;
  for (const Constant& choice : parameter.choices)
    if (const auto* text = std::get_if<std::string>(&choice)) choices.push_back(*text);
  if (std::ranges::find(choices, constant) != choices.end()) return;
  error(Code::UnknownChoice, span, {parameter.name, std::string(constant), suggestion(nearest(constant, choices))});
}

/// Of a string parameter and a constant: the parameter remembers the constant, and its value is known by an index.
Type Walker::parameter_equality(const BinaryExpr& expr, const Type& left, const Type& right) {
  if (left.is_parameter && right.is_parameter) {
    error(Code::StringParameter, expr.span);
    return boolean_type();
  }
  if (!context_.report) return boolean_type();
  const std::string_view name = left.is_parameter ? left.text : right.text;
  const std::string constant(left.is_parameter ? right.text : left.text);
  std::vector<ParameterInfo>& parameters = context_.program.info.parameters;
  const auto parameter = std::ranges::find(parameters, name, &ParameterInfo::name);
  if (parameter == parameters.end()) return boolean_type(); // an error was reported
  warn_of_choice(*parameter, constant, (left.is_parameter ? expr.right : expr.left)->span);
  ExpressionFact fact;
  fact.type = boolean_type();
  fact.form = OperatorForm::Parameter;
  fact.index = static_cast<uint32_t>(parameter - parameters.begin());
  fact.integer_constant = compared_index(*parameter, constant);
  if (fact.integer_constant == kNoneCompared) {
    fact.integer_constant = static_cast<int64_t>(parameter->compared.size());
    parameter->compared.push_back(constant);
  }
  return record(expr, std::move(fact));
}

Type Walker::equality(const BinaryExpr& expr, const Type& left, const Type& right) {
  if (is_unknown(left) || is_unknown(right)) return boolean_type();
  ExpressionFact fact;
  fact.type = boolean_type();
  if (left.kind == Type::Kind::String && right.kind == Type::Kind::String) {
    if (left.is_parameter || right.is_parameter) return parameter_equality(expr, left, right);
    fact.form = OperatorForm::Constant;
    fact.integer_constant = (left.text == right.text) == (expr.op == BinaryOp::Eq);
    return record(expr, std::move(fact));
  }
  if (is_scalar(left) && is_scalar(right) && left.value != right.value) {
    fact.form = OperatorForm::Mixed;
    fact.operand_type = ValueType::Number;
    fact.library = operator_row("op.eq", ValueType::Integer, ValueType::Number);
    return record(expr, std::move(fact));
  }
  if (left.is_value() && right.is_value() && left.value == right.value) {
    fact.operand_type = left.value;
    return record(expr, std::move(fact));
  }
  const std::string op(spelling_of(expr.op));
  if (is_function(left) || is_function(right)) {
    const bool at_left = is_function(left);
    type_error(Code::OperandType, (at_left ? expr.left : expr.right)->span, {op, describe(at_left ? left : right)});
  } else {
    type_error(Code::OperandsDoNotFit, expr.span, {op, describe(left), describe(right)});
  }
  return boolean_type();
}

namespace {

/// By bytes, as stock Lua compares in the locale "C".
bool is_ordered(BinaryOp op, std::string_view left, std::string_view right) {
  switch (op) {
  case BinaryOp::Lt:
    return left < right;
  case BinaryOp::Le:
    return left <= right;
  case BinaryOp::Gt:
    return left > right;
  default:
    return left >= right;
  }
}

} // namespace

Type Walker::ordering(const BinaryExpr& expr, const Type& left, const Type& right) {
  const auto is_constant = [](const Type& type) { return type.kind == Type::Kind::String && !type.is_parameter; };
  if (is_constant(left) && is_constant(right)) {
    ExpressionFact fact;
    fact.type = boolean_type();
    fact.form = OperatorForm::Constant;
    fact.integer_constant = is_ordered(expr.op, left.text, right.text);
    return record(expr, std::move(fact));
  }
  const std::string op(spelling_of(expr.op));
  bool fits = true;
  for (const auto& [operand, type] : {std::pair{expr.left, left}, std::pair{expr.right, right}}) {
    if (is_scalar(type)) continue;
    fits = false;
    if (!is_unknown(type)) type_error(Code::OperandType, operand->span, {op, describe(type)});
  }
  if (!fits) return boolean_type();
  ExpressionFact fact;
  fact.type = boolean_type();
  if (left.value == right.value) {
    fact.operand_type = left.value;
    return record(expr, std::move(fact));
  }
  const bool swapped = expr.op == BinaryOp::Gt || expr.op == BinaryOp::Ge;
  fact.form = OperatorForm::Mixed;
  fact.operand_type = ValueType::Number;
  fact.library = swapped ? operator_row(row_name(expr.op), right.value, left.value)
                         : operator_row(row_name(expr.op), left.value, right.value);
  return record(expr, std::move(fact));
}

} // namespace moonshade::sema
