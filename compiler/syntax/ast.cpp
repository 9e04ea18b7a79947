// Names of node kinds and operators, from their lists.
#include "compiler/syntax/ast.h"

#include <array>
#include <type_traits>

namespace moonshade::syntax {
namespace {

constexpr auto kExprNames = std::to_array<std::string_view>({
#define MOONSHADE_EXPR(kind, type) #type,
#include "compiler/syntax/ast.def"
});
constexpr auto kStatNames = std::to_array<std::string_view>({
#define MOONSHADE_STAT(kind, type) #type,
#include "compiler/syntax/ast.def"
});
constexpr auto kBinarySpellings = std::to_array<std::string_view>({
#define MOONSHADE_BINARY_OP(name, spelling, token, left, right) spelling,
#include "compiler/syntax/operators.def"
});
constexpr auto kUnarySpellings = std::to_array<std::string_view>({
#define MOONSHADE_UNARY_OP(name, spelling, token) spelling,
#include "compiler/syntax/operators.def"
});

// Every struct of the list is of the kind that the list gives it, and may live in an arena.
#define MOONSHADE_EXPR(kind, type)                                                                                     \
  static_assert(type::kKind == ExprKind::kind && std::is_trivially_destructible_v<type>);
#define MOONSHADE_STAT(kind, type)                                                                                     \
  static_assert(type::kKind == StatKind::kind && std::is_trivially_destructible_v<type>);
#include "compiler/syntax/ast.def"

} // namespace

std::string_view name_of(ExprKind kind) { return kExprNames.at(static_cast<size_t>(kind)); }
std::string_view name_of(StatKind kind) { return kStatNames.at(static_cast<size_t>(kind)); }
std::string_view spelling_of(BinaryOp op) { return kBinarySpellings.at(static_cast<size_t>(op)); }
std::string_view spelling_of(UnaryOp op) { return kUnarySpellings.at(static_cast<size_t>(op)); }

} // namespace moonshade::syntax
