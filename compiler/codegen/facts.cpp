// Walks over functions of the IR that gather facts for emission (facts.h).
#include "compiler/codegen/facts.h"

#include "compiler/ir/narrow.h"

#include <algorithm>
#include <optional>

namespace moonshade::codegen {

namespace {

using ir::Op;

/// Above this many instructions in all its places of use, a function is not emitted in place.
constexpr uint64_t kInlineBudget = 1500;

class FactsWalk {
public:
  FactsWalk(const ir::Function& function, FunctionFacts& facts) : function_(function), facts_(facts) {}

  void walk(const ir::Block& block) {
    path_.push_back(&block);
    for (const ir::ValueId id : block.instructions)
      visit(id, function_.instructions[id]);
    path_.pop_back();
  }
  void finish() {
    for (size_t i = 0; i < homes_.size(); ++i) {
      if (homes_[i].empty()) continue;
      facts_.homes[i] = homes_[i].back();
      const auto& reads = reads_[i];
      if (!reads) continue;
      // The outermost loop within the home.
      const auto inside = [&](const OpenLoop& loop) { return loop.depth >= homes_[i].size(); };
      const auto loop = std::ranges::find_if(*reads, inside);
      if (loop != reads->end()) facts_.last_loops[i] = loop->label;
    }
  }

  struct OpenLoop {
    ir::LabelId label;
    size_t depth; ///< of its body in the path
    bool operator==(const OpenLoop&) const = default;
  };
  std::vector<std::vector<const ir::Block*>> homes_; ///< by variable: path to the home so far
  /// By variable: the loops around all its reads so far; nothing before the first.
  std::vector<std::optional<std::vector<OpenLoop>>> reads_;

private:
  bool varying(ir::ValueId id) const { return facts_.uniformity->control_varying[id]; }

  void visit(ir::ValueId id, const ir::Instruction& instruction) {
    switch (instruction.op) {
    case Op::Load:
    case Op::LoadElement:
      read(instruction.index, loops_);
      [[fallthrough]];
    case Op::Store:
    case Op::StoreElement:
      access(instruction.index);
      break;
    case Op::Call:
      for (const ir::VariableId variable : instruction.variables) {
        read(variable, {}); // the function called has labels of its own
        access(variable);
      }
      break;
    case Op::Loop:
    case Op::Scope:
      facts_.labels[instruction.index].varying = varying(id);
      targets_.push_back(instruction.index);
      if (instruction.op == Op::Loop) loops_.push_back({instruction.index, path_.size()});
      walk(instruction.blocks[0]);
      if (instruction.op == Op::Loop) loops_.pop_back();
      targets_.pop_back();
      break;
    case Op::If:
      for (const ir::Block& block : instruction.blocks)
        walk(block);
      break;
    case Op::Result:
      if (instruction.index < 32) facts_.further_results[instruction.operands[0]] |= 1U << instruction.index;
      break;
    case Op::Break:
      if (varying(id)) bypass(instruction.index);
      break;
    case Op::Return:
      facts_.function.varying = facts_.function.varying || varying(id);
      if (varying(id)) bypass(ir::kNone);
      break;
    default:
      break;
    }
  }

  void bypass(ir::LabelId target) {
    for (size_t i = targets_.size(); i > 0 && targets_[i - 1] != target; --i)
      facts_.labels[targets_[i - 1]].bypassed = true;
  }

  void read(ir::VariableId variable, const std::vector<OpenLoop>& loops) {
    auto& common = reads_[variable];
    if (!common) common = loops;
    const auto end = std::ranges::mismatch(*common, loops).in1;
    common->erase(end, common->end());
  }

  void access(ir::VariableId variable) {
    auto& home = homes_[variable];
    if (home.empty()) {
      home = path_;
      return;
    }
    size_t common = 0;
    while (common < home.size() && common < path_.size() && home[common] == path_[common])
      ++common;
    home.resize(common);
  }

  const ir::Function& function_;
  FunctionFacts& facts_;
  std::vector<const ir::Block*> path_;
  std::vector<ir::LabelId> targets_;
  std::vector<OpenLoop> loops_;
};

/// Visits every function after those it calls.
class CalleesFirst {
public:
  explicit CalleesFirst(const ir::Module& module) : module_(module), seen_(module.functions.size()) {
    for (ir::FunctionId id = 0; id < module.functions.size(); ++id)
      visit(id);
  }
  std::vector<ir::FunctionId> order;

private:
  void visit(ir::FunctionId id) {
    if (seen_[id]) return;
    seen_[id] = true;
    const ir::Function& function = module_.functions[id];
    each_instruction(function, function.body, [&](const ir::Instruction& instruction) {
      if (instruction.op == Op::Call) visit(instruction.index);
    });
    order.push_back(id);
  }
  const ir::Module& module_;
  std::vector<bool> seen_;
};

} // namespace

FunctionFacts function_facts(const ir::Function& function, const ir::Uniformity& uniformity, uint64_t step_limit) {
  FunctionFacts facts;
  facts.uniformity = &uniformity;
  facts.labels.resize(function.next_label);
  facts.homes.resize(function.variables.size());
  FactsWalk walk(function, facts);
  walk.homes_.resize(function.variables.size());
  walk.reads_.resize(function.variables.size());
  facts.last_loops.assign(function.variables.size(), ir::kNone);
  walk.walk(function.body);
  walk.finish();
  std::fill_n(facts.homes.begin(), function.captures, nullptr);
  facts.narrow = ir::narrow_variables(function, step_limit);
  return facts;
}

SizePlan plan_sizes(const ir::Module& module) {
  const size_t count = module.functions.size();
  SizePlan plan{std::vector<uint64_t>(count), std::vector<bool>(count)};
  std::vector<uint64_t> uses(count);
  for (const ir::Function& function : module.functions)
    each_instruction(function, function.body, [&](const ir::Instruction& instruction) {
      if (instruction.op == Op::Call) ++uses[instruction.index];
    });
  for (const ir::FunctionId id : CalleesFirst(module).order) {
    const ir::Function& function = module.functions[id];
    each_instruction(function, function.body, [&](const ir::Instruction& instruction) {
      const bool in_place = instruction.op == Op::Call && !plan.outlined[instruction.index];
      plan.size[id] += in_place ? plan.size[instruction.index] : 1;
    });
    plan.outlined[id] = uses[id] > 1 && plan.size[id] > 8 && plan.size[id] * uses[id] > kInlineBudget;
  }
  return plan;
}

std::vector<FaultFacts> fault_facts(const ir::Module& module) {
  std::vector<FaultFacts> facts(module.functions.size());
  for (const ir::FunctionId id : CalleesFirst(module).order) {
    const ir::Function& function = module.functions[id];
    each_instruction(function, function.body, [&](const ir::Instruction& instruction) {
      if (instruction.op == Op::Fault) facts[id].faults = true;
      if (instruction.op == Op::Step) facts[id].steps = true;
      if (instruction.op != Op::Call) return;
      facts[id].faults |= facts[instruction.index].faults;
      facts[id].steps |= facts[instruction.index].steps;
    });
  }
  return facts;
}

} // namespace moonshade::codegen
