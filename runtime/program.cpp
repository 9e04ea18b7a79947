// Compiled programs and their instances (shader.h): blocks of constants, batch calls, prints.
#include "compiler/codegen/print.h"
#include "runtime/compiled.h"
#include "runtime/floating_point.h"
#include "runtime/image_set.h"
#include "runtime/parameters.h"
#include "runtime/print_text.h"

#include <cstring>
#include <sstream>

namespace moonshade {

namespace {

/// Where the lines of one call go; its address stands behind the constants.
struct PrintContext {
  const Code* code;
  const PrintSink* sink;
};

/// One instance's constants; aligned for any element.
struct Constants {
  explicit Constants(uint64_t size) : bytes(new std::byte[size]()) {}
  std::unique_ptr<std::byte[]> bytes;
};

/// The constants of an instance, with the parameters' values and what the top level gives; or its fault.
Constants make_constants(const Compiled& compiled, const std::vector<Constant>& values, const ImageSet& images,
                         uint32_t& fault);

class CompiledShader final : public Shader {
public:
  CompiledShader(std::shared_ptr<const Compiled> compiled, Constants constants, std::vector<Constant> parameters,
                 std::shared_ptr<const ImageSet> images)
      : compiled_(std::move(compiled)), constants_(std::move(constants)), parameters_(std::move(parameters)),
        images_(std::move(images)) {}

  const ShaderInfo& info() const override { return compiled_->info; }
  Precision precision() const override { return compiled_->code().info.precision; }
  unsigned width() const override { return compiled_->code().info.width; }

  void run(size_t entry, const Batch& batch) const override {
    const Code& code = compiled_->code(); // to the end of the batch, whatever takes its place meanwhile
    const DefaultFloatingPoint environment;
    codegen::BatchFaults faults;
    const codegen::KernelBatch call{batch.count, batch.inputs, batch.outputs, constants_.bytes.get(), nullptr};
    codegen::run_batch(code.kernels[entry], code.info.entries[entry].info, call, faults, batch.fault_codes);
    if (batch.faults == nullptr || faults.count == 0) return;
    *batch.faults = {faults.count, faults.first_point, code.info.places[faults.first_site].code, faults.first_site};
  }

  FaultSite fault_site(uint32_t site) const override {
    return site < compiled_->sites.size() ? compiled_->sites[site] : FaultSite{};
  }

  bool has_prints() const override { return compiled_->has_prints; }

  void print(size_t entry, const Batch& batch, uint64_t point, const PrintSink& sink) const override {
    const std::shared_ptr<const Compiled> printing = has_prints() ? printing_code(*compiled_) : nullptr;
    if (printing == nullptr) return;
    const Code& code = printing->code();
    const codegen::KernelInfo& info = code.info.entries[entry].info;
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
    const Constants constants = make_constants(*printing, parameters_, *images_, fault);
    const PrintContext context{&code, &sink};
    const PrintContext* address = &context;
    std::memcpy(constants.bytes.get() + code.info.print_slot, static_cast<void*>(&address), sizeof address);
    const DefaultFloatingPoint environment;
    codegen::BatchFaults faults;
    codegen::run_batch(code.kernels[entry], info, {1, inputs.data(), outputs.data(), constants.bytes.get(), nullptr},
                       faults, nullptr);
  }

private:
  std::shared_ptr<const Compiled> compiled_;
  Constants constants_;
  std::vector<Constant> parameters_; ///< their values
  std::shared_ptr<const ImageSet> images_;
};

void store_number(std::byte* target, Precision precision, double value) {
  const auto narrow = static_cast<float>(value);
  if (precision == Precision::F32)
    std::memcpy(target, &narrow, sizeof narrow);
  else
    std::memcpy(target, &value, sizeof value);
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

Constants make_constants(const Compiled& compiled, const std::vector<Constant>& values, const ImageSet& images,
                         uint32_t& fault) {
  const Code& code = compiled.code();
  Constants constants(code.info.block_size());
  const ImageSet* address = &images;
  std::memcpy(constants.bytes.get() + code.info.image_slot, static_cast<void*>(&address), sizeof address);
  for (const ParameterSlot& slot : compiled.slots)
    store_constant(constants.bytes.get() + slot.offset, slot.type, code.info.precision,
                   stored_value(compiled.info.parameters[slot.parameter], values[slot.parameter]));
  const DefaultFloatingPoint environment;
  if (code.init != nullptr) codegen::call_init(code.init, constants.bytes.get(), fault);
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
  unsigned width() const override { return compiled_->code().info.width; }
  const CompileTimes& times() const override { return compiled_->times; }
  bool is_quick() const override { return compiled_->is_quick && &compiled_->code() == compiled_->first_code.get(); }

  Instantiation instantiate(const std::map<std::string, Constant>& parameters) const override {
    std::vector<Constant> values;
    if (std::string error = parameter_values(compiled_->info, parameters, values); !error.empty())
      return {nullptr, error};
    std::string error;
    const auto images = ImageSet::open(compiled_->info, values, compiled_->opener, error);
    if (images == nullptr) return {nullptr, error};
    uint32_t fault = 0;
    Constants constants = make_constants(*compiled_, values, *images, fault);
    if (fault != 0)
      return {nullptr, describe(compiled_->sites[fault - 1], compiled_->code().info.places[fault - 1].code)};
    return {std::make_shared<CompiledShader>(compiled_, std::move(constants), std::move(values), images), ""};
  }

private:
  std::shared_ptr<const Compiled> compiled_;
};

} // namespace

extern "C" void codegen::moonshade_print(void* sink, uint32_t place, const uint64_t* components) {
  if (sink == nullptr) return;
  const auto& context = *static_cast<const PrintContext*>(sink);
  const codegen::PrintPlaceInfo& print = context.code->info.prints[place];
  (*context.sink)(print_line(print.text, print.types, components));
}

std::shared_ptr<const Program> make_program(std::shared_ptr<const Compiled> compiled) {
  return std::make_shared<CompiledProgram>(std::move(compiled));
}

} // namespace moonshade
