// Compiled to bitcode alone, with the driver and the externals in the same piece (c_support.h). Uses nothing but what
// every C library has.
#include "compiler/codegen/c_support.h"

#include "compiler/codegen/driver.cpp" // NOLINT(bugprone-suspicious-include)
#include "stdlib/externals.cpp"        // NOLINT(bugprone-suspicious-include)

namespace moonshade::codegen {

namespace {

constexpr uint32_t kSizes[] = {1, 8, 4, 8, sizeof(const char*)};
constexpr int64_t kNone = -1;

template <class T> T read(const Byte* bytes) {
  T value;
  memcpy(&value, bytes, sizeof value);
  return value;
}

void write(Byte* bytes, int64_t value) { memcpy(bytes, &value, sizeof value); }

double number_at(const Byte* bytes, uint32_t kind) {
  switch (kind) {
  case kCInteger:
    return static_cast<double>(read<int64_t>(bytes));
  case kCFloat:
    return read<float>(bytes);
  case kCDouble:
    return read<double>(bytes);
  default:
    return 0;
  }
}

int64_t find(const char* text, const char* const* list, uint64_t count) {
  for (uint64_t i = 0; i < count; ++i)
    if (strcmp(text, list[i]) == 0) return static_cast<int64_t>(i);
  return kNone;
}

const char* string_at(const CParameterRow& row, const Byte* source) {
  const auto* text = read<const char*>(source);
  return text != nullptr ? text : row.strings->default_value;
}

bool fits(const CParameterRow& row, const Byte* source) {
  if (row.kind == kCString)
    return row.error == nullptr ||
           find(string_at(row, source), row.strings->choices, row.strings->choice_count) != kNone;
  for (uint32_t i = 0; row.error != nullptr && i < row.count; ++i) {
    const double value = number_at(source + i * kSizes[row.kind], row.kind);
    if (!(value >= row.min && value <= row.max)) return false;
  }
  return true;
}

/// As the header that shaderc writes declares it.
struct CFaults {
  uint64_t count, first_point;
  uint32_t first_site;
};

} // namespace

extern "C" const char* moonshade_c_instantiate(const CShader* shader, void* constants, const void* parameters) {
  const auto* source = static_cast<const Byte*>(parameters != nullptr ? parameters : shader->defaults);
  auto* target = static_cast<Byte*>(constants);
  for (uint64_t i = 0; i < shader->parameter_count; ++i) {
    const CParameterRow& row = shader->parameters[i];
    if (!fits(row, source + row.source)) return row.error;
    if (row.target == kCNoTarget) continue;
    if (row.kind == kCBoolean)
      target[row.target] = source[row.source] != 0;
    else if (row.kind == kCString)
      write(target + row.target,
            find(string_at(row, source + row.source), row.strings->compared, row.strings->compared_count));
    else
      memcpy(target + row.target, source + row.source, size_t{row.count} * kSizes[row.kind]);
  }
  if (shader->init == nullptr) return nullptr;
  uint32_t fault = 0;
  call_init(shader->init, constants, fault);
  return fault == 0 ? nullptr : shader->site_errors[fault - 1];
}

extern "C" void moonshade_c_run(const KernelView* kernel, const void* constants, const uint64_t* batch) {
  auto* const* pointers = reinterpret_cast<void* const*>(batch + 1);
  auto* const* outputs = pointers + kernel->input_count;
  const KernelBatch call{*batch, pointers, outputs, constants, nullptr};
  BatchFaults faults;
  moonshade_run_batch(kernel, &call, &faults, static_cast<uint8_t*>(outputs[kernel->output_count + 1]));
  if (auto* report = static_cast<CFaults*>(outputs[kernel->output_count]); report != nullptr)
    *report = {faults.count, faults.count == 0 ? 0 : faults.first_point, faults.first_site};
}

} // namespace moonshade::codegen
