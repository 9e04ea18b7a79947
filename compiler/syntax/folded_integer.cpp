// After Lua 5.4's constant folding (lcode.c, luaO_rawarith); the values of `<const>` locals are those that the parser
// has folded at their declarations, so that each is folded once.
#include "compiler/syntax/folded_integer.h"

#include <limits>

namespace moonshade::syntax {

namespace {

/// Wraps, as all of Lua's integers do.
int64_t wrapped(uint64_t bits) { return static_cast<int64_t>(bits); }

/// To the right where negative.
int64_t shifted_left(int64_t value, int64_t by) {
  if (by <= -64 || by >= 64) return 0;
  const auto bits = static_cast<uint64_t>(value);
  return wrapped(by >= 0 ? bits << by : bits >> -by);
}

std::optional<int64_t> fold(UnaryOp op, int64_t value) {
  if (op == UnaryOp::Neg) return wrapped(0 - static_cast<uint64_t>(value));
  if (op == UnaryOp::BitNot) return ~value;
  return {};
}

/// `//` and `%`, which round down; by zero nothing is folded.
std::optional<int64_t> divide(BinaryOp op, int64_t a, int64_t b) {
  if (b == 0) return {};
  const bool is_quotient = op == BinaryOp::FloorDiv;
  if (b == -1) return is_quotient ? wrapped(0 - static_cast<uint64_t>(a)) : 0; // the least integer has no opposite
  const bool rounds_up = a % b != 0 && (a < 0) != (b < 0);
  return is_quotient ? a / b - (rounds_up ? 1 : 0) : a % b + (rounds_up ? b : 0);
}

std::optional<int64_t> fold(BinaryOp op, int64_t a, int64_t b) {
  const auto left = static_cast<uint64_t>(a), right = static_cast<uint64_t>(b);
  switch (op) {
  case BinaryOp::Add:
    return wrapped(left + right);
  case BinaryOp::Sub:
    return wrapped(left - right);
  case BinaryOp::Mul:
    return wrapped(left * right);
  case BinaryOp::FloorDiv:
  case BinaryOp::Mod:
    return divide(op, a, b);
  case BinaryOp::BitAnd:
    return a & b;
  case BinaryOp::BitOr:
    return a | b;
  case BinaryOp::BitXor:
    return a ^ b;
  case BinaryOp::Shl:
    return shifted_left(a, b);
  case BinaryOp::Shr:
    return b == std::numeric_limits<int64_t>::min() ? 0 : shifted_left(a, -b);
  default:
    return {};
  }
}

} // namespace

std::optional<int64_t> folded_integer(const Expr& expr) {
  if (const auto* paren = try_as<ParenExpr>(&expr)) return folded_integer(*paren->inner);
  if (const auto* integer = try_as<IntegerExpr>(&expr)) return integer->value;
  if (const auto* name = try_as<NameExpr>(&expr))
    return name->local != nullptr ? name->local->folded_integer : std::nullopt;
  if (const auto* unary = try_as<UnaryExpr>(&expr)) {
    const auto operand = folded_integer(*unary->operand);
    return operand ? fold(unary->op, *operand) : std::nullopt;
  }
  const auto* binary = try_as<BinaryExpr>(&expr);
  if (binary == nullptr) return {};
  const auto left = folded_integer(*binary->left);
  if (!left) return {};
  const auto right = folded_integer(*binary->right);
  return right ? fold(binary->op, *left, *right) : std::nullopt;
}

} // namespace moonshade::syntax
