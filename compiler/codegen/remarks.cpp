// From the uniformity of every function for every signature with which it is called (remarks.h).
#include "compiler/codegen/remarks.h"

#include "compiler/codegen/facts.h"
#include "compiler/codegen/width.h"
#include "compiler/ir/walk.h"

#include <algorithm>
#include <set>

namespace moonshade::codegen {

namespace {

using Code = DiagnosticCode;

class Remarks {
public:
  Remarks(const ir::Module& module, Diagnostics& diagnostics)
      : module_(module), sizes_(plan_sizes(module)), diagnostics_(diagnostics) {}

  void of_entry(const ir::Entry& entry, const Options& options) {
    const ir::Function& function = module_.functions[entry.function];
    std::vector<bool> uniform;
    for (const std::string& name : function.parameter_names)
      uniform.push_back(std::ranges::find(options.uniform_inputs, name) != options.uniform_inputs.end());
    ir::analyse_uniformity(module_, entry.function, ir::entry_signature(function, uniform), table_);
  }

  void report() {
    for (const auto& [key, uniformity] : table_)
      of_function(module_.functions[key.first], uniformity);
  }

private:
  void of_function(const ir::Function& function, const ir::Uniformity& uniformity) {
    std::set<std::pair<uint32_t, uint32_t>> loops; // whose own tests are branches at the same place
    ir::for_each_instruction(function, [&](ir::ValueId id) {
      const ir::Instruction& instruction = function.instructions[id];
      if (instruction.op == ir::Op::Loop) loops.insert({instruction.span.begin, instruction.span.end});
    });
    ir::for_each_instruction(function, [&](ir::ValueId id) {
      const ir::Instruction& instruction = function.instructions[id];
      if (!instruction.span.has_place()) return;
      switch (instruction.op) {
      case ir::Op::If:
        if (uniformity.control_varying[id] && !loops.contains({instruction.span.begin, instruction.span.end}))
          diagnostics_.report(Code::VaryingBranch, instruction.span);
        break;
      case ir::Op::Loop:
        if (uniformity.control_varying[id]) diagnostics_.report(Code::VaryingLoop, instruction.span);
        break;
      case ir::Op::LoadElement:
        if (uniformity.varying(instruction.operands[0])) diagnostics_.report(Code::Gather, instruction.span);
        break;
      case ir::Op::StoreElement:
        if (uniformity.varying(instruction.operands[0])) diagnostics_.report(Code::Scatter, instruction.span);
        break;
      case ir::Op::Call:
        if (sizes_.outlined[instruction.index])
          diagnostics_.report(Code::CalledNotInlined, instruction.span, {module_.functions[instruction.index].name});
        break;
      case ir::Op::Step:
        if (instruction.span != function.span) // which is the step of the call
          diagnostics_.report(Code::CountsSteps, instruction.span);
        break;
      default:
        break;
      }
    });
  }

  const ir::Module& module_;
  const SizePlan sizes_;
  Diagnostics& diagnostics_;
  ir::UniformityTable table_;
};

} // namespace

std::string report_remarks(const ir::Module& module, const Options& options, Diagnostics& diagnostics) {
  const Target target = make_target({options.cpu, options.triple, options.optimization});
  if (!target.error.empty()) return target.error;
  const auto [width, why] = choose_width(module, target, options);
  diagnostics.report(Code::Width, Span{},
                     {std::to_string(width), std::string(name_of(options.precision)), target.cpu,
                      std::to_string(target.vector_bits), why});
  if (width == 1) return "";
  Remarks remarks(module, diagnostics);
  for (const ir::Entry& entry : module.entries)
    remarks.of_entry(entry, options);
  remarks.report();
  return "";
}

} // namespace moonshade::codegen
