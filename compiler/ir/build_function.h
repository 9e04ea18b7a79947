// Inside `build` only: the state of the translation of one specialisation, shared by build.cpp (functions) and the
// files build_*.cpp.
#pragma once

#include "compiler/ir/build_calculus.h"
#include "compiler/ir/builder.h"
#include "compiler/sema/program.h"

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace moonshade::ir {

/// What the translations of all functions share.
struct ModuleBuild {
  const sema::Program& program;
  Module& module;
  std::vector<GlobalId> parameters; ///< by the shader's parameter; kNone for strings
  Derivatives derivatives;          ///< that the bodies call
};

/// The type that a value of one of sema's types has at run time; none where it has no storage.
std::optional<ValueType> run_time_type(const sema::Type& type);
/// Those of a list that have one.
std::vector<ValueType> run_time_types(const std::vector<sema::Type>& types);
/// The library's function of this name for these parameters; null where there is none.
const LibraryFunction* find_row(std::string_view name, std::initializer_list<ValueType> types);

class FunctionBuild {
public:
  FunctionBuild(ModuleBuild& shared, const sema::Specialisation& specialisation, Function& function);
  /// Translates the whole body.
  void run();

private:
  using Values = std::vector<ValueId>;

  /// Sets the span of what is emitted until the end of the scope.
  class At {
  public:
    At(Builder& builder, Span span) : builder_(builder), before_(builder.span()) { builder_.set_span(span); }
    ~At() { builder_.set_span(before_); }
    At(const At&) = delete;
    At& operator=(const At&) = delete;

  private:
    Builder& builder_;
    Span before_;
  };

  // Functions (build.cpp)
  void receive_parameters();
  VariableId variable_of(const sema::Slot& slot);
  const sema::LocalFact* local_fact(const syntax::Local& local) const;
  /// The variable gets a value of this type; a table that is not the variable's own is copied.
  void store_local(const syntax::Local& local, ValueId value, const sema::Type& type);
  void store_slot(const sema::Slot& slot, ValueId value);
  /// At the end of the top level: what shading reads is copied into globals.
  void store_globals();
  const sema::ExpressionFact& fact(const syntax::Expr& expr) const;
  /// What sema should have refused: faults wherever it is executed, and is loud about it.
  void defect(std::string_view what);

  // Expressions (build_expressions.cpp). A value of kNone stands for what has none at run time: functions and strings.
  ValueId evaluate(const syntax::Expr& expr);
  /// What is known while compiling, a string, a function or a length, may be written as a call that faults or assigns.
  void effects_of(const syntax::Expr& expr);
  ValueId evaluate_as(const syntax::Expr& expr, ValueType type) { return converted(evaluate(expr), type); }
  /// All values of a list as Lua adjusts it: the last expression gives all its values, the others one each.
  Values evaluate_list(std::span<syntax::Expr* const> exprs);
  /// All values of one expression.
  Values evaluate_all(const syntax::Expr& expr);
  /// The types of what evaluate_list gives.
  std::vector<sema::Type> types_of(std::span<syntax::Expr* const> exprs) const;
  ValueId converted(ValueId value, ValueType type);
  ValueId evaluate_kind(const syntax::Expr& expr);
  ValueId name(const syntax::NameExpr& expr);
  ValueId index(const syntax::IndexExpr& expr);
  ValueId constant(const sema::ExpressionFact& known);
  ValueId unary(const syntax::UnaryExpr& expr);
  ValueId binary(const syntax::BinaryExpr& expr);
  ValueId arithmetic(const syntax::BinaryExpr& expr, const sema::ExpressionFact& known);
  ValueId library_operator(const syntax::BinaryExpr& expr, const sema::ExpressionFact& known);
  ValueId comparison(const syntax::BinaryExpr& expr, const sema::ExpressionFact& known);
  ValueId mixed_comparison(syntax::BinaryOp op, ValueId left, ValueId right);
  ValueId logical(const syntax::BinaryExpr& expr);
  ValueId conditional(const syntax::BinaryExpr& expr, ValueType type);
  ValueId conditional_table(const syntax::BinaryExpr& expr, const sema::Type& type);
  ValueId choose(ValueId condition, ValueType type, Block then_block, ValueId then_value, Block else_block,
                 ValueId else_value);
  ValueId table_function(const sema::ExpressionFact& known, const sema::Type& array, const Values& arguments);
  ValueId dynamic_component(const syntax::IndexExpr& expr);
  ValueId library_value(const LibraryFunction& row, ValueType type, Values operands);
  void divisor_fault(ValueId divisor);
  std::optional<int64_t> known_integer(ValueId value) const;

  // Calls (build_calls.cpp)
  Values call(const syntax::Expr& expr);
  Values call_specialisation(const sema::ExpressionFact& known, const Values& arguments);
  Values call_library(const sema::ExpressionFact& known, Values arguments);
  Values square_numbers(ValueType type, ValueId argument);
  Values column_of(ValueId matrix, unsigned column);
  ValueId matrix_times(ValueId matrix, const Values& vector);
  ValueId matrix_product(ValueId left, ValueId right);
  ValueId transposed(ValueId matrix);
  ValueId construct(ValueType type, const Values& arguments);
  ValueId integer_of(ValueId number);
  Values modf(ValueId argument);
  ValueId texture(const sema::ExpressionFact& known, const syntax::CallExpr& expr);
  ValueId to_integer(const sema::ExpressionFact& known, ValueId argument);
  void assertion(const syntax::Expr& expr, const sema::ExpressionFact& known, ValueId condition);
  void print(std::span<syntax::Expr* const> args, const Values& arguments);
  std::string message_of(const syntax::Expr& argument, std::string_view otherwise) const;
  /// The variables that a call of a specialisation binds to its captures.
  std::vector<VariableId> captures_of(const sema::Specialisation& callee);

  // Derivatives (build_calculus.cpp)
  ValueId gradient(const sema::ExpressionFact& known, ValueId point);
  ValueId fwidth(const sema::ExpressionFact& known, ValueId point, ValueId width);
  // Tables (build_tables.cpp). The value of a table is the number of the element that it is; kNone for one alone.
  ValueId table(const syntax::TableExpr& expr);
  void construct(const syntax::TableExpr& expr, const sema::Table& table, ValueId element);
  void construct_slot(const sema::Table& table, const sema::Table::Field& field, ValueId element,
                      const syntax::Expr& value);
  void give_slot(const sema::Table& table, const sema::Table::Field& field, ValueId element, ValueId value,
                 const sema::Type& type);
  /// All of `from` into `to`, unless they are the same.
  void copy_table(const sema::Table& to, ValueId to_element, const sema::Table& from, ValueId from_element);
  void copy_elements(const sema::Table& to, ValueId to_element, const sema::Table& from, ValueId from_element);
  void copy_fields(const sema::Table& to, ValueId to_slot, const sema::Table& from, ValueId from_slot);
  /// A value where a table of this kind is to be: copied into it, where it is another one.
  ValueId as_table(const sema::Type& to, ValueId value, const sema::Type& from);
  /// The number of slot `index` (from 0; kNone for a record's) of a table among all its slots of that field.
  ValueId slot_number(const sema::Table& table, ValueId element, ValueId index);
  ValueId load_leaf(const sema::Table::Field& field, ValueId slot);
  void store_leaf(const sema::Table::Field& field, ValueId slot, ValueId value);
  /// A slot that an expression names: its object and key are evaluated, the key not checked yet.
  struct Access {
    const sema::Table::Field* field = nullptr;
    const sema::Table* table = nullptr;
    ValueId element = kNone; ///< kNone: the table is there once
    ValueId key = kNone;     ///< of an array
    Span place{};
  };
  Access access(const syntax::IndexExpr& expr);
  /// The number of the slot, or a fault.
  ValueId checked_slot(const Access& access);
  ValueId table_index(const syntax::IndexExpr& expr);
  void ipairs_loop(const syntax::GenericForStat& stat);

  // Statements (build_statements.cpp)
  void statements(const syntax::Block& block);
  void statements(std::span<syntax::Stat* const> stats);
  void statement(const syntax::Stat& stat);
  void local(const syntax::LocalStat& stat);
  void assign(const syntax::AssignStat& stat);
  void if_chain(const syntax::IfStat& stat);
  void if_clauses(const syntax::IfStat& stat, size_t clause);
  void while_loop(const syntax::WhileStat& stat);
  void repeat_loop(const syntax::RepeatStat& stat);
  void numeric_for(const syntax::NumericForStat& stat);
  void integer_for(const syntax::NumericForStat& stat, ValueId start, ValueId limit, ValueId step);
  void float_for(const syntax::NumericForStat& stat, ValueId start, ValueId limit, ValueId step);
  /// A limit of an integer loop that is a number: the integer it stands for, and whether the loop is skipped anyway.
  struct Limit {
    ValueId value;
    ValueId skip; ///< kNone: never
  };
  Limit clip_limit(ValueId limit, ValueId step);
  ValueId is_last_iteration(ValueId counter, ValueId limit, ValueId step);
  ValueId is_positive(ValueId step);
  void loop_body(const syntax::NumericForStat& stat, VariableId counter);
  void break_if(ValueId condition, LabelId label);
  void return_statement(const syntax::ReturnStat& stat);
  void find_goto_targets(const syntax::Block& block);

  ModuleBuild& shared_;
  const sema::Specialisation& specialisation_;
  Function& function_;
  Builder b_;
  std::unordered_map<const sema::Slot*, VariableId> variables_;
  std::unordered_map<const syntax::Stat*, LabelId> labels_; ///< of loops and of labels that a goto names
  std::unordered_set<const syntax::LabelStat*> goto_targets_;
};

} // namespace moonshade::ir
