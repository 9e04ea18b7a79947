// remove_bounded_steps: counting costs time, and most shaders cannot take a million steps. An upper bound of the steps
// of each function is worked out from its loops and calls; functions that are reached only from entries (and init)
// whose bound is within the limit lose their `step`s.
//
// A loop's bound is known where it has the shape that `build` gives a numeric `for` with constant bounds: a counter
// that is stored a constant just before the loop and counter + constant at the end of its body, and an `if` in the body
// that breaks on a condition over the counter and constants alone. The loop is then simply run on its counter, in float
// and in double where that is a number.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <limits>
#include <optional>

namespace moonshade::ir {
namespace {

constexpr uint64_t kUnbounded = std::numeric_limits<uint64_t>::max();

uint64_t saturating_add(uint64_t a, uint64_t b) { return a > kUnbounded - b ? kUnbounded : a + b; }
uint64_t saturating_mul(uint64_t a, uint64_t b) {
  uint64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? kUnbounded : product;
}

/// A counter and where it is read and stored in a loop.
struct Counter {
  VariableId variable;
  ValueId start = kNone;      ///< constant
  ValueId next = kNone;       ///< stored at the end of the body
  ValueId condition = kNone;  ///< of the break
  std::vector<ValueId> loads; ///< in the body itself
};

/// A scalar while a loop is run on its counter; T is the domain's number.
template <class T> struct Scalar {
  bool boolean = false;
  int64_t integer = 0;
  T number = 0;
};

template <class T> class CounterMachine {
public:
  /// `loads` are those of the counter in the loop's body.
  CounterMachine(const Function& function, const std::vector<ValueId>& loads) : function_(function), loads_(loads) {}

  void set(const Scalar<T>& value) { value_ = value; }

  /// Nothing where the value depends on more than the counter and constants.
  std::optional<Scalar<T>> evaluate(ValueId id, unsigned depth = 0) const {
    const Instruction& instruction = function_.instructions[id];
    Scalar<T> result;
    switch (instruction.op) {
    case Op::ConstBoolean:
      result.boolean = instruction.integer != 0;
      return result;
    case Op::ConstInteger:
      result.integer = instruction.integer;
      return result;
    case Op::ConstNumber:
      result.number = static_cast<T>(instruction.number);
      return result;
    case Op::Load:
      return std::ranges::find(loads_, id) != loads_.end() ? std::optional(value_) : std::nullopt;
    default:
      break;
    }
    if (depth > 8 || instruction.operands.empty() || instruction.operands.size() > 2) return {};
    const std::optional<Scalar<T>> a = evaluate(instruction.operands[0], depth + 1);
    const std::optional<Scalar<T>> b =
        instruction.operands.size() < 2 ? std::optional(Scalar<T>{}) : evaluate(instruction.operands[1], depth + 1);
    if (!a || !b) return {};
    return apply(instruction, function_.instructions[instruction.operands[0]].type, *a, *b);
  }

private:
  static std::optional<Scalar<T>> apply(const Instruction& instruction, ValueType type, const Scalar<T>& a,
                                        const Scalar<T>& b) {
    Scalar<T> result;
    const uint64_t ua = static_cast<uint64_t>(a.integer), ub = static_cast<uint64_t>(b.integer);
    const bool integers = type == ValueType::Integer;
    if (!integers && type != ValueType::Number && instruction.op != Op::Not) return {};
    switch (instruction.op) {
    case Op::Add:
      result.integer = static_cast<int64_t>(ua + ub);
      result.number = a.number + b.number;
      return result;
    case Op::Sub:
      result.integer = static_cast<int64_t>(ua - ub);
      result.number = a.number - b.number;
      return result;
    case Op::Xor:
      result.integer = a.integer ^ b.integer;
      return result;
    case Op::Not:
      if (type != ValueType::Boolean) return {};
      result.boolean = !a.boolean;
      return result;
    case Op::Lt:
      result.boolean = integers ? a.integer < b.integer : a.number < b.number;
      return result;
    case Op::Le:
      result.boolean = integers ? a.integer <= b.integer : a.number <= b.number;
      return result;
    default:
      return {};
    }
  }

  const Function& function_;
  const std::vector<ValueId>& loads_;
  Scalar<T> value_;
};

class StepBounds {
public:
  explicit StepBounds(const Module& module)
      : module_(module), bounds_(module.functions.size()), budget_(saturating_mul(2, module.step_limit)) {}

  uint64_t of_function(FunctionId id) {
    if (!bounds_[id]) bounds_[id] = of_block(module_.functions[id], module_.functions[id].body);
    return *bounds_[id];
  }

private:
  uint64_t of_block(const Function& function, const Block& block) {
    uint64_t sum = 0;
    for (size_t i = 0; i < block.instructions.size(); ++i) {
      const Instruction& instruction = function.instructions[block.instructions[i]];
      switch (instruction.op) {
      case Op::Step:
        sum = saturating_add(sum, 1);
        break;
      case Op::Call:
        sum = saturating_add(sum, of_function(instruction.index));
        break;
      case Op::If:
        sum = saturating_add(
            sum, std::max(of_block(function, instruction.blocks[0]), of_block(function, instruction.blocks[1])));
        break;
      case Op::Scope:
        sum = saturating_add(sum, of_block(function, instruction.blocks[0]));
        break;
      case Op::Loop: {
        const uint64_t trips = trip_count(function, block, i);
        sum = saturating_add(
            sum, trips == kUnbounded ? kUnbounded : saturating_mul(trips, of_block(function, instruction.blocks[0])));
        break;
      }
      default:
        break;
      }
    }
    return sum;
  }

  uint64_t trip_count(const Function& function, const Block& around, size_t position) {
    const std::optional<Counter> counter = find_counter(function, around, position);
    if (!counter) return kUnbounded;
    if (function.instructions[counter->start].type == ValueType::Integer) return run<double>(function, *counter);
    return std::max(run<double>(function, *counter), run<float>(function, *counter));
  }

  static std::optional<Counter> find_counter(const Function& function, const Block& around, size_t position) {
    const Instruction& loop = function.instructions[around.instructions[position]];
    const Block& body = loop.blocks[0];
    if (body.instructions.empty()) return {};
    const Instruction& last = function.instructions[body.instructions.back()];
    if (last.op != Op::Store || last.index < function.captures) return {};
    Counter counter{.variable = last.index, .next = last.operands[0], .loads = {}};
    if (!is_stored_twice(function, counter.variable)) return {};
    for (size_t i = 0; i < position; ++i) {
      const Instruction& before = function.instructions[around.instructions[i]];
      if (before.op == Op::Store && before.index == counter.variable) counter.start = before.operands[0];
    }
    if (counter.start == kNone) return {};
    const Op start = function.instructions[counter.start].op;
    if (start != Op::ConstInteger && start != Op::ConstNumber) return {};
    for (const ValueId id : body.instructions) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::Load && instruction.index == counter.variable) counter.loads.push_back(id);
      if (instruction.op != Op::If || instruction.blocks[0].instructions.size() != 1) continue;
      const Instruction& leave = function.instructions[instruction.blocks[0].instructions[0]];
      if (leave.op == Op::Break && leave.index == loop.index) counter.condition = instruction.operands[0];
    }
    return counter.condition == kNone ? std::nullopt : std::optional(counter);
  }

  /// Once before the loop and once at its end, and no call can store it.
  static bool is_stored_twice(const Function& function, VariableId variable) {
    unsigned stores = 0;
    for_each_instruction(function, [&](ValueId id) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::Store && instruction.index == variable) ++stores;
      if (std::ranges::find(instruction.variables, variable) != instruction.variables.end()) stores += 2;
    });
    return stores == 2;
  }

  template <class T> uint64_t run(const Function& function, const Counter& counter) {
    CounterMachine<T> machine(function, counter.loads);
    machine.set(*machine.evaluate(counter.start));
    for (uint64_t trips = 1; budget_ != 0; ++trips, --budget_) {
      const auto leaves = machine.evaluate(counter.condition);
      if (!leaves) return kUnbounded;
      if (leaves->boolean) return trips;
      const auto next = machine.evaluate(counter.next);
      if (!next) return kUnbounded;
      machine.set(*next);
    }
    return kUnbounded;
  }

  const Module& module_;
  std::vector<std::optional<uint64_t>> bounds_;
  uint64_t budget_; ///< iterations that may still be run: hostile files have many long loops
};

void mark_reached(const Module& module, FunctionId id, std::vector<bool>& reached) {
  if (reached[id]) return;
  reached[id] = true;
  const Function& function = module.functions[id];
  for_each_instruction(function, [&](ValueId value) {
    if (function.instructions[value].op == Op::Call) mark_reached(module, function.instructions[value].index, reached);
  });
}

} // namespace

void remove_bounded_steps(Module& module) {
  StepBounds bounds(module);
  std::vector<bool> keeps(module.functions.size());
  if (bounds.of_function(module.init) > module.step_limit) mark_reached(module, module.init, keeps);
  for (const Entry& entry : module.entries)
    if (bounds.of_function(entry.function) > module.step_limit) mark_reached(module, entry.function, keeps);
  for (FunctionId id = 0; id < module.functions.size(); ++id) {
    if (keeps[id]) continue;
    Function& function = module.functions[id];
    rewrite_blocks(function, [&](ValueId value, std::vector<ValueId>& result) {
      if (function.instructions[value].op != Op::Step) result.push_back(value);
      return true;
    });
  }
}

} // namespace moonshade::ir
