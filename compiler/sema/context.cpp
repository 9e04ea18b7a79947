// The engine of inference: rounds over the reachable specialisations, memoised by function, place and argument types.
#include "compiler/sema/context.h"

#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

size_t WorkKeyHash::operator()(const WorkKey& key) const {
  size_t hash = std::hash<const void*>()(key.function) * 1000003 + std::hash<const void*>()(key.parent);
  for (const Type& type : key.arguments)
    hash = hash * 1000003 + hash_of(type);
  return hash;
}

Context::Context(const syntax::Chunk& c, Diagnostics& d, Program& p)
    : chunk(c), diagnostics(d), program(p), walked(c.functions.size()) {}

Work* Context::find_or_make(const syntax::Function* function, Work* parent, std::vector<Type> arguments, Span place) {
  WorkKey key{function, parent, std::move(arguments)};
  if (const auto found = works.find(key); found != works.end()) return found->second.get();
  if (works.size() >= kMaxSpecialisations) {
    too_large(place, "the functions of this shader are called with too many lists of argument types",
              kMaxSpecialisations);
    return nullptr;
  }
  auto work = std::make_unique<Work>();
  work->function = function;
  work->parent = parent;
  work->arguments = key.arguments;
  in_order.push_back(work.get());
  return works.emplace(std::move(key), std::move(work)).first->second.get();
}

namespace {

std::string specialisation_name(Context& context, const Work& work) {
  std::string name(work.function->name);
  if (work.function == context.chunk.main) name = "top level";
  if (name.empty()) name = "function";
  const unsigned count = ++context.name_counts[name];
  return count == 1 ? name : name + "#" + std::to_string(count);
}

/// Opens the record of facts before the reporting walk.
void open_specialisation(Context& context, Work& work) {
  work.owned = std::make_unique<Specialisation>();
  work.spec = work.owned.get();
  work.spec->function = work.function;
  work.spec->name = specialisation_name(context, work);
  work.spec->parameters = work.arguments;
  if (context.collect) {
    work.spec->id = static_cast<uint32_t>(context.program.specialisations.size());
    context.program.specialisations.push_back(std::move(work.owned));
  }
  Work*& walked = context.walked[work.function->index];
  if (walked == nullptr) walked = &work;
}

/// Captures of this specialisation: outer locals that it uses itself (in spec->locals) or that its callees capture.
void close_specialisation(Context& context, Work& work) {
  Specialisation& spec = *work.spec;
  if (work.has_results) spec.results = work.results;
  const auto capture = [&](const syntax::Local* local) {
    if (std::ranges::find(work.captures, local) == work.captures.end()) work.captures.push_back(local);
  };
  for (const auto& [local, fact] : spec.locals)
    if (local->function != work.function && local->function != context.chunk.main && fact.type.is_value())
      capture(local);
  for (const auto& [id, link] : work.callees) {
    const Work* callee = link.work;
    work.derivative_order = std::max(work.derivative_order, callee->derivative_order);
    for (const syntax::Local* local : callee->outer_writes)
      if (local->function != work.function) work.outer_writes.insert(local);
    for (const syntax::Local* local : callee->captures) {
      if (local->function == work.function) {
        spec.locals[local].captured_by_call = true;
        continue;
      }
      capture(local);
      spec.locals.insert({local, callee->spec->locals.at(local)}).first->second.captured_by_call = true;
    }
  }
  std::ranges::sort(work.captures, {}, [](const syntax::Local* local) { return local->id; });
  spec.captures = work.captures;
  for (const auto& [local, variable] : work.variables)
    spec.locals[local].type = variable.type;
}

/// Conflicts that the reporting walk did not meet again.
void report_conflicts(Context& context, const Work& work) {
  std::vector<std::pair<const syntax::Local*, const Variable*>> conflicts;
  for (const auto& [local, variable] : work.variables)
    if (!is_unknown(variable.conflict_type)) conflicts.push_back({local, &variable});
  std::ranges::sort(conflicts, {}, [](const auto& conflict) { return conflict.first->id; });
  for (const auto& [local, variable] : conflicts)
    refuse_conflict(context, work, *variable, local->name, variable->conflict_type, variable->conflict);
  if (!is_unknown(work.conflict_type))
    refuse_result(context, work, work.conflict_index, work.conflict_type, work.conflict);
  if (work.function != context.chunk.main) return;
  std::vector<const Global*> globals;
  for (const auto& [name, global] : context.globals.by_name)
    if (!is_unknown(global.variable.conflict_type)) globals.push_back(&global);
  std::ranges::sort(globals, {}, &Global::name);
  for (const Global* global : globals)
    refuse_conflict(context, work, global->variable, global->name, global->variable.conflict_type,
                    global->variable.conflict);
}

void walk_roots(Context& context, const std::vector<Work*>& roots) {
  for (Work* root : roots) {
    if (root->round != context.round) root->caller = nullptr;
    context.analyse(*root);
  }
}

} // namespace

void Context::analyse(Work& work) {
  if (work.round == round || work.is_done || exhausted) return;
  work.round = round;
  if (++call_depth > kMaxCallDepth) {
    too_large(work.function->span, "calls inside each other are too many", kMaxCallDepth);
  } else {
    if (report) open_specialisation(*this, work);
    Walker(*this, work).function_body();
    if (report && !exhausted) {
      close_specialisation(*this, work);
      report_conflicts(*this, work);
      check_order(*this, work);
      check_assigned(*this, work);
      work.is_done = true;
    }
  }
  --call_depth;
}

void Context::infer(const std::vector<Work*>& roots) {
  report = false;
  do {
    changed = false;
    ++round;
    walk_roots(*this, roots);
  } while (changed && !exhausted);
}

void Context::report_walk(const std::vector<Work*>& roots) {
  report = true;
  ++round;
  walk_roots(*this, roots);
}

void Context::continue_report_walk(const std::vector<Work*>& roots) { walk_roots(*this, roots); }

Diagnostic& Context::error(DiagnosticCode code, Span span, std::initializer_list<std::string> args) {
  if (!report || !reported.insert({span.begin, span.end}).second) return silent = Diagnostic{};
  return diagnostics.report(code, span, args);
}

void Context::too_large(Span span, std::string what, size_t limit) {
  if (exhausted) return;
  exhausted = true;
  diagnostics.report(DiagnosticCode::TooLarge, span, {std::move(what), std::to_string(limit)});
}

void refuse_conflict(Context& context, const Work& work, const Variable& variable, std::string_view name,
                     const Type& type, Span place) {
  const Type& first = variable.first_type;
  if (is_function(first) || is_function(type)) {
    context.error(DiagnosticCode::FunctionNotKnown, place, {std::string(name)});
  } else if (first.kind == Type::Kind::String && type.kind == Type::Kind::String) {
    context.error(DiagnosticCode::SeveralStrings, place, {std::string(name)})
        .note(DiagnosticCode::NoteFirstGiven, variable.first, {describe(first)});
  } else {
    context.type_error(work, DiagnosticCode::TypeConflict, place, {std::string(name), describe(first), describe(type)})
        .note(DiagnosticCode::NoteFirstGiven, variable.first, {describe(first)});
  }
}

void refuse_result(Context& context, const Work& work, size_t index, const Type& type, Span place) {
  context.type_error(work, DiagnosticCode::ResultType, place, {describe(type), describe(work.first_results[index])})
      .note(DiagnosticCode::NoteOtherReturn, work.first_return);
}

std::string signature(const Work& work) {
  std::string text(work.function->name.empty() ? "function" : work.function->name);
  text += "(";
  for (size_t i = 0; i < work.arguments.size(); ++i)
    text += (i ? ", " : "") + type_name(work.arguments[i]);
  return text + ")";
}

Diagnostic& Context::type_error(const Work& work, DiagnosticCode code, Span span,
                                std::initializer_list<std::string> args) {
  Diagnostic& diagnostic = error(code, span, args);
  if (&diagnostic == &silent || specialise_unknown) return diagnostic;
  constexpr int kMostNotes = 8;
  int notes = 0;
  for (const Work* at = &work; at->caller != nullptr && notes < kMostNotes; at = at->caller, ++notes)
    diagnostic.note(DiagnosticCode::NoteInSpecialisation, at->call_span, {signature(*at)});
  return diagnostic;
}

} // namespace moonshade::sema
