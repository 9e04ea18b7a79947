// One traversal of the whole tree. Definitions inside functions are refused later, where the body is walked; only those
// of the top level define anything.
#include "compiler/sema/globals.h"

#include <algorithm>
#include <optional>

namespace moonshade::sema {

using namespace syntax;

namespace {

class Collector {
public:
  Collector(Globals& globals, std::vector<RequireCall>& require_calls)
      : globals_(globals), require_calls_(require_calls) {}

  void block(const Block& block, bool certain) {
    for (const Stat* stat : block.stats)
      statement(*stat, certain);
  }

private:
  /// A branch that is open: clause `index` of an `if` (the last is `else`), or of a loop or function (null).
  struct Branch {
    const IfStat* stat;
    size_t index;
    bool operator==(const Branch&) const = default;
  };
  using Path = std::vector<Branch>;

  /// Whether at most one of the two places is reached, as far as branches of `if`s tell, from `depth` on.
  static bool exclude_each_other(const Path& a, const Path& b, size_t depth) {
    for (size_t i = depth; i < std::min(a.size(), b.size()); ++i)
      if (a[i] != b[i]) return a[i].stat != nullptr && a[i].stat == b[i].stat;
    return false;
  }

  void assign_local(const Local& local) {
    const auto declared = declared_in_.find(&local);
    if (declared == declared_in_.end()) return;
    std::vector<Path>& before = assigned_[&local];
    const size_t depth = declared->second;
    if (before.empty() && depth == path_.size()) {
      globals_.assigned_once.insert(&local);
    } else {
      globals_.assigned_once.erase(&local);
    }
    bool in_branches = std::all_of(path_.begin() + static_cast<std::ptrdiff_t>(depth), path_.end(),
                                   [](const Branch& branch) { return branch.stat != nullptr; });
    for (const Path& other : before)
      in_branches = in_branches && exclude_each_other(other, path_, depth);
    if (before.empty() && in_branches) globals_.assigned_in_branches.insert(&local);
    if (!in_branches) globals_.assigned_in_branches.erase(&local);
    before.push_back(path_);
  }

  void define(const NameExpr& target, const Function* function, bool certain, Span stat) {
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
      global.begins = loop_begin_.value_or(stat.end);
      global.function = function;
      global.in_branch = !certain;
      global.is_broken = function != nullptr && !certain;
      if (function != nullptr) globals_.functions.push_back(&global);
    } else {
      global.is_single = false;
      global.is_broken = global.is_broken || function != nullptr || global.function != nullptr;
    }
  }

  void function(const Function& function) {
    ++function_depth_;
    branch({nullptr, 0}, *function.body);
    --function_depth_;
  }

  void loop(const Stat& stat, const Block& body) {
    const std::optional<uint32_t> around = loop_begin_;
    if (!loop_begin_) loop_begin_ = stat.span.begin;
    branch({nullptr, 0}, body);
    loop_begin_ = around;
  }

  void branch(Branch branch, const Block& body) {
    path_.push_back(branch);
    block(body, false);
    path_.pop_back();
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
                       const auto* name = try_as<NameExpr>(call.callee);
                       if (name != nullptr && name->is_global() && name->name == "require")
                         require_calls_.push_back({&call, certain_stat_, is_certain_ && skippable_ == 0});
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
                       const bool may_skip = binary.op == BinaryOp::And || binary.op == BinaryOp::Or;
                       expression(binary.left);
                       skippable_ += may_skip;
                       expression(binary.right);
                       skippable_ -= may_skip;
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
      define(*name, try_as<Function>(value), certain, stat.span);
    }
  }

  void statement(const Stat& stat, bool certain) {
    is_certain_ = certain && !may_have_left_;
    if (is_certain_) certain_stat_ = &stat;
    visit(stat, Overloaded{
                    [&](const LocalStat& local) {
                      expressions(local.values);
                      if (!local.values.empty()) return;
                      for (const Local* each : local.locals)
                        declared_in_[each] = path_.size();
                    },
                    [&](const AssignStat& assign) { assignment(assign, certain); },
                    [&](const CallStat& call) { expression(call.call); },
                    [&](const DoStat& body) { block(*body.body, certain); },
                    [&](const WhileStat& loop) {
                      expression(loop.condition);
                      this->loop(loop, *loop.body);
                    },
                    [&](const RepeatStat& loop) {
                      this->loop(loop, *loop.body);
                      is_certain_ = false;
                      expression(loop.condition);
                    },
                    [&](const IfStat& stat) {
                      for (size_t i = 0; i < stat.clauses.size(); ++i) {
                        is_certain_ = is_certain_ && i == 0;
                        expression(stat.clauses[i].condition);
                        branch({&stat, i}, *stat.clauses[i].body);
                      }
                      if (stat.else_body != nullptr) branch({&stat, stat.clauses.size()}, *stat.else_body);
                    },
                    [&](const NumericForStat& loop) {
                      expression(loop.start);
                      expression(loop.limit);
                      expression(loop.step);
                      this->loop(loop, *loop.body);
                    },
                    [&](const GenericForStat& loop) {
                      expressions(loop.values);
                      this->loop(loop, *loop.body);
                    },
                    [&](const FunctionStat& definition) {
                      if (const auto* name = try_as<NameExpr>(definition.target)) {
                        define(*name, definition.function, certain, definition.span);
                      } else {
                        expression(definition.target);
                      }
                      function(*definition.function);
                    },
                    [&](const LocalFunctionStat& definition) { function(*definition.function); },
                    [&](const ReturnStat& result) {
                      expressions(result.values);
                      leave();
                    },
                    [&](const GotoStat&) { leave(); },
                    [](const auto&) {},
                });
  }

  void leave() { may_have_left_ = may_have_left_ || function_depth_ == 0; }

public:
  void mark_used() {
    for (const std::string_view name : used_)
      if (Global* global = globals_.find(name)) global->is_used = true;
  }

private:
  Globals& globals_;
  std::vector<RequireCall>& require_calls_;
  unsigned function_depth_ = 0;
  std::optional<uint32_t> loop_begin_; ///< of the outermost loop of the top level
  const Stat* certain_stat_ = nullptr;
  bool is_certain_ = true;     ///< the expression being walked is reached whatever happens
  bool may_have_left_ = false; ///< a statement of the top level before this one leaves its block
  unsigned skippable_ = 0;     ///< right sides of `and` and `or` around the expression
  Path path_;
  std::unordered_map<const Local*, size_t> declared_in_; ///< of those declared without a value: the path's length there
  std::unordered_map<const Local*, std::vector<Path>> assigned_;
  std::vector<std::string_view> used_;
};

} // namespace

void collect_globals(const Chunk& chunk, Globals& globals, std::vector<RequireCall>& calls) {
  Collector collector(globals, calls);
  collector.block(*chunk.main->body, true);
  collector.mark_used();
}

} // namespace moonshade::sema
