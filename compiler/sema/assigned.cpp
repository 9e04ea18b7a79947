// Definite assignment: a variable must be assigned on every path before it is read, also where a call reads it; and a
// function that gives results must not run into its `end`. One pass over a body, in the order of execution: the set of
// assigned variables only grows along a path, so loops need no iteration.
//
// What a function reads of outer variables before assigning them is a requirement on its callers, who check it.
#include "compiler/sema/context.h"
#include "compiler/sema/modules.h"

#include <algorithm>
#include <functional>
#include <set>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

/// Variables are numbered as they are met. Of an unreachable path everything is assigned.
struct State {
  bool is_reachable = true;
  std::vector<bool> assigned;

  bool has(unsigned variable) const { return variable < assigned.size() && assigned[variable]; }
  void set(unsigned variable, bool value) {
    if (variable >= assigned.size()) assigned.resize(variable + 1);
    assigned[variable] = value;
  }
};

State unreachable() { return {false, {}}; }

/// What holds on both of two paths.
State merge(const State& a, const State& b) {
  if (!a.is_reachable) return b;
  if (!b.is_reachable) return a;
  State result = a.assigned.size() <= b.assigned.size() ? a : b;
  const State& other = a.assigned.size() <= b.assigned.size() ? b : a;
  for (size_t i = 0; i < result.assigned.size(); ++i)
    result.assigned[i] = result.assigned[i] && other.assigned[i];
  return result;
}

bool is_literal(const Expr& expr, bool value) {
  const auto* literal = try_as<BooleanExpr>(&strip_parentheses(expr));
  return literal != nullptr && literal->value == value;
}

/// A name of the library that the shader takes for its own has another value until then.
Code unassigned_code(const Context& context, const void* variable) {
  return context.hidden_names.contains(variable) ? Code::HiddenUnassigned : Code::UnassignedVariable;
}

class Flow {
public:
  Flow(Context& context, Work& work) : context_(context), work_(work) {}

  void run() {
    block(*work_.function->body);
    if (state_.is_reachable && work_.function->parent != nullptr && !work_.results.empty())
      context_.error(Code::MissingReturn, work_.function->end_span).note(Code::NoteOtherReturn, work_.first_return);
    const State exit = merge(exit_, state_);
    work_.never_returns = !exit.is_reachable;
    for (const auto& [variable, number] : numbers_)
      if (exit.has(number) && (work_.function->parent == nullptr || !is_own(variable)))
        work_.assigns_always.push_back(variable);
    std::ranges::sort(work_.assigns_always, std::less<>());
  }

private:
  bool is_top() const { return work_.function == context_.chunk.main; }

  /// Is the variable one of this call (at the top level also a global), so that nobody else can have assigned it?
  bool is_own(const void* variable) const {
    if (is_top()) return true;
    const auto found = work_.variables.find(static_cast<const Local*>(variable));
    return found != work_.variables.end();
  }

  unsigned number_of(const void* variable) {
    return numbers_.try_emplace(variable, static_cast<unsigned>(numbers_.size())).first->second;
  }

  const void* tracked(const Local& local) const { return context_.unset_locals.contains(&local) ? &local : nullptr; }

  const void* tracked(const Global* global) const {
    if (context_.is_library_code(work_)) return nullptr; // whose top level has run, so to speak
    return global == nullptr || global->is_broken ? nullptr : global;
  }

  /// The variable of a name that is read, where it can be unassigned; null otherwise.
  const void* tracked(const NameExpr& name) {
    return name.local != nullptr ? tracked(*name.local) : tracked(context_.find_global(work_, name));
  }

  /// The same of one that gets a value.
  const void* assigned(const NameExpr& name) {
    return name.local != nullptr ? tracked(*name.local) : tracked(context_.globals.find(name.name));
  }

  void require(const void* variable, std::string_view name, Span place, const Span* call) {
    const unsigned number = number_of(variable);
    if (!state_.is_reachable || state_.has(number)) return;
    state_.set(number, true); // once is enough
    if (is_own(variable)) {
      Diagnostic& diagnostic = context_.error(unassigned_code(context_, variable), place, {std::string(name)});
      if (call != nullptr) diagnostic.note(Code::NoteReadDuringCall, *call);
      return;
    }
    if (!required_.insert(variable).second) return;
    if (++context_.facts > kMaxFacts) {
      context_.too_large(place, "the functions of this shader read too many variables of their surroundings",
                         kMaxFacts);
      return;
    }
    work_.requires_assigned.push_back({variable, name, place});
  }

  // ---- expressions, in the order of evaluation

  void expressions(std::span<Expr* const> exprs) {
    for (const Expr* expr : exprs)
      expression(*expr);
  }

  /// A variable of a call that has ended and left the function as its result.
  static bool is_outlived(const Work& callee, const void* variable) {
    for (const Work* frame = callee.parent; frame != nullptr; frame = frame->parent)
      if (frame->parent != nullptr && frame->frame_home != nullptr &&
          frame->variables.contains(static_cast<const Local*>(variable)))
        return true;
    return false;
  }

  void call(uint32_t id, Span span) {
    const auto found = work_.callees.find(id);
    if (found == work_.callees.end()) return;
    const Work& callee = *found->second.work;
    for (const Requirement& requirement : callee.requires_assigned)
      if (work_.variables.contains(static_cast<const Local*>(requirement.variable)) ||
          !is_outlived(callee, requirement.variable))
        require(requirement.variable, requirement.name, requirement.place, &span);
    for (const void* variable : callee.assigns_always)
      state_.set(number_of(variable), true);
  }

  void expression(const Expr& expr) {
    visit(expr, Overloaded{
                    [&](const NameExpr& name) {
                      if (const void* variable = tracked(name)) require(variable, name.name, name.span, nullptr);
                    },
                    [&](const IndexExpr& index) {
                      expression(*index.object);
                      expression(*index.key);
                    },
                    [&](const CallExpr& node) {
                      expression(*node.callee);
                      expressions(node.args);
                      call(node.id, node.span);
                    },
                    [&](const MethodCallExpr& node) {
                      expression(*node.object);
                      expressions(node.args);
                    },
                    [&](const TableExpr& table) {
                      for (const TableField& field : table.fields)
                        expression(*field.value);
                    },
                    [&](const ParenExpr& paren) { expression(*paren.inner); },
                    [&](const UnaryExpr& unary) { expression(*unary.operand); },
                    [&](const BinaryExpr& binary) {
                      expression(*binary.left);
                      const bool may_skip = binary.op == BinaryOp::And || binary.op == BinaryOp::Or;
                      State before;
                      if (may_skip) before = state_;
                      expression(*binary.right);
                      if (may_skip) state_ = merge(before, state_);
                    },
                    [](const auto&) {},
                });
  }

  // ---- statements

  void block(const Block& block) {
    for (const Stat* stat : block.stats)
      statement(*stat);
  }

  /// How many values a list gives; a call that was refused gives enough.
  size_t value_count(std::span<Expr* const> exprs) const {
    if (exprs.empty()) return 0;
    const Expr& last = *exprs.back();
    if (last.kind != ExprKind::Call && last.kind != ExprKind::MethodCall) return exprs.size();
    const auto fact = work_.spec->expressions.find(last.id);
    return fact == work_.spec->expressions.end() ? SIZE_MAX : exprs.size() - 1 + fact->second.results.size();
  }

  void local(const LocalStat& stat) {
    expressions(stat.values);
    const size_t count = value_count(stat.values);
    for (size_t i = 0; i < stat.locals.size(); ++i)
      if (context_.unset_locals.contains(stat.locals[i])) state_.set(number_of(stat.locals[i]), i < count);
  }

  void assign(const AssignStat& stat) {
    expressions(stat.values);
    for (const Expr* target : stat.targets) {
      if (const auto* name = try_as<NameExpr>(target)) {
        if (const void* variable = assigned(*name)) state_.set(number_of(variable), true);
      } else {
        expression(*target);
      }
    }
  }

  void branches(const IfStat& stat) {
    State after = unreachable();
    for (const IfClause& clause : stat.clauses) {
      expression(*clause.condition);
      const State before = state_;
      block(*clause.body);
      after = merge(after, state_);
      state_ = before;
    }
    if (stat.else_body != nullptr) block(*stat.else_body);
    state_ = merge(after, state_);
  }

  /// The state behind a loop that ends in `exit`, or by a `break`.
  void leave_loop(const Stat& loop, State exit) {
    const auto found = jumps_.find(&loop);
    state_ = found == jumps_.end() ? std::move(exit) : merge(found->second, exit);
  }

  void jump(const Stat* target) {
    if (target != nullptr) {
      const auto [found, is_new] = jumps_.try_emplace(target, state_);
      if (!is_new) found->second = merge(found->second, state_);
    }
    state_ = unreachable();
  }

  void call_statement(const CallStat& stat) {
    expression(*stat.call);
    const auto fact = work_.spec->expressions.find(stat.call->id);
    if (fact == work_.spec->expressions.end() || stat.call->kind != ExprKind::Call) return;
    const auto callee = work_.callees.find(stat.call->id);
    const bool ends = callee != work_.callees.end()
                          ? callee->second.work->never_returns
                          : fact->second.call == CallKind::Error && fact->second.type.kind == Type::Kind::None;
    if (ends) state_ = unreachable();
  }

  void statement(const Stat& stat) {
    for (size_t i = 0; work_.function->parent == nullptr && i < context_.modules.size(); ++i)
      if (context_.modules[i].before == &stat) call(module_call(i), context_.modules[i].required);
    visit(stat, Overloaded{
                    [&](const LocalStat& node) { local(node); },
                    [&](const AssignStat& node) { assign(node); },
                    [&](const CallStat& node) { call_statement(node); },
                    [&](const DoStat& node) { block(*node.body); },
                    [&](const WhileStat& node) {
                      expression(*node.condition);
                      State exit = is_literal(*node.condition, true) ? unreachable() : state_;
                      block(*node.body);
                      leave_loop(node, std::move(exit));
                    },
                    [&](const RepeatStat& node) {
                      block(*node.body);
                      expression(*node.condition);
                      leave_loop(node, is_literal(*node.condition, false) ? unreachable() : state_);
                    },
                    [&](const IfStat& node) { branches(node); },
                    [&](const NumericForStat& node) {
                      expression(*node.start);
                      expression(*node.limit);
                      if (node.step != nullptr) expression(*node.step);
                      State exit = state_;
                      block(*node.body);
                      leave_loop(node, std::move(exit));
                    },
                    [&](const GenericForStat& node) {
                      expressions(node.values);
                      for (const Local* variable : node.variables)
                        if (context_.unset_locals.contains(variable)) state_.set(number_of(variable), false);
                      State exit = state_;
                      block(*node.body);
                      leave_loop(node, std::move(exit));
                    },
                    [&](const FunctionStat& node) {
                      const auto* name = try_as<NameExpr>(node.target);
                      if (name == nullptr) return;
                      if (const void* variable = assigned(*name)) state_.set(number_of(variable), true);
                    },
                    [&](const ReturnStat& node) {
                      expressions(node.values);
                      exit_ = merge(exit_, state_);
                      state_ = unreachable();
                    },
                    [&](const BreakStat& node) { jump(node.loop); },
                    [&](const GotoStat& node) { jump(node.target); },
                    [&](const LabelStat& node) { leave_loop(node, state_); },
                    [](const auto&) {},
                });
  }

  Context& context_;
  Work& work_;
  State state_;
  State exit_ = unreachable();
  std::unordered_map<const void*, unsigned> numbers_;
  std::unordered_map<const Stat*, State> jumps_; ///< by loop and label
  std::set<const void*> required_;
};

} // namespace

void check_assigned(Context& context, Work& work) { Flow(context, work).run(); }

void check_assigned_for_entry(Context& context, const Work& top, const Global& global, const Work& entry) {
  if (top.never_returns) return;
  const auto is_assigned = [&](const void* variable) {
    return std::ranges::binary_search(top.assigns_always, variable, std::less<>());
  };
  if (!is_assigned(&global)) context.error(Code::FunctionNotKnown, global.definition, {std::string(global.name)});
  for (const Requirement& requirement : entry.requires_assigned)
    if (!is_assigned(requirement.variable))
      context.error(unassigned_code(context, requirement.variable), requirement.place, {std::string(requirement.name)});
}

} // namespace moonshade::sema
