// The order of a check: globals, entry points, inference, the reporting walk over all that the program consists of,
// then the bodies that nothing calls, which are walked with unknown arguments so that their errors are reported too.
#include "compiler/sema/annotations.h"
#include "compiler/sema/context.h"
#include "compiler/sema/entries.h"
#include "compiler/sema/modules.h"
#include "compiler/sema/warnings.h"

namespace moonshade::sema {

namespace {

/// Functions that nothing called, one level of nesting after the other (a function is walked inside a specialisation of
/// the one around it).
void check_uncalled(Context& context) {
  context.specialise_unknown = true;
  while (!context.exhausted) {
    std::vector<Work*> roots;
    for (const syntax::Chunk* chunk : context.chunks())
      for (const syntax::Function* function : chunk->functions) {
        if (context.walked.contains(function) || function->parent == nullptr) continue;
        const auto parent = context.walked.find(function->parent);
        if (parent == context.walked.end()) continue;
        Work* work = context.find_or_make(
            {function, parent->second, false, nullptr, 0, std::vector<Type>(function->params.size())}, function->span);
        if (work == nullptr) return;
        roots.push_back(work);
      }
    if (roots.empty()) return;
    context.infer(roots);
    context.report_walk(roots);
  }
}

/// What has no type though no error was reported is a variable read only where nothing leads, or a defect of ours.
void check_typed(Context& context) {
  if (context.untyped == nullptr || context.diagnostics.has_errors()) return;
  if (const auto* name = syntax::try_as<syntax::NameExpr>(context.untyped)) {
    context.error(DiagnosticCode::UnassignedVariable, name->span, {std::string(name->name)});
  } else {
    context.error(DiagnosticCode::InternalError, context.untyped->span, {"an expression without a type"});
  }
}

} // namespace

Program check(const syntax::Chunk& chunk, const Options& options, Diagnostics& diagnostics) {
  Program program;
  program.chunk = &chunk;
  Context context(chunk, options, diagnostics, program);
  Work* top = context.find_or_make({chunk.main, nullptr, true, nullptr, 0, {}}, chunk.main->span);
  context.top = top;
  collect_modules(context, options);
  if (diagnostics.has_errors() && !context.modules.empty()) return program; // the syntax of a module, perhaps
  std::vector<EntryPlan> plans = plan_entries(context, options.entries);

  std::vector<Work*> chosen = {top}, others;
  for (EntryPlan& plan : plans) {
    plan.work = context.find_or_make(
        {plan.global->function, context.top_level_of(*plan.global->function), false, nullptr, 0, plan.inputs},
        plan.global->definition);
    if (plan.work == nullptr) return program;
    (plan.is_selected ? chosen : others).push_back(plan.work);
  }
  std::vector<Work*> all = chosen;
  all.insert(all.end(), others.begin(), others.end());
  context.infer(all);
  context.collect = true;
  context.report_walk(chosen);
  context.collect = false;
  context.continue_report_walk(others);
  if (context.exhausted) return program;
  for (const EntryPlan& plan : plans) {
    finish_entry(context, plan);
    check_assigned_for_entry(context, *top, *plan.global, *plan.work);
  }
  check_modules(context);
  check_uncalled(context);
  check_typed(context);
  if (!diagnostics.has_errors()) check_annotations(context);
  for (const Context::Module& module : context.modules) {
    program.info.modules.push_back(module.name);
    program.modules_before[module.before].push_back(module.work->spec);
  }
  for (const syntax::Chunk* each : context.chunks())
    if (!diagnostics.has_errors()) check_warnings(*each, program, diagnostics);
  return program;
}

} // namespace moonshade::sema
