// For tests: compiled kernels over columns (kernel_harness.h).
#include "runtime/kernel_harness.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace moonshade::testing {

namespace {

/// The elements of a column as the kernel reads them.
std::vector<std::byte> elements(const Column& column, Precision precision) {
  std::vector<std::byte> bytes;
  const auto append = [&](auto value) {
    const auto* begin = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof(value));
  };
  for (const int64_t integer : column.integers) {
    if (column.type == ValueType::Boolean)
      append(static_cast<uint8_t>(integer));
    else
      append(integer);
  }
  for (const double number : column.numbers) {
    if (precision == Precision::F32)
      append(static_cast<float>(number));
    else
      append(number);
  }
  // Exactly as long as it must be, so that a sanitizer sees a read beyond.
  bytes.shrink_to_fit();
  return bytes;
}

uint64_t bits_of(const std::byte* element, size_t size, bool number) {
  uint64_t bits = 0;
  std::memcpy(&bits, element, size);
  if (number && size == 4 && std::isnan(std::bit_cast<float>(static_cast<uint32_t>(bits)))) return 0x7fc00000;
  if (number && size == 8 && std::isnan(std::bit_cast<double>(bits))) return 0x7ff8000000000000;
  return bits;
}

std::string object_of(codegen::Generated& generated) {
  EXPECT_EQ(generated.error, "");
  return generated.object();
}

} // namespace

Column numbers(std::vector<double> values) { return {ValueType::Number, std::move(values), {}}; }
Column integers(std::vector<int64_t> values) { return {ValueType::Integer, {}, std::move(values)}; }

double Outcome::number(size_t component, size_t point, Precision precision) const {
  const uint64_t value = bits[component][point];
  return precision == Precision::F32 ? std::bit_cast<float>(static_cast<uint32_t>(value))
                                     : std::bit_cast<double>(value);
}

CompiledModule::CompiledModule(const ir::Module& module, codegen::Options options)
    : generated(codegen::generate(module, options)), constants(generated.info.constants_size + 64),
      code_(JitCode::load(object_of(generated))) {
  EXPECT_EQ(code_.error(), "");
  for (const ir::Entry& entry : module.entries) {
    number_outputs_.emplace_back();
    for (const ValueType type : module.functions[entry.function].results)
      number_outputs_.back().insert(number_outputs_.back().end(), component_count(type),
                                    type != ValueType::Boolean && type != ValueType::Integer);
  }
}

uint32_t CompiledModule::initialise() {
  uint32_t fault = 0;
  auto* init = reinterpret_cast<codegen::Init>(code_.function(generated.info.init_symbol));
  codegen::call_init(init, constants.data(), fault);
  return fault;
}

Outcome CompiledModule::run(const std::vector<Column>& inputs, uint64_t count, size_t entry) const {
  const codegen::KernelInfo& info = generated.info.entries[entry].info;
  auto* kernel = reinterpret_cast<codegen::Kernel>(code_.function(generated.info.entries[entry].symbol));
  std::vector<std::vector<std::byte>> in, out;
  std::vector<const void*> in_pointers;
  std::vector<void*> out_pointers;
  for (const Column& column : inputs)
    in.push_back(elements(column, generated.info.precision));
  for (const auto& bytes : in)
    in_pointers.push_back(bytes.data());
  for (const codegen::Component& component : info.outputs)
    out.emplace_back(component.size * count, std::byte{0xee});
  for (auto& bytes : out)
    out_pointers.push_back(bytes.data());
  Outcome outcome;
  outcome.fault_codes.resize(count);
  codegen::BatchFaults faults;
  codegen::run_batch(kernel, info, {count, in_pointers.data(), out_pointers.data(), constants.data(), nullptr}, faults,
                     outcome.fault_codes.data());
  for (size_t c = 0; c < out.size(); ++c) {
    outcome.bits.emplace_back();
    for (uint64_t point = 0; point < count; ++point)
      outcome.bits[c].push_back(
          bits_of(out[c].data() + point * info.outputs[c].size, info.outputs[c].size, number_outputs_[entry][c]));
  }
  outcome.fault_count = faults.count;
  if (faults.count != 0) {
    outcome.first_point = faults.first_point;
    outcome.first_site = faults.first_site;
  }
  return outcome;
}

} // namespace moonshade::testing
