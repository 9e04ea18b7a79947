// One traversal of the whole tree. Definitions inside functions are refused later, where the body is walked; only those
// of the top level define anything.
#include "compiler/sema/globals.h"

#include <utility>

namespace moonshade::sema {

using namespace syntax;

namespace {

class Collector {
public:
  explicit Collector(Globals& globals) : globals_(globals) {}

  void block(const Block& block, bool certain) {
    const Block* const around = std::exchange(block_, &block);
    for (const Stat* stat : block.stats)
      statement(*stat, certain);
    block_ = around;
  }

private:
  void assign_local(const Local& local) {
    const auto declared = declared_in_.find(&local);
    if (declared == declared_in_.end()) return;
    const bool is_first = assigned_.insert(&local).second;
    if (is_first && declared->second == block_) {
      globals_.assigned_once.insert(&local);
    } else {
      globals_.assigned_once.erase(&local);
    }
  }

  void define(const NameExpr& target, const Function* function, bool certain) {
    if (target.local != nullptr) assign_local(*target.local);
    if (!target.is_global() || target.environment != nullptr) return;
    if (function_depth_ != 0) {
      globals_.assigned_inside.insert(target.name);
      return;
    }
    const auto [found, is_new] = globals_.by_name.try_emplace(target.name);
    Global& global = found->second;
    if (is_new) {
      global.name = target.name;
      global.definition = target.span;
      global.function = function;
      global.in_branch = !certain;
      global.is_broken = function != nullptr && !certain;
      if (function != nullptr) globals_.functions.push_back(&global);
    } else if (function != nullptr || global.function != nullptr) {
      global.is_broken = true;
    }
  }

  void function(const Function& function) {
    ++function_depth_;
    block(*function.body, false);
    --function_depth_;
  }

  void expressions(std::span<Expr* const> exprs) {
    for (const Expr* expr : exprs)
      expression(expr);
  }

  void expression(const Expr* expr) {
    if (expr == nullptr) return;
    visit(*expr, Overloaded{
                     [&](const NameExpr& name) {
                       if (name.is_global()) used_.push_back(name.name);
                     },
                     [&](const Function& inner) { function(inner); },
                     [&](const IndexExpr& index) {
                       expression(index.object);
                       expression(index.key);
                     },
                     [&](const CallExpr& call) {
                       expression(call.callee);
                       expressions(call.args);
                     },
                     [&](const MethodCallExpr& call) {
                       expression(call.object);
                       expressions(call.args);
                     },
                     [&](const ParenExpr& paren) { expression(paren.inner); },
                     [&](const UnaryExpr& unary) { expression(unary.operand); },
                     [&](const BinaryExpr& binary) {
                       expression(binary.left);
                       expression(binary.right);
                     },
                     [&](const TableExpr& table) {
                       for (const TableField& field : table.fields) {
                         expression(field.key);
                         expression(field.value);
                       }
                     },
                     [](const auto&) {},
                 });
  }

  void assignment(const AssignStat& stat, bool certain) {
    expressions(stat.values);
    for (size_t i = 0; i < stat.targets.size(); ++i) {
      const auto* name = try_as<NameExpr>(stat.targets[i]);
      if (name == nullptr) {
        expression(stat.targets[i]);
        continue;
      }
      const Expr* value = i < stat.values.size() ? stat.values[i] : nullptr;
      define(*name, try_as<Function>(value), certain);
    }
  }

  void statement(const Stat& stat, bool certain) {
    visit(stat, Overloaded{
                    [&](const LocalStat& local) {
                      expressions(local.values);
                      if (!local.values.empty()) return;
                      for (const Local* each : local.locals)
                        declared_in_[each] = block_;
                    },
                    [&](const AssignStat& assign) { assignment(assign, certain); },
                    [&](const CallStat& call) { expression(call.call); },
                    [&](const DoStat& body) { block(*body.body, certain); },
                    [&](const WhileStat& loop) {
                      expression(loop.condition);
                      block(*loop.body, false);
                    },
                    [&](const RepeatStat& loop) {
                      block(*loop.body, false);
                      expression(loop.condition);
                    },
                    [&](const IfStat& branch) {
                      for (const IfClause& clause : branch.clauses) {
                        expression(clause.condition);
                        block(*clause.body, false);
                      }
                      if (branch.else_body != nullptr) block(*branch.else_body, false);
                    },
                    [&](const NumericForStat& loop) {
                      expression(loop.start);
                      expression(loop.limit);
                      expression(loop.step);
                      block(*loop.body, false);
                    },
                    [&](const GenericForStat& loop) {
                      expressions(loop.values);
                      block(*loop.body, false);
                    },
                    [&](const FunctionStat& definition) {
                      if (const auto* name = try_as<NameExpr>(definition.target)) {
                        define(*name, definition.function, certain);
                      } else {
                        expression(definition.target);
                      }
                      function(*definition.function);
                    },
                    [&](const LocalFunctionStat& definition) { function(*definition.function); },
                    [&](const ReturnStat& result) { expressions(result.values); },
                    [](const auto&) {},
                });
  }

public:
  void mark_used() {
    for (const std::string_view name : used_)
      if (Global* global = globals_.find(name)) global->is_used = true;
  }

private:
  Globals& globals_;
  unsigned function_depth_ = 0;
  const Block* block_ = nullptr;
  std::unordered_map<const Local*, const Block*> declared_in_; ///< of those declared without a value
  std::set<const Local*> assigned_;
  std::vector<std::string_view> used_;
};

} // namespace

Globals collect_globals(const Chunk& chunk) {
  Globals globals;
  Collector collector(globals);
  collector.block(*chunk.main->body, true);
  collector.mark_used();
  return globals;
}

} // namespace moonshade::sema
