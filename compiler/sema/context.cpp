// The engine of inference: rounds over the reachable specialisations, memoised by function, place and argument types.
#include "compiler/sema/context.h"

#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

size_t WorkKeyHash::operator()(const WorkKey& key) const {
  size_t hash = std::hash<const void*>()(key.function) * 1000003 + std::hash<const void*>()(key.parent);
  hash = hash * 1000003 + std::hash<const void*>()(key.site) + key.call * 2 + (key.is_init ? 1 : 0);
  hash = hash * 1000003 + key.moment;
  for (const Type& type : key.arguments)
    hash = hash * 1000003 + hash_of(type);
  return hash;
}

Context::Context(const syntax::Chunk& c, const Options& options, Diagnostics& d, Program& p)
    : chunk(c), diagnostics(d), program(p), load_library(options.load_library) {}

std::vector<const syntax::Chunk*> Context::chunks() const {
  std::vector<const syntax::Chunk*> all = {&chunk};
  for (const Module& module : modules)
    all.push_back(module.chunk);
  return all;
}

const Context::Module* Context::find_module(std::string_view name) const {
  const auto found = std::ranges::find(modules, name, &Module::name);
  return found == modules.end() ? nullptr : &*found;
}

Work* Context::top_level_of(const syntax::Function& function) const {
  const syntax::Function* at = &function;
  while (at->parent != nullptr)
    at = at->parent;
  for (const Module& module : modules)
    if (module.chunk->main == at) return module.work;
  return library_chunk && library_chunk->chunk->main == at ? library_chunk->work : top;
}

const syntax::Function* Context::library_function(std::string_view name) {
  if (!library_chunk) {
    const syntax::Chunk* loaded = load_library ? load_library() : nullptr;
    if (loaded == nullptr) return nullptr;
    library_chunk.emplace().chunk = loaded;
    std::vector<RequireCall> requires_calls;
    collect_globals(*loaded, library_chunk->globals, requires_calls);
    library_chunk->work = find_or_make({loaded->main, nullptr, true, nullptr, 0, {}}, loaded->main->span);
  }
  const Global* global = library_chunk->globals.find(name);
  return global != nullptr ? global->function : nullptr;
}

Global* Context::find_global(const Work& work, const syntax::NameExpr& name, bool* is_open) {
  if (is_library_code(work)) return library_chunk->globals.find(name.name);
  Global* global = globals.find(name.name);
  if (global == nullptr) return nullptr;
  const HiddenNames::Meaning meaning = hidden_names.meaning(*global, moment_of(work, name.span));
  if (is_open != nullptr) *is_open = meaning == HiddenNames::Meaning::Open;
  return meaning == HiddenNames::Meaning::Library ? nullptr : global;
}

Work* Context::find_or_make(WorkKey key, Span place) {
  if (const auto found = works.find(key); found != works.end()) return found->second.get();
  if (works.size() >= kMaxSpecialisations) {
    too_large(place, "the functions of this shader are called with too many lists of argument types",
              kMaxSpecialisations);
    return nullptr;
  }
  auto work = std::make_unique<Work>();
  work->function = key.function;
  work->parent = key.parent;
  work->arguments = key.arguments;
  work->is_init = key.is_init;
  work->moment = key.moment;
  work->site = key.site;
  in_order.push_back(work.get());
  return works.emplace(std::move(key), std::move(work)).first->second.get();
}

// ---- storage -------------------------------------------------------------------------------------------------------

Work* Context::home_of(const Variable& variable) const {
  if (variable.table != nullptr) return variable.table->outermost()->owner;
  Work* owner = variable.owner;
  return variable.is_captured && owner->frame_home != nullptr ? owner->frame_home : owner;
}

namespace {

const std::vector<Constant>* data_of(const Variable& leaf) {
  for (const Table::Field* field : leaf.table->fields)
    if (&field->variable == &leaf) return &field->data;
  return nullptr;
}

} // namespace

Place Context::place_for(Work& work, Variable& variable, std::string_view name) {
  const Type& type = variable.type;
  const ValueType value = type.is_value() ? type.value : ValueType::Integer; // of tables: which element
  if (variable.slot == nullptr) {
    program.slots.push_back(std::make_unique<Slot>());
    variable.slot = program.slots.back().get();
    variable.slot->id = static_cast<uint32_t>(program.slots.size());
    variable.slot->name = name;
  }
  variable.slot->type = value;
  variable.slot->count = 1;
  if (const Table* table = variable.table) {
    const uint64_t count = table->instances() * (table->kind == Table::Kind::Array ? table->length : 1);
    variable.slot->count = static_cast<uint32_t>(std::min<uint64_t>(count, kMaxTableElements));
  }
  const bool is_data = variable.table != nullptr && variable.table->outermost()->is_data;
  if (!is_data && !is_frozen_for(work, variable)) {
    if (home_of(variable) != &work) work.used.insert(&variable);
    return {variable.slot, Place{}.global};
  }
  const auto [found, is_new] = globals_of.try_emplace(&variable, static_cast<uint32_t>(program.globals.size()));
  if (is_new)
    program.globals.push_back({variable.slot->name, value, variable.slot->count, is_data ? nullptr : variable.slot,
                               is_data ? data_of(variable) : nullptr, variable.parameter});
  return {nullptr, found->second};
}

Variable* Context::find_variable(Work& work, const syntax::Local& local) const {
  Work* owner = &work;
  while (owner != nullptr && owner->function != local.function)
    owner = owner->parent;
  if (owner == nullptr) return nullptr;
  Variable& variable = owner->variables[&local];
  variable.owner = owner;
  variable.is_captured = local.is_captured;
  return &variable;
}

Table* Context::table_of(Work& work, const void* syntax, unsigned which, Span span) {
  Table*& table = tables[{&work, syntax, which}];
  if (table == nullptr) {
    program.tables.push_back(std::make_unique<Table>());
    table = program.tables.back().get();
    table->maker = &work;
    table->owner = residence(&work);
    table->span = span;
  }
  return table;
}

Table* Context::inner_table(Table& outer, Table::Field& field, Span span) {
  if (field.inner == nullptr) {
    program.tables.push_back(std::make_unique<Table>());
    field.inner = program.tables.back().get();
    field.inner->outer = &outer;
    field.inner->maker = outer.maker;
    field.inner->owner = outer.owner;
    field.inner->span = span;
  }
  return field.inner;
}

namespace {

std::string specialisation_name(Context& context, const Work& work) {
  std::string name(work.function->name);
  if (work.function->parent == nullptr) name = &work == context.top ? "top level" : "module";
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
  work.spec->is_library = context.is_library_code(work);
  if (context.collect) {
    work.spec->id = static_cast<uint32_t>(context.program.specialisations.size());
    context.program.specialisations.push_back(std::move(work.owned));
  }
  Work*& walked = context.walked[work.function];
  if (walked == nullptr) walked = &work;
}

/// Captures of this specialisation: what lives elsewhere and is used by it or its callees.
void close_specialisation(Context& context, Work& work) {
  Specialisation& spec = *work.spec;
  if (work.has_results) spec.results = work.results;
  std::set<Variable*> captures = work.used;
  for (const auto& [id, link] : work.callees) {
    work.derivative_order = std::max(work.derivative_order, link.work->derivative_order);
    for (Variable* variable : link.work->captures)
      if (context.home_of(*variable) != &work) captures.insert(variable);
    for (Variable* variable : link.work->outer_writes)
      if (context.home_of(*variable) != &work) work.outer_writes.insert(variable);
  }
  work.captures.assign(captures.begin(), captures.end());
  std::ranges::sort(work.captures, {}, [](const Variable* variable) { return variable->slot->id; });
  for (const Variable* variable : work.captures)
    spec.captures.push_back(variable->slot);
  for (const auto& [local, variable] : work.variables)
    spec.locals[local] = {variable.type, has_storage(variable.type) ? variable.slot : nullptr};
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
  if (!report || !reported.insert({span.file, span.begin, span.end}).second) return silent = Diagnostic{};
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
  if (is_table(first) && is_table(type)) {
    context.error(DiagnosticCode::TableNotKnown, place, {"'" + std::string(name) + "' stands"});
  } else if (is_function(first) || is_function(type)) {
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
  const Type& first = work.first_results[index];
  if (is_function(first) && is_function(type)) {
    context.error(DiagnosticCode::FunctionChoice, place).note(DiagnosticCode::NoteOtherReturn, work.first_return);
  } else if (is_table(first) && is_table(type)) {
    context.error(DiagnosticCode::TableNotKnown, place, {"this stands"})
        .note(DiagnosticCode::NoteOtherReturn, work.first_return);
  } else if (first.kind == Type::Kind::String && type.kind == Type::Kind::String) {
    context.error(DiagnosticCode::StringChoice, place).note(DiagnosticCode::NoteOtherReturn, work.first_return);
  } else {
    context.type_error(work, DiagnosticCode::ResultType, place, {describe(type), describe(first)})
        .note(DiagnosticCode::NoteOtherReturn, work.first_return);
  }
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
