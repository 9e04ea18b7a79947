// Compiled programs and their instances (shader.h): the JIT's code, blocks of constants, batch calls.
#include "compiler/codegen/batch.h"
#include "compiler/codegen/codegen.h"
#include "compiler/codegen/print.h"
#include "runtime/floating_point.h"
#include "runtime/frontend_parts.h"
#include "runtime/gradients.h"
#include "runtime/jit.h"
#include "runtime/print_text.h"
#include "runtime/shader.h"
#include "runtime/stopwatch.h"

#include <llvm/Config/llvm-config.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <optional>
#include <sstream>

namespace moonshade {

namespace {

/// Where a parameter's value goes in the block of constants.
struct ParameterSlot {
  size_t parameter; ///< index into ShaderInfo::parameters
  ValueType type;
  uint64_t offset;
};

/// What the instances of a program share.
struct Compiled {
  std::optional<JitCode> code;
  codegen::CodeInfo generated;
  ShaderInfo info;
  std::vector<codegen::Kernel> kernels; ///< by entry
  codegen::Init init = nullptr;
  std::vector<ParameterSlot> slots;
  std::vector<FaultSite> sites;
  CompileTimes times;

  // Where the shader prints: what the code that prints is made of, once somebody asks for it.
  std::shared_ptr<const ir::Module> with_prints; ///< null: it does not print
  CompileOptions options;
  mutable std::once_flag printing_made;
  mutable std::shared_ptr<const Compiled> printing; ///< null then: it could not be made
};

/// Where the lines of one call go; its address stands behind the constants.
struct PrintContext {
  const Compiled* compiled;
  const PrintSink* sink;
};

/// One instance's constants; aligned for any element.
struct Constants {
  explicit Constants(uint64_t size) : bytes(new std::byte[size]()) {}
  std::unique_ptr<std::byte[]> bytes;
};

std::shared_ptr<const Compiled> printing_code(const Compiled& compiled);
/// The constants of an instance, with the parameters' values and what the top level gives; or its fault.
Constants make_constants(const Compiled& compiled, const std::vector<Constant>& values, uint32_t& fault);

class CompiledShader final : public Shader {
public:
  CompiledShader(std::shared_ptr<const Compiled> compiled, Constants constants, std::vector<Constant> parameters)
      : compiled_(std::move(compiled)), constants_(std::move(constants)), parameters_(std::move(parameters)) {}

  const ShaderInfo& info() const override { return compiled_->info; }
  Precision precision() const override { return compiled_->generated.precision; }
  unsigned width() const override { return compiled_->generated.width; }

  void run(size_t entry, const Batch& batch) const override {
    const DefaultFloatingPoint environment;
    codegen::BatchFaults faults;
    const codegen::KernelBatch call{batch.count, batch.inputs, batch.outputs, constants_.bytes.get(), nullptr};
    codegen::run_batch(compiled_->kernels[entry], compiled_->generated.entries[entry].info, call, faults,
                       batch.fault_codes);
    if (batch.faults == nullptr || faults.count == 0) return;
    *batch.faults = {faults.count, faults.first_point, compiled_->generated.places[faults.first_site].code,
                     faults.first_site};
  }

  FaultSite fault_site(uint32_t site) const override {
    return site < compiled_->sites.size() ? compiled_->sites[site] : FaultSite{};
  }

  bool has_prints() const override { return compiled_->with_prints != nullptr; }

  void print(size_t entry, const Batch& batch, uint64_t point, const PrintSink& sink) const override {
    const std::shared_ptr<const Compiled> code = has_prints() ? printing_code(*compiled_) : nullptr;
    if (code == nullptr) return;
    const codegen::KernelInfo& info = code->generated.entries[entry].info;
    std::vector<const void*> inputs;
    for (size_t i = 0; i < info.inputs.size(); ++i) {
      const size_t offset = info.inputs[i].uniform ? 0 : info.inputs[i].size * point;
      inputs.push_back(static_cast<const std::byte*>(batch.inputs[i]) + offset);
    }
    std::vector<uint64_t> results(info.outputs.size());
    std::vector<void*> outputs;
    for (uint64_t& result : results)
      outputs.push_back(&result);
    uint32_t fault = 0;
    const Constants constants = make_constants(*code, parameters_, fault);
    const PrintContext context{code.get(), &sink};
    const PrintContext* address = &context;
    std::memcpy(constants.bytes.get() + code->generated.print_slot, static_cast<void*>(&address), sizeof address);
    const DefaultFloatingPoint environment;
    codegen::BatchFaults faults;
    codegen::run_batch(code->kernels[entry], info, {1, inputs.data(), outputs.data(), constants.bytes.get(), nullptr},
                       faults, nullptr);
  }

private:
  std::shared_ptr<const Compiled> compiled_;
  Constants constants_;
  std::vector<Constant> parameters_; ///< their values
};

void store_number(std::byte* target, Precision precision, double value) {
  const auto narrow = static_cast<float>(value);
  if (precision == Precision::F32)
    std::memcpy(target, &narrow, sizeof narrow);
  else
    std::memcpy(target, &value, sizeof value);
}

/// What compiled code gets: of a string its index.
Constant stored_value(const ParameterInfo& parameter, const Constant& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? Constant(compared_index(parameter, *text)) : value;
}

/// Writes a value that check_override has passed.
void store_constant(std::byte* target, ValueType type, Precision precision, const Constant& value) {
  const size_t size = precision == Precision::F32 ? sizeof(float) : sizeof(double);
  if (const auto* boolean = std::get_if<bool>(&value)) {
    *target = std::byte{*boolean};
  } else if (const auto* integer = std::get_if<int64_t>(&value)) {
    if (type == ValueType::Integer)
      std::memcpy(target, integer, sizeof *integer);
    else
      store_number(target, precision, static_cast<double>(*integer));
  } else if (const auto* number = std::get_if<double>(&value)) {
    store_number(target, precision, *number);
  } else if (const auto* vector = std::get_if<std::vector<double>>(&value)) {
    for (size_t c = 0; c < vector->size() && c < component_count(type); ++c)
      store_number(target + c * size, precision, (*vector)[c]);
  }
}

Constants make_constants(const Compiled& compiled, const std::vector<Constant>& values, uint32_t& fault) {
  Constants constants(compiled.generated.constants_size + sizeof(PrintContext*));
  for (const ParameterSlot& slot : compiled.slots)
    store_constant(constants.bytes.get() + slot.offset, slot.type, compiled.generated.precision,
                   stored_value(compiled.info.parameters[slot.parameter], values[slot.parameter]));
  const DefaultFloatingPoint environment;
  if (compiled.init != nullptr) codegen::call_init(compiled.init, constants.bytes.get(), fault);
  return constants;
}

std::string describe(const FaultSite& site, FaultCode code) {
  std::ostringstream text;
  text << site.file << ':' << site.line << ':' << site.column << ": the top level faults: " << fault_name(code);
  if (!site.message.empty()) text << ": " << site.message;
  return text.str();
}

class CompiledProgram final : public Program {
public:
  explicit CompiledProgram(std::shared_ptr<const Compiled> compiled) : compiled_(std::move(compiled)) {}

  const ShaderInfo& info() const override { return compiled_->info; }
  unsigned width() const override { return compiled_->generated.width; }
  const CompileTimes& times() const override { return compiled_->times; }

  Instantiation instantiate(const std::map<std::string, Constant>& parameters) const override {
    std::vector<Constant> values;
    if (std::string error = parameter_values(parameters, values); !error.empty()) return {nullptr, error};
    uint32_t fault = 0;
    Constants constants = make_constants(*compiled_, values, fault);
    if (fault != 0)
      return {nullptr, describe(compiled_->sites[fault - 1], compiled_->generated.places[fault - 1].code)};
    return {std::make_shared<CompiledShader>(compiled_, std::move(constants), std::move(values)), ""};
  }

private:
  /// The value of each parameter: as given, or its default.
  std::string parameter_values(const std::map<std::string, Constant>& given, std::vector<Constant>& values) const {
    const std::vector<ParameterInfo>& parameters = compiled_->info.parameters;
    for (const auto& [name, value] : given)
      if (std::ranges::find(parameters, name, &ParameterInfo::name) == parameters.end())
        return "the shader has no parameter '" + name + "'";
    for (const ParameterInfo& parameter : parameters) {
      const auto override_value = given.find(parameter.name);
      if (override_value == given.end()) {
        values.push_back(parameter.default_value);
        continue;
      }
      CheckedConstant checked = check_override(parameter, override_value->second);
      if (!checked.error.empty()) return checked.error;
      values.push_back(std::move(checked.value));
    }
    return {};
  }

  std::shared_ptr<const Compiled> compiled_;
};

std::string diagnostics_text(const CheckedShader& shader, bool color) {
  std::ostringstream text;
  print_text(shader.diagnostics(), shader.sources(), text, color);
  return text.str();
}

/// What code generation refused, as a diagnostic of the file where it concerns the shader.
std::string refusal(const CheckedShader& shader, const codegen::Generated& generated, bool color) {
  if (generated.exceeded_limit == 0) return "error: " + generated.error + "\n";
  Diagnostics diagnostics;
  diagnostics.report(DiagnosticCode::TooLarge, Span{FileId{0}, 0, 0},
                     {generated.error, std::to_string(generated.exceeded_limit)});
  std::ostringstream text;
  print_text(diagnostics, shader.sources(), text, color);
  return text.str();
}

/// Loads the object code; the error where that fails.
std::string load(Compiled& compiled, std::string object) {
  compiled.code = JitCode::load(std::move(object));
  if (!compiled.code->error().empty()) return compiled.code->error();
  for (const codegen::EntryCode& entry : compiled.generated.entries) {
    auto* kernel = reinterpret_cast<codegen::Kernel>(compiled.code->function(entry.symbol));
    if (kernel == nullptr) return "the code of '" + entry.symbol + "' cannot be linked";
    compiled.kernels.push_back(kernel);
  }
  if (compiled.generated.init_symbol.empty()) return {};
  void* init = compiled.code->function(compiled.generated.init_symbol);
  compiled.init = reinterpret_cast<codegen::Init>(init);
  return compiled.init == nullptr ? "the code of the top level cannot be linked" : "";
}

void find_slots(Compiled& compiled, const ir::Module& module) {
  for (size_t i = 0; i < module.globals.size(); ++i)
    if (const ir::Global& global = module.globals[i]; global.parameter != ir::kNone)
      compiled.slots.push_back({global.parameter, global.type, compiled.generated.global_offsets[i]});
}

std::shared_ptr<const Compiled> make_printing_code(const Compiled& compiled) {
  ir::Module module = *compiled.with_prints;
  ir::optimize(module, compiled.options.precision);
  codegen::Options options = codegen_options(compiled.options);
  options.width = 1;
  options.prints = true;
  codegen::Generated generated = codegen::generate(module, options);
  std::string object;
  if (generated.error.empty()) object = generated.object();
  if (!generated.error.empty()) return nullptr;
  auto printing = std::make_shared<Compiled>();
  printing->generated = std::move(generated.info);
  printing->info = compiled.info;
  find_slots(*printing, module);
  return load(*printing, std::move(object)).empty() ? printing : nullptr;
}

std::shared_ptr<const Compiled> printing_code(const Compiled& compiled) {
  std::call_once(compiled.printing_made, [&] { compiled.printing = make_printing_code(compiled); });
  return compiled.printing;
}

} // namespace

extern "C" void codegen::moonshade_print(void* sink, uint32_t place, const uint64_t* components) {
  if (sink == nullptr) return;
  const auto& context = *static_cast<const PrintContext*>(sink);
  const codegen::PrintPlaceInfo& print = context.compiled->generated.prints[place];
  (*context.sink)(print_line(print.text, print.types, components));
}

Compilation compile(const CheckedShader& shader, const CompileOptions& options) {
  Stopwatch watch;
  std::string diagnostics = diagnostics_text(shader, options.color_diagnostics);
  if (!shader.ok()) return {nullptr, diagnostics};
  auto compiled = std::make_shared<Compiled>();
  CompileTimes& times = compiled->times;
  times.parse = shader.parts().parse_milliseconds;
  times.sema = shader.parts().sema_milliseconds;
  watch.lap();
  ir::Module module = build_printing_module(shader, options);
  if (ir::has_prints(module)) {
    compiled->with_prints = std::make_shared<const ir::Module>(module);
    compiled->options = options;
    ir::remove_prints(module);
  }
  ir::optimize(module, options.precision);
  times.ir = watch.lap();
  codegen::Generated generated = codegen::generate(module, codegen_options(options));
  times.emit = generated.times.emit;
  times.optimize = generated.times.optimize;
  watch.lap();
  std::string object;
  if (generated.error.empty() && !generated.runs_here)
    generated.error = "code for '" + (options.target.empty() ? options.cpu : options.target) + "' does not run on this machine";
  if (generated.error.empty()) object = generated.object();
  if (!generated.error.empty()) return {nullptr, diagnostics + refusal(shader, generated, options.color_diagnostics)};
  compiled->generated = std::move(generated.info);
  compiled->info = compiled_info(shader.info(), module, options);
  find_slots(*compiled, module);
  for (const codegen::FaultPlaceInfo& place : compiled->generated.places)
    compiled->sites.push_back(resolve(shader.sources(), place));
  if (std::string error = load(*compiled, std::move(object)); !error.empty())
    return {nullptr, diagnostics + "error: " + error + "\n"};
  times.codegen = watch.lap();
  times.total = times.parse + times.sema + times.ir + times.emit + times.optimize + times.codegen;
  return {std::make_shared<CompiledProgram>(std::move(compiled)), std::move(diagnostics)};
}

Compilation compile(const std::string& name, const std::string& text, const CompileOptions& options) {
  return compile(CheckedShader(name, text, options.entries, options.modules), options);
}

unsigned native_width(Precision precision) { return codegen::native_width(precision); }

std::string version() { return "moonshade " MOONSHADE_VERSION " (LLVM " LLVM_VERSION_STRING ")"; }

} // namespace moonshade
