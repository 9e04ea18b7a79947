// Conditions, `and` and `or`. Both take booleans, with one exception: `c and a or b`, also in chains, is the
// conditional expression where a is no boolean (such an a is never false, so it means what Lua says).
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

void Walker::condition(const Expr& expr) { require_condition(expr, expression(expr)); }

void Walker::require_condition(const Expr& expr, const Type& type) {
  if (is_unknown(type) || type.is(ValueType::Boolean)) return;
  if (is_scalar(type)) {
    type_error(Code::NumberAsCondition, expr.span, {describe(type)});
  } else {
    type_error(Code::ConditionType, expr.span, {describe(type)});
  }
}

/// `and` that is no arm of a conditional.
Type Walker::and_expression(const BinaryExpr& expr) {
  condition(*expr.left);
  const Type right = expression(*expr.right);
  if (!is_unknown(right) && !right.is(ValueType::Boolean)) {
    type_error(Code::AndWithoutOr, expr.right->span, {describe(right)});
    return unknown_type();
  }
  ExpressionFact fact;
  fact.type = boolean_type();
  fact.form = OperatorForm::Logical;
  fact.operand_type = ValueType::Boolean;
  return record(expr, std::move(fact));
}

/// One part of a chain of `or`s.
struct Walker::Arm {
  const Expr* expr;
  const BinaryExpr* conditional; ///< as `c and a`; null otherwise
  Type type;                     ///< of a, or of the whole

  bool is_conditional() const { return conditional != nullptr && !is_unknown(type) && !type.is(ValueType::Boolean); }
  /// Which of the two forms it is depends on a type that is not inferred yet (or was an error).
  bool is_undecided() const { return conditional != nullptr && is_unknown(type); }
};

namespace {

/// The `or`s of a chain, from the outermost inwards: each is the left side of the one before.
std::vector<const BinaryExpr*> chain_of(const BinaryExpr& outermost) {
  std::vector<const BinaryExpr*> chain = {&outermost};
  while (true) {
    const auto* inner = try_as<BinaryExpr>(chain.back()->left);
    if (inner == nullptr || inner->op != BinaryOp::Or) return chain;
    chain.push_back(inner);
  }
}

/// The parts of a chain, from the left; the last one is no condition.
std::vector<const Expr*> parts_of(const std::vector<const BinaryExpr*>& chain) {
  std::vector<const Expr*> parts = {chain.back()->left};
  for (size_t i = chain.size(); i-- > 0;)
    parts.push_back(chain[i]->right);
  return parts;
}

const BinaryExpr* as_and(const Expr& expr) {
  const auto* inner = try_as<BinaryExpr>(&strip_parentheses(expr));
  return inner != nullptr && inner->op == BinaryOp::And ? inner : nullptr;
}

} // namespace

Type Walker::or_expression(const BinaryExpr& expr) {
  const std::vector<const BinaryExpr*> chain = chain_of(expr);
  std::vector<Arm> arms;
  for (const Expr* part : parts_of(chain))
    arms.push_back({part, as_and(*part), {}});
  arms.back().conditional = nullptr;
  for (Arm& arm : arms) {
    if (arm.conditional != nullptr) condition(*arm.conditional->left);
    arm.type = expression(arm.conditional != nullptr ? *arm.conditional->right : *arm.expr);
  }
  const bool is_conditional = std::ranges::any_of(arms, &Arm::is_conditional);
  if (!is_conditional && std::ranges::any_of(arms, &Arm::is_undecided)) return unknown_type();
  const std::optional<Type> type = is_conditional ? conditional_type(expr, arms) : logical_type(arms);
  if (!type) return unknown_type();

  ExpressionFact fact;
  fact.form = is_conditional ? OperatorForm::Conditional : OperatorForm::Logical;
  fact.type = *type;
  fact.operand_type = type->value;
  for (const Arm& arm : arms) {
    if (arm.conditional == nullptr) continue;
    record(*arm.conditional, fact);
    for (const Expr* at = arm.expr; at != arm.conditional; at = static_cast<const ParenExpr*>(at)->inner)
      record(*at, fact.type);
  }
  for (size_t i = 1; i < chain.size(); ++i)
    record(*chain[i], fact);
  return record(expr, std::move(fact));
}

/// The common type of the results; nothing where they were refused.
std::optional<Type> Walker::conditional_type(const BinaryExpr& expr, const std::vector<Arm>& arms) {
  for (size_t i = 0; i + 1 < arms.size(); ++i)
    if (!arms[i].is_conditional() && !is_unknown(arms[i].type)) {
      type_error(Code::ConditionalArm, arms[i].expr->span);
      return std::nullopt;
    }
  if (std::ranges::any_of(arms, [](const Arm& arm) { return is_table(arm.type); }))
    return conditional_table(expr, arms);
  Type type;
  for (const Arm& arm : arms) {
    if (is_function(arm.type)) {
      refuse_function(expr.span, {}, &expr);
      return std::nullopt;
    }
    const std::optional<Type> joined = join(type, arm.type);
    if (!joined && type.kind == Type::Kind::String && arm.type.kind == Type::Kind::String) break; // two strings
    if (!joined) {
      type_error(Code::ConditionalTypes, expr.span, {describe(type), describe(arm.type)});
      return std::nullopt;
    }
    type = *joined;
  }
  if (type.kind != Type::Kind::String) return type;
  error(Code::StringChoice, expr.span);
  return std::nullopt;
}

/// Each arm gives a table built there: they meet in one.
std::optional<Type> Walker::conditional_table(const BinaryExpr& expr, const std::vector<Arm>& arms) {
  Type type;
  for (const Arm& arm : arms) {
    if (is_unknown(arm.type)) return std::nullopt;
    if (!is_table(arm.type)) {
      const Type other = is_table(arms[0].type) ? arms[0].type : arms[1].type;
      type_error(Code::ConditionalTypes, expr.span, {describe(other), describe(arm.type)});
      return std::nullopt;
    }
  }
  for (const Arm& arm : arms) {
    const Expr& value = arm.conditional != nullptr ? *arm.conditional->right : *arm.expr;
    type = merge_tables(is_unknown(type) ? arm.type : type, arm.type, &expr, 0, value, expr.span);
  }
  // The first arm alone is no table of its own.
  return std::ranges::all_of(arms, [&](const Arm& arm) { return arm.type == arms[0].type; }) && type == arms[0].type
             ? type
             : merge_tables(type, arms[0].type, &expr, 0,
                            arms[0].conditional != nullptr ? *arms[0].conditional->right : *arms[0].expr, expr.span);
}

/// `or` between booleans; the first operand that is none is refused.
std::optional<Type> Walker::logical_type(const std::vector<Arm>& arms) {
  const auto is_wrong = [](const Arm& arm) { return !is_unknown(arm.type) && !arm.type.is(ValueType::Boolean); };
  const auto wrong = std::ranges::find_if(arms, is_wrong);
  if (wrong == arms.end()) return boolean_type();
  if (wrong + 1 != arms.end()) {
    require_condition(*wrong->expr, wrong->type);
  } else {
    type_error(Code::OrOperand, wrong->expr->span, {describe(wrong->type)});
  }
  return std::nullopt;
}

} // namespace moonshade::sema
