// decide_comparisons: comparisons of integers that are settled by how great these can be at all become constants, and
// with them checks of indices: `a[i % #a + 1]`, `v[math.floor(hash(p) * 3) + 1]`. A range holds in float and in double,
// and is that of the numbers that are not NaN; conversions to integers make 0 of what they cannot convert.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <cmath>
#include <limits>
#include <optional>

namespace moonshade::ir {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A number within, or NaN.
struct Interval {
  double low = -kInfinity, high = kInfinity;
  bool bounded() const { return std::isfinite(low) && std::isfinite(high); }
};

struct IntegerRange {
  int64_t low, high;
};

/// Room for the roundings of float, also of constants. Rounding takes nothing across 0.
Interval rounded(Interval interval) {
  constexpr double kRelative = 0x1p-22, kLeast = 0x1p-125, kGreatest = 0x1p126; // beyond, float may overflow
  double low = interval.low - std::abs(interval.low) * kRelative - kLeast;
  double high = interval.high + std::abs(interval.high) * kRelative + kLeast;
  if (interval.low >= 0) low = std::max(low, 0.0);
  if (interval.high <= 0) high = std::min(high, 0.0);
  return {low < -kGreatest ? -kInfinity : low, high > kGreatest ? kInfinity : high};
}

Interval product(Interval a, Interval b) {
  if (!a.bounded() || !b.bounded()) return {};
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return rounded({low, high});
}

Interval sum(Interval a, Interval b) { return rounded({a.low + b.low, a.high + b.high}); }

IntegerRange hull(IntegerRange a, IntegerRange b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

/// Of rows that give one number, what all their results lie in.
std::optional<Interval> results_of(std::string_view name) {
  for (const std::string_view unit : {"fract", "saturate", "hash", "step", "linearstep", "smoothstep", "smootherstep"})
    if (name == unit) return rounded({0, 1});
  if (name == "sin" || name == "cos") return rounded({-1, 1});
  return {};
}

class Ranges {
public:
  explicit Ranges(Function& function)
      : function_(function), numbers_(function.instructions.size()), integers_(function.instructions.size()) {}

  void run() {
    for_each_instruction(function_, [&](ValueId id) {
      Instruction& instruction = function_.instructions[id];
      if (instruction.type == ValueType::Number) numbers_[id] = interval(instruction);
      if (instruction.type == ValueType::Integer) integers_[id] = range(instruction);
      if (const std::optional<bool> known = decided(instruction)) {
        instruction.op = Op::ConstBoolean;
        instruction.integer = *known;
        instruction.operands.clear();
      }
    });
  }

private:
  Interval number(const Instruction& instruction, size_t i) const { return numbers_[instruction.operands[i]]; }
  std::optional<IntegerRange> integer(const Instruction& instruction, size_t i) const {
    return integers_[instruction.operands[i]];
  }

  Interval interval(const Instruction& instruction) const {
    switch (instruction.op) {
    case Op::ConstNumber:
      return !std::isfinite(instruction.number) ? Interval{} : rounded({instruction.number, instruction.number});
    case Op::IntegerToNumber:
      if (const auto of = integer(instruction, 0))
        return rounded({static_cast<double>(of->low), static_cast<double>(of->high)});
      return {};
    case Op::Add:
      return sum(number(instruction, 0), number(instruction, 1));
    case Op::Sub:
      return sum(number(instruction, 0), {-number(instruction, 1).high, -number(instruction, 1).low});
    case Op::Mul:
      return product(number(instruction, 0), number(instruction, 1));
    case Op::Fma:
      return sum(product(number(instruction, 0), number(instruction, 1)), number(instruction, 2));
    case Op::Select: {
      const Interval a = number(instruction, 1), b = number(instruction, 2);
      return {std::min(a.low, b.low), std::max(a.high, b.high)};
    }
    case Op::CallLibrary:
      return interval_of_call(instruction);
    default:
      return {};
    }
  }

  Interval interval_of_call(const Instruction& call) const {
    if (is_derivative_export(call.library->symbol)) return {};
    const std::string_view name = call.library->name;
    if (const auto known = results_of(name)) return *known;
    const Interval x = call.operands.empty() || !is_number(call, 0) ? Interval{} : number(call, 0);
    if (name == "floor") return {std::floor(x.low), std::floor(x.high)};
    if (name == "abs") return {0, std::max(-x.low, x.high)};
    if (name == "clamp" && is_constant(call, 1) && is_constant(call, 2)) {
      const Interval least = number(call, 1), most = number(call, 2);
      return {std::min(least.low, most.low), most.high};
    }
    return {};
  }
  bool is_number(const Instruction& call, size_t i) const {
    return function_.instructions[call.operands[i]].type == ValueType::Number;
  }
  bool is_constant(const Instruction& call, size_t i) const {
    return function_.instructions[call.operands[i]].op == Op::ConstNumber && number(call, i).bounded();
  }

  std::optional<IntegerRange> range(const Instruction& instruction) const {
    switch (instruction.op) {
    case Op::ConstInteger:
      return IntegerRange{instruction.integer, instruction.integer};
    case Op::Add:
    case Op::Sub:
      return range_of_sum(instruction);
    case Op::And:
      for (const size_t i : {size_t{0}, size_t{1}})
        if (const auto mask = integer(instruction, i); mask && mask->low >= 0) return IntegerRange{0, mask->high};
      return {};
    case Op::Select: {
      const auto a = integer(instruction, 1), b = integer(instruction, 2);
      return a && b ? std::optional(hull(*a, *b)) : std::nullopt;
    }
    case Op::CallLibrary:
      return range_of_call(instruction);
    default:
      return {};
    }
  }

  std::optional<IntegerRange> range_of_sum(const Instruction& sum) const {
    const auto a = integer(sum, 0), b = integer(sum, 1);
    if (!a || !b) return {};
    IntegerRange result{};
    const bool adds = sum.op == Op::Add;
    const bool wraps = adds ? __builtin_add_overflow(a->low, b->low, &result.low) ||
                                  __builtin_add_overflow(a->high, b->high, &result.high)
                            : __builtin_sub_overflow(a->low, b->high, &result.low) ||
                                  __builtin_sub_overflow(a->high, b->low, &result.high);
    return wraps ? std::nullopt : std::optional(result);
  }

  std::optional<IntegerRange> range_of_call(const Instruction& call) const {
    const std::string_view name = call.library->name;
    if (name == "op.mod") { // the sign of the divisor, and 0 for the divisor 0
      const auto divisor = integer(call, 1);
      if (!divisor || divisor->low == std::numeric_limits<int64_t>::min()) return {};
      return IntegerRange{std::min<int64_t>(0, divisor->low + 1), std::max<int64_t>(0, divisor->high - 1)};
    }
    const bool rounds = name == "math.floor" || name == "math.ceil";
    if (!rounds || !is_number(call, 0)) return {};
    const Interval x = number(call, 0);
    constexpr double kFits = 0x1p62;
    if (!(x.low >= -kFits && x.high <= kFits)) return {};
    const bool floors = name == "math.floor";
    return hull({static_cast<int64_t>(floors ? std::floor(x.low) : std::ceil(x.low)),
                 static_cast<int64_t>(floors ? std::floor(x.high) : std::ceil(x.high))},
                {0, 0});
  }

  std::optional<bool> decided(const Instruction& instruction) const {
    if (instruction.operands.size() != 2) return {};
    const auto a = integer(instruction, 0), b = integer(instruction, 1);
    if (!a || !b) return {};
    const bool below = a->high<b->low, above = a->low> b->high;
    switch (instruction.op) {
    case Op::Lt:
      return below ? std::optional(true) : a->low >= b->high ? std::optional(false) : std::nullopt;
    case Op::Le:
      return a->high <= b->low ? std::optional(true) : above ? std::optional(false) : std::nullopt;
    case Op::Eq:
      return below || above ? std::optional(false) : std::nullopt;
    case Op::Ne:
      return below || above ? std::optional(true) : std::nullopt;
    default:
      return {};
    }
  }

  Function& function_;
  std::vector<Interval> numbers_;                     ///< by value
  std::vector<std::optional<IntegerRange>> integers_; ///< by value
};

} // namespace

void decide_comparisons(Function& function) { Ranges(function).run(); }

} // namespace moonshade::ir
