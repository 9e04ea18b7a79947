// The walk over the body of one specialisation: gives every expression its type, joins the types of variables and
// results, and in the reporting round refuses what the dialect leaves out and records the facts. Its methods stand in
// expressions.cpp, operators.cpp, conditionals.cpp, calls.cpp, calculus.cpp, sums.cpp, images.cpp, parameters.cpp and
// statements.cpp.
#pragma once

#include "compiler/sema/context.h"

#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>

namespace moonshade::sema {

class Walker {
public:
  Walker(Context& context, Work& work) : context_(context), work_(work) {}

  void function_body();

private:
  // ---- expressions.cpp
  Type expression(const syntax::Expr& expr);
  /// All values: several only for a call.
  TypeList values(const syntax::Expr& expr);
  TypeList expression_list(std::span<syntax::Expr* const> exprs);
  Type name(const syntax::NameExpr& expr);
  Type local_name(const syntax::NameExpr& expr);
  Type global_name(const syntax::NameExpr& expr);
  Type global_of_shader(const syntax::NameExpr& expr, Global& global);
  Type index(const syntax::IndexExpr& expr);
  Type library_field(const syntax::IndexExpr& expr, std::string_view table);
  Type vector_component(const syntax::IndexExpr& expr, const Type& object);
  /// Says where a name's value is at run time.
  void set_place(ExpressionFact& fact, Variable& variable, std::string_view name);
  Type function_expression(const syntax::Function& function);
  void refuse_name(Span span, std::string_view name);

  // ---- tables.cpp
  Type table(const syntax::TableExpr& expr);
  /// The constructor fills a table: its own, or the one in the slot of another constructor in which it stands.
  void construct_table(const syntax::TableExpr& expr, Table& table);
  /// Whether the table is written as constants alone; its leaves get their data.
  bool read_data(const syntax::TableExpr& expr, Table& table, uint64_t number);
  bool read_datum(const syntax::Expr& value, const Table& table, Table::Field& field, uint64_t slot);
  void construct_array(const syntax::TableExpr& expr, Table& table);
  void construct_record(const syntax::TableExpr& expr, Table& table);
  void construct_field(Table& table, Table::Field& field, const syntax::Expr& value);
  void construct_field(Table& table, Table::Field& field, const syntax::Expr& value, const Type& type);
  void refuse_element(Table& table, const Table::Field& field, const syntax::Expr& value, const Type& type);
  void refuse_second_slot(const syntax::Expr& value);
  Type table_index(const syntax::IndexExpr& expr, const Type& object);
  /// The field or element that is named; null where that was refused, or is not known yet.
  Table::Field* accessed_field(const syntax::IndexExpr& expr, const Table& table);
  void assign_element(const syntax::IndexExpr& target, const Type& object, const Type& type, const syntax::Expr& given,
                      Span statement);
  /// A table that exists already gets into the slots of another: its values are copied, so nobody may tell.
  void copy_table(const Type& from, Table& to, const syntax::Expr& value);
  /// The two become of one shape.
  bool join_shapes(Table& to, const Table& from, Span place);
  /// The table that stands for several, made where they meet: each is fresh, and is copied.
  Type merge_tables(const Type& before, const Type& given, const void* syntax, unsigned which,
                    const syntax::Expr& value, Span place);
  bool is_fresh(const syntax::Expr& value, const Type& type) const;
  /// Records where the leaves of a table are, for a constructor or a copy of it.
  void place_leaves(Table& table);
  /// A result, or part of one: what it refers to outlives this call.
  bool leaves_call();
  void escape(const Type& type);
  void escape(const Type& type, std::set<const Work*>& seen);
  void escape(Table& table, std::set<const Work*>& seen);
  std::string describe_shape(const Table& table) const;

  // ---- operators.cpp
  Type unary(const syntax::UnaryExpr& expr);
  Type length_operator(const syntax::UnaryExpr& expr, const Type& operand);
  Type binary(const syntax::BinaryExpr& expr);
  Type arithmetic(const syntax::BinaryExpr& expr, const Type& left, const Type& right);
  Type bitwise(const syntax::BinaryExpr& expr, const Type& left, const Type& right);
  void warn_of_choice(const ParameterInfo& parameter, std::string_view constant, Span span);
  Type parameter_equality(const syntax::BinaryExpr& expr, const Type& left, const Type& right);
  Type equality(const syntax::BinaryExpr& expr, const Type& left, const Type& right);
  Type ordering(const syntax::BinaryExpr& expr, const Type& left, const Type& right);
  bool takes_arithmetic(const syntax::Expr& operand, const Type& type, std::string_view op);
  bool takes_integer(const syntax::Expr& operand, const Type& type, std::string_view op);
  void refuse_mixed(const syntax::Expr& operand, std::string_view op);

  // ---- conditionals.cpp
  /// The expression must be a boolean.
  void condition(const syntax::Expr& expr);
  void require_condition(const syntax::Expr& expr, const Type& type);
  Type and_expression(const syntax::BinaryExpr& expr);
  Type or_expression(const syntax::BinaryExpr& expr);
  struct Arm;
  std::optional<Type> conditional_type(const syntax::BinaryExpr& expr, const std::vector<Arm>& arms);
  std::optional<Type> conditional_table(const syntax::BinaryExpr& expr, const std::vector<Arm>& arms);
  std::optional<Type> logical_type(const std::vector<Arm>& arms);

  // ---- calls.cpp
  TypeList call(const syntax::CallExpr& expr);
  TypeList call_function(const syntax::CallExpr& expr, const Type& function, TypeList args);
  TypeList call_library(const syntax::CallExpr& expr, std::string_view name);
  TypeList call_table_row(const syntax::Expr& expr, std::string_view name, const std::vector<const syntax::Expr*>& args,
                          const std::vector<Type>& types);
  TypeList method_call(const syntax::MethodCallExpr& expr);
  TypeList construct(const syntax::CallExpr& expr, std::string_view name);
  bool is_table_function(std::string_view name, const TypeList& types) const;
  TypeList table_function(const syntax::CallExpr& expr, std::string_view name, const TypeList& types);
  // ---- sums.cpp
  TypeList sum_call(const syntax::CallExpr& expr, std::string_view name, const TypeList& args);
  bool takes_sum_arguments(const syntax::CallExpr& expr, std::string_view name, const TypeList& args, size_t most);
  bool is_summable(const syntax::CallExpr& expr, std::string_view name, const Type& function, const Type& point);
  // ---- images.cpp
  TypeList texture_call(const syntax::CallExpr& expr);
  bool takes_texture_arguments(const syntax::CallExpr& expr, const TypeList& args);
  bool read_image_options(const syntax::TableExpr& options, bool& raw);
  uint32_t add_image(const syntax::Expr& file, const Type& type, bool raw);
  TypeList construct_matrix(const syntax::CallExpr& expr, std::string_view name);
  Type matrix_column(const syntax::IndexExpr& expr, const Type& object);
  Type matrix_arithmetic(const syntax::BinaryExpr& expr, const Type& left, const Type& right);
  TypeList extremum(const syntax::CallExpr& expr, std::string_view name);
  TypeList to_integer(const syntax::CallExpr& expr, std::string_view name);
  TypeList modf(const syntax::CallExpr& expr);
  TypeList math_type(const syntax::CallExpr& expr);
  TypeList print(const syntax::CallExpr& expr);
  TypeList assertion(const syntax::CallExpr& expr);
  TypeList error_call(const syntax::CallExpr& expr);
  void require_message(const syntax::Expr& expr, const Type& type, std::string_view name);
  /// Argument types, the last call expanded; functions among them are refused.
  TypeList arguments(std::span<syntax::Expr* const> args);
  bool is_recursive(const syntax::CallExpr& expr, const WorkKey& key);

  // ---- calculus.cpp
  TypeList derivative_call(const syntax::CallExpr& expr, std::string_view name);
  bool takes_derivative_arguments(const syntax::CallExpr& expr, std::string_view name, const TypeList& args);
  void refuse_rows(const syntax::CallExpr& expr, const Specialisation& function, std::string_view name);
  bool is_free_of_effects(const syntax::Expr& function, const Work& callee, std::string_view name);

  // ---- modules.cpp
  void infer_modules();
  void run_modules_before(const syntax::Stat& stat);
  TypeList require_module(const syntax::CallExpr& expr);
  void return_from_module(const syntax::ReturnStat& stat, const TypeList& list);

  // ---- parameters.cpp
  TypeList parameter(const syntax::CallExpr& expr);
  std::string_view constant_name(const syntax::Expr& expr);
  uint32_t add_parameter(const syntax::CallExpr& expr, ParameterInfo info);
  bool depends_on_parameter(const syntax::Expr& expr) const;
  /// The variable (a syntax::Local or a Global) gets the value of an expression.
  void trace_parameter(const void* variable, const syntax::Expr* given);
  /// A name or an expression that stands for several functions.
  void refuse_function(Span span, std::string_view name, const syntax::Expr* given);

  // ---- statements.cpp
  void block(const syntax::Block& block);
  void statement(const syntax::Stat& stat);
  void local(const syntax::LocalStat& stat);
  void assign(const syntax::AssignStat& stat);
  void assign_name(const syntax::AssignStat& stat, const syntax::NameExpr& target, const Type& type,
                   const syntax::Expr& given);
  void assign_index(const syntax::AssignStat& stat, const syntax::IndexExpr& target, const Type& type,
                    const syntax::Expr& given);
  void bind_table(const syntax::AssignStat& stat, const syntax::NameExpr& target, const Type& type,
                  const syntax::Expr& given);
  void define_function(const syntax::FunctionStat& stat);
  void numeric_for(const syntax::NumericForStat& stat);
  const syntax::CallExpr* ipairs_call(const syntax::GenericForStat& stat) const;
  void generic_for(const syntax::GenericForStat& stat);
  void refuse_generic_for(const syntax::GenericForStat& stat);
  void join_results(const syntax::ReturnStat& stat, const TypeList& list);
  Type merge_results(const syntax::ReturnStat& stat, size_t index, const Type& type);
  void return_values(const syntax::ReturnStat& stat);
  void declare(const syntax::Local& local, const Type& type, Span given_at, const syntax::Expr* given);
  void branch(const syntax::Expr& condition, const syntax::Block& body);
  void refuse_definition(const Global& global, Span span);
  /// Joins a type given at a place into a variable.
  void give(Variable& variable, const Type& type, Span place, const syntax::Expr* given, std::string_view name);

  // ---- gotos.cpp
  void collect_labels(const syntax::Block& block);
  void check_goto(const syntax::GotoStat& stat);

  // ---- shared
  Variable& variable_of(const syntax::Local& local);
  bool at_top_level() const { return work_.function->parent == nullptr; }
  Type record(const syntax::Expr& expr, ExpressionFact fact);
  Type record(const syntax::Expr& expr, const Type& type);
  Diagnostic& error(DiagnosticCode code, Span span, std::initializer_list<std::string> args = {}) {
    return context_.error(code, span, args);
  }
  Diagnostic& type_error(DiagnosticCode code, Span span, std::initializer_list<std::string> args = {}) {
    return context_.type_error(work_, code, span, args);
  }
  std::optional<std::string_view> nearest_visible(std::string_view name) const;

  Context& context_;
  Work& work_;
  unsigned loop_depth_ = 0;
  /// Whose results the calls of this walk are, by id.
  std::unordered_map<uint32_t, const Work*> callees_;
  unsigned parameter_branches_ = 0;          ///< enclosing branches that depend on a parameter
  std::vector<const syntax::Block*> blocks_; ///< enclosing ones in this function
  std::vector<size_t> positions_;            ///< of the statement being walked in each of them
  /// Where a label of an enclosing block stands.
  struct LabelPlace {
    const syntax::Block* block;
    size_t run_begin; ///< of the labels side by side to which it belongs
    bool ends_block;
  };
  std::unordered_map<const syntax::LabelStat*, LabelPlace> labels_;
};

/// gradient and fwidth: their first argument is a function.
bool is_derivative(std::string_view name);

/// fbm, turbulence, ...: with a function first, they sum that.
bool is_sum(std::string_view name, const TypeList& args);

} // namespace moonshade::sema
