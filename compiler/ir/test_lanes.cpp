// For tests: lanes. See test_lanes.h. Operations on single values are those of the interpreter, which a module of one
// instruction would be too slow for: they come from `evaluate`.
#include "compiler/ir/test_lanes.h"

#include "compiler/ir/walk.h"

#include <map>

namespace moonshade::ir::test {
namespace {

using Mask = uint64_t;

/// A slot or value: one element where uniform, one a lane where varying.
using Lanes = std::vector<Value>;

const Value& of_lane(const Lanes& lanes, size_t lane) { return lanes.size() == 1 ? lanes[0] : lanes[lane]; }

struct Machine {
  const Module& module;
  const std::vector<std::vector<Value>>& globals;
  UniformityTable& table;
  LanesOutcome& outcome;
  Mask dead = 0;
};

class LanesActivation {
public:
  LanesActivation(Machine& machine, FunctionId function, const Signature& signature, Mask active,
                  const std::vector<Lanes>& arguments, const std::vector<Lanes*>& captures)
      : machine_(machine), function_(machine.module.functions[function]),
        facts_(analyse_uniformity(machine.module, function, signature, machine.table)), active_(active),
        arguments_(arguments), values_(function_.instructions.size()), own_(function_.variables.size()) {
    for (VariableId i = 0; i < function_.variables.size(); ++i) {
      own_[i].resize(facts_.variable_varying[i] ? lane_count() : 1);
      variables_.push_back(i < function_.captures ? captures[i] : &own_[i]);
      promise(variables_[i]->size() == own_[i].size(), "a capture is a vector on one side only");
    }
    for (const bool varying : facts_.results_varying)
      results_.emplace_back(varying ? lane_count() : 1);
    frames_.push_back({kNone, active, 0, 0});
  }

  void run() { block(function_.body); }
  const std::vector<Lanes>& results() const { return results_; }

private:
  struct Frame {
    LabelId label;
    Mask entered;
    Mask left;   ///< wait behind it
    Mask beyond; ///< left it for further out
  };

  size_t lane_count() const { return machine_.outcome.lanes.size(); }
  void promise(bool kept, const std::string& what) {
    if (!kept) machine_.outcome.broken_promises.push_back(function_.name + ": " + what);
  }
  template <class Visit> void for_lanes(Mask mask, Visit&& visit) {
    for (size_t lane = 0; lane < lane_count(); ++lane)
      if (mask >> lane & 1) visit(lane);
  }

  void block(const Block& block) {
    for (const ValueId id : block.instructions) {
      if (active_ == 0) return;
      execute(id);
    }
  }

  Mask true_lanes(const Lanes& lanes) {
    Mask mask = 0;
    for_lanes(active_, [&](size_t lane) { mask |= Mask{of_lane(lanes, lane).boolean} << lane; });
    return mask;
  }

  void kill(Mask lanes, FaultCode code, const std::string& message) {
    for_lanes(lanes, [&](size_t lane) {
      machine_.outcome.lanes[lane].fault = code;
      machine_.outcome.lanes[lane].message = message;
    });
    machine_.dead |= lanes;
    active_ &= ~lanes;
  }

  void execute(ValueId id) {
    const Instruction& instruction = function_.instructions[id];
    switch (instruction.op) {
    case Op::Store:
      return store(*variables_[instruction.index], values_[instruction.operands[0]]);
    case Op::Load:
      values_[id] = *variables_[instruction.index];
      return promise(values_[id].size() == 1 || facts_.value_varying[id], "a load of a vector is uniform");
    case Op::Argument:
      values_[id] = arguments_[instruction.index];
      return promise(values_[id].size() == 1 || facts_.value_varying[id], "an argument");
    case Op::Call:
      return call(id, instruction);
    case Op::If:
      return branch(id, instruction);
    case Op::Loop:
    case Op::Scope:
      return construct(id, instruction);
    case Op::Break: {
      size_t target = frames_.size() - 1;
      while (frames_[target].label != instruction.index)
        --target;
      return leave(id, target);
    }
    case Op::Return:
      for (size_t i = 0; i < instruction.operands.size(); ++i)
        store(results_[i], values_[instruction.operands[i]]);
      return leave(id, 0);
    case Op::Fault:
      return kill(true_lanes(values_[instruction.operands[0]]), instruction.fault, instruction.text);
    case Op::Step: {
      Mask over = 0;
      for_lanes(active_, [&](size_t lane) {
        if (++machine_.outcome.lanes[lane].steps > machine_.module.step_limit) over |= Mask{1} << lane;
      });
      return kill(over, FaultCode::StepLimit, "");
    }
    case Op::Print:
      return;
    default:
      return compute(id, instruction);
    }
  }

  /// A uniform slot takes a scalar, whatever the mask; a varying one the active lanes.
  void store(Lanes& slot, const Lanes& value) {
    if (slot.size() == 1) {
      promise(value.size() == 1, "a varying value goes to a uniform slot");
      slot[0] = value[0];
    } else {
      for_lanes(active_, [&](size_t lane) { slot[lane] = of_lane(value, lane); });
    }
  }

  void compute(ValueId id, const Instruction& instruction) {
    const bool varying = facts_.value_varying[id];
    values_[id].resize(varying ? lane_count() : 1);
    const auto at = [&](size_t lane) {
      std::vector<Value> operands;
      operands.reserve(instruction.operands.size());
      for (const ValueId operand : instruction.operands) {
        promise(varying || values_[operand].size() == 1 || instruction.op == Op::Result,
                "a uniform value has a varying operand");
        operands.push_back(of_lane(values_[operand], lane));
      }
      if (instruction.op == Op::LoadGlobal) return machine_.globals[instruction.index][0];
      if (instruction.op == Op::Result) return of_lane(more_[instruction.operands[0]][instruction.index], lane);
      if (instruction.op != Op::CallLibrary) return evaluate(instruction, operands);
      const std::vector<Value> all = call_native(*instruction.library, instruction.type, operands);
      std::vector<Lanes>& more = more_[id];
      more.resize(all.size(), Lanes(varying ? lane_count() : 1));
      for (size_t i = 0; i < all.size(); ++i)
        more[i][varying ? lane : 0] = all[i];
      return all[0];
    };
    if (varying)
      for_lanes(active_, [&](size_t lane) { values_[id][lane] = at(lane); });
    else
      values_[id][0] = at(0);
  }

  void call(ValueId id, const Instruction& instruction) {
    std::vector<Lanes> arguments;
    arguments.reserve(instruction.operands.size());
    for (const ValueId operand : instruction.operands)
      arguments.push_back(values_[operand]);
    std::vector<Lanes*> captures;
    captures.reserve(instruction.variables.size());
    for (const VariableId variable : instruction.variables)
      captures.push_back(variables_[variable]);
    LanesActivation callee(machine_, instruction.index, facts_.calls.at(id), active_, arguments, captures);
    callee.run();
    active_ &= ~machine_.dead;
    more_[id] = callee.results();
    if (callee.results().empty()) return;
    values_[id] = callee.results()[0];
    promise((values_[id].size() == 1) == !facts_.value_varying[id], "a call's result");
  }

  void branch(ValueId id, const Instruction& instruction) {
    const Lanes& condition = values_[instruction.operands[0]];
    if (!facts_.control_varying[id]) {
      promise(condition.size() == 1, "a uniform if on a varying condition");
      return block(instruction.blocks[condition[0].boolean ? 0 : 1]);
    }
    const Mask before = active_, taken = true_lanes(condition);
    active_ = taken;
    block(instruction.blocks[0]);
    const Mask behind = active_;
    active_ = before & ~taken;
    block(instruction.blocks[1]);
    active_ |= behind;
  }

  void construct(ValueId id, const Instruction& instruction) {
    frames_.push_back({instruction.index, active_, 0, 0});
    do
      block(instruction.blocks[0]);
    while (instruction.op == Op::Loop && active_ != 0);
    const Frame frame = frames_.back();
    frames_.pop_back();
    const Mask left = (instruction.op == Op::Loop ? 0 : active_) | frame.left;
    active_ = left & ~machine_.dead;
    const Mask all = frame.entered & ~machine_.dead;
    if (!facts_.control_varying[id])
      promise(active_ == all || (frame.beyond & all) == all, "lanes leave a construct that is not varying apart");
  }

  void leave(ValueId id, size_t target) {
    const Frame& frame = frames_[target];
    if (!facts_.control_varying[id])
      promise(active_ == (frame.entered & ~frame.left & ~frame.beyond & ~machine_.dead),
              "a break or return that is not varying leaves lanes behind");
    frames_[target].left |= active_;
    for (size_t inner = target + 1; inner < frames_.size(); ++inner)
      frames_[inner].beyond |= active_;
    active_ = 0;
  }

  Machine& machine_;
  const Function& function_;
  const Uniformity& facts_;
  Mask active_;
  const std::vector<Lanes>& arguments_;
  std::vector<Lanes> values_;
  std::map<ValueId, std::vector<Lanes>> more_; ///< all results of calls
  std::vector<Lanes> own_;
  std::vector<Lanes*> variables_;
  std::vector<Lanes> results_;
  std::vector<Frame> frames_;
};

} // namespace

LanesOutcome run_lanes(const Module& module, const std::vector<Value>& parameters, FunctionId entry,
                       const std::vector<std::vector<Value>>& points, const std::vector<bool>& uniform_inputs) {
  LanesOutcome outcome;
  outcome.lanes.resize(points.size());
  const Interpreter instance(module, parameters);
  UniformityTable table;
  Machine machine{module, instance.globals(), table, outcome};
  const Function& function = module.functions[entry];
  std::vector<Lanes> arguments(function.parameters.size());
  for (size_t i = 0; i < arguments.size(); ++i)
    for (size_t lane = 0; lane < points.size(); ++lane)
      if (lane == 0 || !uniform_inputs[i]) arguments[i].push_back(points[lane][i]);
  LanesActivation activation(machine, entry, entry_signature(function, uniform_inputs), (Mask{1} << points.size()) - 1,
                             arguments, {});
  activation.run();
  for (size_t lane = 0; lane < points.size(); ++lane)
    for (const Lanes& result : activation.results())
      outcome.lanes[lane].results.push_back(of_lane(result, lane));
  return outcome;
}

} // namespace moonshade::ir::test
