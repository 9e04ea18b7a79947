// `build`, expressions: values in order of evaluation, and what is evaluated only where Lua does.
#include "compiler/ir/build_function.h"
#include "compiler/ir/cost.h"
#include "compiler/syntax/folded_integer.h"
#include "stdlib/images.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace moonshade::ir {

using namespace syntax;
using sema::CallKind;
using sema::ExpressionFact;
using sema::NameKind;
using sema::OperatorForm;

namespace {

const BinaryExpr* as_operation(const Expr& expr, BinaryOp op) {
  const auto* binary = try_as<BinaryExpr>(&strip_parentheses(expr));
  return binary != nullptr && binary->op == op ? binary : nullptr;
}

/// The literal 2, for which Lua's `^` multiplies.
bool is_two(const Expr& expr) {
  const Expr& inner = strip_parentheses(expr);
  if (const auto* integer = try_as<IntegerExpr>(&inner)) return integer->value == 2;
  if (const auto* number = try_as<NumberExpr>(&inner)) return number->value == 2;
  return false;
}

bool converts(ValueType from, ValueType to) {
  if (from == to) return false;
  return (from == ValueType::Integer && to != ValueType::Boolean) ||
         (from == ValueType::Number && component_count(to) > 1);
}

/// The terms of a chain of `or`s, from the left.
std::vector<const Expr*> conditional_terms(const BinaryExpr& expr) {
  std::vector<const Expr*> terms;
  const Expr* rest = &expr;
  while (const BinaryExpr* chain = as_operation(*rest, BinaryOp::Or)) {
    terms.push_back(chain->right);
    rest = chain->left;
  }
  terms.push_back(rest);
  std::reverse(terms.begin(), terms.end());
  return terms;
}

} // namespace

ValueId FunctionBuild::converted(ValueId value, ValueType type) {
  if (value == kNone) {
    defect("a value is missing");
    return b_.zero(type);
  }
  return converts(b_.type_of(value), type) ? b_.convert(value, type) : value;
}

ValueId FunctionBuild::evaluate(const Expr& expr) {
  const At at(b_, expr.span);
  const ValueId value = evaluate_kind(expr);
  const sema::Type& type = fact(expr).type;
  return value != kNone && type.is_value() ? converted(value, type.value) : value;
}

ValueId FunctionBuild::evaluate_kind(const Expr& expr) {
  return visit(expr, Overloaded{
                         [&](const BooleanExpr& literal) { return b_.boolean(literal.value); },
                         [&](const IntegerExpr& literal) { return b_.integer(literal.value); },
                         [&](const NumberExpr& literal) { return b_.number(literal.value); },
                         [&](const ParenExpr& paren) { return evaluate(*paren.inner); },
                         [&](const NameExpr& use) { return name(use); },
                         [&](const IndexExpr& access) { return index(access); },
                         [&](const UnaryExpr& operation) { return unary(operation); },
                         [&](const BinaryExpr& operation) { return binary(operation); },
                         [&](const CallExpr& operation) {
                           const Values values = call(operation);
                           return values.empty() ? kNone : values[0];
                         },
                         [&](const MethodCallExpr& operation) {
                           const Values values = call(operation);
                           return values.empty() ? kNone : values[0];
                         },
                         [&](const TableExpr& constructor) { return table(constructor); },
                         [&](const auto&) { return kNone; }, // strings and functions
                     });
}

void FunctionBuild::effects_of(const Expr& expr) {
  if (expr.kind != ExprKind::Name) evaluate(expr);
}

FunctionBuild::Values FunctionBuild::evaluate_all(const Expr& expr) {
  if (expr.kind != ExprKind::Call && expr.kind != ExprKind::MethodCall) return {evaluate(expr)};
  const At at(b_, expr.span);
  Values values = call(expr);
  if (!values.empty() && values[0] != kNone && fact(expr).type.is_value())
    values[0] = converted(values[0], fact(expr).type.value);
  return values;
}

FunctionBuild::Values FunctionBuild::evaluate_list(std::span<Expr* const> exprs) {
  Values values;
  for (size_t i = 0; i + 1 < exprs.size(); ++i)
    values.push_back(evaluate(*exprs[i]));
  if (!exprs.empty()) {
    const Values last = evaluate_all(*exprs.back());
    values.insert(values.end(), last.begin(), last.end());
  }
  return values;
}

std::vector<sema::Type> FunctionBuild::types_of(std::span<Expr* const> exprs) const {
  std::vector<sema::Type> types;
  for (const Expr* expr : exprs) {
    const ExpressionFact& known = fact(*expr);
    const bool is_last_call =
        expr == exprs.back() && (expr->kind == ExprKind::Call || expr->kind == ExprKind::MethodCall);
    if (is_last_call && !known.results.empty())
      types.insert(types.end(), known.results.begin(), known.results.end());
    else
      types.push_back(known.type);
  }
  return types;
}

// ---- names
// -----------------------------------------------------------------------------------------------------------

ValueId FunctionBuild::constant(const ExpressionFact& known) {
  if (known.type.is(ValueType::Boolean)) return b_.boolean(known.integer_constant != 0);
  return known.type.is(ValueType::Integer) ? b_.integer(known.integer_constant) : b_.number(known.constant);
}

ValueId FunctionBuild::name(const NameExpr& expr) {
  const ExpressionFact& known = fact(expr);
  switch (known.name) {
  case NameKind::Global:
    return b_.load_global(known.index, shared_.module.globals[known.index].type);
  case NameKind::Constant:
    return constant(known);
  case NameKind::Function:
  case NameKind::Library:
    return kNone;
  case NameKind::Local:
    break;
  }
  return known.slot != nullptr ? b_.load(variable_of(*known.slot)) : kNone;
}

ValueId FunctionBuild::index(const IndexExpr& expr) {
  const ExpressionFact& known = fact(expr);
  if (known.field != nullptr) return table_index(expr);
  if (known.is_dynamic) return dynamic_component(expr);
  if (known.components.empty()) {
    effects_of(*expr.object);
    if (known.name == NameKind::Constant) return constant(known);
    return kNone; // a function of a library's table
  }
  const ValueId object = evaluate(*expr.object);
  if (object == kNone) return kNone;
  if (known.components.size() == 1) return b_.component(object, known.components[0]);
  Values numbers;
  for (const uint8_t component : known.components)
    numbers.push_back(b_.component(object, component));
  return b_.construct(vector_type(static_cast<unsigned>(numbers.size())), numbers);
}

/// v[i]: the components are chosen from, so an index that faults cannot hurt.
ValueId FunctionBuild::dynamic_component(const IndexExpr& expr) {
  const ValueId object = evaluate(*expr.object);
  ValueId index = evaluate(*expr.key);
  if (b_.type_of(index) == ValueType::Number) index = integer_of(index);
  const unsigned size = component_count(b_.type_of(object));
  const ValueId below = b_.compare(Op::Lt, index, b_.integer(1));
  const ValueId above = b_.compare(Op::Lt, b_.integer(size), index);
  b_.fault(b_.binary(Op::Or, below, above), FaultCode::Index);
  ValueId value = b_.component(object, size - 1);
  for (unsigned i = size - 1; i-- > 0;)
    value = b_.select(b_.compare(Op::Eq, index, b_.integer(i + 1)), b_.component(object, i), value);
  return value;
}

// ---- operators
// -------------------------------------------------------------------------------------------------------

ValueId FunctionBuild::unary(const UnaryExpr& expr) {
  const ExpressionFact& known = fact(expr);
  if (known.form == OperatorForm::Constant) {
    effects_of(*expr.operand);
    return constant(known);
  }
  switch (expr.op) {
  case UnaryOp::Len:
    defect("a length that is no constant");
    return b_.integer(0);
  case UnaryOp::Not:
    return b_.unary(Op::Not, evaluate_as(*expr.operand, ValueType::Boolean));
  case UnaryOp::BitNot:
    return b_.unary(Op::Not, evaluate_as(*expr.operand, ValueType::Integer));
  case UnaryOp::Neg:
    break;
  }
  const ValueId operand =
      known.type.is_value() ? evaluate_as(*expr.operand, known.type.value) : evaluate(*expr.operand);
  const Instruction& literal = b_.at(operand);
  if (literal.op == Op::ConstNumber) return b_.number(-literal.number);
  if (literal.op == Op::ConstInteger)
    return b_.integer(static_cast<int64_t>(0 - static_cast<uint64_t>(literal.integer)));
  return b_.unary(Op::Neg, operand);
}

ValueId FunctionBuild::binary(const BinaryExpr& expr) {
  const ExpressionFact& known = fact(expr);
  if (known.form == OperatorForm::Constant || known.form == OperatorForm::Parameter) {
    effects_of(*expr.left);
    effects_of(*expr.right);
  }
  if (known.form == OperatorForm::Constant) return constant(known);
  switch (expr.op) {
  case BinaryOp::Or:
    if (known.form != OperatorForm::Conditional) return logical(expr);
    return known.type.kind == sema::Type::Kind::Table ? conditional_table(expr, known.type)
                                                      : conditional(expr, known.type.value);
  case BinaryOp::And:
    return logical(expr);
  case BinaryOp::Lt:
  case BinaryOp::Gt:
  case BinaryOp::Le:
  case BinaryOp::Ge:
  case BinaryOp::Eq:
  case BinaryOp::Ne:
    return comparison(expr, known);
  default:
    return arithmetic(expr, known);
  }
}

void FunctionBuild::divisor_fault(ValueId divisor) {
  const std::optional<int64_t> value = known_integer(divisor);
  if (value && *value != 0) return;
  b_.fault(b_.compare(Op::Eq, divisor, b_.integer(0)), FaultCode::DivideByZero);
}

std::optional<int64_t> FunctionBuild::known_integer(ValueId value) const {
  const Instruction& instruction = b_.at(value);
  if (instruction.op != Op::ConstInteger) return {};
  return instruction.integer;
}

ValueId FunctionBuild::arithmetic(const BinaryExpr& expr, const ExpressionFact& known) {
  if (expr.op == BinaryOp::Pow && is_two(*expr.right)) {
    const ValueId base = evaluate_as(*expr.left, known.type.value);
    return b_.binary(Op::Mul, base, base);
  }
  if (known.library != nullptr) return library_operator(expr, known);
  Op op = Op::Add;
  switch (expr.op) {
  case BinaryOp::Add:
    op = Op::Add;
    break;
  case BinaryOp::Sub:
    op = Op::Sub;
    break;
  case BinaryOp::Mul:
    op = Op::Mul;
    break;
  case BinaryOp::Div:
    op = Op::Div;
    break;
  case BinaryOp::BitAnd:
    op = Op::And;
    break;
  case BinaryOp::BitOr:
    op = Op::Or;
    break;
  case BinaryOp::BitXor:
    op = Op::Xor;
    break;
  default:
    defect("an operator without its row of the library");
    return b_.zero(known.type.value);
  }
  // Stock Lua compiles `x - 0` with an integer 0 as `x + 0`: the two differ for x = -0.0.
  if (op == Op::Sub && known.operand_type == ValueType::Number && folded_integer(*expr.right) == 0) op = Op::Add;
  const sema::Type &left_type = fact(*expr.left).type, &right_type = fact(*expr.right).type;
  if (op == Op::Mul && is_matrix(left_type.value) && (is_matrix(right_type.value) || is_vector(right_type.value))) {
    const ValueId matrix = evaluate(*expr.left);
    return matrix_product(matrix, evaluate(*expr.right));
  }
  const ValueId left = evaluate_as(*expr.left, known.operand_type);
  const ValueId right = evaluate_as(*expr.right, known.operand_type);
  return b_.binary(op, left, right);
}

ValueId FunctionBuild::library_operator(const BinaryExpr& expr, const ExpressionFact& known) {
  const LibraryFunction& row = *known.library;
  const bool by_component = row.componentwise && is_vector(known.type.value);
  const ValueType type = by_component ? known.type.value : row.results[0];
  // Both operands are evaluated before either is converted or checked: a conversion has no effect, a fault has.
  const ValueId left = evaluate(*expr.left);
  const ValueId right = evaluate(*expr.right);
  if (by_component || !is_vector(known.type.value)) return library_value(row, type, {left, right});
  // A row of numbers alone, for vectors: component after component.
  Values numbers;
  for (uint32_t i = 0; i < component_count(known.type.value); ++i) {
    const auto part = [&](ValueId operand) {
      return is_vector(b_.type_of(operand)) ? b_.component(operand, i) : operand;
    };
    numbers.push_back(library_value(row, ValueType::Number, {part(left), part(right)}));
  }
  return b_.construct(known.type.value, numbers);
}

/// Operands are converted to what the row takes; a zero divisor of integers faults.
ValueId FunctionBuild::library_value(const LibraryFunction& row, ValueType type, Values operands) {
  const bool by_component = row.componentwise && is_vector(type);
  for (size_t i = 0; i < operands.size(); ++i) {
    if (!by_component)
      operands[i] = converted(operands[i], row.parameters[i]);
    else if (operands[i] == kNone || !is_vector(b_.type_of(operands[i])))
      operands[i] = converted(operands[i], ValueType::Number);
  }
  const bool divides = row.name == "op.idiv" || row.name == "op.mod" || row.name == "math.fmod";
  if (divides && row.parameters[1] == ValueType::Integer) divisor_fault(operands[1]);
  return b_.call_library(row, type, std::move(operands));
}

ValueId FunctionBuild::comparison(const BinaryExpr& expr, const ExpressionFact& known) {
  if (known.form == OperatorForm::Parameter) {
    const ValueId value = b_.load_global(shared_.parameters[known.index], ValueType::Integer);
    return b_.compare(expr.op == BinaryOp::Eq ? Op::Eq : Op::Ne, value, b_.integer(known.integer_constant));
  }
  if (known.form == OperatorForm::Mixed) {
    const ValueId left = evaluate(*expr.left);
    return mixed_comparison(expr.op, left, evaluate(*expr.right));
  }
  const ValueId left = evaluate_as(*expr.left, known.operand_type);
  const ValueId right = evaluate_as(*expr.right, known.operand_type);
  switch (expr.op) {
  case BinaryOp::Lt:
    return b_.compare(Op::Lt, left, right);
  case BinaryOp::Le:
    return b_.compare(Op::Le, left, right);
  case BinaryOp::Gt:
    return b_.compare(Op::Lt, right, left);
  case BinaryOp::Ge:
    return b_.compare(Op::Le, right, left);
  case BinaryOp::Eq:
    return b_.compare(Op::Eq, left, right);
  default:
    return b_.compare(Op::Ne, left, right);
  }
}

/// An integer with a number, exactly: the library's rows, with the operands the way round that a row has them.
ValueId FunctionBuild::mixed_comparison(BinaryOp op, ValueId left, ValueId right) {
  if (op == BinaryOp::Gt || op == BinaryOp::Ge) {
    std::swap(left, right);
    op = op == BinaryOp::Gt ? BinaryOp::Lt : BinaryOp::Le;
  }
  const bool equality = op == BinaryOp::Eq || op == BinaryOp::Ne;
  if (equality && b_.type_of(left) == ValueType::Number) std::swap(left, right);
  const std::string_view name = equality ? "op.eq" : op == BinaryOp::Lt ? "op.lt" : "op.le";
  const LibraryFunction* row = find_row(name, {b_.type_of(left), b_.type_of(right)});
  if (row == nullptr) {
    defect("a comparison without its row of the library");
    return b_.boolean(false);
  }
  const ValueId value = b_.call_library(*row, ValueType::Boolean, {left, right});
  return op == BinaryOp::Ne ? b_.unary(Op::Not, value) : value;
}

/// The value of `then_block` where the condition holds, else that of `else_block`; both blocks are ready and give their
/// value at the end. Cheap ones are executed both.
ValueId FunctionBuild::choose(ValueId condition, ValueType type, Block then_block, ValueId then_value, Block else_block,
                              ValueId else_value) {
  const auto then_cost = speculation_cost(function_, then_block), else_cost = speculation_cost(function_, else_block);
  if (then_cost && else_cost && *then_cost + *else_cost <= kSelectCost) {
    Block& here = b_.current();
    here.instructions.insert(here.instructions.end(), then_block.instructions.begin(), then_block.instructions.end());
    here.instructions.insert(here.instructions.end(), else_block.instructions.begin(), else_block.instructions.end());
    return b_.select(condition, then_value, else_value);
  }
  const VariableId result = b_.variable("", type);
  // The stores go to the ends of the ready blocks.
  const auto store_at_end = [&](Block block, ValueId value) {
    return b_.block([&] {
      b_.current() = std::move(block);
      b_.store(result, value);
    });
  };
  Block with_then = store_at_end(std::move(then_block), then_value);
  Block with_else = store_at_end(std::move(else_block), else_value);
  b_.if_else(condition, std::move(with_then), std::move(with_else));
  return b_.load(result);
}

ValueId FunctionBuild::logical(const BinaryExpr& expr) {
  const bool is_and = expr.op == BinaryOp::And;
  const ValueId left = evaluate_as(*expr.left, ValueType::Boolean);
  ValueId right = kNone;
  Block block = b_.block([&] { right = evaluate_as(*expr.right, ValueType::Boolean); });
  const auto cost = speculation_cost(function_, block);
  if (cost && *cost <= kSelectCost) {
    Block& here = b_.current();
    here.instructions.insert(here.instructions.end(), block.instructions.begin(), block.instructions.end());
    return b_.binary(is_and ? Op::And : Op::Or, left, right);
  }
  if (is_and) return choose(left, ValueType::Boolean, std::move(block), right, {}, left);
  return choose(left, ValueType::Boolean, {}, left, std::move(block), right);
}

/// As below, for tables: each arm is copied into the one where they meet.
ValueId FunctionBuild::conditional_table(const BinaryExpr& expr, const sema::Type& type) {
  const std::vector<const Expr*> terms = conditional_terms(expr);
  const auto from = [&](auto&& self, size_t i) -> void {
    const At at(b_, terms[i]->span);
    const BinaryExpr* term = i + 1 < terms.size() ? as_operation(*terms[i], BinaryOp::And) : nullptr;
    const Expr& arm = term != nullptr ? *term->right : *terms[i];
    const auto take = [&] { as_table(type, evaluate(arm), fact(arm).type); };
    if (term == nullptr) return take();
    const ValueId condition = evaluate_as(*term->left, ValueType::Boolean);
    Block then_block = b_.block(take);
    Block else_block = b_.block([&] { self(self, i + 1); });
    b_.if_else(condition, std::move(then_block), std::move(else_block));
  };
  from(from, 0);
  return kNone;
}

/// c and a or b, also in chains: (c and a or d and b) or e. A term `c and a` with an `a` that is not boolean gives a
/// where c holds and passes on otherwise; any other term gives its value.
ValueId FunctionBuild::conditional(const BinaryExpr& expr, ValueType type) {
  const std::vector<const Expr*> terms = conditional_terms(expr);
  const auto from = [&](auto&& self, size_t i) -> ValueId {
    const At at(b_, terms[i]->span);
    const BinaryExpr* term = i + 1 < terms.size() ? as_operation(*terms[i], BinaryOp::And) : nullptr;
    if (term == nullptr) return evaluate_as(*terms[i], type);
    const ValueId condition = evaluate_as(*term->left, ValueType::Boolean);
    ValueId then_value = kNone, else_value = kNone;
    Block then_block = b_.block([&] { then_value = evaluate_as(*term->right, type); });
    Block else_block = b_.block([&] { else_value = self(self, i + 1); });
    return choose(condition, type, std::move(then_block), then_value, std::move(else_block), else_value);
  };
  return from(from, 0);
}

} // namespace moonshade::ir
