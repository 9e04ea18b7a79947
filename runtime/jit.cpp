// JITLink alone (jit.h): an object file has all that is to be known of its code, so ORC's sessions, layers and tables
// of symbols would only cost time, more of it than the linking.
#include "runtime/jit.h"

#include "compiler/codegen/batch.h"
#include "compiler/codegen/images.h"
#include "compiler/codegen/native_calls.h"
#include "compiler/codegen/print.h"
#include "stdlib/library.h"

#include <llvm/ExecutionEngine/JITLink/JITLink.h>
#include <llvm/ExecutionEngine/JITLink/JITLinkMemoryManager.h>
#include <llvm/Support/Error.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/Process.h>

#include <cmath>
#include <cstring>

namespace moonshade {

namespace jitlink = llvm::jitlink;
namespace orc = llvm::orc;

struct JitCode::Memory {
  Memory() : manager(llvm::sys::Process::getPageSizeEstimate()) {}
  ~Memory() {
    if (allocation) llvm::consumeError(manager.deallocate(std::move(allocation)));
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  jitlink::InProcessMemoryManager manager;
  jitlink::JITLinkMemoryManager::FinalizedAlloc allocation;
};

namespace {

/// Functions of the C library that LLVM itself calls for operations which a machine lacks, those of the driver, and
/// those of the library.
std::map<llvm::StringRef, orc::ExecutorAddr> external_functions() {
  std::map<llvm::StringRef, orc::ExecutorAddr> functions;
  const auto define = [&](const char* name, auto* address) { functions[name] = orc::ExecutorAddr::fromPtr(address); };
  for (const LibraryExternal& external : library_externals())
    define(external.name, static_cast<char*>(external.address));
  define("moonshade_block_faulted", &codegen::moonshade_block_faulted);
  define("moonshade_texture_f32", &codegen::moonshade_texture_f32);
  define("moonshade_texture_f64", &codegen::moonshade_texture_f64);
  define("moonshade_print", &codegen::moonshade_print);
  define("memcpy", &std::memcpy);
  define("memset", &std::memset);
  define("memmove", &std::memmove);
  define("fma", static_cast<double (*)(double, double, double)>(&std::fma));
  define("fmaf", static_cast<float (*)(float, float, float)>(&std::fma));
  define("floor", static_cast<double (*)(double)>(&std::floor));
  define("floorf", static_cast<float (*)(float)>(&std::floor));
  define("ceil", static_cast<double (*)(double)>(&std::ceil));
  define("ceilf", static_cast<float (*)(float)>(&std::ceil));
  define("trunc", static_cast<double (*)(double)>(&std::trunc));
  define("truncf", static_cast<float (*)(float)>(&std::trunc));
  define("rint", static_cast<double (*)(double)>(&std::rint));
  define("rintf", static_cast<float (*)(float)>(&std::rint));
  return functions;
}

orc::ExecutorAddr find_external(llvm::StringRef name) {
  static const std::map<llvm::StringRef, orc::ExecutorAddr> functions = external_functions();
  if (const auto found = functions.find(name); found != functions.end()) return found->second;
  return orc::ExecutorAddr::fromPtr(codegen::native_call_address({name.data(), name.size()}));
}

} // namespace

/// One link. JITLink goes through its steps at once, on this thread; the context ends with them.
class JitCode::Context : public jitlink::JITLinkContext {
public:
  explicit Context(JitCode& code) : JITLinkContext(nullptr), code_(code) {}

  jitlink::JITLinkMemoryManager& getMemoryManager() override { return code_.memory_->manager; }
  void notifyFailed(llvm::Error error) override { code_.error_ = llvm::toString(std::move(error)); }

  void lookup(const LookupMap& symbols, std::unique_ptr<jitlink::JITLinkAsyncLookupContinuation> then) override {
    jitlink::AsyncLookupResult found;
    for (const auto& symbol : symbols) {
      const orc::ExecutorAddr address = find_external(symbol.first);
      if (address.isNull()) {
        then->run(llvm::createStringError("there is no function '" + symbol.first.str() + "'"));
        return;
      }
      found[symbol.first] = {address, llvm::JITSymbolFlags::Exported};
    }
    then->run(std::move(found));
  }

  llvm::Error notifyResolved(jitlink::LinkGraph& graph) override {
    for (const jitlink::Symbol* symbol : graph.defined_symbols())
      if (symbol->hasName() && symbol->getScope() != jitlink::Scope::Local)
        code_.functions_[symbol->getName().str()] = symbol->getAddress().toPtr<void*>();
    return llvm::Error::success();
  }

  void notifyFinalized(jitlink::JITLinkMemoryManager::FinalizedAlloc allocation) override {
    code_.memory_->allocation = std::move(allocation);
  }

private:
  JitCode& code_;
};

JitCode::JitCode() : memory_(std::make_unique<Memory>()) {}
JitCode::~JitCode() = default;
JitCode::JitCode(JitCode&&) noexcept = default;
JitCode& JitCode::operator=(JitCode&&) noexcept = default;

JitCode JitCode::load(const std::string& object) {
  JitCode code;
  auto graph = jitlink::createLinkGraphFromObject(llvm::MemoryBufferRef(object, "shader"));
  if (!graph)
    code.error_ = llvm::toString(graph.takeError());
  else
    jitlink::link(std::move(*graph), std::make_unique<Context>(code));
  return code;
}

void* JitCode::function(const std::string& symbol) const {
  const auto found = functions_.find(symbol);
  return found != functions_.end() ? found->second : nullptr;
}

} // namespace moonshade
