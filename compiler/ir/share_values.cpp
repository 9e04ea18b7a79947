// share_values: of equal computations, the later takes the value of the earlier where that is visible. LLVM would do
// the same for arithmetic, but only after inlining the library's bodies, and hardly for those with loops; and what
// never reaches it costs no time there. Products stay apart: `fuse` wants each for itself. A fault on a condition that
// a fault before it has, on every path to it, hits no point that is left, and goes: `a % n` beside `a // n` is checked
// once.
#include "compiler/ir/hash.h"
#include "compiler/ir/passes.h"
#include "compiler/ir/walk.h"

#include <bit>
#include <unordered_map>
#include <unordered_set>

namespace moonshade::ir {
namespace {

struct Key {
  const Instruction* instruction;

  bool operator==(const Key& other) const {
    const Instruction &a = *instruction, &b = *other.instruction;
    return a.op == b.op && a.type == b.type && a.index == b.index && a.integer == b.integer &&
           std::bit_cast<uint64_t>(a.number) == std::bit_cast<uint64_t>(b.number) && a.library == b.library &&
           a.operands == b.operands;
  }
};

struct KeyHash {
  size_t operator()(const Key& key) const {
    const Instruction& instruction = *key.instruction;
    size_t hash = static_cast<size_t>(instruction.op);
    const auto mix = [&](uint64_t part) { hash = hash_with(hash, part); };
    mix(static_cast<uint64_t>(instruction.type));
    mix(instruction.index);
    mix(static_cast<uint64_t>(instruction.integer));
    mix(std::bit_cast<uint64_t>(instruction.number));
    mix(reinterpret_cast<uintptr_t>(instruction.library));
    for (const ValueId operand : instruction.operands)
      mix(operand);
    return hash;
  }
};

class Sharing {
public:
  explicit Sharing(Function& function) : function_(function), replacements_(function.instructions.size()) {
    for_each_instruction(function, [&](ValueId id) {
      const Op op = function.instructions[id].op;
      stores_globals_ = stores_globals_ || op == Op::StoreGlobal || op == Op::StoreGlobalElement;
    });
  }

  void run() { walk(function_.body); }

private:
  bool is_shared(const Instruction& instruction) const {
    if (instruction.op == Op::LoadGlobal || instruction.op == Op::LoadGlobalElement)
      return !stores_globals_; // constants to all functions but init
    return info(instruction.op).shape == OpShape::Value && instruction.op != Op::Mul;
  }

  /// Whether a fault before this one, on every path to it, had the same condition.
  bool is_checked(const Instruction& instruction, std::vector<ValueId>& checked) {
    if (instruction.op != Op::Fault) return false;
    if (!checked_.insert(instruction.operands[0]).second) return true;
    checked.push_back(instruction.operands[0]);
    return false;
  }

  void walk(Block& block) {
    std::vector<ValueId> result, checked;
    std::vector<Key> added;
    result.reserve(block.instructions.size());
    for (const ValueId id : block.instructions) {
      Instruction& instruction = function_.instructions[id]; // stays where it is: nothing is added
      replacements_.apply(instruction);
      if (is_shared(instruction)) {
        const auto [known, is_new] = known_.try_emplace(Key{&instruction}, id);
        if (!is_new) {
          replacements_.replace(id, known->second);
          continue;
        }
        added.push_back(known->first);
      }
      if (is_checked(instruction, checked)) continue;
      for (Block& inner : instruction.blocks)
        walk(inner);
      result.push_back(id);
    }
    block.instructions = std::move(result);
    // Neither is visible outside.
    for (const Key& key : added)
      known_.erase(key);
    for (const ValueId condition : checked)
      checked_.erase(condition);
  }

  Function& function_;
  bool stores_globals_ = false;
  Replacements replacements_;
  std::unordered_map<Key, ValueId, KeyHash> known_;
  std::unordered_set<ValueId> checked_; ///< conditions of faults
};

} // namespace

void share_values(Function& function) { Sharing(function).run(); }

} // namespace moonshade::ir
