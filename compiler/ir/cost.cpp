// Costs of speculation. See cost.h.
#include "compiler/ir/cost.h"

#include <algorithm>
#include <array>

namespace moonshade::ir {
namespace {

/// Functions of the library that are a few instructions and no more, in additions for each component.
constexpr unsigned kCheapFunction = 2;
constexpr std::array<std::string_view, 22> kCheapFunctions = {
    "abs",  "floor",    "ceil",     "fract",    "round", "trunc", "sign",  "min",   "max",    "clamp",  "saturate",
    "step", "math.abs", "math.max", "math.min", "mix",   "op.lt", "op.le", "op.eq", "op.shl", "op.shr", "dot"};

} // namespace

std::optional<unsigned> speculation_cost(const Instruction& instruction) {
  const unsigned components = component_count(instruction.type);
  switch (instruction.op) {
  case Op::ConstBoolean:
  case Op::ConstInteger:
  case Op::ConstNumber:
  case Op::Argument:
  case Op::Construct:
  case Op::Component:
    return 0;
  case Op::Div:
    return 4 * components;
  case Op::CallLibrary:
    if (std::ranges::find(kCheapFunctions, instruction.library->name) == kCheapFunctions.end()) return {};
    return kCheapFunction * components;
  // Globals never change after init, and results have no cost of their own.
  case Op::LoadGlobal:
  case Op::Result:
    return 0;
  default:
    if (info(instruction.op).shape != OpShape::Value) return {};
    return components;
  }
}

std::optional<unsigned> speculation_cost(const Function& function, const Block& block) {
  unsigned sum = 0;
  for (const ValueId id : block.instructions) {
    const std::optional<unsigned> cost = speculation_cost(function.instructions[id]);
    if (!cost) return {};
    sum += *cost;
  }
  return sum;
}

} // namespace moonshade::ir
