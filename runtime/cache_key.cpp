// Keys (cache_key.h). A hash of fields, each with its length, so that no two lists of fields read the same.
#include "runtime/cache_key.h"

#include "compiler/base/arena.h"
#include "compiler/codegen/codegen.h"
#include "compiler/syntax/lexer.h"
#include "runtime/build_id.h"

#include <llvm/Config/llvm-config.h>
#include <llvm/Support/BLAKE3.h>

namespace moonshade {

namespace {

class KeyHasher {
public:
  void add(std::string_view text) {
    add(uint64_t{text.size()});
    hasher_.update(llvm::StringRef(text.data(), text.size()));
  }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(const char* text) { add(std::string_view(text)); }
  template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>)
  void add(T value) {
    hasher_.update(llvm::ArrayRef(reinterpret_cast<const uint8_t*>(&value), sizeof value));
  }
  template <class T> void add(const std::vector<T>& values) {
    add(uint64_t{values.size()});
    for (const T& value : values)
      add(value);
  }
  void add(const Gradient& gradient) {
    add(gradient.entry);
    add(gradient.inputs);
  }
  void add(const Constant& value) {
    add(uint64_t{value.index()});
    std::visit([&](const auto& held) { add(held); }, value);
  }
  CacheKey key() { return hasher_.final(); }

private:
  llvm::BLAKE3 hasher_;
};

/// Adds the modules that a text names.
void add_required(const std::string& text, const ModuleReader& reader, SourceClosure& closure) {
  if (text.find("require") == std::string::npos) return;
  Arena arena;
  Diagnostics diagnostics;
  syntax::Lexer lexer(FileId{0}, text, arena, diagnostics);
  using syntax::TokenKind;
  for (syntax::Token token = lexer.next(); token.kind != TokenKind::EndOfFile;) {
    const bool is_require = token.kind == TokenKind::Name && token.text == "require";
    token = lexer.next();
    if (!is_require) continue;
    if (token.kind == TokenKind::LeftParen) token = lexer.next();
    if (token.kind != TokenKind::String) continue;
    const std::string name(token.text);
    if (closure.modules.contains(name)) continue;
    ModuleText module = reader(name);
    if (!module.error.empty()) continue;
    const std::string& module_text = closure.modules.emplace(name, std::move(module)).first->second.text;
    add_required(module_text, reader, closure);
  }
}

} // namespace

ModuleReader SourceClosure::reader() const {
  return [modules = modules](const std::string& name) {
    const auto found = modules.find(name);
    return found != modules.end() ? found->second : ModuleText{"", "", "it is not among the modules"};
  };
}

SourceClosure source_closure(const std::string& name, const std::string& text, const ModuleReader& reader) {
  SourceClosure closure{name, text, {}};
  if (reader) add_required(text, reader, closure);
  return closure;
}

std::optional<CacheKey> cache_key(const SourceClosure& sources, const CompileOptions& options) {
  const std::string& build = library_build_id();
  if (build.empty()) return std::nullopt;
  KeyHasher hasher;
  hasher.add(build);
  hasher.add(llvm_build_id());
  hasher.add(LLVM_VERSION_STRING);
  hasher.add(codegen::describe_target(options.cpu, options.target));
  // Every option is named here: one that is added does not compile until it is thought of.
  const auto& [precision, width, modules, optimization, cpu, target, entries, uniform_inputs, step_limit,
               color_diagnostics, gradients, images, bake, baked, cache, background] = options;
  static_cast<void>(modules), static_cast<void>(cpu), static_cast<void>(target); // in the sources, in the target
  static_cast<void>(cache), static_cast<void>(background);                       // not of the optimised code
  static_cast<void>(images);                                                     // data of an instance
  hasher.add(precision);
  hasher.add(width);
  hasher.add(optimization);
  hasher.add(entries);
  hasher.add(uniform_inputs);
  hasher.add(step_limit);
  hasher.add(color_diagnostics);
  hasher.add(gradients);
  hasher.add(bake);
  hasher.add(uint64_t{baked.size()});
  for (const auto& [parameter, value] : baked) {
    hasher.add(parameter);
    hasher.add(value);
  }
  hasher.add(sources.name);
  hasher.add(sources.text);
  hasher.add(uint64_t{sources.modules.size()});
  for (const auto& [module, text] : sources.modules) {
    hasher.add(module);
    hasher.add(text.path);
    hasher.add(text.text);
  }
  return hasher.key();
}

} // namespace moonshade
