// Order of evaluation. Lua leaves open in which order operands, arguments and the values of a list are evaluated; that
// shows only where one of them calls a function that assigns a variable which another of them uses. Such expressions
// are refused. Local functions that assign variables of their surroundings are rare, so most bodies are not even looked
// at.
#include "compiler/sema/context.h"

#include <algorithm>
#include <map>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

/// What evaluating an expression uses and assigns, and by which part of it.
struct Effects {
  std::map<const Local*, Span> uses, writes;

  void add(const Effects& other) {
    uses.insert(other.uses.begin(), other.uses.end());
    writes.insert(other.writes.begin(), other.writes.end());
  }
};

class OrderCheck {
public:
  OrderCheck(Context& context, const Work& work) : context_(context), work_(work) {}

  void block(const Block& block) {
    for (const Stat* stat : block.stats)
      statement(*stat);
  }

private:
  /// Parts in an open order: none may assign what another uses.
  Effects siblings(const std::vector<const Expr*>& parts) {
    Effects all;
    for (const Expr* part : parts) {
      if (part == nullptr) continue;
      const Effects effects = expression(*part);
      conflict(all.uses, effects.writes);
      conflict(effects.uses, all.writes);
      all.add(effects);
    }
    return all;
  }

  void conflict(const std::map<const Local*, Span>& uses, const std::map<const Local*, Span>& writes) {
    for (const auto& [local, write] : writes) {
      const auto use = uses.find(local);
      if (use == uses.end()) continue;
      const std::string name(local->name);
      context_.error(Code::OrderOfEvaluation, use->second, {name, "a call in the same statement may assign it"})
          .note(Code::NoteAssignedByCall, write, {name});
    }
  }

  Effects list(std::span<Expr* const> exprs) { return siblings({exprs.begin(), exprs.end()}); }

  Effects call(const CallExpr& expr) {
    std::vector<const Expr*> parts = {expr.callee};
    parts.insert(parts.end(), expr.args.begin(), expr.args.end());
    Effects effects = siblings(parts);
    const auto callee = work_.callees.find(expr.id);
    if (callee == work_.callees.end()) return effects;
    for (const Local* local : callee->second.work->captures)
      effects.uses.insert({local, expr.span});
    for (const Local* local : callee->second.work->outer_writes)
      effects.writes.insert({local, expr.span});
    return effects;
  }

  Effects expression(const Expr& expr) {
    return visit(expr, Overloaded{
                           [&](const NameExpr& name) {
                             Effects effects;
                             if (name.local != nullptr) effects.uses.insert({name.local, name.span});
                             return effects;
                           },
                           [&](const IndexExpr& index) { return siblings({index.object, index.key}); },
                           [&](const CallExpr& node) { return call(node); },
                           [&](const MethodCallExpr& node) {
                             std::vector<const Expr*> parts = {node.object};
                             parts.insert(parts.end(), node.args.begin(), node.args.end());
                             return siblings(parts);
                           },
                           [&](const ParenExpr& paren) { return expression(*paren.inner); },
                           [&](const UnaryExpr& unary) { return expression(*unary.operand); },
                           [&](const BinaryExpr& binary) {
                             if (binary.op != BinaryOp::And && binary.op != BinaryOp::Or)
                               return siblings({binary.left, binary.right});
                             Effects effects = expression(*binary.left); // first, by definition
                             effects.add(expression(*binary.right));
                             return effects;
                           },
                           [](const auto&) { return Effects{}; },
                       });
  }

  void statement(const Stat& stat) {
    visit(stat, Overloaded{
                    [&](const LocalStat& node) { list(node.values); },
                    [&](const AssignStat& node) { list(node.values); },
                    [&](const CallStat& node) { expression(*node.call); },
                    [&](const DoStat& node) { block(*node.body); },
                    [&](const WhileStat& node) {
                      expression(*node.condition);
                      block(*node.body);
                    },
                    [&](const RepeatStat& node) {
                      block(*node.body);
                      expression(*node.condition);
                    },
                    [&](const IfStat& node) {
                      for (const IfClause& clause : node.clauses) {
                        expression(*clause.condition);
                        block(*clause.body);
                      }
                      if (node.else_body != nullptr) block(*node.else_body);
                    },
                    [&](const NumericForStat& node) {
                      siblings({node.start, node.limit, node.step});
                      block(*node.body);
                    },
                    [&](const GenericForStat& node) { block(*node.body); },
                    [&](const ReturnStat& node) { list(node.values); },
                    [](const auto&) {},
                });
  }

  Context& context_;
  const Work& work_;
};

} // namespace

void check_order(Context& context, Work& work) {
  const bool any =
      std::ranges::any_of(work.callees, [](const auto& callee) { return !callee.second.work->outer_writes.empty(); });
  if (any) OrderCheck(context, work).block(*work.function->body);
}

} // namespace moonshade::sema
