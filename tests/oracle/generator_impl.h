// The generator's class: expressions by wanted type over what is in scope, statements by weight, functions before their
// use. What it avoids, because the dialect refuses it: variables that mix integers and numbers, calls that assign
// anywhere but as a statement of their own, writes to what the top level made, names bound to a second table.
// Members are defined by subject in generator_*.cpp.
#pragma once

#include "tests/oracle/generator_types.h"
#include "tests/oracle/random.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string_view>

namespace moonshade::oracle {

class Generator {
public:
  explicit Generator(uint64_t seed) : random_(seed) {}
  std::string program();

private:
  /// A function being written.
  struct Frame {
    std::vector<T> results;
    const Shape* table = nullptr;
    int same = -1;
    std::string same_name;
    int effect = kNoEffect;
    std::set<int> mutated;
  };
  struct Mark {
    size_t scope, tables, functions;
  };

  // ---- output and names (generator.cpp) ----
  void line(const std::string& text);
  void open(const std::string& text);
  void close(const std::string& text = "end");
  std::string fresh(const char* prefix) { return prefix + std::to_string(next_name_++); }
  T any_type();
  int level() const { return static_cast<int>(frames_.size()); }
  Mark mark() const { return {scope_.size(), tables_.size(), functions_.size()}; }
  void leave(const Mark& mark);
  bool may_assign(int variable_level) const;
  void note_effect(int variable_level);
  std::vector<const Variable*> in_scope(T type, bool assignable) const;

  // ---- values (generator_values.cpp) ----
  std::string integer_literal();
  std::string number_literal();
  std::string literal(T type);
  std::string construct(T type, int depth);
  std::string leaf(T type, int depth);
  std::string expression(T type, int depth);
  std::string conditional(T type, int depth);
  std::string binary(const char* op, T left, T right, int depth);
  std::string boolean(int depth);
  std::string integer(int depth);
  std::string number(int depth);
  std::string vector(T type, int depth);
  std::string matrix(T type, int depth);

  // ---- the library (generator_library.cpp) ----
  std::string library(T type, int depth);
  std::string sum_of_function(int depth);

  // ---- tables (generator_tables.cpp) ----
  void make_shapes();
  const Shape* add_shape(Shape shape);
  std::string index(int length, const std::string& table, int depth);
  /// Goes on from a table to a value of this type inside it.
  std::string descend(std::string text, const Shape* shape, T type, int depth);
  std::string element(T type, bool write, int depth); ///< empty where there is none
  std::string constructor(const Shape& shape, int depth, bool refers);
  std::string fresh_table(const Shape& shape, int depth); ///< constructor, call or conditional
  void declare_table(int depth);
  void alias_table();
  void table_in_branches(const Shape& shape);
  void loop_over_table(int depth);
  void swap_elements();
  bool is_writable(const TableVariable& table) const { return table.writable && may_assign(table.level); }
  void note_write(const TableVariable& table);

  // ---- functions (generator_functions.cpp, generator_closures.cpp) ----
  /// Both of one of `functions_`.
  bool is_callable(const Function& callee) const {
    return &callee < functions_.data() + std::min(callable_, functions_.size());
  }
  bool can_call(const Function& callee, bool is_statement) const;
  std::string call(T type, int depth);         ///< empty where there is none
  std::string call_at_once(T type, int depth); ///< likewise
  std::string call_text(const Function& callee, int depth);
  std::string argument(const Function& callee, size_t i, int depth);
  std::string function_argument(const std::vector<T>& signature, int depth);
  std::string table_argument(const Parameter& parameter, int depth);
  std::string result_list();
  void call_statement();
  void function(int statements, int depth);
  void parameter_list(Function& made, std::string& list);
  std::string begin_function(const std::string& name, const std::string& list);
  void end_function(Function& made, const Mark& mark);
  void alias_function();
  void function_in_record();
  void closure_maker();
  void object_maker();
  void composer();
  void closure_instance();
  void repeated_caller();

  // ---- statements (generator_statements.cpp) ----
  void declare(T type, int depth);
  void assign();
  void assign_several();
  void block(int statements, int depth);
  void if_statement(int depth);
  void loop_body(int depth);
  void numeric_for(int depth);
  void while_loop(int depth);
  void repeat_loop(int depth);
  void nested_break(int depth);
  void statement(int depth);

  // ---- the program's parts (generator.cpp) ----
  void parameters();
  void top_level_constant();
  void top_level_loop();
  void top_level_state();
  void entry();

  static constexpr int kMaxCalls = 14; // in the whole program: calls nest, and time multiplies
  static constexpr int kMaxHeavy = 4;  // of calls of noise and the like, which are all inlined

  Random random_;
  std::string text_;
  int indent_ = 0;
  int next_name_ = 0;
  int calls_ = 0;
  int heavy_ = 0;
  int nesting_ = 0; // of functions inside functions and of anonymous ones
  bool writes_top_ = false;
  std::deque<Shape> shapes_;
  std::vector<Variable> scope_;
  std::vector<TableVariable> tables_;
  std::vector<Function> functions_; ///< in the order of their definitions
  size_t callable_ = SIZE_MAX;      ///< how many of them may be called in what is being written
  std::vector<Frame> frames_;
};

} // namespace moonshade::oracle
