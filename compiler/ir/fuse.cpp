// fuse, for f32: a product that is added to or subtracted from once becomes part of an fma. The rule is fixed, and the
// pass runs at every level of optimisation, before a width is chosen, so that the bits are the same everywhere:
//
//   x + y    where x is a product a*b used nowhere else:      fma(a, b, y)
//            else where y is a product a*b used nowhere else: fma(a, b, x)
//   x - y    where x is a product a*b used nowhere else:      fma(a, b, -y)
//            else where y is a product a*b used nowhere else: fma(-a, b, x)      (exact: a*b is not rounded)
//
// for numbers and vectors, in order of execution. Only `mul` counts as a product, not what the library computes.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

namespace moonshade::ir {
namespace {

bool is_product(const Function& function, const std::vector<uint32_t>& uses, ValueId id) {
  return function.instructions[id].op == Op::Mul && uses[id] == 1;
}

ValueId append_negation(Function& function, ValueId of, Span span, std::vector<ValueId>& result) {
  Instruction negation{};
  negation.op = Op::Neg;
  negation.type = function.instructions[of].type;
  negation.operands = {of};
  negation.span = span;
  function.instructions.push_back(std::move(negation));
  result.push_back(static_cast<ValueId>(function.instructions.size() - 1));
  return result.back();
}

void fuse(Function& function) {
  // What is printed is no use: the numbers are to be those of code without prints.
  std::vector<uint32_t> uses = count_uses(function);
  for_each_instruction(function, [&](ValueId id) {
    if (function.instructions[id].op != Op::Print) return;
    for (const ValueId operand : function.instructions[id].operands)
      --uses[operand];
  });
  rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
    const Op op = function.instructions[id].op;
    const ValueType type = function.instructions[id].type;
    if ((op == Op::Add || op == Op::Sub) && (type == ValueType::Number || is_vector(type))) {
      const ValueId x = function.instructions[id].operands[0], y = function.instructions[id].operands[1];
      const Span span = function.instructions[id].span;
      const bool left = is_product(function, uses, x);
      if (left || is_product(function, uses, y)) {
        std::vector<ValueId> operands = function.instructions[left ? x : y].operands;
        ValueId addend = left ? y : x;
        if (op == Op::Sub) {
          ValueId& negated = left ? addend : operands[0];
          negated = append_negation(function, negated, span, result);
        }
        operands.push_back(addend);
        function.instructions[id].op = Op::Fma;
        function.instructions[id].operands = std::move(operands);
      }
    }
    result.push_back(id);
    return true;
  });
}

} // namespace

void fuse(Module& module) {
  for (Function& function : module.functions) {
    fuse(function);
    remove_dead_code(function);
  }
}

} // namespace moonshade::ir
