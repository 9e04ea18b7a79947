// A program of the build: from the bitcode of one domain's exports it makes
//
//     ms_split_exports native NAME IN.bc OUT.bc
//         the same functions as bitcode to be compiled to machine code, which compiled shaders call where inlining a
//         function is not worth its time (native_library.h). They become internal to their file, so that they do
//         not meet the bitcode's own names anywhere; what is visible is one table of them, sorted by name:
//         moonshade_native_NAME.
//     ms_split_exports small LIMIT IN.bc OUT.bc
//         the exports of at most LIMIT instructions alone, bitcode that is read in a fraction of the time.
#include <llvm/Bitcode/BitcodeWriter.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>
#include <llvm/IRReader/IRReader.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/SourceMgr.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Transforms/IPO/GlobalDCE.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace {

/// Whether it asks for tables in registers (gather.ll.in), which only the code generator can give it.
bool asks_for_tables(const llvm::Function& function) {
  for (const llvm::BasicBlock& block : function)
    for (const llvm::Instruction& instruction : block)
      if (const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
          call != nullptr && call->getCalledFunction() != nullptr &&
          call->getCalledFunction()->getName() == "moonshade_target_has_tables")
        return true;
  return false;
}

/// { const char* name; void* address; uint32_t instructions; uint32_t asks_for_tables; }, as in native_library.h.
llvm::Constant* row(llvm::Module& module, llvm::StructType* type, llvm::Function& function) {
  llvm::LLVMContext& context = module.getContext();
  llvm::Constant* text = llvm::ConstantDataArray::getString(context, function.getName());
  auto* name = new llvm::GlobalVariable(module, text->getType(), true, llvm::GlobalValue::PrivateLinkage, text);
  llvm::Type* i32 = llvm::Type::getInt32Ty(context);
  return llvm::ConstantStruct::get(type, {name, &function, llvm::ConstantInt::get(i32, function.getInstructionCount()),
                                          llvm::ConstantInt::get(i32, asks_for_tables(function) ? 1 : 0)});
}

void make_table(llvm::Module& module, const std::string& name) {
  std::vector<llvm::Function*> exports;
  for (llvm::Function& function : module)
    if (!function.isDeclaration() && function.hasExternalLinkage()) exports.push_back(&function);
  std::ranges::sort(exports, {}, [](const llvm::Function* function) { return function->getName(); });
  llvm::LLVMContext& context = module.getContext();
  llvm::Type *pointer = llvm::PointerType::get(context, 0), *i32 = llvm::Type::getInt32Ty(context);
  auto* type = llvm::StructType::get(context, {pointer, pointer, i32, i32});
  std::vector<llvm::Constant*> rows;
  for (llvm::Function* function : exports) {
    rows.push_back(row(module, type, *function));
    function->removeFnAttr(llvm::Attribute::AlwaysInline);
    function->setComdat(nullptr);
    function->setLinkage(llvm::GlobalValue::InternalLinkage);
  }
  auto* array = llvm::ConstantArray::get(llvm::ArrayType::get(type, rows.size()), rows);
  auto* all = llvm::ConstantStruct::getAnon(
      {llvm::ConstantInt::get(llvm::Type::getInt64Ty(context), rows.size()),
       new llvm::GlobalVariable(module, array->getType(), true, llvm::GlobalValue::PrivateLinkage, array)});
  auto* table = new llvm::GlobalVariable(module, all->getType(), true, llvm::GlobalValue::ExternalLinkage, all,
                                         "moonshade_native_" + name);
  table->setVisibility(llvm::GlobalValue::HiddenVisibility);
}

void drop_large_exports(llvm::Module& module, size_t limit) {
  for (llvm::Function& function : llvm::make_early_inc_range(module))
    if (function.hasExternalLinkage() && !function.isDeclaration() && function.getInstructionCount() > limit)
      function.eraseFromParent(); // exports call no exports
  llvm::ModuleAnalysisManager analyses;
  llvm::FunctionAnalysisManager functions;
  llvm::PassBuilder builder;
  builder.registerModuleAnalyses(analyses);
  builder.registerFunctionAnalyses(functions);
  analyses.registerPass([&] { return llvm::FunctionAnalysisManagerModuleProxy(functions); });
  functions.registerPass([&] { return llvm::ModuleAnalysisManagerFunctionProxy(analyses); });
  llvm::GlobalDCEPass().run(module, analyses);
  for (llvm::Function& function : llvm::make_early_inc_range(module))
    if (function.isDeclaration() && function.use_empty()) function.eraseFromParent();
}

} // namespace

int main(int argc, char** argv) {
  const std::string mode = argc == 5 ? argv[1] : "";
  if (mode != "native" && mode != "small")
    return llvm::errs() << "usage: ms_split_exports native|small NAME|LIMIT IN.bc OUT.bc\n", 2;
  llvm::LLVMContext context;
  context.setDiscardValueNames(true);
  llvm::SMDiagnostic problem;
  const std::unique_ptr<llvm::Module> module = llvm::parseIRFile(argv[3], problem, context);
  if (module == nullptr) return problem.print(argv[0], llvm::errs()), 1;
  if (mode == "native")
    make_table(*module, argv[2]);
  else
    drop_large_exports(*module, std::strtoul(argv[2], nullptr, 10));
  std::error_code error;
  llvm::raw_fd_ostream out(argv[4], error);
  if (error) return llvm::errs() << argv[4] << ": " << error.message() << "\n", 1;
  llvm::WriteBitcodeToFile(*module, out);
  return 0;
}
