// Uniformity. See uniformity.h for what the answers mean.
//
// The walk keeps a stack of the constructs around the current instruction, each with a flag: whether lanes *wait*
// there, that is, whether some of the lanes that entered this execution of the construct's block are switched off now
// and go on behind it (or, for an `if`, in its other block). They wait at a varying `if` around, and at a loop, scope
// or function to which a varying break or return before has sent them. Then
//
//   a break is varying where lanes wait at a construct inside its target (those at the target itself have left it);
//   a return is varying where lanes wait anywhere but at the function;
//   a store must not be to a uniform variable where lanes wait inside the variable's *home* that may read the variable
//   later. The home is the innermost block that holds all accesses and that stores the variable first, so that no
//   execution of the block sees what an earlier one stored (or a block executed at most once a call). Lanes that wait
//   outside the home never read what this execution of it stored. Lanes that wait at a construct which holds all
//   *reads* do not read again either, as long as no loop between home and construct brings them back to it: so the
//   counter of a loop that lanes leave one by one stays uniform. The home of a capture lies outside the function: there
//   any waiting counts, and so does Signature::partial.
//
// What is varying only grows, and what grows makes more varying: the walk is repeated until nothing changes.
#include "compiler/ir/uniformity.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace moonshade::ir {
namespace {

/// Depth of a home outside the function: lanes that wait anywhere in it count.
constexpr int kOutside = -1;

/// Where a variable lives. Depths: 0 is the function's body, each construct around a block is one deeper.
struct Home {
  int depth = 0;
  /// The blocks from the function's body to the innermost one that holds all reads; empty where there are none.
  std::vector<const Block*> reads;
  /// Depth of the outermost loop inside the home on the way to the reads.
  size_t first_loop = std::numeric_limits<size_t>::max();
};

class HomeFinder {
public:
  explicit HomeFinder(const Function& function)
      : function_(function), accesses_(function.variables.size()), reads_(function.variables.size()),
        stored_first_(function.variables.size(), -1) {}

  std::vector<Home> find() {
    path_.push_back({&function_.body, false, false});
    walk(function_.body);
    std::vector<Home> homes;
    homes.reserve(function_.variables.size());
    for (VariableId variable = 0; variable < function_.variables.size(); ++variable)
      homes.push_back(home(variable));
    return homes;
  }

private:
  struct Enclosing {
    const Block* block;
    bool is_loop;
    bool repeated; ///< executed more than once in a call of the function, perhaps
  };
  using Path = std::optional<std::vector<Enclosing>>; ///< to the innermost block that holds what was seen

  void walk(const Block& block) {
    for (const ValueId id : block.instructions) {
      const Instruction& instruction = function_.instructions[id];
      switch (instruction.op) {
      case Op::Load:
      case Op::LoadElement:
        narrow(reads_[instruction.index]);
        [[fallthrough]];
      case Op::StoreElement:
        narrow(accesses_[instruction.index]);
        break;
      case Op::Store:
        if (!accesses_[instruction.index]) stored_first_[instruction.index] = static_cast<int>(path_.size()) - 1;
        narrow(accesses_[instruction.index]);
        break;
      case Op::Call:
        for (const VariableId variable : instruction.variables) {
          narrow(reads_[variable]);
          narrow(accesses_[variable]);
        }
        break;
      default:
        break;
      }
      for (const Block& inner : instruction.blocks) {
        const bool is_loop = instruction.op == Op::Loop;
        path_.push_back({&inner, is_loop, path_.back().repeated || is_loop});
        walk(inner);
        path_.pop_back();
      }
    }
  }

  void narrow(Path& common) const {
    if (!common) {
      common = path_;
      return;
    }
    size_t same = 0;
    while (same < common->size() && same < path_.size() && (*common)[same].block == path_[same].block)
      ++same;
    common->resize(same);
  }

  Home home(VariableId variable) const {
    Home home;
    const Path& reads = reads_[variable];
    const Path& accesses = accesses_[variable];
    if (reads)
      for (const Enclosing& enclosing : *reads)
        home.reads.push_back(enclosing.block);
    if (variable < function_.captures) {
      home.depth = kOutside;
      return home;
    }
    if (!accesses) return home;
    const std::vector<Enclosing>& common = *accesses;
    for (size_t depth = common.size(); depth-- > 0;)
      if (!common[depth].repeated || stored_first_[variable] == static_cast<int>(depth) ||
          (stored_first_[variable] > static_cast<int>(depth) && stores_first(*common[depth].block, variable))) {
        home.depth = static_cast<int>(depth);
        break;
      }
    if (reads)
      for (size_t depth = reads->size(); depth-- > static_cast<size_t>(home.depth) + 1;)
        if ((*reads)[depth].is_loop) home.first_loop = depth;
    return home;
  }

  /// Whether each execution of the block stores the variable before any other access.
  bool stores_first(const Block& block, VariableId variable) const {
    for (const ValueId id : block.instructions) {
      const Instruction& instruction = function_.instructions[id];
      if (instruction.op == Op::Store && instruction.index == variable) return true;
      if (instruction.op == Op::If && stores_first(instruction.blocks[0], variable) &&
          stores_first(instruction.blocks[1], variable))
        return true;
      if (accesses(instruction, variable)) return false;
    }
    return false;
  }

  bool accesses(const Instruction& instruction, VariableId variable) const {
    switch (instruction.op) {
    case Op::Load:
    case Op::Store:
    case Op::LoadElement:
    case Op::StoreElement:
      return instruction.index == variable;
    case Op::Call:
      return std::ranges::find(instruction.variables, variable) != instruction.variables.end();
    default:
      break;
    }
    return std::ranges::any_of(instruction.blocks, [&](const Block& block) {
      return std::ranges::any_of(block.instructions,
                                 [&](ValueId id) { return accesses(function_.instructions[id], variable); });
    });
  }

  const Function& function_;
  std::vector<Enclosing> path_;
  std::vector<Path> accesses_; ///< by variable
  std::vector<Path> reads_;
  std::vector<int> stored_first_; ///< by variable: depth of its first access if that is a store, else -1
};

class Analysis {
public:
  Analysis(const Module& module, const Function& function, const Signature& signature, UniformityTable& table)
      : module_(module), function_(function), signature_(signature), table_(table),
        homes_(HomeFinder(function).find()) {
    const size_t values = function.instructions.size();
    result_.value_varying.resize(values);
    result_.control_varying.resize(values);
    result_.may_kill.resize(values);
    result_.variable_varying.resize(function.variables.size());
    result_.results_varying.resize(function.results.size());
    for (size_t i = 0; i < function.captures && i < signature.captures_varying.size(); ++i)
      result_.variable_varying[i] = signature.captures_varying[i];
  }

  Uniformity run() {
    do {
      changed_ = false;
      enclosing_.assign(1, {kFunction, kNone, &function_.body, false});
      result_.function_may_kill = walk(function_.body);
    } while (changed_);
    return std::move(result_);
  }

private:
  static constexpr LabelId kFunction = kNone;    ///< stands for the function as the target of `return`
  static constexpr LabelId kNoLabel = kNone - 1; ///< of an if

  struct Enclosing {
    LabelId label;
    ValueId construct;
    const Block* block;
    bool waiting;
  };

  void set(std::vector<bool>::reference flag, bool condition = true) {
    if (!condition || flag) return;
    flag = true;
    changed_ = true;
  }

  bool any_varying(const std::vector<ValueId>& values) const {
    return std::ranges::any_of(values, [&](ValueId value) { return result_.value_varying[value]; });
  }

  /// Whether a store to the variable at this place would miss lanes that may read it later.
  bool is_partial_for(VariableId variable) const {
    const Home& home = homes_[variable];
    if (home.depth == kOutside && signature_.partial) return true;
    for (size_t depth = enclosing_.size(); static_cast<int>(--depth) > home.depth;) {
      if (!enclosing_[depth].waiting) continue;
      if (home.depth == kOutside) return true;
      const bool holds_all_reads =
          home.reads.empty() || (depth < home.reads.size() && home.reads[depth] == enclosing_[depth].block);
      if (!holds_all_reads || depth > home.first_loop) return true;
    }
    return false;
  }

  /// True where the block may kill lanes.
  bool walk(const Block& block) {
    bool may_kill = false;
    for (const ValueId id : block.instructions) {
      visit(id);
      may_kill = may_kill || result_.may_kill[id];
    }
    return may_kill;
  }

  void visit(ValueId id) {
    const Instruction& instruction = function_.instructions[id];
    const std::vector<bool>::reference varying = result_.value_varying[id];
    switch (instruction.op) {
    case Op::Argument:
      return set(varying, signature_.arguments_varying[instruction.index]);
    case Op::LoadGlobal:
    case Op::StoreGlobal:
    case Op::StoreGlobalElement:
    case Op::Print:
      return;
    case Op::LoadGlobalElement:
      return set(varying, any_varying(instruction.operands));
    case Op::Load:
      return set(varying, result_.variable_varying[instruction.index]);
    case Op::LoadElement:
      return set(varying, result_.variable_varying[instruction.index] || any_varying(instruction.operands));
    case Op::Store:
    case Op::StoreElement:
      return set(result_.variable_varying[instruction.index],
                 any_varying(instruction.operands) || is_partial_for(instruction.index));
    case Op::Call:
      return visit_call(id, instruction);
    case Op::Result:
      return set(varying, is_result_varying(instruction));
    case Op::If:
      return visit_if(id, instruction);
    case Op::Loop:
    case Op::Scope:
      return visit_labelled(id, instruction);
    case Op::Break:
      return visit_exit(id, depth_of(instruction.index));
    case Op::Return:
      return visit_return(id, instruction);
    case Op::Fault:
    case Op::Step:
      result_.may_kill[id] = true;
      return;
    default:
      return set(varying, any_varying(instruction.operands));
    }
  }

  bool is_result_varying(const Instruction& instruction) {
    const ValueId call = instruction.operands[0];
    if (function_.instructions[call].op != Op::Call) return result_.value_varying[call];
    return analyse_uniformity(module_, function_.instructions[call].index, result_.calls.at(call), table_)
        .results_varying[instruction.index];
  }

  void visit_call(ValueId id, const Instruction& instruction) {
    Signature asked;
    for (const ValueId operand : instruction.operands)
      asked.arguments_varying.push_back(result_.value_varying[operand]);
    for (const VariableId variable : instruction.variables) {
      asked.captures_varying.push_back(result_.variable_varying[variable]);
      asked.partial = asked.partial || is_partial_for(variable);
    }
    const Uniformity& callee = analyse_uniformity(module_, instruction.index, asked, table_);
    for (size_t i = 0; i < instruction.variables.size(); ++i)
      set(result_.variable_varying[instruction.variables[i]], callee.variable_varying[i]);
    set(result_.value_varying[id], !callee.results_varying.empty() && callee.results_varying[0]);
    result_.may_kill[id] = callee.function_may_kill;
    result_.calls.insert_or_assign(id, std::move(asked));
  }

  void visit_if(ValueId id, const Instruction& instruction) {
    set(result_.control_varying[id], result_.value_varying[instruction.operands[0]]);
    bool may_kill = false;
    for (const Block& block : instruction.blocks) {
      enclosing_.push_back({kNoLabel, id, &block, result_.control_varying[id]});
      may_kill = walk(block) || may_kill;
      enclosing_.pop_back();
    }
    result_.may_kill[id] = may_kill;
  }

  void visit_labelled(ValueId id, const Instruction& instruction) {
    enclosing_.push_back({instruction.index, id, &instruction.blocks[0], false});
    // Lanes that a later part of a loop's body sends away are away when the body runs again.
    if (instruction.op == Op::Loop)
      for (const LabelId label : exits_[id])
        enclosing_[depth_of(label)].waiting = true;
    result_.may_kill[id] = walk(instruction.blocks[0]);
    enclosing_.pop_back();
  }

  size_t depth_of(LabelId label) const {
    for (size_t depth = enclosing_.size(); depth-- > 1;)
      if (enclosing_[depth].label == label) return depth;
    return 0;
  }

  /// A break or return to the construct at depth `target`. (Lanes that wait at the target itself have left it already.)
  void visit_exit(ValueId id, size_t target) {
    for (size_t depth = target + 1; depth < enclosing_.size(); ++depth)
      set(result_.control_varying[id], enclosing_[depth].waiting);
    if (!result_.control_varying[id]) return;
    enclosing_[target].waiting = true;
    // All loops and scopes that lanes leave here while others stay.
    for (size_t depth = std::max<size_t>(target, 1); depth < enclosing_.size(); ++depth) {
      if (enclosing_[depth].label == kNoLabel) continue;
      std::vector<LabelId>& exits = exits_[enclosing_[depth].construct];
      if (std::ranges::find(exits, enclosing_[target].label) != exits.end()) continue;
      exits.push_back(enclosing_[target].label);
      result_.control_varying[enclosing_[depth].construct] = true;
      changed_ = true;
    }
  }

  void visit_return(ValueId id, const Instruction& instruction) {
    visit_exit(id, 0);
    for (size_t i = 0; i < instruction.operands.size(); ++i)
      set(result_.results_varying[i], result_.control_varying[id] || result_.value_varying[instruction.operands[i]]);
  }

  const Module& module_;
  const Function& function_;
  const Signature& signature_;
  UniformityTable& table_;
  std::vector<Home> homes_;
  Uniformity result_;
  std::vector<Enclosing> enclosing_;
  std::unordered_map<ValueId, std::vector<LabelId>> exits_; ///< by loop and scope: targets of varying exits inside
  bool changed_ = false;
};

} // namespace

const Uniformity& analyse_uniformity(const Module& module, FunctionId function, const Signature& signature,
                                     UniformityTable& table) {
  const std::pair<FunctionId, Signature> key{function, signature};
  if (const auto found = table.find(key); found != table.end()) return found->second;
  Uniformity answers = Analysis(module, module.functions[function], signature, table).run();
  return table.emplace(key, std::move(answers)).first->second;
}

Signature entry_signature(const Function& function, const std::vector<bool>& uniform_inputs) {
  Signature signature;
  signature.arguments_varying.resize(function.parameters.size(), true);
  for (size_t i = 0; i < function.parameters.size() && i < uniform_inputs.size(); ++i)
    if (uniform_inputs[i]) signature.arguments_varying[i] = false;
  return signature;
}

} // namespace moonshade::ir
