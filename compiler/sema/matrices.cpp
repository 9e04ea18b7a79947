// Matrices: columns of vectors. Construction, columns by a constant index, and operators: m * v, m * n; + and - of two
// matrices and * and / with a number by component.
#include "compiler/sema/walker.h"

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

TypeList Walker::construct_matrix(const CallExpr& expr, std::string_view name) {
  const Type result = Type::of(name == "mat3" ? ValueType::Mat3 : ValueType::Mat4);
  const TypeList result_list{{result}, false};
  const TypeList args = arguments(expr.args);
  unsigned components = 0;
  bool is_known = !args.open;
  bool has_matrix = false;
  for (size_t i = 0; i < args.types.size(); ++i) {
    const Type& type = args.types[i];
    has_matrix = has_matrix || is_matrix(type);
    if (is_scalar(type) || is_vector(type) || (is_matrix(type) && args.types.size() == 1)) {
      components += component_count(type.value);
      continue;
    }
    is_known = false;
    if (is_unknown(type)) continue;
    type_error(Code::ArgumentType, expr.args[std::min(i, expr.args.size() - 1)]->span,
               {std::to_string(i + 1), std::string(name), describe(type), "a number or a vector"});
  }
  if (!is_known) return result_list;
  const bool is_diagonal = args.types.size() == 1 && is_scalar(args.types[0]);
  if (components != component_count(result.value) && !is_diagonal && !has_matrix) {
    type_error(Code::ConstructorComponents, expr.span,
               {std::string(name), std::to_string(component_count(result.value)), std::to_string(components)});
    return result_list;
  }
  ExpressionFact fact;
  fact.type = result;
  fact.results = {result};
  fact.call = CallKind::Construct;
  return {{record(expr, std::move(fact))}, false};
}

Type Walker::matrix_column(const IndexExpr& expr, const Type& object) {
  const unsigned size = matrix_size(object.value);
  const Type column = Type::of(vector_type(size));
  if (const auto* key = try_as<StringExpr>(expr.key)) {
    type_error(Code::UnknownField, key->span,
               {describe(object), std::string(key->value), "; its columns are [1] to [" + std::to_string(size) + "]"});
    return unknown_type();
  }
  const auto* number = try_as<IntegerExpr>(&strip_parentheses(*expr.key));
  if (number == nullptr) {
    const Type key_type = expression(*expr.key);
    if (!is_unknown(key_type)) error(Code::NotAvailableYet, expr.key->span, {"a column whose index is no constant is"});
    return column;
  }
  if (number->value < 1 || number->value > static_cast<int64_t>(size)) {
    type_error(Code::ColumnOutside, expr.key->span, {type_name(object), std::to_string(size)});
    return column;
  }
  ExpressionFact fact;
  fact.type = column;
  const auto first = static_cast<uint8_t>((number->value - 1) * size);
  for (uint8_t i = 0; i < size; ++i)
    fact.components.push_back(static_cast<uint8_t>(first + i));
  return record(expr, std::move(fact));
}

Type Walker::matrix_arithmetic(const BinaryExpr& expr, const Type& left, const Type& right) {
  ExpressionFact fact;
  const bool is_same = left == right;
  const bool is_product = expr.op == BinaryOp::Mul;
  fact.type = is_matrix(left) ? left : right;
  fact.operand_type = fact.type.value;
  bool fits = false;
  if (is_product && is_matrix(left) && (is_same || is_vector(right))) {
    const Type vector = Type::of(vector_type(matrix_size(left.value)));
    fact.type = is_same ? left : vector;
    fits = is_same || right == vector;
  } else if (expr.op == BinaryOp::Add || expr.op == BinaryOp::Sub) {
    fits = is_same;
  } else if (is_product) {
    fits = is_scalar(left) || is_scalar(right);
  } else if (expr.op == BinaryOp::Div) {
    fits = is_scalar(right);
  }
  if (!fits) {
    type_error(Code::OperandsDoNotFit, expr.span, {std::string(spelling_of(expr.op)), describe(left), describe(right)});
    return unknown_type();
  }
  return record(expr, std::move(fact));
}

} // namespace moonshade::sema
