// The bodies here are those of stdlib/geometry.h, operation by operation, and in other forms those of stdlib/matrix.h.
#include "compiler/ir/expand_vectors.h"

#include "compiler/ir/walk.h"

namespace moonshade::ir {
namespace {

bool is_expanded(const Instruction& instruction) {
  return instruction.op == Op::CallLibrary && is_linear_algebra(*instruction.library);
}

/// Appends instructions to a block that is being rewritten.
class Expansion {
public:
  Expansion(Function& function, std::vector<ValueId>& block, Span span)
      : function_(function), block_(block), span_(span) {}

  ValueId expand(std::string_view name, ValueType type, const std::vector<ValueId>& operands) {
    const ValueId a = operands[0];
    if (name == "dot") return dot(a, operands[1]);
    if (name == "cross") return cross(a, operands[1]);
    if (name == "length") return length(a);
    if (name == "distance") return length(add(Op::Sub, type_of(a), {a, operands[1]}));
    if (name == "normalize") return normalize(a);
    if (name == "reflect") return reflect(a, operands[1]);
    if (name == "refract") return refract(a, operands[1], operands[2]);
    if (name == "rotate") return rotate(a, operands[1], operands[2]);
    if (name == "determinant") return determinant(a);
    const ValueId against = less(dot(operands[2], operands[1]), number(0)); // faceforward
    return add(Op::Select, type, {against, a, add(Op::Neg, type, {a})});
  }

private:
  ValueType type_of(ValueId value) const { return function_.instructions[value].type; }
  unsigned size_of(ValueId vector) const { return component_count(type_of(vector)); }

  ValueId append(Instruction instruction) {
    instruction.span = span_;
    return ir::append(function_, block_, std::move(instruction));
  }
  ValueId add(Op op, ValueType type, std::vector<ValueId> operands) {
    Instruction instruction{};
    instruction.op = op;
    instruction.type = type;
    instruction.operands = std::move(operands);
    return append(std::move(instruction));
  }
  ValueId number(double value) {
    Instruction instruction{};
    instruction.op = Op::ConstNumber;
    instruction.type = ValueType::Number;
    instruction.number = value;
    return append(std::move(instruction));
  }
  ValueId at(ValueId vector, unsigned index) {
    Instruction instruction{};
    instruction.op = Op::Component;
    instruction.type = ValueType::Number;
    instruction.operands = {vector};
    instruction.index = index;
    return append(std::move(instruction));
  }
  ValueId plus(ValueId a, ValueId b) { return add(Op::Add, ValueType::Number, {a, b}); }
  ValueId minus(ValueId a, ValueId b) { return add(Op::Sub, ValueType::Number, {a, b}); }
  ValueId times(ValueId a, ValueId b) { return add(Op::Mul, ValueType::Number, {a, b}); }
  ValueId less(ValueId a, ValueId b) { return add(Op::Lt, ValueType::Boolean, {a, b}); }
  ValueId choose(ValueId condition, ValueId a, ValueId b) {
    return add(Op::Select, ValueType::Number, {condition, a, b});
  }
  ValueId sqrt(ValueId x) { return of_number("sqrt", x); }
  ValueId of_number(std::string_view row, ValueId x) {
    Instruction instruction{};
    instruction.op = Op::CallLibrary;
    instruction.type = ValueType::Number;
    instruction.operands = {x};
    instruction.library = &library_overloads(row).front();
    return append(std::move(instruction));
  }
  template <class F> ValueId by_component(ValueId vector, F f) {
    std::vector<ValueId> numbers;
    for (unsigned i = 0; i < size_of(vector); ++i)
      numbers.push_back(f(i));
    return add(Op::Construct, type_of(vector), std::move(numbers));
  }

  ValueId dot(ValueId a, ValueId b) {
    ValueId sum = times(at(a, 0), at(b, 0));
    for (unsigned i = 1; i < size_of(a); ++i)
      sum = plus(times(at(a, i), at(b, i)), sum);
    return sum;
  }
  ValueId cross(ValueId a, ValueId b) {
    return by_component(a, [&](unsigned i) {
      const unsigned j = (i + 1) % 3, k = (i + 2) % 3;
      return minus(times(at(a, j), at(b, k)), times(at(a, k), at(b, j)));
    });
  }
  ValueId length(ValueId v) { return sqrt(dot(v, v)); }
  ValueId normalize(ValueId v) {
    const ValueId size = length(v), zero = number(0);
    const ValueId inverse = add(Op::Div, ValueType::Number, {number(1), size});
    const ValueId scale = choose(add(Op::Eq, ValueType::Boolean, {size, zero}), zero, inverse);
    return by_component(v, [&](unsigned i) { return times(at(v, i), scale); });
  }
  ValueId reflect(ValueId i, ValueId n) {
    const ValueId scale = times(number(-2), dot(n, i));
    return by_component(i, [&](unsigned k) { return plus(times(at(n, k), scale), at(i, k)); });
  }
  ValueId refract(ValueId i, ValueId n, ValueId eta) {
    const ValueId cosine = dot(n, i), one = number(1), zero = number(0);
    const ValueId k = minus(one, times(times(eta, eta), minus(one, times(cosine, cosine))));
    const ValueId bend = plus(times(eta, cosine), sqrt(k));
    const ValueId total = less(k, zero);
    return by_component(i, [&](unsigned c) {
      const ValueId bent = minus(times(at(i, c), eta), times(at(n, c), bend));
      return choose(total, times(at(n, c), zero), bent);
    });
  }

  ValueId rotate(ValueId v, ValueId axis, ValueId angle) {
    const ValueId s = of_number("sin", angle), c = of_number("cos", angle), k = normalize(axis);
    const ValueId along = times(dot(k, v), minus(number(1), c)), across = cross(k, v);
    return by_component(
        v, [&](unsigned i) { return plus(times(at(k, i), along), plus(times(at(across, i), s), times(at(v, i), c))); });
  }

  // Matrices: `size` columns of as many numbers.
  unsigned matrix_size(ValueId matrix) const { return type_of(matrix) == ValueType::Mat3 ? 3 : 4; }
  ValueId entry(ValueId matrix, unsigned row, unsigned column) {
    return at(matrix, column * matrix_size(matrix) + row);
  }
  /// Of the rows and columns listed, expanded along the first row: numbers for at most four of them.
  ValueId determinant_of(ValueId m, const std::vector<unsigned>& rows, const std::vector<unsigned>& columns) {
    if (rows.size() == 1) return entry(m, rows[0], columns[0]);
    ValueId sum = kNone;
    for (size_t i = 0; i < columns.size(); ++i) {
      const ValueId term = times(entry(m, rows[0], columns[i]), cofactor(m, rows, columns, 0, i));
      sum = sum == kNone ? term : i % 2 == 0 ? plus(sum, term) : minus(sum, term);
    }
    return sum;
  }
  ValueId cofactor(ValueId m, std::vector<unsigned> rows, std::vector<unsigned> columns, size_t row, size_t column) {
    rows.erase(rows.begin() + static_cast<ptrdiff_t>(row));
    columns.erase(columns.begin() + static_cast<ptrdiff_t>(column));
    return determinant_of(m, rows, columns);
  }
  const std::vector<unsigned>& all(ValueId m) const { return matrix_size(m) == 3 ? kThree : kFour; }
  ValueId determinant(ValueId m) { return determinant_of(m, all(m), all(m)); }
  inline static const std::vector<unsigned> kThree = {0, 1, 2}, kFour = {0, 1, 2, 3};

  Function& function_;
  std::vector<ValueId>& block_;
  Span span_;
};

void expand(Function& function) {
  Replacements replacements(function.instructions.size());
  rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& block) {
    replacements.apply(function.instructions[id]);
    if (!is_expanded(function.instructions[id])) {
      block.push_back(id);
      return true;
    }
    const Instruction call = function.instructions[id]; // a copy: instructions are added
    Expansion expansion(function, block, call.span);
    replacements.replace(id, expansion.expand(call.library->name, call.type, call.operands));
    return true;
  });
}

} // namespace

FunctionId VectorExpander::expanded(FunctionId function) {
  if (const auto known = known_.find(function); known != known_.end()) return known->second;
  Function copy = module_.functions[function];
  bool is_changed = false, has_rows = false;
  for_each_instruction(copy, [&](ValueId id) {
    Instruction& instruction = copy.instructions[id];
    has_rows = has_rows || is_expanded(instruction);
    if (instruction.op != Op::Call) return;
    const FunctionId callee = expanded(instruction.index);
    is_changed = is_changed || callee != instruction.index;
    instruction.index = callee;
  });
  if (has_rows) expand(copy);
  FunctionId made = function;
  if (is_changed || has_rows) {
    made = static_cast<FunctionId>(module_.functions.size());
    module_.functions.push_back(std::move(copy));
  }
  known_.emplace(function, made);
  return made;
}

} // namespace moonshade::ir
