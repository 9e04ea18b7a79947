// Modules run before the top level of the shader, those that others require first: a module depends on nothing but what
// it requires, so when it runs does not show. Its result is a table or a function, known while compiling; `require` is
// a name for it.
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
      require(*each.call);
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

  void require(const CallExpr& call) {
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
    load(*loaded.chunk);
    open_.pop_back();
    Work* work = context_.find_or_make({loaded.chunk->main, nullptr, true, nullptr, 0, {}}, call.span);
    if (work == nullptr) return;
    work->site = work->frame_home = context_.top;
    context_.modules.push_back({name, loaded.chunk, call.span, work});
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

void Walker::run_modules() {
  for (size_t i = 0; i < context_.modules.size(); ++i) {
    Context::Module& module = context_.modules[i];
    if (module.work->round != context_.round) {
      module.work->caller = &work_;
      module.work->call_span = module.required;
      context_.analyse(*module.work);
    }
    if (context_.report && module.work->spec != nullptr) work_.callees[module_call(i)] = {module.work, module.required};
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
