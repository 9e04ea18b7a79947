// From a text to a program (shader.h): the stages in order, the object cache before and after them, and code that is
// made quickly first and optimised behind the host's back.
#include "runtime/background.h"
#include "runtime/cache_key.h"
#include "runtime/compiled.h"
#include "runtime/frontend_parts.h"
#include "runtime/program_archive.h"
#include "runtime/stopwatch.h"

#include <llvm/Config/llvm-config.h>

#include <algorithm>
#include <sstream>

namespace moonshade {

namespace {

std::string diagnostics_text(const CheckedShader& shader, bool color) {
  std::ostringstream text;
  print_text(shader.diagnostics(), shader.sources(), text, color);
  return text.str();
}

std::vector<ParameterSlot> find_slots(const ir::Module& module, const codegen::CodeInfo& code) {
  std::vector<ParameterSlot> slots;
  for (size_t i = 0; i < module.globals.size(); ++i)
    if (const ir::Global& global = module.globals[i]; global.parameter != ir::kNone)
      slots.push_back({global.parameter, global.type, code.global_offsets[i]});
  return slots;
}

/// The sources of a shader that was checked, as those of source_closure.
SourceClosure closure_of(const CheckedShader& shader) {
  const SourceSet& sources = shader.sources();
  SourceClosure closure{std::string(sources.name(FileId{0})), std::string(sources.text(FileId{0})), {}};
  const auto& modules = shader.parts().modules;
  for (size_t i = 0; i < modules.size(); ++i) {
    const FileId file = modules[i].chunk->file;
    closure.modules[modules[i].name] = {std::string(sources.name(file)), std::string(sources.text(file)), ""};
  }
  return closure;
}

/// The place of one compilation in the cache.
class Cached {
public:
  Cached(const SourceClosure& sources, const CompileOptions& options) : cache_(options.cache) {
    if (cache_ != nullptr) key_ = cache_key(sources, options);
  }

  /// The program, where the cache has it.
  std::shared_ptr<Compiled> find(std::string& diagnostics) const {
    if (!key_) return nullptr;
    const std::optional<std::string> bytes = cache_->find(*key_);
    if (!bytes) return nullptr;
    std::optional<ArchivedProgram> archived = archived_program(*bytes);
    std::string error = "no program";
    std::unique_ptr<const Code> code;
    if (archived) code = load_code(std::move(archived->code), archived->object, error);
    if (!error.empty()) {
      cache_->reject(*key_);
      return nullptr;
    }
    auto compiled = std::make_shared<Compiled>();
    compiled->info = std::move(archived->info);
    compiled->slots = std::move(archived->slots);
    compiled->sites = std::move(archived->sites);
    compiled->has_prints = archived->has_prints;
    compiled->set_code(std::move(code));
    diagnostics = std::move(archived->diagnostics);
    return compiled;
  }

  void store(const Compiled& compiled, const codegen::CodeInfo& code, const std::string& diagnostics,
             const std::string& object) const {
    if (!key_) return;
    cache_->store(*key_, to_bytes({compiled.info, code, compiled.slots, compiled.sites, compiled.has_prints,
                                   diagnostics, object}));
  }

private:
  std::shared_ptr<ObjectCache> cache_;
  std::optional<CacheKey> key_;
};

/// What printing code is made from.
void keep_sources(Compiled& compiled, const SourceClosure& sources, const CompileOptions& options) {
  if (!compiled.has_prints) return;
  compiled.sources = sources;
  compiled.options = options;
  compiled.options.modules = sources.reader();
  compiled.options.cache = nullptr;
  compiled.options.background = nullptr;
}

/// The object code of a module, and how long it took.
codegen::Generated generate(const ir::Module& module, const codegen::Options& options, std::string& object,
                            CompileTimes& times) {
  Stopwatch watch;
  codegen::Generated generated = codegen::generate(module, options);
  times.emit = generated.times.emit;
  times.optimize = generated.times.optimize;
  watch.lap();
  if (generated.error.empty() && !generated.runs_here)
    generated.error =
        "code for '" + (options.triple.empty() ? options.cpu : options.triple) + "' does not run on this machine";
  if (generated.error.empty()) object = generated.object();
  times.codegen = watch.lap();
  return generated;
}

/// Compiles the module again, as the options say, for a program that exists.
void optimise(Compiled& compiled, const ir::Module& module, const codegen::Options& options, const Cached& cached,
              const std::string& diagnostics) {
  std::string object, error;
  CompileTimes times;
  codegen::Generated generated = generate(module, options, object, times);
  if (!generated.error.empty()) return; // what there is remains
  codegen::CodeInfo info = generated.info;
  std::unique_ptr<const Code> code = load_code(std::move(generated.info), object, error);
  if (code == nullptr) return;
  compiled.replace_code(std::move(code));
  cached.store(compiled, info, diagnostics, object);
}

Compilation compile_anew(const CheckedShader& shader, const SourceClosure& sources, const CompileOptions& options,
                         const Cached& cached, double cache_milliseconds) {
  Stopwatch watch;
  std::string diagnostics = diagnostics_text(shader, options.color_diagnostics);
  if (!shader.ok()) return {nullptr, diagnostics};
  auto compiled = std::make_shared<Compiled>();
  compiled->opener = options.images;
  CompileTimes& times = compiled->times;
  times.parse = shader.parts().parse_milliseconds;
  times.sema = shader.parts().sema_milliseconds;
  times.cache = cache_milliseconds;
  watch.lap();
  auto module = std::make_shared<ir::Module>(build_printing_module(shader, options));
  compiled->has_prints = ir::has_prints(*module);
  ir::remove_prints(*module);
  if (const std::string error = optimize_module(*module, shader.info(), options); !error.empty())
    return {nullptr, diagnostics + "error: " + error + "\n"};
  times.ir = watch.lap();

  codegen::Options wanted = jit_options(options);
  codegen::Options first = wanted;
  const bool tiered = options.background != nullptr && options.optimization > 1;
  if (tiered) {
    make_quick(first);
    wanted.library_calls = codegen::LibraryCalls::None; // nobody waits for it: as fast as can be
  }
  std::string object;
  codegen::Generated generated = generate(*module, first, object, times);
  if (!generated.error.empty())
    return {nullptr, diagnostics + refusal(shader, generated, options.color_diagnostics),
            generated.exceeded_limit != 0};
  compiled->info = compiled_info(shader.info(), *module, options);
  compiled->slots = find_slots(*module, generated.info);
  for (const codegen::FaultPlaceInfo& place : generated.info.places)
    compiled->sites.push_back(resolve(shader.sources(), place));
  keep_sources(*compiled, sources, options);
  watch.lap();
  std::string error;
  const codegen::CodeInfo info = generated.info;
  std::unique_ptr<const Code> code = load_code(std::move(generated.info), object, error);
  if (code == nullptr) return {nullptr, diagnostics + "error: " + error + "\n"};
  compiled->set_code(std::move(code));
  times.codegen += watch.lap();
  if (tiered) {
    compiled->is_quick = times.quick = true;
    run_in_background(*options.background,
                      [waiting = std::weak_ptr<Compiled>(compiled), module, wanted, cached, diagnostics] {
                        if (const std::shared_ptr<Compiled> used = waiting.lock())
                          optimise(*used, *module, wanted, cached, diagnostics);
                      });
  } else {
    cached.store(*compiled, info, diagnostics, object);
    if (options.cache != nullptr) times.cache += watch.lap();
  }
  times.total = times.parse + times.sema + times.cache + times.ir + times.emit + times.optimize + times.codegen;
  return {make_program(std::move(compiled)), std::move(diagnostics)};
}

/// The program from the cache; null where that has none. `milliseconds`: how long it took to see.
Compilation find_cached(const Cached& cached, const SourceClosure& sources, const CompileOptions& options,
                        const CompileTimes& before, Stopwatch& watch, double& milliseconds) {
  if (options.cache == nullptr) return {};
  std::string diagnostics;
  std::shared_ptr<Compiled> compiled = cached.find(diagnostics);
  if (compiled != nullptr) {
    compiled->opener = options.images;
    keep_sources(*compiled, sources, options);
  }
  milliseconds = watch.lap();
  if (compiled == nullptr) return {};
  compiled->times = before;
  compiled->times.cache = milliseconds;
  compiled->times.cached = true;
  compiled->times.total += milliseconds;
  return {make_program(std::move(compiled)), std::move(diagnostics)};
}

std::shared_ptr<const Compiled> make_printing_code(const Compiled& compiled) {
  const CompileOptions& options = compiled.options;
  const CheckedShader shader(compiled.sources.name, compiled.sources.text, options.entries, options.modules);
  if (!shader.ok()) return nullptr;
  ir::Module module = build_printing_module(shader, options);
  if (!optimize_module(module, shader.info(), options).empty()) return nullptr;
  codegen::Options code_options = jit_options(options);
  code_options.width = 1;
  code_options.prints = true;
  std::string object, error;
  CompileTimes times;
  codegen::Generated generated = generate(module, code_options, object, times);
  if (!generated.error.empty()) return nullptr;
  auto printing = std::make_shared<Compiled>();
  printing->info = compiled.info;
  printing->slots = find_slots(module, generated.info);
  std::unique_ptr<const Code> code = load_code(std::move(generated.info), object, error);
  if (code == nullptr) return nullptr;
  printing->set_code(std::move(code));
  return printing;
}

} // namespace

std::unique_ptr<const Code> load_code(codegen::CodeInfo info, const std::string& object, std::string& error) {
  auto code = std::make_unique<Code>();
  const JitCode& jit = code->jit.emplace(JitCode::load(object));
  error = jit.error();
  for (const codegen::EntryCode& entry : info.entries) {
    code->kernels.push_back(reinterpret_cast<codegen::Kernel>(jit.function(entry.symbol)));
    if (code->kernels.back() == nullptr && error.empty()) error = "the code of '" + entry.symbol + "' cannot be linked";
  }
  if (!info.init_symbol.empty()) {
    code->init = reinterpret_cast<codegen::Init>(jit.function(info.init_symbol));
    if (code->init == nullptr && error.empty()) error = "the code of the top level cannot be linked";
  }
  code->info = std::move(info);
  return error.empty() ? std::move(code) : nullptr;
}

std::shared_ptr<const Compiled> printing_code(const Compiled& compiled) {
  std::call_once(compiled.printing_made, [&] { compiled.printing = make_printing_code(compiled); });
  return compiled.printing;
}

Compilation compile(const CheckedShader& shader, const CompileOptions& options) {
  if (!shader.ok()) return {nullptr, diagnostics_text(shader, options.color_diagnostics)};
  Stopwatch watch;
  const SourceClosure sources = closure_of(shader);
  const Cached cached(sources, options);
  double milliseconds = 0;
  if (Compilation found = find_cached(cached, sources, options, shader.times(), watch, milliseconds); found.program)
    return found;
  return compile_anew(shader, sources, options, cached, milliseconds);
}

Compilation compile(const std::string& name, const std::string& text, const CompileOptions& options) {
  if (options.cache == nullptr) return compile(CheckedShader(name, text, options.entries, options.modules), options);
  Stopwatch watch;
  const SourceClosure sources = source_closure(name, text, options.modules);
  const Cached cached(sources, options);
  double milliseconds = 0;
  if (Compilation found = find_cached(cached, sources, options, {}, watch, milliseconds); found.program) return found;
  // With the texts that the key was made of, though a file may have changed since.
  const CheckedShader shader(name, text, options.entries, [&](const std::string& module) {
    const auto found = sources.modules.find(module);
    if (found != sources.modules.end()) return found->second;
    return options.modules ? options.modules(module) : ModuleText{"", "", "this host loads no modules"};
  });
  // A module that was not seen in the text is not in the key either.
  const bool all_seen = std::ranges::all_of(shader.parts().modules,
                                            [&](const auto& module) { return sources.modules.contains(module.name); });
  if (!all_seen) return compile_anew(shader, closure_of(shader), options, Cached({}, {}), milliseconds);
  return compile_anew(shader, sources, options, cached, milliseconds);
}

unsigned native_width(Precision precision) { return codegen::native_width(precision); }

std::string version() { return "moonshade " MOONSHADE_VERSION " (LLVM " LLVM_VERSION_STRING ")"; }

} // namespace moonshade
