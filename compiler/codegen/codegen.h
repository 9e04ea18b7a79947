// From a module of the IR to machine code: the public face of code generation. Needs no LLVM header.
#pragma once

#include "compiler/base/fault.h"
#include "compiler/base/source.h"
#include "compiler/codegen/batch.h"
#include "compiler/ir/ir.h"

#include <memory>
#include <string>
#include <vector>

namespace moonshade::codegen {

/// Which of the library's functions are called as machine code of this process (native_calls.h). The others are linked
/// as bitcode, inlined and compiled with the shader: faster by what a call costs, and by what the optimiser makes of
/// arguments that it knows, but most of a shader's compile time.
enum class LibraryCalls : uint8_t {
  None,  ///< none: for code that leaves this process, or must be as fast as can be
  Large, ///< those that are not small, where a shader has more of them than a budget
  All,   ///< those that are not small
};

struct Options {
  Precision precision = Precision::F32;
  unsigned width = 0;                      ///< 0: the best for the target
  int optimization = 2;                    ///< 0 to 3
  std::string cpu = "native";              ///< "native" or a name of LLVM's
  std::string triple;                      ///< empty: this machine's
  std::vector<std::string> uniform_inputs; ///< by name of the parameter
  LibraryCalls library_calls = LibraryCalls::None;
  bool prints = false; ///< emit `print` (print.h); for one lane
};

struct CInterface;

struct EntryCode {
  std::string symbol;
  KernelInfo info;
};

struct FaultPlaceInfo {
  FaultCode code;
  Span span;
  std::string message;
};

/// A `print` of the shader: Instruction::text, and the types of the operands.
struct PrintPlaceInfo {
  std::string text;
  std::vector<ValueType> types;
};

/// Everything about the generated code but the code.
struct CodeInfo {
  Precision precision = Precision::F32;
  unsigned width = 1;
  std::vector<EntryCode> entries;       ///< in the order of ir::Module::entries
  std::string init_symbol;              ///< empty: nothing to run
  std::vector<uint64_t> global_offsets; ///< by GlobalId: where it lies in the instance's constants
  uint64_t constants_size = 0;
  std::vector<FaultPlaceInfo> places; ///< by fault site
  std::vector<PrintPlaceInfo> prints; ///< where prints are emitted
  uint64_t print_slot = 0;            ///< where the sink's address lies, behind constants_size bytes of constants
  uint64_t image_slot = 0;            ///< and behind it that of the images (images.h)
  uint64_t block_size() const { return constants_size + 2 * sizeof(void*); } ///< with these two
};

struct Times {
  double emit = 0, optimize = 0, codegen = 0; ///< milliseconds
};

/// An optimised LLVM module and what is to be known of it. Each has a context of its own.
class Generated {
public:
  Generated();
  ~Generated();
  Generated(Generated&&) noexcept;
  Generated& operator=(Generated&&) noexcept;

  std::string error; ///< set where nothing was generated: unknown CPU, shader too large, ...
  /// The error is that the shader is too large: `error` says in what, and this is the limit.
  uint64_t exceeded_limit = 0;
  CodeInfo info;
  Times times;
  bool runs_here = false; ///< this machine has what the code needs

  std::string llvm_text() const;
  std::string assembly();
  /// An object file of the target.
  std::string object();
  /// An object file for C programs (c_interface.h).
  std::string c_object(const CInterface& interface);

  struct Parts;
  std::unique_ptr<Parts> parts;
};

Generated generate(const ir::Module& module, const Options& options);

/// All of the target that generated code depends on: triple, processor and features.
std::string describe_target(const std::string& cpu, const std::string& triple);

/// The lane count that suits this machine best.
unsigned native_width(Precision precision);

} // namespace moonshade::codegen
