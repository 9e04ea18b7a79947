// The syntax tree of a Lua 5.4 chunk. Nodes are plain structs in an Arena; names and strings are views into the arena
// or the SourceSet, both of which must outlive the tree. Names are already resolved as Lua resolves them: a use points
// at the declaration of its local, `break` at its loop, `goto` at its label. Each node has an id, dense within the
// chunk, by which later stages index tables of their own; locals have dense ids of theirs.
//
// The height of the tree is bounded (parser.h: kMaxTreeHeight), so functions over it may recurse.
#pragma once

#include "compiler/base/source.h"

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace moonshade::syntax {

enum class ExprKind : uint8_t {
#define MOONSHADE_EXPR(kind, type) kind,
#include "compiler/syntax/ast.def"
};
enum class StatKind : uint8_t {
#define MOONSHADE_STAT(kind, type) kind,
#include "compiler/syntax/ast.def"
};
enum class BinaryOp : uint8_t {
#define MOONSHADE_BINARY_OP(name, spelling, token, left, right) name,
#include "compiler/syntax/operators.def"
};
enum class UnaryOp : uint8_t {
#define MOONSHADE_UNARY_OP(name, spelling, token) name,
#include "compiler/syntax/operators.def"
};

/// The struct's name: "BinaryExpr".
std::string_view name_of(ExprKind kind);
std::string_view name_of(StatKind kind);
/// As Lua writes it: "//".
std::string_view spelling_of(BinaryOp op);
std::string_view spelling_of(UnaryOp op);

struct Node {
  Span span;
  uint32_t id = 0;
  /// 1 + the greatest height of the children.
  uint16_t height = 1;
};

struct Expr : Node {
  ExprKind kind;

protected:
  explicit constexpr Expr(ExprKind k) : kind(k) {}
};

struct Stat : Node {
  StatKind kind;

protected:
  explicit constexpr Stat(StatKind k) : kind(k) {}
};

struct Block;
struct Function;
struct LabelStat;

/// A name as it stands in the source.
struct Name {
  std::string_view text;
  Span span;
};

enum class Attrib : uint8_t { None, Const, Close };

/// What declares a local: a `local` statement, a parameter (Self is the hidden one of `function a:b`), a loop, or
/// `local function`.
enum class LocalKind : uint8_t { Variable, Parameter, Self, NumericFor, GenericFor, Function };

/// The declaration of a local variable.
struct Local {
  std::string_view name;
  Span span;
  /// Dense within the chunk.
  uint32_t id = 0;
  LocalKind kind = LocalKind::Variable;
  Attrib attrib = Attrib::None;
  /// Some inner function uses it (as an upvalue).
  bool is_captured = false;
  /// Some assignment (not its declaration) gives it a value.
  bool is_assigned = false;
  /// The function whose local it is.
  Function* function = nullptr;
  /// The value of a `<const>` local where stock Lua knows it while it compiles (folded_integer.h).
  std::optional<int64_t> folded_integer;
};

// ---- expressions ---------------------------------------------------------------------------------------------------

template <ExprKind Kind> struct ExprOf : Expr {
  static constexpr ExprKind kKind = Kind;
  constexpr ExprOf() : Expr(Kind) {}
};

struct NilExpr : ExprOf<ExprKind::Nil> {};

struct BooleanExpr : ExprOf<ExprKind::Boolean> {
  bool value = false;
};

/// A numeral that denotes an integer.
struct IntegerExpr : ExprOf<ExprKind::Integer> {
  int64_t value = 0;
};

/// A numeral that denotes a float (it may be infinite: 1e999).
struct NumberExpr : ExprOf<ExprKind::Number> {
  double value = 0;
};

/// A string; escapes are already replaced, and any byte may occur.
struct StringExpr : ExprOf<ExprKind::String> {
  std::string_view value;
};

struct VarargExpr : ExprOf<ExprKind::Vararg> {};

/// A function body, wherever it stands: an expression, `function f`, `local function f`, or the chunk itself.
struct Function : ExprOf<ExprKind::Function> {
  /// With the hidden `self` first for a method.
  std::span<Local* const> params;
  bool is_vararg = false;
  /// The `...` among the parameters; of no place where there is none (the chunk).
  Span vararg_span;
  bool is_method = false;
  Block* body = nullptr;
  /// The enclosing function; null for the chunk.
  Function* parent = nullptr;
  /// The token `end`; for the chunk the empty span at the end of the text.
  Span end_span;
  /// For messages: "f", "a.b:c", the local it initialises; empty for the chunk and where it has none.
  std::string_view name;
  /// Dense within the chunk, in order of their beginning; the chunk itself is 0.
  uint32_t index = 0;
};

/// The use of a name: of a local of this function, of an outer function's local, or of a global.
struct NameExpr : ExprOf<ExprKind::Name> {
  std::string_view name;
  /// Null for a global (and for `_ENV` itself where no local of that name is visible).
  Local* local = nullptr;
  /// The local belongs to an outer function.
  bool is_upvalue = false;
  /// For a global: the user's own local named `_ENV` of which it is a field; null where it is a true global.
  Local* environment = nullptr;

  bool is_global() const { return local == nullptr; }
};

/// object[key] or object.name (then the key is a StringExpr).
struct IndexExpr : ExprOf<ExprKind::Index> {
  Expr* object = nullptr;
  Expr* key = nullptr;
  bool is_dotted = false;
};

struct CallExpr : ExprOf<ExprKind::Call> {
  Expr* callee = nullptr;
  std::span<Expr* const> args;
};

/// object:method(args)
struct MethodCallExpr : ExprOf<ExprKind::MethodCall> {
  Expr* object = nullptr;
  Name method;
  std::span<Expr* const> args;
};

/// (inner): of several values it keeps the first.
struct ParenExpr : ExprOf<ExprKind::Paren> {
  Expr* inner = nullptr;
};

struct UnaryExpr : ExprOf<ExprKind::Unary> {
  UnaryOp op = {};
  Span op_span;
  Expr* operand = nullptr;
};

struct BinaryExpr : ExprOf<ExprKind::Binary> {
  BinaryOp op = {};
  Span op_span;
  Expr* left = nullptr;
  Expr* right = nullptr;
};

enum class FieldKind : uint8_t { Positional, Named, Keyed };

/// value, name = value (the key is a StringExpr) or [key] = value.
struct TableField {
  FieldKind kind = FieldKind::Positional;
  Span span;
  Expr* key = nullptr;
  Expr* value = nullptr;
};

struct TableExpr : ExprOf<ExprKind::Table> {
  std::span<const TableField> fields;
};

/// Stands where an expression could not be parsed; the error is already reported.
struct ErrorExpr : ExprOf<ExprKind::Error> {};

// ---- statements ----------------------------------------------------------------------------------------------------

template <StatKind Kind> struct StatOf : Stat {
  static constexpr StatKind kKind = Kind;
  constexpr StatOf() : Stat(Kind) {}
};

struct Block : Node {
  std::span<Stat* const> stats;
};

/// A comment with its `--`.
struct Comment {
  Span span;
  std::string_view text;
};
/// The comment lines that stand immediately before a statement, top to bottom; often empty.
using CommentLines = std::span<const Comment>;

struct LocalStat : StatOf<StatKind::Local> {
  std::span<Local* const> locals;
  std::span<Expr* const> values;
  CommentLines comments;
};

/// Targets are NameExpr or IndexExpr (or ErrorExpr).
struct AssignStat : StatOf<StatKind::Assign> {
  std::span<Expr* const> targets;
  std::span<Expr* const> values;
  CommentLines comments;
};

/// `call` is a CallExpr or a MethodCallExpr.
struct CallStat : StatOf<StatKind::Call> {
  Expr* call = nullptr;
};

struct DoStat : StatOf<StatKind::Do> {
  Block* body = nullptr;
};

struct WhileStat : StatOf<StatKind::While> {
  Expr* condition = nullptr;
  Block* body = nullptr;
};

/// The condition sees the locals of the body.
struct RepeatStat : StatOf<StatKind::Repeat> {
  Block* body = nullptr;
  Expr* condition = nullptr;
};

/// if/elseif condition then body
struct IfClause {
  Span span;
  Expr* condition = nullptr;
  Block* body = nullptr;
};

struct IfStat : StatOf<StatKind::If> {
  std::span<const IfClause> clauses;
  /// Null where there is no `else`.
  Block* else_body = nullptr;
};

struct NumericForStat : StatOf<StatKind::NumericFor> {
  Local* variable = nullptr;
  Expr* start = nullptr;
  Expr* limit = nullptr;
  /// Null where it is left out.
  Expr* step = nullptr;
  Block* body = nullptr;
};

struct GenericForStat : StatOf<StatKind::GenericFor> {
  std::span<Local* const> variables;
  std::span<Expr* const> values;
  Block* body = nullptr;
};

/// function a.b:c() ... end; the target is a NameExpr or a dotted IndexExpr.
struct FunctionStat : StatOf<StatKind::Function> {
  Expr* target = nullptr;
  Function* function = nullptr;
  CommentLines comments;
};

struct LocalFunctionStat : StatOf<StatKind::LocalFunction> {
  Local* local = nullptr;
  Function* function = nullptr;
  CommentLines comments;
};

/// Always the last statement of its block.
struct ReturnStat : StatOf<StatKind::Return> {
  std::span<Expr* const> values;
};

struct BreakStat : StatOf<StatKind::Break> {
  /// The loop it leaves; null where there is none (an error).
  Stat* loop = nullptr;
};

struct GotoStat : StatOf<StatKind::Goto> {
  Name label;
  /// Null where there is none (an error).
  LabelStat* target = nullptr;
};

struct LabelStat : StatOf<StatKind::Label> {
  Name label;
};

/// Stands where a statement could not be parsed; the error is already reported.
struct ErrorStat : StatOf<StatKind::Error> {};

// ---- chunk ---------------------------------------------------------------------------------------------------------

/// A whole file.
struct Chunk {
  FileId file = kNoFile;
  /// The chunk as a vararg function.
  Function* main = nullptr;
  /// Ids of nodes, locals and functions are smaller than these.
  uint32_t node_count = 0;
  uint32_t local_count = 0;
  /// All functions, by index.
  std::span<Function* const> functions;
};

/// An indented tree, one node a line, for --emit=ast.
void print_ast(const Chunk& chunk, std::ostream& out);

// ---- casts and visitors --------------------------------------------------------------------------------------------

/// The node as a T, or null where it is of another kind (or null).
template <class T, class Base> auto try_as(Base* node) -> decltype(T::kKind, static_cast<T*>(node)) {
  return node != nullptr && node->kind == T::kKind ? static_cast<T*>(node) : nullptr;
}
template <class T, class Base> auto try_as(const Base* node) -> decltype(T::kKind, static_cast<const T*>(node)) {
  return node != nullptr && node->kind == T::kKind ? static_cast<const T*>(node) : nullptr;
}

/// The expression inside any parentheses.
inline const Expr& strip_parentheses(const Expr& expr) {
  const Expr* inner = &expr;
  while (const auto* paren = try_as<ParenExpr>(inner))
    inner = paren->inner;
  return *inner;
}

/// Calls `visitor(node as its own struct)`; the visitor has one overload a kind, or a generic one for the rest.
template <class Visitor> decltype(auto) visit(const Expr& expr, Visitor&& visitor) {
  switch (expr.kind) {
#define MOONSHADE_EXPR(kind, type)                                                                                     \
  case ExprKind::kind:                                                                                                 \
    return std::forward<Visitor>(visitor)(static_cast<const type&>(expr));
#include "compiler/syntax/ast.def"
  }
  __builtin_unreachable();
}
template <class Visitor> decltype(auto) visit(const Stat& stat, Visitor&& visitor) {
  switch (stat.kind) {
#define MOONSHADE_STAT(kind, type)                                                                                     \
  case StatKind::kind:                                                                                                 \
    return std::forward<Visitor>(visitor)(static_cast<const type&>(stat));
#include "compiler/syntax/ast.def"
  }
  __builtin_unreachable();
}

/// For visitors made of lambdas: visit(expr, Overloaded{[](const CallExpr& call) {...}, [](const auto&) {...}}).
template <class... Functions> struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions> Overloaded(Functions...) -> Overloaded<Functions...>;

} // namespace moonshade::syntax
