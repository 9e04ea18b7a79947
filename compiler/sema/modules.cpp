// A module runs before the statement that requires it first; where that stands in a branch, loop or function, before
// the statement of the top level around it, which must not show. Its result is a table or a function, known while
// compiling; `require` is a name for it.
#include "compiler/sema/modules.h"

#include "compiler/sema/walker.h"

#include <algorithm>
#include <cctype>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

std::string_view module_name(const CallExpr& call) {
  const auto* text = call.args.size() == 1 ? try_as<StringExpr>(&strip_parentheses(*call.args[0])) : nullptr;
  if (text == nullptr || text->value.empty()) return {};
  bool after_dot = true;
  for (const char c : text->value) {
    const bool is_dot = c == '.';
    if (!is_dot && c != '_' && c != '-' && std::isalnum(static_cast<unsigned char>(c)) == 0) return {};
    if (is_dot && after_dot) return {};
    after_dot = is_dot;
  }
  return after_dot ? std::string_view{} : text->value;
}

namespace {

class Loader {
public:
  Loader(Context& context, const Options& options) : context_(context), options_(options) {}

  /// In the order in which they run.
  const std::vector<HiddenNames::File>& files() const { return files_; }

  void load(const Chunk& chunk) {
    std::vector<RequireCall> calls;
    collect_globals(chunk, context_.globals, calls);
    HiddenNames::File file{chunk.main->span.file, context_.modules.size(), is_certain_};
    if (context_.globals.find("require") != nullptr) calls.clear(); // the shader's own
    for (const RequireCall& each : calls) {
      const size_t first = context_.modules.size();
      is_certain_ = file.is_certain && each.is_certain;
      require(each);
      const size_t last = context_.modules.size();
      if (each.is_certain && first < last) file.required.push_back({each.call->span.end, first, last});
    }
    files_.push_back(std::move(file));
  }

private:
  struct Open {
    std::string name;
    const CallExpr* call;
  };

  void require(const RequireCall& require_call) {
    const CallExpr& call = *require_call.call;
    const std::string name(module_name(call));
    if (name.empty()) {
      context_.diagnostics.report(Code::ModuleName, call.args.empty() ? call.span : call.args[0]->span);
      return;
    }
    const auto circle = std::ranges::find(open_, name, &Open::name);
    if (circle != open_.end()) {
      refuse_circle(call, circle);
      return;
    }
    if (std::ranges::find(seen_, name) != seen_.end()) return;
    seen_.push_back(name);
    if (seen_.size() > kMaxModules) {
      context_.too_large(call.span, "the shader requires too many modules", kMaxModules);
      return;
    }
    const LoadedModule loaded =
        options_.load_module ? options_.load_module(name) : LoadedModule{nullptr, "this host loads no modules"};
    if (loaded.chunk == nullptr) {
      context_.diagnostics.report(Code::ModuleNotFound, call.args[0]->span, {name, loaded.error});
      return;
    }
    open_.push_back({name, &call});
    const size_t first = context_.modules.size();
    load(*loaded.chunk);
    open_.pop_back();
    Work* work = context_.find_or_make({loaded.chunk->main, nullptr, true, nullptr, 0, {}}, call.span);
    if (work == nullptr) return;
    work->site = work->frame_home = context_.top;
    context_.modules.push_back(
        {name, loaded.chunk, call.span, work, require_call.stat, require_call.is_certain, first});
  }

  void refuse_circle(const CallExpr& call, std::vector<Open>::iterator first) {
    std::string text;
    for (auto at = first; at != open_.end(); ++at)
      text += at->name + " requires ";
    Diagnostic& diagnostic = context_.diagnostics.report(Code::ModuleCycle, call.span, {text + first->name});
    for (auto at = first; at != open_.end(); ++at)
      diagnostic.note(Code::NoteRequiredHere, at->call->span, {at->name});
  }

  Context& context_;
  const Options& options_;
  bool is_certain_ = true; ///< the file that is loaded next runs whatever happens
  std::vector<HiddenNames::File> files_;
  std::vector<Open> open_;
  std::vector<std::string> seen_;
};

} // namespace

void collect_modules(Context& context, const Options& options) {
  Loader loader(context, options);
  loader.load(context.chunk);
  context.hidden_names.order_by(context.globals, loader.files());
}

/// Types of modules, those that others require first: by their results those are inferred.
void Walker::infer_modules() {
  for (size_t i = 0; i < context_.modules.size(); ++i) {
    Context::Module& module = context_.modules[i];
    if (module.work->round != context_.round) {
      module.work->caller = &work_;
      module.work->call_span = module.required;
      context_.analyse(*module.work);
    }
  }
}

void Walker::run_modules_before(const Stat& stat) {
  for (size_t i = 0; i < context_.modules.size(); ++i) {
    const Context::Module& module = context_.modules[i];
    if (module.before == &stat && module.work->spec != nullptr)
      work_.callees[module_call(i)] = {module.work, module.required};
  }
}

namespace {

FileId file_of(const Work& work) { return work.function->span.file; }

/// Whether a variable changes while files run, so that it matters when it is used.
bool is_changing(const Context& context, const Variable& variable) {
  if (variable.table != nullptr) return variable.table->outermost()->is_mutated;
  for (const auto& [local, each] : variable.owner->variables)
    if (&each == &variable) return local->is_assigned;
  for (const auto& [name, global] : context.globals.by_name)
    if (&global.variable == &variable) return !global.is_single;
  return false;
}

} // namespace

void check_modules(Context& context) {
  for (size_t i = 0; i < context.modules.size(); ++i) {
    const Context::Module& module = context.modules[i];
    if (module.is_certain) continue;
    const auto is_own = [&](FileId file) {
      for (size_t k = module.first; k <= i; ++k)
        if (file_of(*context.modules[k].work) == file) return true;
      return false;
    };
    std::string_view global; // the first by name: hash tables have no order of their own
    for (const auto& [name, each] : context.globals.by_name)
      if (is_own(each.definition.file) && (global.empty() || name < global)) global = name;
    if (!global.empty()) context.error(Code::ModuleGlobal, module.required, {module.name, std::string(global)});
    for (const Variable* variable : module.work->captures) {
      const Work* maker = variable->table != nullptr ? variable->table->outermost()->maker : variable->owner;
      if (is_own(file_of(*maker)) || !is_changing(context, *variable)) continue;
      context.error(Code::ModuleOrder, module.required, {module.name, variable->slot->name});
      break;
    }
  }
}

/// `return M` at the end of a module.
void Walker::return_from_module(const ReturnStat& stat, const TypeList& list) {
  if (list.types.empty()) return;
  const Type& type = list.types[0];
  if (!is_unknown(type) && !is_table(type) && !is_function(type)) {
    type_error(Code::ModuleResult, stat.values[0]->span, {describe(type)});
    work_.has_open_return = true;
    return;
  }
  join_results(stat, {{type}, false});
}

TypeList Walker::require_module(const CallExpr& expr) {
  for (const Expr* arg : expr.args)
    expression(*arg);
  const Context::Module* module = context_.find_module(module_name(expr));
  if (module == nullptr || !module->work->has_results) {
    if (module != nullptr && context_.report && module->work->is_done && !module->work->has_open_return)
      error(Code::ModuleResult, expr.span, {"nothing"});
    return {{}, true};
  }
  ExpressionFact fact;
  fact.type = module->work->results[0];
  fact.results = {fact.type};
  fact.call = CallKind::Require;
  return {{record(expr, std::move(fact))}, false};
}

} // namespace moonshade::sema
