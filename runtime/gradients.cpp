// Entries for gradients (gradients.h).
#include "runtime/gradients.h"

#include "compiler/ir/derivative.h"
#include "compiler/ir/passes.h"

#include <algorithm>

namespace moonshade {

namespace {

bool is_differentiable(ValueType type) { return type != ValueType::Boolean && type != ValueType::Integer; }

/// Those of the gradient's inputs that the entry declares, as indices.
std::vector<uint32_t> declared(const EntryInfo& entry, const Gradient& gradient) {
  std::vector<uint32_t> indices;
  for (const std::string& name : gradient.inputs) {
    const auto found = std::ranges::find(entry.inputs, name, &InputInfo::name);
    if (found != entry.inputs.end() && is_differentiable(found->type))
      indices.push_back(static_cast<uint32_t>(found - entry.inputs.begin()));
  }
  return indices;
}

bool is_small_enough(const EntryInfo& entry, const std::vector<uint32_t>& inputs) {
  unsigned components = 0;
  for (const uint32_t index : inputs)
    components += component_count(entry.inputs[index].type);
  return components <= ir::kMaxDirections;
}

} // namespace

std::string gradient_name(const Gradient& gradient) {
  std::string name = gradient.entry + "'";
  for (size_t i = 0; i < gradient.inputs.size(); ++i)
    name += (i == 0 ? "" : ",") + gradient.inputs[i];
  return name;
}

void add_gradients(ir::Module& module, const ShaderInfo& info, const CompileOptions& options) {
  // Values in place of variables: the fewer variables, the fewer derivatives to keep.
  if (!options.gradients.empty()) ir::simplify(module);
  for (const Gradient& gradient : options.gradients) {
    const EntryInfo* entry = info.find_entry(gradient.entry);
    const auto found = std::ranges::find(module.entries, gradient.entry, &ir::Entry::name);
    if (entry == nullptr || found == module.entries.end()) continue;
    const std::vector<uint32_t> inputs = declared(*entry, gradient);
    if (!is_small_enough(*entry, inputs)) continue;
    if (ir::derivative_order(module, found->function) >= ir::kMaxOrder) continue;
    const ir::FunctionId function = inputs.empty() ? found->function : add_gradient(module, found->function, inputs);
    module.entries.push_back({gradient_name(gradient), function});
  }
}

EntryInfo entry_info(const std::string& name, const ShaderInfo& info, const CompileOptions& options) {
  if (const EntryInfo* entry = info.find_entry(name)) return *entry;
  const auto gradient = std::ranges::find(options.gradients, name, gradient_name);
  EntryInfo entry = *info.find_entry(gradient->entry);
  entry.name = name;
  const std::vector<ValueType> values = entry.results;
  for (const ValueType type : values)
    for (unsigned c = 0; is_differentiable(type) && c < component_count(type); ++c)
      for (const uint32_t index : declared(entry, *gradient))
        entry.results.push_back(entry.inputs[index].type);
  return entry;
}

} // namespace moonshade
