// share_variables: of variables that always hold the same, one is left. Derivatives make such: those of a point's
// coordinates along each its own axis (p = p * 2) begin and are multiplied alike.
//
// Variables are taken for equal at first where each is stored when the others are: between the stores that belong
// together nothing is read and nothing branches, so whoever reads one of them finds all stored equally often. A walk
// numbers the values that follow from this, equal computations alike, and whatever is stored unequal divides them;
// again, until a walk divides nothing.
#include "compiler/ir/hash.h"
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <bit>
#include <unordered_map>

namespace moonshade::ir {
namespace {

constexpr int kMaxRounds = 8;

using Key = std::vector<uint64_t>;
struct KeyHash {
  size_t operator()(const Key& key) const {
    size_t hash = key.size();
    for (const uint64_t part : key)
      hash = hash_with(hash, part);
    return hash;
  }
};

class VariableSharing {
public:
  explicit VariableSharing(const Function& function)
      : function_(function), alone_(function.variables.size()), classes_(function.variables.size()),
        stored_(function.variables.size()), numbers_(function.instructions.size()) {}

  /// By variable the one that it is equal to; empty where none is.
  std::vector<VariableId> run() {
    find_alone();
    size_t classes = 0;
    for (int round = 0; round < kMaxRounds; ++round) {
      numbering_ = round > 0; // mostly the times of the stores already divide all
      known_.clear();
      for (Key& numbers : stored_)
        numbers.clear();
      walk(function_.body);
      const size_t before = classes;
      classes = divide();
      if (classes == classes_.size()) return {};
      if (numbering_ && classes == before) return classes_;
    }
    return {};
  }

private:
  void find_alone() {
    for (VariableId variable = 0; variable < alone_.size(); ++variable)
      alone_[variable] = variable < function_.captures || function_.variables[variable].count != 1;
    for_each_instruction(function_, [&](ValueId id) {
      for (const VariableId variable : function_.instructions[id].variables)
        alone_[variable] = true;
    });
  }

  /// Into classes of those that were equal and were stored equally, named by their first. Their number.
  size_t divide() {
    std::unordered_map<Key, VariableId, KeyHash> known;
    size_t count = 0;
    for (VariableId variable = 0; variable < classes_.size(); ++variable) {
      Key key = stored_[variable];
      key.push_back(classes_[variable]);
      key.push_back(static_cast<uint64_t>(function_.variables[variable].type));
      const bool is_alone = alone_[variable] || stored_[variable].empty();
      classes_[variable] = is_alone ? variable : known.try_emplace(std::move(key), variable).first->second;
      count += classes_[variable] == variable;
    }
    return count;
  }

  void walk(const Block& block) {
    ++segment_;
    ++burst_;
    for (const ValueId id : block.instructions) {
      const Instruction& instruction = function_.instructions[id];
      if (instruction.op == Op::Store) {
        Key& stored = stored_[instruction.index];
        stored.push_back(burst_);
        stored.push_back(numbers_[instruction.operands[0]]);
        continue;
      }
      const OpShape shape = info(instruction.op).shape;
      if (shape != OpShape::Value) ++burst_;
      for (const Block& inner : instruction.blocks)
        walk(inner);
      if (shape == OpShape::Block) ++segment_;
      if (!numbering_) continue;
      numbers_[id] = shape == OpShape::Value      ? number_of(value_key(instruction))
                     : is_known_load(instruction) ? number_of(load_key(instruction.index))
                                                  : number_of({id});
    }
    ++burst_;
  }

  Key value_key(const Instruction& instruction) const {
    Key key = {static_cast<uint64_t>(instruction.op),
               static_cast<uint64_t>(instruction.type),
               instruction.index,
               static_cast<uint64_t>(instruction.integer),
               std::bit_cast<uint64_t>(instruction.number),
               reinterpret_cast<uintptr_t>(instruction.library)};
    for (const ValueId operand : instruction.operands)
      key.push_back(numbers_[operand]);
    return key;
  }
  /// Of what only `store` changes.
  bool is_known_load(const Instruction& instruction) const {
    return instruction.op == Op::Load && !alone_[instruction.index];
  }
  /// Loads are equal where no branch and no store lies between.
  Key load_key(VariableId variable) const { return {classes_[variable], segment_, stored_[variable].size()}; }
  /// By the length of the keys no two kinds of them are equal.
  uint64_t number_of(Key key) { return known_.try_emplace(std::move(key), known_.size()).first->second; }

  const Function& function_;
  std::vector<bool> alone_;         ///< by variable: never equal to another
  std::vector<VariableId> classes_; ///< by variable: the first of those that it is taken to be equal to
  std::vector<Key> stored_;         ///< by variable, in order: when, and the number of what was stored
  std::vector<uint64_t> numbers_;   ///< by value
  std::unordered_map<Key, uint64_t, KeyHash> known_;
  bool numbering_ = false;
  uint64_t segment_ = 0; ///< what no branch lies in
  uint64_t burst_ = 0;   ///< of stores
};

} // namespace

void share_variables(Function& function) {
  const std::vector<VariableId> equal = VariableSharing(function).run();
  if (equal.empty()) return;
  rewrite_blocks(function, [&](ValueId id, std::vector<ValueId>& result) {
    Instruction& instruction = function.instructions[id];
    if (instruction.op == Op::Load) instruction.index = equal[instruction.index];
    if (instruction.op != Op::Store || equal[instruction.index] == instruction.index) result.push_back(id);
    return true;
  });
}

} // namespace moonshade::ir
