// What stands behind a compiled program and its instances, for the runtime's own files.
//
// A program's code may exist twice: made quickly, and optimised (CompileOptions::background). Both are made from the
// same IR, so all that is known of the code but its text and its width is the same: entries, constants, fault sites. A
// call takes the code that is there when it begins; no code goes before the program does.
#pragma once

#include "compiler/codegen/batch.h"
#include "compiler/codegen/codegen.h"
#include "runtime/cache_key.h"
#include "runtime/jit.h"
#include "runtime/shader.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace moonshade {

/// Where a parameter's value goes in the block of constants.
struct ParameterSlot {
  size_t parameter; ///< index into ShaderInfo::parameters
  ValueType type;
  uint64_t offset;
};

/// Machine code, loaded.
struct Code {
  std::optional<JitCode> jit;
  codegen::CodeInfo info;
  std::vector<codegen::Kernel> kernels; ///< by entry
  codegen::Init init = nullptr;
};
/// Loads the object code; null with the reason in `error` where that fails.
std::unique_ptr<const Code> load_code(codegen::CodeInfo info, const std::string& object, std::string& error);

/// What the instances of a program share.
struct Compiled {
  ShaderInfo info;
  std::vector<ParameterSlot> slots;
  std::vector<FaultSite> sites;
  CompileTimes times;
  bool is_quick = false; ///< the first code is
  ImageOpener opener;    ///< for the images of instances

  const Code& code() const { return *current.load(std::memory_order_acquire); }
  void set_code(std::unique_ptr<const Code> first) {
    first_code = std::move(first);
    current.store(first_code.get(), std::memory_order_release);
  }
  /// Calls that begin from now on take this code. To be called once.
  void replace_code(std::unique_ptr<const Code> optimised) {
    better_code = std::move(optimised);
    current.store(better_code.get(), std::memory_order_release);
  }

  std::atomic<const Code*> current = nullptr;
  std::unique_ptr<const Code> first_code, better_code;

  // Where the shader prints: what the code that prints is made from, once somebody asks for it.
  bool has_prints = false;
  SourceClosure sources; ///< empty where it does not print
  CompileOptions options;
  mutable std::once_flag printing_made;
  mutable std::shared_ptr<const Compiled> printing; ///< null then: it could not be made
};

/// The code that prints; null where none can be made.
std::shared_ptr<const Compiled> printing_code(const Compiled& compiled);

/// The program of what was compiled.
std::shared_ptr<const Program> make_program(std::shared_ptr<const Compiled> compiled);

} // namespace moonshade
