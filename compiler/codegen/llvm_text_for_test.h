// Passes over LLVM's modules, tested as text before and after.
#pragma once

#include <llvm/AsmParser/Parser.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Support/SourceMgr.h>
#include <llvm/Support/raw_ostream.h>

#include <memory>
#include <string>

namespace moonshade::codegen {

/// The function `f` of a module's text as `pass` leaves it; or what is wrong with the text or with the result.
template <class Pass> std::string function_after(const std::string& text, const Pass& pass) {
  llvm::LLVMContext context;
  llvm::SMDiagnostic diagnostic;
  const std::unique_ptr<llvm::Module> module = llvm::parseAssemblyString(text, diagnostic, context);
  if (module == nullptr) return diagnostic.getMessage().str();
  pass(*module);
  std::string result;
  llvm::raw_string_ostream stream(result);
  if (!llvm::verifyModule(*module, &stream)) module->getFunction("f")->print(stream);
  return result;
}

} // namespace moonshade::codegen
