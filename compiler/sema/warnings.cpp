// The warnings (warnings.h). One traversal gathers uses and ways out of loops and judges blocks on the way; what needs
// the whole file is judged at its end.
#include "compiler/sema/warnings.h"

#include "compiler/sema/names.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

bool is_exempt(std::string_view name) { return name.starts_with('_'); }

class Warner {
public:
  Warner(const Program& program, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (const auto& specialisation : program.specialisations)
      specialisations_[specialisation->function].push_back(specialisation.get());
  }

  void check(const Chunk& chunk) {
    function(*chunk.main);
    for (const Local* local : declared_)
      judge_use(*local);
    for (const auto& [name, span] : called_globals_)
      if (const auto found = defined_globals_.find(name); found != defined_globals_.end())
        warn_of_hidden(name, found->second, span);
  }

private:
  /// What may leave a loop besides its condition.
  struct Loop {
    bool has_break = false, has_jump = false; ///< a jump: return, goto, error()
  };

  // ---- declarations and uses ----

  void declare(const Local& local, const Expr* value) {
    declared_.push_back(&local);
    if (value != nullptr) values_[&local] = value;
  }

  bool is_read(const Local& local) const { return read_.contains(&local); }

  void judge_use(const Local& local) {
    if (is_exempt(local.name)) return;
    if (!is_read(local)) {
      const auto value = values_.find(&local);
      const bool is_function =
          local.kind == LocalKind::Function || (value != values_.end() && try_as<Function>(value->second) != nullptr);
      diagnostics_.report(is_function ? Code::UnusedFunction : Code::UnusedLocal, local.span,
                          {std::string(local.name)});
    } else if (const auto call = called_locals_.find(&local); call != called_locals_.end()) {
      if (!stands_for_library(local)) warn_of_hidden(local.name, local.span, call->second);
    }
  }

  /// `local sin = math.sin`: the name still says what it is.
  bool stands_for_library(const Local& local) const {
    const auto value = values_.find(&local);
    if (value == values_.end()) return false;
    const Expr& expr = strip_parentheses(*value->second);
    if (const auto* index = try_as<IndexExpr>(&expr)) return try_as<NameExpr>(index->object) != nullptr;
    const auto* name = try_as<NameExpr>(&expr);
    return name != nullptr && name->is_global();
  }

  void warn_of_hidden(std::string_view name, Span definition, Span call) {
    if (is_exempt(name) || !(is_library_function(name) || is_built_in(name))) return;
    diagnostics_.report(Code::HiddenLibraryName, definition, {std::string(name)}).note(Code::NoteCalledHere, call);
  }

  void note_call(const Expr& callee) {
    const auto* name = try_as<NameExpr>(&callee);
    if (name == nullptr) return;
    if (name->is_global() && !is_of_library(*name))
      called_globals_.try_emplace(name->name, name->span);
    else if (name->local != nullptr &&
             (name->local->kind == LocalKind::Variable || name->local->kind == LocalKind::Function))
      called_locals_.try_emplace(name->local, name->span);
  }

  /// The global stands for what the library has, wherever it is reached: it is not defined yet, or a name for that.
  bool is_of_library(const NameExpr& name) const {
    const auto specialisations = specialisations_.find(function_);
    if (specialisations == specialisations_.end()) return false;
    return std::ranges::all_of(specialisations->second, [&](const Specialisation* specialisation) {
      const auto fact = specialisation->expressions.find(name.id);
      return fact != specialisation->expressions.end() && fact->second.name == NameKind::Library;
    });
  }

  void define(const Expr& target) {
    const auto* name = try_as<NameExpr>(&target);
    if (name == nullptr) return expression(&target);
    if (name->is_global()) defined_globals_.try_emplace(name->name, name->span);
  }

  // ---- expressions ----

  void expressions(std::span<Expr* const> exprs) {
    for (const Expr* expr : exprs)
      expression(expr);
  }

  void expression(const Expr* expr) {
    if (expr == nullptr) return;
    visit(*expr, Overloaded{
                     [&](const NameExpr& name) {
                       if (name.local != nullptr) read_.insert(name.local);
                       if (name.environment != nullptr) read_.insert(name.environment);
                     },
                     [&](const Function& inner) { function(inner); },
                     [&](const IndexExpr& index) {
                       expression(index.object);
                       expression(index.key);
                     },
                     [&](const CallExpr& call) {
                       note_call(*call.callee);
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

  void function(const Function& function) {
    const Function* const around = std::exchange(function_, &function);
    std::vector<const Stat*> loops_around = std::exchange(loops_around_, {});
    block(*function.body);
    loops_around_ = std::move(loops_around);
    function_ = around;
  }

  // ---- statements ----

  void block(const Block& block) {
    const Stat* end = nullptr; // the statement behind which nothing is reached
    bool is_reported = false;
    for (const Stat* stat : block.stats) {
      if (try_as<LabelStat>(stat) != nullptr) end = nullptr;
      if (end != nullptr && !is_reported) {
        diagnostics_.report(Code::UnreachableCode, stat->span).note(Code::NoteControlLeaves, end->span);
        is_reported = true;
      }
      statement(*stat);
      if (ends(*stat)) end = stat;
    }
  }

  void optional_block(const Block* body) {
    if (body != nullptr) block(*body);
  }

  void jump() {
    for (const Stat* loop : loops_around_)
      loops_[loop].has_jump = true;
  }

  void loop(const Stat& stat, const Block& body) {
    loops_around_.push_back(&stat);
    block(body);
    loops_around_.pop_back();
  }

  void statement(const Stat& stat) {
    visit(stat, Overloaded{
                    [&](const LocalStat& local) {
                      expressions(local.values);
                      for (size_t i = 0; i < local.locals.size(); ++i)
                        declare(*local.locals[i], i < local.values.size() ? local.values[i] : nullptr);
                    },
                    [&](const AssignStat& assign) {
                      expressions(assign.values);
                      for (const Expr* target : assign.targets)
                        define(*target);
                    },
                    [&](const CallStat& call) {
                      expression(call.call);
                      if (is_error_call(stat)) jump();
                    },
                    [&](const DoStat& body) { block(*body.body); },
                    [&](const WhileStat& repeated) {
                      expression(repeated.condition);
                      loop(repeated, *repeated.body);
                      judge_condition(repeated, *repeated.condition, false);
                    },
                    [&](const RepeatStat& repeated) {
                      loop(repeated, *repeated.body);
                      expression(repeated.condition);
                      judge_condition(repeated, *repeated.condition, true);
                    },
                    [&](const IfStat& branch) {
                      for (const IfClause& clause : branch.clauses) {
                        expression(clause.condition);
                        block(*clause.body);
                      }
                      optional_block(branch.else_body);
                    },
                    [&](const NumericForStat& repeated) {
                      expression(repeated.start);
                      expression(repeated.limit);
                      expression(repeated.step);
                      loop(repeated, *repeated.body);
                    },
                    [&](const GenericForStat& repeated) {
                      expressions(repeated.values);
                      loop(repeated, *repeated.body);
                    },
                    [&](const FunctionStat& definition) {
                      define(*definition.target);
                      function(*definition.function);
                    },
                    [&](const LocalFunctionStat& definition) {
                      declare(*definition.local, definition.function);
                      function(*definition.function);
                    },
                    [&](const ReturnStat& values) {
                      expressions(values.values);
                      jump();
                    },
                    [&](const BreakStat& leave) { loops_[leave.loop].has_break = true; },
                    [&](const GotoStat&) { jump(); },
                    [](const auto&) {},
                });
  }

  // ---- where control ends (after the statement was walked) ----

  bool is_error_call(const Stat& stat) const {
    const auto* statement = try_as<CallStat>(&stat);
    const auto* call = statement == nullptr ? nullptr : try_as<CallExpr>(statement->call);
    const auto* name = call == nullptr ? nullptr : try_as<NameExpr>(call->callee);
    return name != nullptr && name->is_global() && name->name == "error" && !defined_globals_.contains("error");
  }

  bool ends(const Block& block) const { return !block.stats.empty() && ends(*block.stats.back()); }

  bool is_left(const Stat& loop, bool by_jumps) const {
    const auto found = loops_.find(&loop);
    return found != loops_.end() && (found->second.has_break || (by_jumps && found->second.has_jump));
  }

  bool ends(const Stat& stat) const {
    if (const auto* body = try_as<DoStat>(&stat)) return ends(*body->body);
    if (const auto* loop = try_as<WhileStat>(&stat)) {
      const auto* condition = try_as<BooleanExpr>(&strip_parentheses(*loop->condition));
      return condition != nullptr && condition->value && !is_left(stat, false) && !has_goto(*loop->body);
    }
    if (const auto* branch = try_as<IfStat>(&stat)) {
      if (branch->else_body == nullptr || !ends(*branch->else_body)) return false;
      for (const IfClause& clause : branch->clauses)
        if (!ends(*clause.body)) return false;
      return true;
    }
    return stat.kind == StatKind::Return || stat.kind == StatKind::Break || stat.kind == StatKind::Goto ||
           is_error_call(stat);
  }

  /// Some goto stands in the block: it may lead out of it.
  bool has_goto(const Block& block) const {
    for (const Stat* stat : block.stats)
      if (has_goto(*stat)) return true;
    return false;
  }

  bool has_goto(const Stat& stat) const {
    return visit(stat, Overloaded{
                           [](const GotoStat&) { return true; },
                           [&](const DoStat& body) { return has_goto(*body.body); },
                           [&](const WhileStat& loop) { return has_goto(*loop.body); },
                           [&](const RepeatStat& loop) { return has_goto(*loop.body); },
                           [&](const NumericForStat& loop) { return has_goto(*loop.body); },
                           [&](const GenericForStat& loop) { return has_goto(*loop.body); },
                           [&](const IfStat& branch) {
                             for (const IfClause& clause : branch.clauses)
                               if (has_goto(*clause.body)) return true;
                             return branch.else_body != nullptr && has_goto(*branch.else_body);
                           },
                           [](const auto&) { return false; },
                       });
  }

  // ---- conditions of loops ----

  /// The comparison without whose exact equality the loop goes on; null where something else ends it. `ends_when`: the
  /// truth value of the condition that ends the loop.
  const BinaryExpr* deciding_equality(const Expr& condition, bool ends_when) const {
    const Expr& expr = strip_parentheses(condition);
    if (const auto* negation = try_as<UnaryExpr>(&expr))
      return negation->op == UnaryOp::Not ? deciding_equality(*negation->operand, !ends_when) : nullptr;
    const auto* binary = try_as<BinaryExpr>(&expr);
    if (binary == nullptr) return nullptr;
    if (binary->op == (ends_when ? BinaryOp::Eq : BinaryOp::Ne)) return compares_numbers(*binary) ? binary : nullptr;
    // Both sides must hold (or fail) for the loop to end: either may be what never does.
    if (binary->op != (ends_when ? BinaryOp::And : BinaryOp::Or)) return nullptr;
    const BinaryExpr* left = deciding_equality(*binary->left, ends_when);
    return left != nullptr ? left : deciding_equality(*binary->right, ends_when);
  }

  bool compares_numbers(const BinaryExpr& expr) const {
    const auto specialisations = specialisations_.find(function_);
    if (specialisations == specialisations_.end()) return false;
    for (const Specialisation* specialisation : specialisations->second) {
      const auto found = specialisation->expressions.find(expr.id);
      if (found == specialisation->expressions.end()) continue;
      const ExpressionFact& fact = found->second;
      if (fact.form == OperatorForm::Mixed) return true;
      if (fact.form == OperatorForm::Plain && (fact.operand_type == ValueType::Number || is_vector(fact.operand_type)))
        return true;
    }
    return false;
  }

  void judge_condition(const Stat& loop, const Expr& condition, bool ends_when) {
    if (is_left(loop, true)) return;
    if (const BinaryExpr* equality = deciding_equality(condition, ends_when))
      diagnostics_.report(Code::FloatEqualityLoop, equality->span);
  }

  std::unordered_map<const Function*, std::vector<const Specialisation*>> specialisations_;
  Diagnostics& diagnostics_;
  const Function* function_ = nullptr;
  std::vector<const Stat*> loops_around_; ///< in this function
  std::unordered_map<const Stat*, Loop> loops_;
  std::vector<const Local*> declared_; ///< in order; parameters and loops' variables are not among them
  std::unordered_map<const Local*, const Expr*> values_;
  std::set<const Local*> read_;
  std::unordered_map<const Local*, Span> called_locals_;
  std::map<std::string_view, Span> called_globals_, defined_globals_;
};

} // namespace

void check_warnings(const Chunk& chunk, const Program& program, Diagnostics& diagnostics) {
  Warner(program, diagnostics).check(chunk);
}

} // namespace moonshade::sema
