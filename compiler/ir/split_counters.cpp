// split_counters: a counter of a loop that is read behind the loop, too, gets a second variable for the reads inside.
// Lanes that have left the loop keep their count, so the counter differs by lane; but those that are still in the loop
// have counted alike. The second variable is read by these alone, so it is uniform (uniformity.h): tests of it are
// branches, and what is indexed by it is no gather.
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <optional>

namespace moonshade::ir {
namespace {

/// The accesses to an integer that begins as a constant and is counted up or down in one place.
struct Counter {
  bool possible = true;
  ValueId start = kNone, count = kNone; ///< the two stores
  const Block *start_block = nullptr, *count_block = nullptr;
};

class CounterFinder {
public:
  explicit CounterFinder(const Function& function) : function_(function), counters(function.variables.size()) {
    walk(function.body);
  }

private:
  void walk(const Block& block) {
    for (const ValueId id : block.instructions) {
      const Instruction& instruction = function_.instructions[id];
      for (const VariableId variable : instruction.variables)
        counters[variable].possible = false;
      if (instruction.op == Op::Store) store(id, instruction, block);
      for (const Block& inner : instruction.blocks)
        walk(inner);
    }
  }

  void store(ValueId id, const Instruction& instruction, const Block& block) {
    Counter& counter = counters[instruction.index];
    const Instruction& value = function_.instructions[instruction.operands[0]];
    if (value.op == Op::ConstInteger && counter.start == kNone) {
      counter.start = id;
      counter.start_block = &block;
    } else if (counts(value, instruction.index) && counter.count == kNone) {
      counter.count = id;
      counter.count_block = &block;
    } else {
      counter.possible = false;
    }
  }

  bool counts(const Instruction& value, VariableId variable) const {
    if ((value.op != Op::Add && value.op != Op::Sub) || value.type != ValueType::Integer) return false;
    const Instruction& from = function_.instructions[value.operands[0]];
    return from.op == Op::Load && from.index == variable &&
           function_.instructions[value.operands[1]].op == Op::ConstInteger;
  }

  const Function& function_;

public:
  std::vector<Counter> counters; ///< by variable
};

/// Splits the counters of one loop.
class Splitter {
public:
  Splitter(Function& function, const std::vector<Counter>& counters) : function_(function), counters_(counters) {}

  void run() {
    const size_t count = function_.variables.size();
    reads_.resize(count);
    for_each_instruction(function_, [&](ValueId id) {
      if (function_.instructions[id].op == Op::Load) ++reads_[function_.instructions[id].index];
    });
    walk(function_.body);
  }

private:
  /// The blocks keep their places until the walk is through: instructions are only added to the arena afterwards.
  void walk(Block& block) {
    for (const ValueId id : block.instructions) {
      if (function_.instructions[id].op == Op::Loop) consider(id, block);
      for (Block& inner : function_.instructions[id].blocks)
        walk(inner);
    }
  }

  void consider(ValueId loop, const Block& around) {
    const Block& body = function_.instructions[loop].blocks[0];
    for (VariableId variable = function_.captures; variable < counters_.size(); ++variable) {
      const Counter& counter = counters_[variable];
      if (!counter.possible || counter.start_block != &around || counter.count_block != &body) continue;
      std::vector<ValueId> inside;
      for_each_instruction(function_, body, [&](ValueId id) {
        const Instruction& instruction = function_.instructions[id];
        if (instruction.op == Op::Load && instruction.index == variable) inside.push_back(id);
      });
      if (inside.size() == reads_[variable]) continue; // it is uniform as it is
      splits.push_back({variable, loop, counter, std::move(inside)});
    }
  }

  Function& function_;
  const std::vector<Counter>& counters_;
  std::vector<size_t> reads_;

public:
  struct Split {
    VariableId variable;
    ValueId loop;
    Counter counter;
    std::vector<ValueId> inside;
  };
  std::vector<Split> splits;
};

} // namespace

void split_counters(Function& function) {
  const CounterFinder finder(function);
  Splitter splitter(function, finder.counters);
  splitter.run();
  for (const Splitter::Split& split : splitter.splits) {
    const auto copy = static_cast<VariableId>(function.variables.size());
    function.variables.push_back(function.variables[split.variable]);
    for (const ValueId load : split.inside)
      function.instructions[load].index = copy;
    rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
      const auto store_copy = [&](ValueId like) {
        Instruction store = function.instructions[like];
        store.index = copy;
        function.instructions.push_back(std::move(store));
        result.push_back(static_cast<ValueId>(function.instructions.size() - 1));
      };
      if (id == split.loop) store_copy(split.counter.start);
      result.push_back(id);
      if (id == split.counter.count) store_copy(id);
      return true;
    });
  }
}

} // namespace moonshade::ir
