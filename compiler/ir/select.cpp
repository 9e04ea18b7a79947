// convert_ifs_to_selects: an `if` whose blocks only compute cheap values and store them into variables becomes the
// computation of both and one select for each variable that either stores. Inner ifs first, so that a chain of elseifs
// that only chooses a value ends as a chain of selects.
#include "compiler/ir/cost.h"
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <map>

namespace moonshade::ir {
namespace {

constexpr size_t kMaxVariables = 4; ///< that one `if` may choose

using Stores = std::map<VariableId, ValueId>;

class SelectConversion {
public:
  explicit SelectConversion(Function& function) : function_(function) {}

  void run() {
    rewrite_blocks(function_, [&](ValueId id, std::vector<ValueId>& result) {
      if (!convert(id, result)) result.push_back(id);
      return true;
    });
  }

private:
  /// What the block stores at its end, or nothing where it does anything else that may not be executed in vain.
  std::optional<Stores> stores_of(const Block& block, unsigned& cost) const {
    Stores stores;
    for (const ValueId id : block.instructions) {
      const Instruction& instruction = function_.instructions[id];
      switch (instruction.op) {
      case Op::Store:
        // Captures may be one variable under two names.
        if (instruction.index < function_.captures) return {};
        stores[instruction.index] = instruction.operands[0];
        break;
      case Op::Load:
        // A load in vain of a variable without a value is harmless: nothing looks at what it gives. Behind a store of
        // the block it would come too early.
        if (instruction.index < function_.captures || stores.contains(instruction.index)) return {};
        break;
      default: {
        const std::optional<unsigned> one = speculation_cost(instruction);
        if (!one) return {};
        cost += *one;
        if (cost > kSelectCost) return {};
      }
      }
    }
    return stores;
  }

  bool convert(ValueId id, std::vector<ValueId>& result) {
    if (function_.instructions[id].op != Op::If) return false;
    const Block then_block = function_.instructions[id].blocks[0], else_block = function_.instructions[id].blocks[1];
    unsigned cost = 0;
    const std::optional<Stores> then_stores = stores_of(then_block, cost), else_stores = stores_of(else_block, cost);
    if (!then_stores || !else_stores) return false;
    std::map<VariableId, std::pair<ValueId, ValueId>> chosen;
    for (const auto& [variable, value] : *then_stores)
      chosen[variable] = {value, kNone};
    for (const auto& [variable, value] : *else_stores)
      chosen.try_emplace(variable, kNone, kNone).first->second.second = value;
    for (const auto& [variable, values] : chosen)
      cost += component_count(function_.variables[variable].type);
    if (cost > kSelectCost || chosen.size() > kMaxVariables) return false;

    for (const Block* block : {&then_block, &else_block})
      for (const ValueId inner : block->instructions)
        if (function_.instructions[inner].op != Op::Store) result.push_back(inner);
    const ValueId condition = function_.instructions[id].operands[0];
    const Span span = function_.instructions[id].span;
    for (auto [variable, values] : chosen) {
      const ValueType type = function_.variables[variable].type;
      if (values.first == kNone || values.second == kNone) {
        const ValueId before = append(Op::Load, type, variable, {}, span, result);
        if (values.first == kNone) values.first = before;
        if (values.second == kNone) values.second = before;
      }
      const ValueId value = append(Op::Select, type, 0, {condition, values.first, values.second}, span, result);
      append(Op::Store, ValueType::Boolean, variable, {value}, span, result);
    }
    return true;
  }

  ValueId append(Op op, ValueType type, uint32_t index, std::vector<ValueId> operands, Span span,
                 std::vector<ValueId>& result) {
    Instruction instruction{};
    instruction.op = op;
    instruction.type = type;
    instruction.index = index;
    instruction.operands = std::move(operands);
    instruction.span = span;
    return ir::append(function_, result, std::move(instruction));
  }

  Function& function_;
};

} // namespace

void convert_ifs_to_selects(Function& function) { SelectConversion(function).run(); }

} // namespace moonshade::ir
