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

/// A number of precision T within, or NaN. Roundings keep order, so the bounds of a result are what the operation gives
/// for bounds of its operands.
template <class T> struct Interval {
  static constexpr T kInfinity = std::numeric_limits<T>::infinity();
  T low = -kInfinity, high = kInfinity;
  bool bounded() const { return std::isfinite(low) && std::isfinite(high); }
};

template <class T> Interval<T> hull(Interval<T> a, Interval<T> b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

template <class T> Interval<T> negated(Interval<T> a) { return {-a.high, -a.low}; }

/// Nothing is known where infinities cancel.
template <class T> Interval<T> sum(Interval<T> a, Interval<T> b) {
  const Interval<T> both{a.low + b.low, a.high + b.high};
  return both.low <= both.high ? both : Interval<T>{};
}

/// Of a*b + c, rounded once.
template <class T> Interval<T> fused(Interval<T> a, Interval<T> b, Interval<T> c) {
  if (!a.bounded() || !b.bounded() || !c.bounded()) return {};
  const auto least = [&](T x, T y) { return std::fma(x, y, c.low); };
  const auto most = [&](T x, T y) { return std::fma(x, y, c.high); };
  return {std::min({least(a.low, b.low), least(a.low, b.high), least(a.high, b.low), least(a.high, b.high)}),
          std::max({most(a.low, b.low), most(a.low, b.high), most(a.high, b.low), most(a.high, b.high)})};
}

struct IntegerRange {
  int64_t low, high;
};

IntegerRange hull(IntegerRange a, IntegerRange b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

/// Of rows that give one number, what all their results lie in.
template <class T> std::optional<Interval<T>> results_of(std::string_view name) {
  constexpr T kRoom = T(0x1p-20); // for the roundings within
  if (name == "hash") return Interval<T>{0, T(1 - 0x1p-24)};
  if (name == "fract") return Interval<T>{0, std::nextafter(T(1), T(0))};
  if (name == "saturate" || name == "step" || name == "linearstep") return Interval<T>{0, 1};
  if (name == "smoothstep" || name == "smootherstep") return Interval<T>{-kRoom, 1 + kRoom};
  if (name == "sin" || name == "cos") return Interval<T>{-1 - kRoom, 1 + kRoom};
  return {};
}

/// The intervals of numbers, in one precision.
template <class T> class Intervals {
public:
  explicit Intervals(const Function& function) : function_(function), by_value_(function.instructions.size()) {}

  Interval<T> operator[](ValueId id) const { return by_value_[id]; }
  /// `integer`: the range of the operand, where it is an integer's conversion.
  void find(ValueId id, std::optional<IntegerRange> integer) {
    by_value_[id] = interval(function_.instructions[id], integer);
  }

private:
  using I = Interval<T>;
  I of(const Instruction& instruction, size_t i) const { return by_value_[instruction.operands[i]]; }

  I interval(const Instruction& instruction, std::optional<IntegerRange> integer) const {
    switch (instruction.op) {
    case Op::ConstNumber: {
      const T value = static_cast<T>(instruction.number);
      return std::isfinite(value) ? I{value, value} : I{};
    }
    case Op::IntegerToNumber:
      return integer ? I{static_cast<T>(integer->low), static_cast<T>(integer->high)} : I{};
    case Op::Add:
    case Op::Sub:
      return interval_of_sum(instruction);
    case Op::Mul:
      return fused(of(instruction, 0), of(instruction, 1), I{0, 0});
    case Op::Fma:
      return fused(of(instruction, 0), of(instruction, 1), of(instruction, 2));
    case Op::Select:
      return hull(of(instruction, 1), of(instruction, 2));
    case Op::CallLibrary:
      return interval_of_call(instruction);
    default:
      return {};
    }
  }

  /// The pass `fuse` may come to make one rounding of a product and its sum.
  I interval_of_sum(const Instruction& instruction) const {
    const auto term = [&](size_t i, I x) { return i == 1 && instruction.op == Op::Sub ? negated(x) : x; };
    I result = sum(of(instruction, 0), term(1, of(instruction, 1)));
    for (const size_t i : {size_t{0}, size_t{1}}) {
      const Instruction& product = function_.instructions[instruction.operands[i]];
      if (product.op == Op::Mul)
        result = hull(result, fused(term(i, of(product, 0)), of(product, 1), term(1 - i, of(instruction, 1 - i))));
    }
    return result;
  }

  I interval_of_call(const Instruction& call) const {
    if (is_derivative_export(call.library->symbol)) return {};
    const std::string_view name = call.library->name;
    if (const auto known = results_of<T>(name)) return *known;
    if (name == "floor") return {std::floor(of(call, 0).low), std::floor(of(call, 0).high)};
    if (name == "abs") return {0, std::max(-of(call, 0).low, of(call, 0).high)};
    if (name == "clamp" && is_constant(call, 1) && is_constant(call, 2))
      return {std::min(of(call, 1).low, of(call, 2).low), of(call, 2).high};
    return {};
  }
  bool is_constant(const Instruction& call, size_t i) const {
    return function_.instructions[call.operands[i]].op == Op::ConstNumber && of(call, i).bounded();
  }

  const Function& function_;
  std::vector<I> by_value_;
};

/// What floor or ceil of a number within makes, and the 0 of what cannot be converted.
template <class T> std::optional<IntegerRange> rounded(Interval<T> x, bool floors) {
  constexpr T kFits = T(0x1p62);
  if (!(x.low >= -kFits && x.high <= kFits)) return {};
  const T low = floors ? std::floor(x.low) : std::ceil(x.low), high = floors ? std::floor(x.high) : std::ceil(x.high);
  return hull({static_cast<int64_t>(low), static_cast<int64_t>(high)}, {0, 0});
}

class Ranges {
public:
  explicit Ranges(Function& function)
      : function_(function), narrow_(function), wide_(function), integers_(function.instructions.size()) {}

  void run() {
    for_each_instruction(function_, [&](ValueId id) {
      Instruction& instruction = function_.instructions[id];
      if (instruction.type == ValueType::Number) {
        const bool converts = instruction.op == Op::IntegerToNumber;
        const std::optional<IntegerRange> of = converts ? integer(instruction, 0) : std::nullopt;
        narrow_.find(id, of);
        wide_.find(id, of);
      }
      if (instruction.type == ValueType::Integer) integers_[id] = range(instruction);
      if (const std::optional<bool> known = decided(instruction)) {
        instruction.op = Op::ConstBoolean;
        instruction.integer = *known;
        instruction.operands.clear();
      }
    });
  }

private:
  std::optional<IntegerRange> integer(const Instruction& instruction, size_t i) const {
    return integers_[instruction.operands[i]];
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
    const bool floors = name == "math.floor";
    if ((!floors && name != "math.ceil") || function_.instructions[call.operands[0]].type != ValueType::Number)
      return {};
    const auto narrow = rounded(narrow_[call.operands[0]], floors), wide = rounded(wide_[call.operands[0]], floors);
    return narrow && wide ? std::optional(hull(*narrow, *wide)) : std::nullopt;
  }

  std::optional<bool> decided(const Instruction& instruction) const {
    if (instruction.operands.size() != 2) return {};
    const auto a = integer(instruction, 0), b = integer(instruction, 1);
    if (!a || !b) return {};
    const bool below = a->high < b->low;
    const bool above = b->high < a->low;
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
  Intervals<float> narrow_;
  Intervals<double> wide_;
  std::vector<std::optional<IntegerRange>> integers_; ///< by value
};

} // namespace

void decide_comparisons(Function& function) { Ranges(function).run(); }

} // namespace moonshade::ir
