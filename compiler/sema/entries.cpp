// A name of the manual's table is always an entry point; another global function is one if nothing in the shader uses
// it and all its parameters are inputs, or if the host asks for it.
#include "compiler/sema/entries.h"

#include "compiler/sema/names.h"

#include <algorithm>

namespace moonshade::sema {

using Code = DiagnosticCode;

namespace {

struct TableEntry {
  std::string_view name;
  bool is_vector;
  bool is_number;
};

constexpr TableEntry kTable[] = {
    {"color", true, false},    {"height", false, true},       {"reflectance", true, true},  {"roughness", false, true},
    {"metallic", false, true}, {"transmission", false, true}, {"opacity", false, true},     {"ior", false, true},
    {"emission", true, false}, {"density", false, true},      {"environment", true, false},
};

const TableEntry* find_in_table(std::string_view name) {
  for (const TableEntry& entry : kTable)
    if (entry.name == name) return &entry;
  return nullptr;
}

std::string expected_result(const TableEntry& entry) {
  if (entry.is_vector && entry.is_number) return "a vec3 or a number";
  return entry.is_vector ? "a vec3" : "a number";
}

constexpr std::string_view kInputs[] = {"p",    "P",    "n",    "ng",    "backface", "i", "uv",
                                        "dpdu", "dpdv", "time", "frame", "id",       "fw"};

std::string input_list() {
  std::string text;
  for (const std::string_view name : kInputs)
    text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::vector<Type> input_types(Context& context, const syntax::Function& function, bool report) {
  std::vector<Type> types;
  for (const syntax::Local* param : function.params) {
    const auto type = input_type(param->name);
    types.push_back(type ? Type::of(*type) : unknown_type());
    if (type || !report) continue;
    const auto near = nearest(param->name, kInputs);
    suggest_fix(context.diagnostics.report(Code::UnknownInput, param->span,
                                           {std::string(param->name), input_list(), suggestion(near)}),
                near);
  }
  return types;
}

bool all_inputs(const syntax::Function& function) {
  return std::ranges::all_of(function.params,
                             [](const syntax::Local* param) { return input_type(param->name).has_value(); });
}

} // namespace

bool is_entry_of_table(std::string_view name) { return find_in_table(name) != nullptr; }

std::vector<EntryPlan> plan_entries(Context& context, const std::vector<std::string>& asked) {
  const auto is_asked = [&](std::string_view name) { return std::ranges::find(asked, name) != asked.end(); };
  std::vector<EntryPlan> plans;
  for (const Global* global : context.globals.functions) {
    if (global->is_broken) continue;
    const syntax::Function& function = *global->function;
    const bool is_in_table = find_in_table(global->name) != nullptr;
    if (!is_in_table && !is_asked(global->name) && (global->is_used || !all_inputs(function))) continue;
    const bool is_selected = asked.empty() || is_asked(global->name);
    plans.push_back({global, input_types(context, function, true), is_in_table, is_selected});
  }
  std::vector<std::string_view> names;
  names.reserve(context.globals.functions.size());
  for (const Global* global : context.globals.functions)
    names.push_back(global->name);
  for (const std::string& name : asked)
    if (std::ranges::find(names, name) == names.end())
      context.diagnostics.report(Code::UnknownEntry, Span{}, {name, suggestion(nearest(name, names))});
  return plans;
}

namespace {

void check_table_result(Context& context, const EntryPlan& plan) {
  const TableEntry& entry = *find_in_table(plan.global->name);
  const Work& work = *plan.work;
  const std::string name(entry.name);
  if (work.has_unequal_returns || (!work.has_results && work.has_open_return)) return; // already refused
  if (work.results.empty()) {
    context.error(Code::EntryResultCount, plan.global->function->end_span, {name, expected_result(entry)});
    return;
  }
  if (work.results.size() > 1) {
    context.error(Code::EntryResultCount, work.result_spans[1], {name, expected_result(entry)});
    return;
  }
  const Type& type = work.results[0];
  const bool fits =
      is_unknown(type) || (entry.is_number && is_scalar(type)) || (entry.is_vector && type.is(ValueType::Vec3));
  if (!fits) context.error(Code::EntryResult, work.result_spans[0], {name, expected_result(entry), describe(type)});
}

} // namespace

void finish_entry(Context& context, const EntryPlan& plan) {
  const Work& work = *plan.work;
  if (plan.is_in_table) {
    check_table_result(context, plan);
  } else {
    for (size_t i = 0; i < work.results.size(); ++i)
      if ((!work.results[i].is_value() || is_matrix(work.results[i])) && !is_unknown(work.results[i]))
        context.error(Code::EntryValues, work.result_spans[i], {describe(work.results[i])});
  }
  if (!plan.is_selected || work.spec == nullptr) return;
  EntryInfo info;
  info.name = plan.global->name;
  for (size_t i = 0; i < plan.inputs.size(); ++i)
    info.inputs.push_back({std::string(plan.global->function->params[i]->name), plan.inputs[i].value});
  for (const Type& type : work.results)
    info.results.push_back(plan.is_in_table && type.is(ValueType::Integer) ? ValueType::Number : type.value);
  context.program.info.entries.push_back(std::move(info));
  context.program.entries.push_back({std::string(plan.global->name), work.spec});
}

} // namespace moonshade::sema
