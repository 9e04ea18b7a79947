#include "compiler/codegen/library_context.h"

#include "compiler/codegen/idle.h"

#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Support/Error.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/ValueMapper.h>

#include <vector>

namespace moonshade::codegen {

namespace {

/// Operations of the IR after which a context is made anew: some hundred shaders, or a megabyte.
constexpr uint64_t kMostOperations = 10'000;

Idle<LibraryContext>& idle_contexts() {
  static auto* contexts = new Idle<LibraryContext>;
  return *contexts;
}

/// Copies functions from one module to another of the same context, with all that they refer to.
class Copying : llvm::ValueMaterializer {
public:
  explicit Copying(llvm::Module& to) : to_(to) {}

  /// The function, which is only declared, becomes a copy of the other.
  void define(llvm::Function& declaration, llvm::Function& from) {
    values_[&from] = &declaration;
    wanted_.push_back(&from);
    while (!wanted_.empty() && error.empty()) {
      llvm::Function* next = wanted_.back();
      wanted_.pop_back();
      copy_body(*llvm::cast<llvm::Function>(values_.lookup(next)), *next);
    }
  }

  std::string error;

private:
  void copy_body(llvm::Function& to, llvm::Function& from) {
    if (llvm::Error problem = from.materialize()) {
      error = llvm::toString(std::move(problem));
      return;
    }
    to.setLinkage(from.getLinkage());
    auto* argument = to.arg_begin();
    for (llvm::Argument& original : from.args())
      values_[&original] = &*argument++;
    llvm::SmallVector<llvm::ReturnInst*, 4> returns;
    llvm::CloneFunctionInto(&to, &from, values_, llvm::CloneFunctionChangeType::DifferentModule, returns, "", nullptr,
                            nullptr, this);
  }

  /// What stands for a function or variable of the other module; anything else stands for itself.
  llvm::Value* materialize(llvm::Value* value) override {
    if (auto* function = llvm::dyn_cast<llvm::Function>(value)) return declare(*function);
    auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(value);
    if (variable == nullptr) return nullptr;
    auto* copy = new llvm::GlobalVariable(to_, variable->getValueType(), variable->isConstant(), variable->getLinkage(),
                                          nullptr, variable->getName());
    copy->copyAttributesFrom(variable);
    if (variable->hasInitializer())
      copy->setInitializer(llvm::MapValue(variable->getInitializer(), values_, llvm::RF_None, nullptr, this));
    return copy;
  }

  llvm::Function* declare(llvm::Function& function) {
    llvm::Function* known = to_.getFunction(function.getName());
    if (known != nullptr && (function.isIntrinsic() || !known->isDeclaration())) return known;
    if (known == nullptr) {
      known = llvm::Function::Create(function.getFunctionType(), function.getLinkage(), function.getName(), to_);
      known->copyAttributesFrom(&function);
    }
    if (!function.isDeclaration()) wanted_.push_back(&function);
    return known;
  }

  llvm::Module& to_;
  llvm::ValueToValueMapTy values_;
  std::vector<llvm::Function*> wanted_; ///< bodies that are still to be copied
};

} // namespace

bool LibraryContext::is_worn() const { return operations_ > kMostOperations; }

std::shared_ptr<LibraryContext> LibraryContext::take(uint64_t operations) {
  std::unique_ptr<LibraryContext> taken = idle_contexts().take("");
  if (taken == nullptr) taken = std::make_unique<LibraryContext>();
  taken->operations_ += operations;
  return {taken.release(), [](LibraryContext* done) {
            std::unique_ptr<LibraryContext> context(done);
            context->context.setDiagnosticHandlerCallBack(nullptr); // which knows its compilation
            if (!context->is_worn()) idle_contexts().give_back("", std::move(context));
          }};
}

void LibraryContext::define(llvm::Module& module, std::span<const char> bitcode, std::string& error) {
  std::unique_ptr<llvm::Module>& library = read_[bitcode.data()];
  if (library == nullptr) {
    const llvm::MemoryBufferRef buffer(llvm::StringRef(bitcode.data(), bitcode.size()), "library");
    auto read = llvm::getLazyBitcodeModule(buffer, context);
    if (!read) {
      error = "the library's bitcode cannot be read: " + llvm::toString(read.takeError());
      return;
    }
    library = std::move(*read);
  }
  Copying copying(module);
  std::vector<llvm::Function*> lacking;
  for (llvm::Function& function : module)
    if (function.isDeclaration() && !function.isIntrinsic()) lacking.push_back(&function);
  for (llvm::Function* function : lacking)
    if (llvm::Function* found = library->getFunction(function->getName());
        found != nullptr && !found->isDeclaration() && function->isDeclaration())
      copying.define(*function, *found);
  if (!copying.error.empty()) error = "the library's bitcode cannot be read: " + copying.error;
  // A list without anything in it, which copying leaves.
  if (llvm::NamedMDNode* units = module.getNamedMetadata("llvm.dbg.cu")) module.eraseNamedMetadata(units);
}

} // namespace moonshade::codegen
