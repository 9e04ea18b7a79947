// Shaders as a host sees them: compile once, instantiate with parameters, call for batches of points.
//
//     auto compiled = moonshade::compile("copper.lua", text, {});
//     if (!compiled.program) { std::cerr << compiled.diagnostics; return 1; }
//     auto instance = compiled.program->instantiate({{"scale", 8.0}});
//     instance.shader->run(instance.shader->info().entry_index("color"), batch);
//
// Two kinds of shader stand behind one interface: compiled code, and the same file run by stock Lua 5.4 (interpret.h).
// Thread safety: a Program and a Shader are immutable and may be used by any number of threads at once; so may compile
// and instantiate. There is no global state. This header needs neither LLVM nor Lua, and compiles with g++ 12.
#pragma once

#include "compiler/base/fault.h"
#include "compiler/sema/shader_info.h"
#include "runtime/image.h"
#include "stdlib/library.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade {

/// A request for derivatives: of what the entry gives, by inputs (numbers and vectors, at most 16 components together).
struct Gradient {
  std::string entry;
  std::vector<std::string> inputs;
};
/// The name of the entry that it makes: "height'p,uv". That entry has the inputs of `height` and gives its results and
/// then, for each number and each component of a vector among them, the gradient by each of the inputs that the entry
/// declares, in the order of the request, of the input's type. Derivatives are exact; at a kink those of the branch
/// taken; hashes, floors and the lattice of noise count as constant.
std::string gradient_name(const Gradient& gradient);

/// How to compile. The defaults suit rendering on this machine.
/// The text of a module that a shader requires, or why there is none.
struct ModuleText {
  std::string path; ///< for messages
  std::string text;
  std::string error; ///< empty where it was found
};
/// Finds modules by their names ("patterns.stone"). Called while a shader is checked, once for each name.
using ModuleReader = std::function<ModuleText(const std::string& name)>;
/// Looks for patterns/stone.lua in these folders, in this order. Nothing outside of them is read.
ModuleReader folder_modules(std::vector<std::string> folders);

/// Compiled code on disk, for later compilations of the same text with the same options, by this process or others that
/// use the same build of this library on the same kind of processor. Any number of processes and threads may share a
/// folder. What is damaged, or could have been written by somebody else, is compiled anew; a folder that cannot be
/// written is a cache that keeps nothing.
class ObjectCache;
/// Null for an empty folder. The folder is made when something is stored; what was used longest ago goes when it holds
/// more than `limit` bytes.
std::shared_ptr<ObjectCache> open_object_cache(const std::string& folder, uint64_t limit = uint64_t{256} << 20);
/// $XDG_CACHE_HOME/moonshade or ~/.cache/moonshade; empty where neither is known.
std::string default_cache_folder();
struct CacheCounts {
  uint64_t hits = 0, misses = 0;
  uint64_t rejected = 0; ///< misses that found something which could not be trusted
  uint64_t stored = 0;
};
CacheCounts cache_counts(const ObjectCache& cache);

/// Optimises programs while they are used already (CompileOptions::background), on a thread of its own, in the order in
/// which they came.
class BackgroundCompiler {
public:
  /// Without a thread, programs wait for run_one().
  explicit BackgroundCompiler(bool with_thread = true);
  /// Ends what is at work; programs that still wait stay as they are.
  ~BackgroundCompiler();
  BackgroundCompiler(const BackgroundCompiler&) = delete;
  BackgroundCompiler& operator=(const BackgroundCompiler&) = delete;

  /// Waits until nothing is left to do; with a thread only.
  void wait();
  /// Optimises the next program on this thread; false where none waits.
  bool run_one();

  struct State;
  State& state() { return *state_; }

private:
  std::unique_ptr<State> state_;
};

struct CompileOptions {
  Precision precision = Precision::F32;
  /// Lanes: 1, 4, 8, 16 or 32; 0 = the best for the target.
  unsigned width = 0;
  /// For `require`; empty: there are no modules.
  ModuleReader modules;
  /// As clang's -O0 to -O3.
  int optimization = 2;
  /// "native" or a CPU name of LLVM's: to run, one of which this machine has all features.
  std::string cpu = "native";
  /// A target triple; empty = this machine's; other than that only for emitting text.
  std::string target;
  /// Entry points to compile; empty: all.
  std::vector<std::string> entries;
  /// Inputs with one value for a whole batch ("time", "frame"): their pointer in a Batch leads to a single value.
  std::vector<std::string> uniform_inputs;
  /// Steps (loop iterations and calls of the shader's functions) after which a point faults.
  uint64_t step_limit = 1'000'000;
  /// At most this many diagnostics are kept, and colour is used in their text.
  bool color_diagnostics = false;
  /// Entries to add; those of functions that the shader does not have are left out, and of functions that differentiate
  /// as often as there are derivatives. (Compiled code only.)
  std::vector<Gradient> gradients;
  /// Opens the images that the shader looks up, for each of its instances; empty: a shader with images has none.
  ImageOpener images;
  /// Compile the parameters as constants: these values, and defaults where none is given. The program has no parameters
  /// then, and gives what it would with these.
  bool bake = false;
  std::map<std::string, Constant> baked = {};
  /// Null: every compilation compiles.
  std::shared_ptr<ObjectCache> cache = {};
  /// Not null: compile() gives quickly made code, which is replaced by optimised code of the same bits as soon as this
  /// has made it; what is in the cache is optimised at once. At levels 0 and 1 all code is made quickly.
  std::shared_ptr<BackgroundCompiler> background = {};
};

/// Faults of one call of Shader::run. Plain data; the caller sets it to zero (or {}) before the call.
struct FaultReport {
  uint64_t count = 0;       ///< points that faulted
  uint64_t first_point = 0; ///< index in the batch of the lowest of them
  FaultCode first_code = FaultCode::None;
  uint32_t first_site = 0; ///< of the first: for Shader::fault_site
};

/// A batch of points. Inputs and outputs are structure-of-arrays: one array a component, each of `count` elements,
/// aligned to its element. Elements are float (F32) or double (F64) for numbers and vector components, int64_t for
/// integers, uint8_t (0 or 1) for booleans.
struct Batch {
  uint64_t count = 0;
  /// One pointer for each component of each input that the entry declares, in the order of EntryInfo::inputs.
  const void* const* inputs = nullptr;
  /// One pointer for each component of each result. Points that fault get zeros.
  void* const* outputs = nullptr;
  /// Null: faults are not reported (outputs are zero all the same).
  FaultReport* faults = nullptr;
  /// Null, or `count` bytes: the FaultCode of each point (0: none).
  uint8_t* fault_codes = nullptr;
};

/// Where a fault stands in the source.
struct FaultSite {
  std::string file;
  uint32_t line = 0, column = 0;
  std::string message; ///< of assert and error
};

/// Takes a line that a shader prints, without its end.
using PrintSink = std::function<void(std::string_view line)>;

/// A shader with its parameters set, ready to be called.
class Shader {
public:
  virtual ~Shader() = default;
  virtual const ShaderInfo& info() const = 0;
  /// Representation of numbers in batches.
  virtual Precision precision() const = 0;
  /// Lanes of the compiled code; 1 for the interpreter.
  virtual unsigned width() const = 0;
  /// Shades a batch. `entry` is an index into info().entries. Safe to call from any number of threads.
  virtual void run(size_t entry, const Batch& batch) const = 0;
  virtual FaultSite fault_site(uint32_t site) const = 0;

  /// Whether the shader has a `print`. run() ignores it, at no cost.
  virtual bool has_prints() const { return false; }
  /// Shades one point of a batch again and gives what it prints to the sink, line by line; writes nothing to the batch.
  /// What the top level prints is never given. Of compiled code, the first call compiles the shader once more, for one
  /// lane.
  virtual void print(size_t entry, const Batch& batch, uint64_t point, const PrintSink& sink) const {
    static_cast<void>(entry), static_cast<void>(batch), static_cast<void>(point), static_cast<void>(sink);
  }
};

struct Instantiation {
  std::shared_ptr<const Shader> shader; ///< null where `error` is set
  std::string error;                    ///< names the parameter, or the fault of the top level
};

/// Milliseconds of each stage of one compilation.
struct CompileTimes {
  double parse = 0, sema = 0, ir = 0, emit = 0, optimize = 0, codegen = 0, total = 0;
  double cache = 0;    ///< look-up, and where it was of use taking over what it holds
  bool cached = false; ///< the code is from the cache
  bool quick = false;  ///< these are the times of quickly made code (CompileOptions::background)
};

/// Compiled code for one shader, without values of its parameters.
class Program {
public:
  virtual ~Program() = default;
  virtual const ShaderInfo& info() const = 0;
  virtual unsigned width() const = 0;
  virtual const CompileTimes& times() const = 0;
  /// Whether its code is still what was made quickly (CompileOptions::background).
  virtual bool is_quick() const = 0;
  /// Sets parameters (defaults where not given) and runs the top level. Compiles nothing.
  virtual Instantiation instantiate(const std::map<std::string, Constant>& parameters) const = 0;
};

struct Compilation {
  std::shared_ptr<const Program> program; ///< null where there was an error
  std::string diagnostics;                ///< errors and warnings as text; empty where there are none
  bool is_too_large = false;              ///< there is no program because the checked shader exceeds a limit
};

/// Compiles the shader `text`; `name` is its file's name in messages.
Compilation compile(const std::string& name, const std::string& text, const CompileOptions& options);

/// The widest machine vectors' best lane count on this machine for the precision.
unsigned native_width(Precision precision);

/// "moonshade 0.1.0 (LLVM 19.1.7)".
std::string version();

} // namespace moonshade
