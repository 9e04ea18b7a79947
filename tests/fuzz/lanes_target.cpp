// What the compiler accepts is run: one lane at -O0 and many lanes at -O2 give the same bits and the same faults, in
// both precisions, and the top level faults in all or in none.
#include "runtime/frontend.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace moonshade {
namespace {

constexpr size_t kPoints = 13; // no multiple of a width
constexpr uint64_t kStepLimit = 500;

/// One component of an input or output, in all representations.
struct Column {
  ValueType type = ValueType::Number;
  std::array<double, kPoints> doubles{};
  std::array<float, kPoints> floats{};
  std::array<int64_t, kPoints> integers{};
  std::array<uint8_t, kPoints> booleans{};

  void* data(Precision precision) {
    if (type == ValueType::Integer) return integers.data();
    if (type == ValueType::Boolean) return booleans.data();
    return precision == Precision::F64 ? static_cast<void*>(doubles.data()) : floats.data();
  }
};

std::vector<Column> columns_of(ValueType type) {
  const bool is_element = type == ValueType::Integer || type == ValueType::Boolean;
  Column column;
  column.type = is_element ? type : ValueType::Number;
  return std::vector<Column>(component_count(type), column);
}

void fill(Column& column, size_t phase) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 11> kNumbers = {0.3,   -0.0, 2.5, kInfinity,          1e30, -1.75, 1e-9,
                                               -17.0, 1.0,  NAN, -9007199254740993.0};
  constexpr std::array<int64_t, 7> kIntegers = {3, 0, -1, INT64_MAX, INT64_MIN, 64, -7};
  for (size_t i = 0; i < kPoints; ++i) {
    column.doubles[i] = kNumbers[(i + phase) % kNumbers.size()];
    column.floats[i] = static_cast<float>(column.doubles[i]);
    column.integers[i] = kIntegers[(i + phase) % kIntegers.size()];
    column.booleans[i] = (i + phase) % 3 == 0;
  }
}

struct Results {
  std::vector<Column> columns;
  std::array<uint8_t, kPoints> faults{};
  FaultReport report;
};

Results run(const Shader& shader, size_t entry) {
  const EntryInfo& info = shader.info().entries[entry];
  std::vector<Column> inputs;
  for (const InputInfo& input : info.inputs)
    for (Column& column : columns_of(input.type)) {
      fill(column, inputs.size() * 4);
      inputs.push_back(column);
    }
  Results results;
  for (ValueType type : info.results)
    for (Column& column : columns_of(type))
      results.columns.push_back(column);
  const auto data = [&](Column& column) { return column.data(shader.precision()); };
  std::vector<const void*> input_pointers(inputs.size());
  std::vector<void*> output_pointers(results.columns.size());
  std::ranges::transform(inputs, input_pointers.begin(), data);
  std::ranges::transform(results.columns, output_pointers.begin(), data);
  shader.run(entry, {kPoints, input_pointers.data(), output_pointers.data(), &results.report, results.faults.data()});
  return results;
}

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}

void check_same(const Results& a, const Results& b, const std::string& entry) {
  for (size_t i = 0; i < kPoints; ++i) {
    const std::string place = entry + ", point " + std::to_string(i);
    fuzz::require(a.faults[i] == b.faults[i], place + ": other faults");
    for (size_t k = 0; k < a.columns.size(); ++k) {
      const Column &x = a.columns[k], &y = b.columns[k];
      const bool same = same_bits(x.doubles[i], y.doubles[i]) && same_bits(x.floats[i], y.floats[i]) &&
                        x.integers[i] == y.integers[i] && x.booleans[i] == y.booleans[i];
      fuzz::require(same, place + ", component " + std::to_string(k) + ": other values");
    }
  }
  fuzz::require(a.report.count == b.report.count && a.report.first_point == b.report.first_point &&
                    a.report.first_code == b.report.first_code,
                entry + ": other reports of faults");
}

Instantiation make(const CheckedShader& shader, Precision precision, unsigned width, int optimization) {
  CompileOptions options;
  options.precision = precision;
  options.width = width;
  options.optimization = optimization;
  options.step_limit = kStepLimit;
  const Compilation compiled = compile(shader, options);
  fuzz::require(compiled.program != nullptr, "no code: " + compiled.diagnostics);
  return compiled.program->instantiate({});
}

void check_agreement(const CheckedShader& shader, Precision precision, unsigned width) {
  const Instantiation one = make(shader, precision, 1, 0), many = make(shader, precision, width, 2);
  fuzz::require(one.error == many.error, "the top level: '" + one.error + "' and '" + many.error + "'");
  if (!one.shader) return;
  for (size_t entry = 0; entry < one.shader->info().entries.size(); ++entry)
    check_same(run(*one.shader, entry), run(*many.shader, entry), one.shader->info().entries[entry].name);
}

} // namespace
} // namespace moonshade

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  constexpr int kNotKept = -1; // libFuzzer goes on only from what compiles
  if (size > fuzz::kMaxInput / 4) return kNotKept;
  const std::string_view text = fuzz::text_of(data, size);
  const CheckedShader shader("fuzz.lua", std::string(text));
  if (!shader.ok()) return kNotKept;
  const uint64_t choice = fuzz::choice_of(text);
  check_agreement(shader, choice & 1 ? Precision::F64 : Precision::F32, choice & 2 ? 8 : 4);
  return 0;
}
