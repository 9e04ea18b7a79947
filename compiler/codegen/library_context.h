// LLVM's context of a compilation, and the library's bitcode in it.
#pragma once

#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>

#include <map>
#include <memory>
#include <span>
#include <string>

namespace moonshade::codegen {

/// Reading the names and types of the library's functions takes longer than to copy those that a shader needs, so what
/// has been read stays in its context for the next compilation there.
class LibraryContext {
public:
  /// Nobody else's meanwhile. `operations`: how much is to be compiled in it.
  static std::shared_ptr<LibraryContext> take(uint64_t operations);

  llvm::LLVMContext context;

  /// Defines what the module, which is of this context, lacks and the bitcode has.
  void define(llvm::Module& module, std::span<const char> bitcode, std::string& error);

private:
  /// A context keeps the types and constants of all that was compiled in it.
  bool is_worn() const;

  std::map<const char*, std::unique_ptr<llvm::Module>> read_; ///< by where the bitcode lies; gone before the context
  uint64_t operations_ = 0;                                   ///< compiled here so far
};

} // namespace moonshade::codegen
