// Conditions, `and` and `or`. Both take booleans, with one exception: `c and a or b`, also in chains, is the
// conditional expression where a is no boolean (such an a is never false, so it means what Lua says).
#include "compiler/sema/walker.h"

#include <algorithm>
#include <utility>

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

namespace {

/// One part of a chain of `or`s.
struct Arm {
  const Expr* expr;
  const BinaryExpr* conditional; ///< as `c and a`; null otherwise
  Type type;                     ///< of a, or of the whole
};

/// The `or`s of a chain, from the outermost inwards: each is the left side of the one before.
std::vector<const BinaryExpr*> chain_of(const BinaryExpr& outermost) {
  std::vector<const BinaryExpr*> chain = {&outermost};
  while (true) {
    const auto* inner = try_as<BinaryExpr>(chain.back()->left);
    if (inner == nullptr || inner->op != BinaryOp::Or) return chain;
    chain.push_back(inner);
  }
}

std::vector<Arm> arms_of(const std::vector<const BinaryExpr*>& chain) {
  std::vector<Arm> arms = {{chain.back()->left, nullptr, {}}};
  for (size_t i = chain.size(); i-- > 0;)
    arms.push_back({chain[i]->right, nullptr, {}});
  for (size_t i = 0; i + 1 < arms.size(); ++i) {
    const auto* inner = try_as<BinaryExpr>(&strip_parentheses(*arms[i].expr));
    if (inner != nullptr && inner->op == BinaryOp::And) arms[i].conditional = inner;
  }
  return arms;
}

} // namespace

Type Walker::or_expression(const BinaryExpr& expr) {
  const std::vector<const BinaryExpr*> chain = chain_of(expr);
  std::vector<Arm> arms = arms_of(chain);
  for (Arm& arm : arms) {
    if (arm.conditional != nullptr) {
      condition(*arm.conditional->left);
      arm.type = expression(*arm.conditional->right);
    } else {
      arm.type = expression(*arm.expr);
    }
  }
  const auto is_conditional = [](const Arm& arm) {
    return arm.conditional != nullptr && !is_unknown(arm.type) && !arm.type.is(ValueType::Boolean);
  };
  const bool conditional = std::ranges::any_of(arms, is_conditional);
  // Which of the two forms it is depends on a type that is not inferred yet (or was an error).
  const auto is_undecided = [](const Arm& arm) { return arm.conditional != nullptr && is_unknown(arm.type); };
  if (!conditional && std::ranges::any_of(arms, is_undecided)) return unknown_type();

  ExpressionFact fact;
  fact.form = conditional ? OperatorForm::Conditional : OperatorForm::Logical;
  if (conditional) {
    for (size_t i = 0; i + 1 < arms.size(); ++i)
      if (!is_conditional(arms[i]) && !(is_unknown(arms[i].type))) {
        type_error(Code::ConditionalArm, arms[i].expr->span);
        return unknown_type();
      }
    std::optional<Type> type = Type{};
    for (const Arm& arm : arms) {
      if (arm.type.kind == Type::Kind::Function || arm.type.kind == Type::Kind::Library) {
        refuse_function(expr.span, {}, &expr);
        return unknown_type();
      }
      const Type before = *type;
      if (type = join(before, arm.type); !type) {
        type_error(Code::ConditionalTypes, expr.span, {describe(before), describe(arm.type)});
        return unknown_type();
      }
    }
    if (type->kind == Type::Kind::String) {
      error(Code::NotAvailableYet, expr.span, {"a conditional between strings is"});
      return unknown_type();
    }
    fact.type = *type;
  } else {
    bool fits = true;
    for (size_t i = 0; i < arms.size(); ++i) {
      const Type& type = arms[i].type;
      if (is_unknown(type) || type.is(ValueType::Boolean)) continue;
      if (!std::exchange(fits, false)) continue; // the first one says it
      if (i + 1 < arms.size()) {
        require_condition(*arms[i].expr, type);
      } else {
        type_error(Code::OrOperand, arms[i].expr->span, {describe(type)});
      }
    }
    if (!fits) return unknown_type();
    fact.type = boolean_type();
  }
  fact.operand_type = fact.type.value;
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

} // namespace moonshade::sema
