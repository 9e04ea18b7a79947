// remove_bounded_steps: counting costs time, and most shaders cannot take a million steps. An upper bound of the steps
// of each function is worked out from its loops and calls; functions that are reached only from entries (and init)
// whose bound is within the limit lose their `step`s.
//
// A loop's bound is known where a variable counts its iterations: it is stored a constant just before the loop, once in
// the body itself, as what it was plus a constant, and nowhere else; and an `if` in the body breaks on a condition over
// it and constants (which may stand beside others: `while n < 256 and x < 4`). All numeric `for`s with constant bounds
// are of this shape. The loop is then simply run on its counter, in float and in double where that is a number.
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

/// Iterations run for one module, all loops together. Longer loops keep counting their steps: that costs them little,
/// and compilation must not take long because a loop does.
constexpr uint64_t kBudget = uint64_t{1} << 17;
constexpr unsigned kMaxBreaks = 4; ///< of one loop that are tried, for each counter

/// A variable that counts the iterations of a loop.
struct Counter {
  ValueId start;              ///< constant
  ValueId next;               ///< what the body stores
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
    if (instruction.type == ValueType::Boolean && (instruction.op == Op::And || instruction.op == Op::Or))
      return logical(instruction, depth);
    const std::optional<Scalar<T>> a = evaluate(instruction.operands[0], depth + 1);
    const std::optional<Scalar<T>> b =
        instruction.operands.size() < 2 ? std::optional(Scalar<T>{}) : evaluate(instruction.operands[1], depth + 1);
    if (!a || !b) return {};
    return apply(instruction, function_.instructions[instruction.operands[0]].type, *a, *b);
  }

  /// Whether the counter alone may decide the condition, or a side of it.
  bool decides(ValueId condition, unsigned depth = 0) const {
    const Instruction& instruction = function_.instructions[condition];
    if (depth > 8) return false;
    if (instruction.type == ValueType::Boolean &&
        (instruction.op == Op::And || instruction.op == Op::Or || instruction.op == Op::Not))
      return std::ranges::any_of(instruction.operands, [&](ValueId operand) { return decides(operand, depth + 1); });
    return evaluate(condition, depth).has_value();
  }

private:
  /// One side may decide alone.
  std::optional<Scalar<T>> logical(const Instruction& instruction, unsigned depth) const {
    const bool decisive = instruction.op == Op::Or;
    bool known = true;
    for (const ValueId operand : instruction.operands) {
      const std::optional<Scalar<T>> side = evaluate(operand, depth + 1);
      known = known && side;
      if (side && side->boolean == decisive) return side;
    }
    return known ? std::optional(Scalar<T>{.boolean = !decisive}) : std::nullopt;
  }

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
  explicit StepBounds(const Module& module) : module_(module), bounds_(module.functions.size()) {}

  uint64_t of_function(FunctionId id) {
    if (const std::optional<uint64_t> known = bounds_[id]) return *known;
    const Function& function = module_.functions[id];
    // The callees first: the counts of stores below are those of one function at a time.
    for_each_instruction(function, [&](ValueId value) {
      if (function.instructions[value].op == Op::Call) of_function(function.instructions[value].index);
    });
    stores_ = count_stores(function);
    const uint64_t bound = of_block(function, function.body);
    bounds_[id] = bound;
    return bound;
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

  /// Stores to each variable; what a call may store counts as many.
  static std::vector<unsigned> count_stores(const Function& function) {
    std::vector<unsigned> stores(function.variables.size());
    for (VariableId i = 0; i < function.captures; ++i)
      stores[i] = 3;
    for_each_instruction(function, [&](ValueId id) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::Store) ++stores[instruction.index];
      for (const VariableId variable : instruction.variables)
        stores[variable] += 3;
    });
    return stores;
  }

  /// The least bound that a counter and a break of the loop at `position` give.
  uint64_t trip_count(const Function& function, const Block& around, size_t position) {
    const Instruction& loop = function.instructions[around.instructions[position]];
    std::vector<ValueId> conditions;
    for (const ValueId id : loop.blocks[0].instructions) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op != Op::If || instruction.blocks[0].instructions.size() != 1) continue;
      const Instruction& leave = function.instructions[instruction.blocks[0].instructions[0]];
      if (leave.op == Op::Break && leave.index == loop.index && conditions.size() < kMaxBreaks)
        conditions.push_back(instruction.operands[0]);
    }
    uint64_t least = kUnbounded;
    for (const ValueId id : loop.blocks[0].instructions) {
      const Instruction& store = function.instructions[id];
      if (store.op != Op::Store || stores_[store.index] != 2 || conditions.empty()) continue;
      const std::optional<Counter> counter = find_counter(function, around, position, store);
      if (!counter) continue;
      for (const ValueId condition : conditions)
        least = std::min(least, run(function, *counter, condition));
    }
    return least;
  }

  static std::optional<Counter> find_counter(const Function& function, const Block& around, size_t position,
                                             const Instruction& store) {
    Counter counter{.start = kNone, .next = store.operands[0], .loads = {}};
    for (size_t i = position; i-- > 0 && counter.start == kNone;) {
      const Instruction& before = function.instructions[around.instructions[i]];
      if (before.op == Op::Store && before.index == store.index) counter.start = before.operands[0];
    }
    if (counter.start == kNone) return {};
    const Op start = function.instructions[counter.start].op;
    if (start != Op::ConstInteger && start != Op::ConstNumber) return {};
    const Block& body = function.instructions[around.instructions[position]].blocks[0];
    for (const ValueId id : body.instructions) {
      const Instruction& instruction = function.instructions[id];
      if (instruction.op == Op::Store && instruction.index == store.index) break; // later loads give the next value
      if (instruction.op == Op::Load && instruction.index == store.index) counter.loads.push_back(id);
    }
    return counter;
  }

  uint64_t run(const Function& function, const Counter& counter, ValueId condition) {
    if (function.instructions[counter.start].type == ValueType::Integer)
      return run_in<double>(function, counter, condition);
    return std::max(run_in<double>(function, counter, condition), run_in<float>(function, counter, condition));
  }

  template <class T> uint64_t run_in(const Function& function, const Counter& counter, ValueId condition) {
    CounterMachine<T> machine(function, counter.loads);
    const auto start = machine.evaluate(counter.start);
    if (!start) return kUnbounded;
    machine.set(*start);
    if (!machine.decides(condition)) return kUnbounded;
    for (uint64_t trips = 1; budget_ != 0; ++trips, --budget_) {
      const auto leaves = machine.evaluate(condition);
      if (leaves && leaves->boolean) return trips;
      const auto next = machine.evaluate(counter.next);
      if (!next) return kUnbounded;
      machine.set(*next);
    }
    return kUnbounded;
  }

  const Module& module_;
  std::vector<std::optional<uint64_t>> bounds_;
  std::vector<unsigned> stores_; ///< by variable of the function at hand
  uint64_t budget_ = kBudget;
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
