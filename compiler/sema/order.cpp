// Order of evaluation. Lua leaves open in which order operands, arguments and the values of a list are evaluated; that
// shows only where one of them calls a function that assigns a variable which another of them uses. Such expressions
// are refused. Local functions that assign variables of their surroundings are rare, so most bodies are not even looked
// at.
#include "compiler/sema/context.h"
#include "compiler/sema/walker.h"

#include <algorithm>
#include <map>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

/// What evaluating an expression uses and assigns, and by which part of it.
struct Effects {
  struct Use {
    std::string_view name;
    Span place;
  };
  std::map<const Variable*, Use> uses, writes;

  void add(const Effects& other) {
    uses.insert(other.uses.begin(), other.uses.end());
    writes.insert(other.writes.begin(), other.writes.end());
  }
};

class OrderCheck {
public:
  OrderCheck(Context& context, Work& work) : context_(context), work_(work) {}

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

  void conflict(const std::map<const Variable*, Effects::Use>& uses,
                const std::map<const Variable*, Effects::Use>& writes) {
    for (const auto& [variable, write] : writes) {
      const auto use = uses.find(variable);
      if (use == uses.end()) continue;
      const std::string name(use->second.name);
      context_.error(Code::OrderOfEvaluation, use->second.place, {name, "a call in the same statement may assign it"})
          .note(Code::NoteAssignedByCall, write.place, {name});
    }
  }

  Effects list(std::span<Expr* const> exprs) { return siblings({exprs.begin(), exprs.end()}); }

  Effects call(const CallExpr& expr) {
    std::vector<const Expr*> parts = {expr.callee};
    parts.insert(parts.end(), expr.args.begin(), expr.args.end());
    Effects effects = siblings(parts);
    const auto callee = work_.callees.find(expr.id);
    if (callee == work_.callees.end()) return effects;
    for (const Variable* variable : callee->second.work->captures)
      if (variable->slot != nullptr) // else there is an error about it
        effects.uses.insert({variable, {variable->slot->name, expr.span}});
    for (const Variable* variable : callee->second.work->outer_writes)
      if (variable->slot != nullptr) effects.writes.insert({variable, {variable->slot->name, expr.span}});
    return effects;
  }

  Effects expression(const Expr& expr) {
    return visit(expr, Overloaded{
                           [&](const NameExpr& name) {
                             Effects effects;
                             if (name.local != nullptr)
                               if (const Variable* variable = context_.find_variable(work_, *name.local))
                                 effects.uses.insert({variable, {name.name, name.span}});
                             return effects;
                           },
                           [&](const IndexExpr& index) {
                             Effects effects = siblings({index.object, index.key});
                             if (const Table::Field* field = field_of(index))
                               effects.uses.insert({&field->variable, {spoken_name(*index.object), index.span}});
                             return effects;
                           },
                           [&](const TableExpr& table) {
                             std::vector<const Expr*> parts;
                             for (const TableField& field : table.fields)
                               parts.push_back(field.value);
                             return siblings(parts);
                           },
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

  const Table::Field* field_of(const IndexExpr& index) const {
    const auto fact = work_.spec->expressions.find(index.id);
    return fact == work_.spec->expressions.end() ? nullptr : fact->second.field;
  }

  static std::string_view spoken_name(const Expr& expr) {
    const Expr* at = &strip_parentheses(expr);
    while (const auto* index = try_as<IndexExpr>(at))
      at = &strip_parentheses(*index->object);
    const auto* name = try_as<NameExpr>(at);
    return name != nullptr ? name->name : "this table";
  }

  /// Objects, indices and values come first, in an order that Lua leaves open; then all is assigned, in such an order.
  void assign(const AssignStat& stat) {
    std::vector<const Expr*> parts(stat.values.begin(), stat.values.end());
    for (size_t i = 0; i < stat.targets.size(); ++i) {
      const auto* index = try_as<IndexExpr>(stat.targets[i]);
      if (index == nullptr) continue;
      parts.push_back(index->object);
      parts.push_back(index->key);
      for (size_t j = 0; j < i; ++j)
        if (const auto* other = try_as<IndexExpr>(stat.targets[j]);
            other != nullptr && may_be_one(*index, *other) && !is_swap(stat, j, i))
          context_.error(Code::SameTargetTwice, index->span, {std::string(spoken_name(*index->object)) + "[...]"});
    }
    siblings(parts);
  }

  /// a[i], a[j] = a[j], a[i]: where the two are one place, both values are that place's.
  static bool is_swap(const AssignStat& stat, size_t first, size_t second) {
    return second < stat.values.size() && is_same(*stat.targets[first], *stat.values[second]) &&
           is_same(*stat.targets[second], *stat.values[first]);
  }

  /// The same names, constants and accesses.
  static bool is_same(const Expr& a, const Expr& b) {
    if (a.kind != b.kind) return false;
    if (const auto* name = try_as<NameExpr>(&a)) {
      const auto& other = static_cast<const NameExpr&>(b);
      return name->local == other.local && name->name == other.name;
    }
    if (const auto* index = try_as<IndexExpr>(&a)) {
      const auto& other = static_cast<const IndexExpr&>(b);
      return is_same(*index->object, *other.object) && is_same(*index->key, *other.key);
    }
    if (const auto* integer = try_as<IntegerExpr>(&a))
      return integer->value == static_cast<const IntegerExpr&>(b).value;
    if (const auto* text = try_as<StringExpr>(&a)) return text->value == static_cast<const StringExpr&>(b).value;
    const auto* binary = try_as<BinaryExpr>(&a);
    if (binary == nullptr) return false;
    const auto& other = static_cast<const BinaryExpr&>(b);
    return binary->op == other.op && is_same(*binary->left, *other.left) && is_same(*binary->right, *other.right);
  }

  bool may_be_one(const IndexExpr& a, const IndexExpr& b) const {
    const Table::Field* field = field_of(a);
    if (field == nullptr || field != field_of(b)) return false;
    const auto *left = constant(*a.key), *right = constant(*b.key);
    if (left != nullptr && right != nullptr && left->value != right->value) return false;
    // Elements of different tables in an array of tables: a[1].x, a[2].x.
    const auto* outer_a = try_as<IndexExpr>(&strip_parentheses(*a.object));
    const auto* outer_b = try_as<IndexExpr>(&strip_parentheses(*b.object));
    return outer_a == nullptr || outer_b == nullptr || may_be_one(*outer_a, *outer_b) ||
           field_of(*outer_a) != field_of(*outer_b);
  }

  static const IntegerExpr* constant(const Expr& key) { return try_as<IntegerExpr>(&strip_parentheses(key)); }

  void statement(const Stat& stat) {
    visit(stat, Overloaded{
                    [&](const LocalStat& node) { list(node.values); },
                    [&](const AssignStat& node) { assign(node); },
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
                    [&](const GenericForStat& node) {
                      list(node.values);
                      block(*node.body);
                    },
                    [&](const ReturnStat& node) { list(node.values); },
                    [](const auto&) {},
                });
  }

  Context& context_;
  Work& work_;
};

} // namespace

void check_order(Context& context, Work& work) {
  const bool any = work.has_several_targets || std::ranges::any_of(work.callees, [](const auto& callee) {
                     return !callee.second.work->outer_writes.empty();
                   });
  if (any) OrderCheck(context, work).block(*work.function->body);
}

} // namespace moonshade::sema
