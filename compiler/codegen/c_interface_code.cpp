// Builds the tables that c_support.cpp reads and the functions that hand them to it (c_interface_code.h).
#include "compiler/codegen/c_interface_code.h"

#include "compiler/codegen/c_support.h"

#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/IntrinsicsAArch64.h>
#include <llvm/IR/IntrinsicsX86.h>
#include <llvm/Linker/Linker.h>
#include <llvm/Support/Error.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/TargetParser/Triple.h>

#include <limits>
#include <set>

namespace moonshade::codegen {

namespace {

class Writer {
public:
  Writer(llvm::Module& module, const CInterface& interface, const CodeInfo& code)
      : module_(module), interface_(interface), code_(code), context_(module.getContext()),
        pointer_(llvm::PointerType::get(context_, 0)), i8_(llvm::Type::getInt8Ty(context_)),
        i32_(llvm::Type::getInt32Ty(context_)), i64_(llvm::Type::getInt64Ty(context_)) {}

  void write() {
    for (size_t i = 0; i < interface_.entries.size(); ++i)
      write_entry(interface_.entries[i], code_.entries[i]);
    write_instantiate();
    write_sites();
  }

  const std::set<std::string>& visible() const { return visible_; }

private:
  // ---- constants ----

  llvm::Constant* number(uint64_t value, llvm::Type* type) { return llvm::ConstantInt::get(type, value); }

  llvm::GlobalVariable* constant(const std::string& name, llvm::Constant* contents,
                                 llvm::GlobalValue::LinkageTypes linkage) {
    auto* variable = llvm::cast<llvm::GlobalVariable>(module_.getOrInsertGlobal(name, contents->getType()));
    variable->setInitializer(contents);
    variable->setConstant(true);
    variable->setLinkage(linkage);
    return variable;
  }

  llvm::GlobalVariable* table(llvm::Constant* contents) {
    llvm::GlobalVariable* variable =
        constant("moonshade_table." + std::to_string(tables_++), contents, llvm::GlobalValue::PrivateLinkage);
    variable->setUnnamedAddr(llvm::GlobalValue::UnnamedAddr::Global);
    return variable;
  }

  llvm::Constant* text(const std::string& bytes) {
    return table(llvm::ConstantDataArray::getString(context_, bytes, true));
  }

  llvm::GlobalVariable* bytes(const std::vector<uint8_t>& values) {
    return table(llvm::ConstantDataArray::get(context_, values));
  }

  llvm::Constant* null() { return llvm::ConstantPointerNull::get(pointer_); }

  llvm::Constant* record(llvm::ArrayRef<llvm::Constant*> fields) { return llvm::ConstantStruct::getAnon(fields); }

  llvm::Constant* array(llvm::ArrayRef<llvm::Constant*> elements) {
    if (elements.empty()) return null();
    return table(llvm::ConstantArray::get(llvm::ArrayType::get(elements[0]->getType(), elements.size()), elements));
  }

  // ---- entries ----

  llvm::Constant* components(const std::vector<Component>& components) {
    std::vector<uint8_t> values;
    for (const Component& component : components)
      values.insert(values.end(), {component.size, uint8_t{component.uniform}});
    return bytes(values);
  }

  void write_entry(const CEntry& entry, const EntryCode& code) {
    std::vector<uint8_t> site_codes;
    for (const CSite& site : interface_.sites)
      site_codes.push_back(static_cast<uint8_t>(site.code));
    llvm::Constant* view =
        table(record({module_.getFunction(code.symbol), number(code.info.width, i32_),
                      number(code.info.inputs.size(), i32_), number(code.info.outputs.size(), i32_),
                      components(code.info.inputs), components(code.info.outputs), bytes(site_codes)}));
    const llvm::FunctionCallee run = support("moonshade_c_run", llvm::Type::getVoidTy(context_));
    llvm::Function* function = public_function(entry.symbol, llvm::Type::getVoidTy(context_));
    Builder builder(llvm::BasicBlock::Create(context_, "", function));
    in_default_environment(builder,
                           [&] { return builder.CreateCall(run, {view, function->getArg(0), function->getArg(1)}); });
    builder.CreateRetVoid();
  }

  // ---- instances ----

  llvm::Constant* real(double value) {
    return llvm::ConstantFP::get(llvm::Type::getDoubleTy(context_),
                                 code_.precision == Precision::F32 ? static_cast<float>(value) : value);
  }

  uint32_t kind(ValueType type) const {
    if (type == ValueType::Boolean) return kCBoolean;
    if (type == ValueType::Integer) return kCInteger;
    return code_.precision == Precision::F32 ? kCFloat : kCDouble;
  }

  llvm::Constant* row(const CParameter& parameter) {
    const ParameterInfo& info = parameter.info;
    const double infinity = std::numeric_limits<double>::infinity();
    const ValueType type = info.type.value_or(ValueType::Integer);
    llvm::Constant *error = null(), *strings = null();
    if (info.min || info.max) error = text("parameter '" + info.name + "' is outside its range");
    if (!info.type && !info.choices.empty()) error = text("parameter '" + info.name + "' is none of its choices");
    if (!info.type) strings = this->strings(info);
    return record({number(parameter.source, i32_), number(parameter.target, i32_), number(component_count(type), i32_),
                   number(info.type ? kind(type) : kCString, i32_), real(info.min.value_or(-infinity)),
                   real(info.max.value_or(infinity)), error, strings});
  }

  /// CStrings
  llvm::Constant* strings(const ParameterInfo& info) {
    std::vector<llvm::Constant*> compared, choices;
    for (const std::string& constant : info.compared)
      compared.push_back(text(constant));
    for (const Constant& choice : info.choices)
      choices.push_back(text(std::get<std::string>(choice)));
    return table(record({array(compared), number(compared.size(), i64_), array(choices), number(choices.size(), i64_),
                         text(std::get<std::string>(info.default_value))}));
  }

  template <class T> static void put(std::vector<uint8_t>& bytes, size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
  }

  void put_number(std::vector<uint8_t>& bytes, size_t offset, double value) const {
    if (code_.precision == Precision::F32)
      put(bytes, offset, static_cast<float>(value));
    else
      put(bytes, offset, value);
  }

  llvm::Constant* defaults() {
    std::vector<uint8_t> bytes(interface_.parameters_size);
    const size_t size = code_.precision == Precision::F32 ? 4 : 8;
    for (const CParameter& parameter : interface_.parameters) {
      const Constant& value = parameter.info.default_value;
      if (const auto* boolean = std::get_if<bool>(&value)) bytes[parameter.source] = *boolean;
      if (const auto* integer = std::get_if<int64_t>(&value)) {
        if (parameter.info.type == ValueType::Integer)
          put(bytes, parameter.source, *integer);
        else
          put_number(bytes, parameter.source, static_cast<double>(*integer));
      }
      if (const auto* one = std::get_if<double>(&value)) put_number(bytes, parameter.source, *one);
      if (const auto* vector = std::get_if<std::vector<double>>(&value))
        for (size_t i = 0; i < vector->size(); ++i)
          put_number(bytes, parameter.source + i * size, (*vector)[i]);
    }
    llvm::GlobalVariable* table = this->bytes(bytes);
    table->setAlignment(llvm::Align(8));
    return table;
  }

  void write_instantiate() {
    std::vector<llvm::Constant*> rows, errors;
    for (const CParameter& parameter : interface_.parameters)
      rows.push_back(row(parameter));
    for (const CSite& site : interface_.sites)
      errors.push_back(text(site.file + ":" + std::to_string(site.line) + ":" + std::to_string(site.column) +
                            ": the top level faults: " + fault_name(site.code) +
                            (site.message.empty() ? "" : ": " + site.message)));
    llvm::Constant* init = null();
    if (!code_.init_symbol.empty()) init = module_.getFunction(code_.init_symbol);
    llvm::Constant* shader = table(record({array(rows), number(rows.size(), i64_), defaults(), init, array(errors)}));
    const llvm::FunctionCallee instantiate = support("moonshade_c_instantiate", pointer_);
    llvm::Function* function = public_function(interface_.prefix + "_instantiate", pointer_);
    Builder builder(llvm::BasicBlock::Create(context_, "", function));
    builder.CreateRet(in_default_environment(
        builder, [&] { return builder.CreateCall(instantiate, {shader, function->getArg(0), function->getArg(1)}); }));
  }

  void write_sites() {
    std::vector<llvm::Constant*> sites;
    for (const CSite& site : interface_.sites)
      sites.push_back(record({text(site.file), number(site.line, i32_), number(site.column, i32_),
                              text(fault_name(site.code)), text(site.message)}));
    const std::string name = interface_.prefix + "_fault_sites";
    if (sites.empty()) return;
    llvm::Constant* contents = llvm::ConstantArray::get(llvm::ArrayType::get(sites[0]->getType(), sites.size()), sites);
    constant(name, contents, llvm::GlobalValue::ExternalLinkage);
    visible_.insert(name);
  }

  // ---- functions ----

  llvm::FunctionCallee support(const char* name, llvm::Type* result) {
    return module_.getOrInsertFunction(name, llvm::FunctionType::get(result, {pointer_, pointer_, pointer_}, false));
  }

  llvm::Function* public_function(const std::string& name, llvm::Type* result) {
    visible_.insert(name);
    return llvm::Function::Create(llvm::FunctionType::get(result, {pointer_, pointer_}, false),
                                  llvm::GlobalValue::ExternalLinkage, name, module_);
  }

  /// The default floating-point environment (runtime/floating_point.h) around what `body` emits. On machines that are
  /// not listed here the caller's is kept.
  template <class Body> llvm::Value* in_default_environment(Builder& builder, Body&& body) {
    const llvm::Triple triple(module_.getTargetTriple());
    if (triple.isX86()) {
      const auto set = [&](llvm::Value* from) {
        builder.CreateIntrinsic(llvm::Type::getVoidTy(context_), llvm::Intrinsic::x86_sse_ldmxcsr, {from});
      };
      llvm::Value* saved = builder.CreateAlloca(i32_);
      builder.CreateIntrinsic(llvm::Type::getVoidTy(context_), llvm::Intrinsic::x86_sse_stmxcsr, {saved});
      set(table(number(0x1f80, i32_))); // every exception masked, to nearest, nothing flushed
      llvm::Value* result = body();
      set(saved);
      return result;
    }
    if (triple.isAArch64()) {
      const auto set = [&](llvm::Value* value) {
        builder.CreateIntrinsic(llvm::Type::getVoidTy(context_), llvm::Intrinsic::aarch64_set_fpcr, {value});
      };
      llvm::Value* saved = builder.CreateIntrinsic(i64_, llvm::Intrinsic::aarch64_get_fpcr, {});
      set(number(0, i64_));
      llvm::Value* result = body();
      set(saved);
      return result;
    }
    return body();
  }

  llvm::Module& module_;
  const CInterface& interface_;
  const CodeInfo& code_;
  llvm::LLVMContext& context_;
  llvm::PointerType* pointer_;
  llvm::Type *i8_, *i32_, *i64_;
  std::set<std::string> visible_;
  unsigned tables_ = 0;
};

std::string link_support(llvm::Module& module) {
  const std::span<const char> bitcode = c_support_bitcode();
  auto support = llvm::getLazyBitcodeModule(
      llvm::MemoryBufferRef(llvm::StringRef(bitcode.data(), bitcode.size()), "support"), module.getContext());
  if (!support) return "the support's bitcode cannot be read: " + llvm::toString(support.takeError());
  (*support)->setTargetTriple(module.getTargetTriple());
  (*support)->setDataLayout(module.getDataLayout());
  if (llvm::Linker::linkModules(module, std::move(*support), llvm::Linker::LinkOnlyNeeded))
    return "the support's bitcode cannot be linked";
  return "";
}

} // namespace

std::string add_c_interface(llvm::Module& module, const CInterface& interface, const CodeInfo& code,
                            const FunctionAttributes& attributes) {
  std::set<const llvm::Function*> finished;
  for (const llvm::Function& function : module)
    if (!function.isDeclaration()) finished.insert(&function);
  Writer writer(module, interface, code);
  writer.write();
  if (std::string error = link_support(module); !error.empty()) return error;
  for (llvm::Function& function : module) {
    if (function.isDeclaration()) {
      // What only this library has, and an object can do without no more than a program with it can.
      if (function.getName().starts_with("moonshade_") && !function.use_empty())
        return "the shader calls " + function.getName().str() + ", which an object file cannot bring along";
      continue;
    }
    if (!finished.contains(&function)) attributes.apply(function);
    if (writer.visible().contains(function.getName().str())) continue;
    function.setLinkage(llvm::GlobalValue::InternalLinkage);
    function.setComdat(nullptr);
  }
  for (llvm::GlobalVariable& variable : module.globals())
    if (!variable.isDeclaration() && !variable.hasPrivateLinkage() &&
        !writer.visible().contains(variable.getName().str()))
      variable.setLinkage(llvm::GlobalValue::InternalLinkage);
  return "";
}

} // namespace moonshade::codegen
