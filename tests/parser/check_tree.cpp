#include "check_tree.h"

#include "compiler/syntax/parser.h"

#include <algorithm>
#include <vector>

namespace moonshade::test {
namespace {

using namespace syntax;

class Checker {
public:
  Checker(const Chunk& chunk, size_t text_size, bool has_errors)
      : chunk_(chunk), text_size_(text_size), has_errors_(has_errors), seen_(chunk.node_count) {}

  std::string run() {
    if (chunk_.functions.empty() || chunk_.functions[0] != chunk_.main) fail("the chunk is function 0");
    for (size_t i = 0; i < chunk_.functions.size(); ++i)
      if (chunk_.functions[i]->index != i) fail("function index");
    expr(chunk_.main, chunk_.main->span);
    return fault_;
  }

private:
  void fail(std::string_view what) {
    if (fault_.empty()) fault_ = what;
  }

  void node(const Node& node, Span parent) {
    if (node.id >= seen_.size() || seen_[node.id]) return fail("id not unique, or beyond node_count");
    seen_[node.id] = true;
    const Span span = node.span;
    if (span.begin > span.end || span.end > text_size_) fail("span outside the text");
    if (!has_errors_ && (span.begin < parent.begin || span.end > parent.end)) fail("span outside the parent's");
    if (!has_errors_ && node.height > kMaxTreeHeight) fail("too high a tree");
  }

  /// Children raise `below_`; the node's own height must be one more.
  template <class T, class Children> void with_children(const T& parent, Children children) {
    const unsigned outer = std::exchange(below_, 0);
    children();
    if (parent.height != below_ + 1) fail("height");
    below_ = std::max<unsigned>(outer, parent.height);
  }

  void local(const Local* local, const Function* function) {
    if (local == nullptr || local->id >= chunk_.local_count) return fail("local");
    if (local->function != function) fail("a local's function");
  }

  void exprs(std::span<Expr* const> list, Span parent) {
    for (const Expr* e : list)
      expr(e, parent);
  }
  void block(const Block* block, Span parent) {
    if (block == nullptr) return fail("a block is missing");
    node(*block, parent);
    with_children(*block, [&] {
      for (const Stat* s : block->stats)
        stat(s, block->span);
    });
  }

  void expr(const Expr* e, Span parent) {
    if (e == nullptr) return fail("an expression is missing");
    node(*e, parent);
    with_children(*e, [&] { visit(*e, [&](const auto& n) { children(n); }); });
  }
  void stat(const Stat* s, Span parent) {
    if (s == nullptr) return fail("a statement is missing");
    node(*s, parent);
    with_children(*s, [&] { visit(*s, [&](const auto& n) { children(n); }); });
  }

  template <class T> void children(const T&) {} // leaves
  void children(const ErrorExpr&) { fail_unless_errors(); }
  void children(const ErrorStat&) { fail_unless_errors(); }
  void fail_unless_errors() {
    if (!has_errors_) fail("error node in a tree without errors");
  }
  void children(const NameExpr& n) {
    if (n.local != nullptr && n.local->name != n.name) fail("a name's local");
    if (n.local != nullptr && n.is_upvalue != (n.local->function != function_)) fail("is_upvalue");
    if (n.is_upvalue && !n.local->is_captured) fail("is_captured");
  }
  void children(const Function& n) {
    if (n.parent != function_) fail("a function's parent");
    const Function* outer = std::exchange(function_, &n);
    for (const Local* param : n.params)
      local(param, &n);
    block(n.body, n.span);
    function_ = outer;
  }
  void children(const IndexExpr& n) { expr(n.object, n.span), expr(n.key, n.span); }
  void children(const CallExpr& n) { expr(n.callee, n.span), exprs(n.args, n.span); }
  void children(const MethodCallExpr& n) { expr(n.object, n.span), exprs(n.args, n.span); }
  void children(const ParenExpr& n) { expr(n.inner, n.span); }
  void children(const UnaryExpr& n) { expr(n.operand, n.span); }
  void children(const BinaryExpr& n) { expr(n.left, n.span), expr(n.right, n.span); }
  void children(const TableExpr& n) {
    for (const TableField& field : n.fields) {
      if ((field.key == nullptr) != (field.kind == FieldKind::Positional)) fail("a field's key");
      if (field.key != nullptr) expr(field.key, field.span);
      expr(field.value, field.span);
    }
  }
  void children(const LocalStat& n) {
    for (const Local* l : n.locals)
      local(l, function_);
    exprs(n.values, n.span);
  }
  void children(const AssignStat& n) { exprs(n.targets, n.span), exprs(n.values, n.span); }
  void children(const CallStat& n) { expr(n.call, n.span); }
  void children(const DoStat& n) { block(n.body, n.span); }
  void children(const WhileStat& n) { expr(n.condition, n.span), block(n.body, n.span); }
  void children(const RepeatStat& n) { block(n.body, n.span), expr(n.condition, n.span); }
  void children(const IfStat& n) {
    if (n.clauses.empty()) fail("an if without clauses");
    for (const IfClause& clause : n.clauses)
      expr(clause.condition, clause.span), block(clause.body, clause.span);
    if (n.else_body != nullptr) block(n.else_body, n.span);
  }
  void children(const NumericForStat& n) {
    local(n.variable, function_);
    expr(n.start, n.span), expr(n.limit, n.span);
    if (n.step != nullptr) expr(n.step, n.span);
    block(n.body, n.span);
  }
  void children(const GenericForStat& n) {
    for (const Local* l : n.variables)
      local(l, function_);
    exprs(n.values, n.span), block(n.body, n.span);
  }
  void children(const FunctionStat& n) { expr(n.target, n.span), expr(n.function, n.span); }
  void children(const LocalFunctionStat& n) { local(n.local, function_), expr(n.function, n.span); }
  void children(const ReturnStat& n) { exprs(n.values, n.span); }
  void children(const BreakStat& n) {
    if (!has_errors_ && n.loop == nullptr) fail("a break without its loop");
  }
  void children(const GotoStat& n) {
    if (!has_errors_ && n.target == nullptr) fail("a goto without its label");
    if (n.target != nullptr && n.target->label.text != n.label.text) fail("a goto's label");
  }

  const Chunk& chunk_;
  size_t text_size_;
  bool has_errors_;
  std::vector<bool> seen_;
  const Function* function_ = nullptr;
  unsigned below_ = 0;
  std::string fault_;
};

} // namespace

std::string check_tree(const Chunk& chunk, size_t text_size, bool has_errors) {
  return Checker(chunk, text_size, has_errors).run();
}

} // namespace moonshade::test
