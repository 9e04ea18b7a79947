// Appends instructions to a function under construction: to the block on top of a stack of blocks that are still open.
// Used by `build`, by passes and by tests. Checks nothing; the verifier does.
#pragma once

#include "compiler/ir/ir.h"

#include <span>
#include <utility>
#include <vector>

namespace moonshade::ir {

class Builder {
public:
  /// Goes on at the end of the function's body.
  explicit Builder(Function& function);
  /// Puts the body back.
  ~Builder();
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  Function& function() { return function_; }
  /// The place in the source that the following instructions come from.
  void set_span(Span span) { span_ = span; }
  Span span() const { return span_; }

  const Instruction& at(ValueId value) const { return function_.instructions[value]; }
  ValueType type_of(ValueId value) const { return at(value).type; }
  VariableId variable(std::string name, ValueType type, uint32_t count = 1);
  LabelId label() { return function_.next_label++; }

  ValueId boolean(bool value);
  ValueId integer(int64_t value);
  ValueId number(double value);
  /// Zero of any type (false for booleans).
  ValueId zero(ValueType type);
  ValueId argument(uint32_t index);
  ValueId load(VariableId variable);
  void store(VariableId variable, ValueId value);
  ValueId load_element(VariableId variable, ValueId index);
  void store_element(VariableId variable, ValueId index, ValueId value);
  ValueId load_global_element(GlobalId global, ValueType type, ValueId index);
  void store_global_element(GlobalId global, ValueId index, ValueId value);
  ValueId load_global(GlobalId global, ValueType type);
  void store_global(GlobalId global, ValueId value);

  /// Neg, Not; arithmetic and bits: the type is that of the first operand.
  ValueId unary(Op op, ValueId a);
  ValueId binary(Op op, ValueId a, ValueId b);
  ValueId fma(ValueId a, ValueId b, ValueId c);
  /// Eq, Ne, Lt, Le.
  ValueId compare(Op op, ValueId a, ValueId b);
  ValueId select(ValueId condition, ValueId a, ValueId b);
  ValueId construct(ValueType type, std::vector<ValueId> numbers);
  ValueId component(ValueId vector, uint32_t index);
  /// The value as a `type`: an integer becomes a number, a number a vector with that number for each component.
  ValueId convert(ValueId value, ValueType type);

  ValueId call_library(const LibraryFunction& row, ValueType type, std::vector<ValueId> operands);
  ValueId call(FunctionId callee, std::span<const ValueType> results, std::vector<ValueId> arguments,
               std::vector<VariableId> captures = {});
  /// Result `index` of a call; the call itself for 0.
  ValueId result(ValueId call, uint32_t index, ValueType type);

  void fault(ValueId condition, FaultCode code, std::string message = {});
  void step();
  void return_values(std::vector<ValueId> values);
  void break_to(LabelId label);

  /// Runs `body` (a callable) on a new open block and gives that block.
  template <class Body> Block block(Body&& body) {
    open_.emplace_back();
    std::forward<Body>(body)();
    Block done = std::move(open_.back());
    open_.pop_back();
    return done;
  }
  ValueId if_else(ValueId condition, Block then_block, Block else_block = {});
  ValueId loop(LabelId label, Block body);
  ValueId scope(LabelId label, Block body);

  /// The current block, to look at or to splice into.
  Block& current() { return open_.back(); }
  /// Execution cannot go past the last instruction of the current block: what would follow is to be left out.
  bool terminated() const;
  /// Appends a ready instruction (its span is set where it has none).
  ValueId append(Instruction instruction);

private:
  Function& function_;
  std::vector<Block> open_;
  Span span_{};
};

/// Whether execution can reach the end of the block; whether it can go on behind an instruction.
bool falls_through(const Function& function, const Block& block);
bool falls_through(const Function& function, const Instruction& instruction);

/// Whether a break somewhere in the block names `label`.
bool has_break_to(const Function& function, const Block& block, LabelId label);

} // namespace moonshade::ir
