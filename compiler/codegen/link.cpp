// Links the library's bitcode, lazily (link.h). The bitcode is optimised already.
#include "compiler/codegen/link.h"

#include "stdlib/native_library.h"

#include <set>

namespace moonshade::codegen {

namespace {

/// Derivatives have bitcode of their own.
bool is_export_of(const llvm::Function& function, unsigned width, unsigned order) {
  return function.isDeclaration() && function.getName().starts_with("ms_") &&
         function.getName().ends_with("_w" + std::to_string(width)) && export_order(function.getName()) == order;
}

bool needs_width(const llvm::Module& module, unsigned width, unsigned order) {
  for (const llvm::Function& function : module)
    if (is_export_of(function, width, order)) return true;
  return false;
}

void link_width(llvm::Module& module, LibraryContext& library, Precision precision, unsigned width, unsigned order,
                std::string& error) {
  const auto needed = [&] { return error.empty() && needs_width(module, width, order); };
  // First from what is soon read.
  const std::span<const char> small = small_bitcode(precision, width, order == 1);
  if (order < 2 && !small.empty() && needed()) library.define(module, small, error);
  if (!needed()) return;
  library.define(module,
                 order == 2   ? second_derivative_bitcode(precision)
                 : order == 1 ? derivative_bitcode(precision, width)
                              : library_bitcode(precision, width),
                 error);
}

} // namespace

void link_library(llvm::Module& module, LibraryContext& library, const Domain& domain,
                  const FunctionAttributes& attributes, std::string& error) {
  std::vector<std::string> own;
  for (const llvm::Function& function : module)
    if (!function.isDeclaration()) own.push_back(function.getName().str());
  for (const unsigned order : {0u, 1u, 2u}) {
    link_width(module, library, domain.precision, domain.width, order, error);
    if (domain.width != 1) link_width(module, library, domain.precision, 1, order, error);
  }
  if (!error.empty()) return;
  const std::set<std::string> known(own.begin(), own.end());
  for (llvm::GlobalVariable& variable : module.globals())
    if (!variable.isDeclaration()) variable.setLinkage(llvm::GlobalValue::InternalLinkage);
  for (llvm::Function& function : module) {
    if (function.isDeclaration()) {
      if (function.getName().starts_with("ms_")) error = "the library has no " + function.getName().str();
      continue;
    }
    if (known.contains(function.getName().str())) continue;
    function.setLinkage(llvm::GlobalValue::InternalLinkage);
    function.setComdat(nullptr);
    attributes.apply(function);
    function.removeFnAttr(llvm::Attribute::NoInline);
    function.removeFnAttr(llvm::Attribute::OptimizeNone);
    function.removeFnAttr(llvm::Attribute::AlwaysInline);
    function.addFnAttr(llvm::Attribute::AlwaysInline);
  }
}

} // namespace moonshade::codegen
