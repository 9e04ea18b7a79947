// ORC's LLJIT, set up with as little as it takes: no platform, no search in the process, no threads (jit.h).
#include "runtime/jit.h"

#include "compiler/codegen/batch.h"
#include "compiler/codegen/images.h"
#include "compiler/codegen/print.h"
#include "stdlib/library.h"

#include <llvm/ExecutionEngine/Orc/LLJIT.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/Support/Error.h>
#include <llvm/Support/MemoryBuffer.h>

#include <cmath>
#include <cstring>

namespace moonshade {

namespace orc = llvm::orc;

struct JitCode::Session {
  std::unique_ptr<orc::LLJIT> jit;
};

namespace {

llvm::Expected<std::unique_ptr<orc::ObjectLayer>> make_linking_layer(orc::ExecutionSession& session,
                                                                     const llvm::Triple&) {
  return std::make_unique<orc::ObjectLinkingLayer>(session);
}

llvm::Expected<std::unique_ptr<orc::LLJIT>> make_jit() {
  return orc::LLJITBuilder()
      .setNumCompileThreads(0)
      .setLinkProcessSymbolsByDefault(false)
      .setPlatformSetUp(orc::setUpInactivePlatform)
      .setObjectLinkingLayerCreator(make_linking_layer)
      .create();
}

/// Functions of the C library that LLVM itself calls for operations which a machine lacks, and those of the library.
llvm::Error define_externals(orc::LLJIT& jit) {
  orc::SymbolMap symbols;
  const auto define = [&](const char* name, auto* address) {
    symbols[jit.mangleAndIntern(name)] = {orc::ExecutorAddr::fromPtr(address), llvm::JITSymbolFlags::Exported};
  };
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
  return jit.getMainJITDylib().define(orc::absoluteSymbols(std::move(symbols)));
}

} // namespace

JitCode::JitCode() = default;
JitCode::~JitCode() = default;
JitCode::JitCode(JitCode&&) noexcept = default;
JitCode& JitCode::operator=(JitCode&&) noexcept = default;

JitCode JitCode::load(std::string object) {
  JitCode code;
  const auto failed = [&](llvm::Error error) {
    if (!error) return false;
    code.error_ = llvm::toString(std::move(error));
    return true;
  };
  auto jit = make_jit();
  if (!jit) {
    failed(jit.takeError());
    return code;
  }
  if (failed(define_externals(**jit))) return code;
  if (failed((*jit)->addObjectFile(llvm::MemoryBuffer::getMemBufferCopy(object, "shader")))) return code;
  code.session_ = std::make_unique<Session>(Session{std::move(*jit)});
  return code;
}

void* JitCode::function(const std::string& symbol) const {
  auto address = session_->jit->lookup(symbol);
  if (!address) {
    llvm::consumeError(address.takeError());
    return nullptr;
  }
  return address->toPtr<void*>();
}

} // namespace moonshade
