// The stages of the compiler up to LLVM, for tools that print them: check a file, describe it, emit a stage as text.
#pragma once

#include "compiler/base/diagnostics.h"
#include "runtime/shader.h"

#include <memory>
#include <string>

namespace moonshade {

/// A parsed and checked shader.
class CheckedShader {
public:
  CheckedShader(const std::string& name, const std::string& text, const std::vector<std::string>& entries = {},
                const ModuleReader& modules = {});
  ~CheckedShader();
  CheckedShader(CheckedShader&&) noexcept;
  CheckedShader& operator=(CheckedShader&&) noexcept;

  /// Parsed alone, for Stage::Ast: all of Lua is `ok()`, whatever the dialect leaves out.
  static CheckedShader parsed(const std::string& name, const std::string& text);

  /// Reports the constant images that cannot be opened, as errors at their names.
  void check_images(const ImageOpener& opener);

  bool ok() const; ///< no error was reported
  const ShaderInfo& info() const;
  const Diagnostics& diagnostics() const;
  const SourceSet& sources() const;
  std::vector<std::string> files() const; ///< that it was read from: its own, and its modules'
  CompileTimes times() const;             ///< of parse and sema

  struct Parts; ///< arena, chunk, sema's program: for the runtime itself
  const Parts& parts() const { return *parts_; }

private:
  CheckedShader();
  void parse(const std::string& name, const std::string& text);

  std::unique_ptr<Parts> parts_;
};

/// Object and Header: for C and C++ programs (compiler/codegen/c_interface.h).
enum class Stage { Ast, Ir, Llvm, Assembly, Object, Header };

struct Emission {
  std::string bytes;
  CompileTimes times{}; ///< of the stages that it took
  std::string error;    ///< for instance an unknown CPU; empty where there is none
  /// The checked shader exceeds a limit, of which `error` is the diagnostic as text.
  bool is_too_large = false;
};
/// The text (or object file) of one stage of an `ok()` shader; Ast also of one that is not.
/// `prefix` begins the names in Object and Header; empty: the file's name.
Emission emit(const CheckedShader& shader, Stage stage, const CompileOptions& options, const std::string& prefix = {});

/// What the compiler decides of an `ok()` shader (compiler/codegen/remarks.h), as notes. Gives the error.
std::string report_remarks(const CheckedShader& shader, const CompileOptions& options, Diagnostics& diagnostics);

/// Compiles an already checked shader.
Compilation compile(const CheckedShader& shader, const CompileOptions& options);

} // namespace moonshade
