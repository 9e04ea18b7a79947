// Points are structure-of-arrays of doubles first, then converted to the batch's representation; edge values come
// first.
#include "tests/oracle/compare.h"

#include "runtime/frontend.h"
#include "runtime/interpret.h"
#include "tests/oracle/random.h"

#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace moonshade::oracle {
namespace {

constexpr size_t kPoints = 203; // no multiple of a width: tails are tested

/// One column of input or output values, by type of element.
struct Column {
  ValueType type; // Number also for components of vectors
  std::vector<double> doubles;
  std::vector<float> floats;
  std::vector<int64_t> integers;
  std::vector<uint8_t> booleans;

  void* data(Precision precision) {
    if (type == ValueType::Integer) return integers.data();
    if (type == ValueType::Boolean) return booleans.data();
    return precision == Precision::F64 ? static_cast<void*>(doubles.data()) : floats.data();
  }
};

ValueType element_type(ValueType type) {
  return type == ValueType::Integer || type == ValueType::Boolean ? type : ValueType::Number;
}

Column random_column(ValueType type, Random& random) {
  static const std::vector<double> edges = {0.0,
                                            -0.0,
                                            1.0,
                                            -1.0,
                                            0.5,
                                            1e30,
                                            -1e-30,
                                            std::numeric_limits<double>::infinity(),
                                            -std::numeric_limits<double>::infinity(),
                                            std::numeric_limits<double>::quiet_NaN(),
                                            1e-42,
                                            16777217.0,
                                            4503599627370497.0};
  static const std::vector<int64_t> integer_edges = {0, 1, -1, 2, 63, 64, INT64_MAX, INT64_MIN, int64_t{1} << 53, -2};
  Column column{type, {}, {}, {}, {}};
  for (size_t i = 0; i < kPoints; ++i) {
    const bool edge = random.chance(i < kPoints / 4 ? 0.5 : 0.02);
    const double number = edge ? random.pick(edges) : random.unit() * 12 - 6;
    column.doubles.push_back(number);
    column.floats.push_back(static_cast<float>(number));
    column.integers.push_back(edge ? random.pick(integer_edges) : random.between(-10, 10));
    column.booleans.push_back(random.chance(0.5) ? 1 : 0);
  }
  return column;
}

/// What one shader gave for all points.
struct Results {
  std::vector<Column> outputs;
  std::vector<uint8_t> faults;
  FaultReport report;
};

Results run(const Shader& shader, size_t entry, std::vector<Column>& inputs) {
  Results results;
  std::vector<const void*> input_pointers;
  for (Column& column : inputs)
    input_pointers.push_back(column.data(shader.precision()));
  for (const ValueType type : shader.info().entries[entry].results)
    for (unsigned k = 0; k < component_count(type); ++k) {
      Column column{element_type(type), {}, {}, {}, {}};
      column.doubles.resize(kPoints);
      column.floats.resize(kPoints);
      column.integers.resize(kPoints);
      column.booleans.resize(kPoints);
      results.outputs.push_back(std::move(column));
    }
  std::vector<void*> output_pointers;
  for (Column& column : results.outputs)
    output_pointers.push_back(column.data(shader.precision()));
  results.faults.resize(kPoints);
  Batch batch;
  batch.count = kPoints;
  batch.inputs = input_pointers.data();
  batch.outputs = output_pointers.data();
  batch.faults = &results.report;
  batch.fault_codes = results.faults.data();
  shader.run(entry, batch);
  return results;
}

template <class F> bool same_bits(F a, F b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_value(const Column& a, const Column& b, size_t i, Precision precision) {
  if (a.type == ValueType::Integer) return a.integers[i] == b.integers[i];
  if (a.type == ValueType::Boolean) return a.booleans[i] == b.booleans[i];
  return precision == Precision::F64 ? same_bits(a.doubles[i], b.doubles[i]) : same_bits(a.floats[i], b.floats[i]);
}

std::string value_text(const Column& column, size_t i, Precision precision) {
  if (column.type == ValueType::Integer) return std::to_string(column.integers[i]);
  if (column.type == ValueType::Boolean) return column.booleans[i] ? "true" : "false";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.17g (%a)",
                precision == Precision::F64 ? column.doubles[i] : static_cast<double>(column.floats[i]),
                precision == Precision::F64 ? column.doubles[i] : static_cast<double>(column.floats[i]));
  return buffer;
}

/// Empty where the two agree.
std::string difference(const Results& expected, const Results& got, Precision precision) {
  for (size_t i = 0; i < kPoints; ++i) {
    if (expected.faults[i] != got.faults[i])
      return "point " + std::to_string(i) + ": fault " + fault_name(static_cast<FaultCode>(got.faults[i])) +
             ", expected " + fault_name(static_cast<FaultCode>(expected.faults[i]));
    for (size_t k = 0; k < expected.outputs.size(); ++k)
      if (!same_value(expected.outputs[k], got.outputs[k], i, precision))
        return "point " + std::to_string(i) + " output " + std::to_string(k) + ": " +
               value_text(got.outputs[k], i, precision) + ", expected " + value_text(expected.outputs[k], i, precision);
  }
  if (expected.report.count != got.report.count)
    return "count of faults " + std::to_string(got.report.count) + ", expected " +
           std::to_string(expected.report.count);
  return {};
}

struct Compiled {
  std::shared_ptr<const Shader> shader;
  std::string error;     // of the compilation: a defect
  std::string top_fault; // of the top level: legitimate where stock Lua has it too
};

Compiled make(const CheckedShader& checked, const Variant& variant) {
  CompileOptions options;
  options.precision = variant.precision;
  options.width = variant.width;
  options.optimization = variant.optimization;
  const Compilation compilation = compile(checked, options);
  if (!compilation.program) return {nullptr, "does not compile: " + compilation.diagnostics, {}};
  const Instantiation instance = compilation.program->instantiate({});
  return {instance.shader, {}, instance.error};
}

} // namespace

std::string name_of(const Variant& variant) {
  return std::string(variant.precision == Precision::F64 ? "f64" : "f32") + " w" + std::to_string(variant.width) +
         " O" + std::to_string(variant.optimization);
}

std::vector<Variant> all_variants() {
  std::vector<Variant> variants;
  for (const Precision precision : {Precision::F64, Precision::F32})
    for (const unsigned width : kWidths)
      for (const int optimization : {0, 2})
        variants.push_back({precision, width, optimization});
  return variants;
}

Outcome compare(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed) {
  const CheckedShader checked("generated.lua", text);
  if (!checked.ok()) {
    std::string detail;
    const Compilation refused = compile("generated.lua", text, {});
    return {Verdict::Refused, refused.diagnostics};
  }
  const auto& entries = checked.info().entries;
  if (entries.empty()) return {Verdict::Refused, "no entry"};
  Random random(point_seed);
  std::vector<Column> inputs;
  for (const InputInfo& input : entries[0].inputs)
    for (unsigned k = 0; k < component_count(input.type); ++k)
      inputs.push_back(random_column(element_type(input.type), random));

  const Instantiation stock = interpret(checked, {}, {});
  Results lua, lane;
  Outcome agreed;
  if (stock.shader) {
    lua = run(*stock.shader, 0, inputs);
    agreed.points = kPoints;
    agreed.faulted = lua.report.count;
  }
  Compiled narrow; // the reference of f32, made when it is first needed
  for (const Variant& variant : variants) {
    const Compiled compiled = make(checked, variant);
    if (!compiled.error.empty()) return {Verdict::Broken, name_of(variant) + ": " + compiled.error};
    if (variant.precision == Precision::F64) {
      if (!stock.shader != !compiled.shader)
        return {Verdict::Differs,
                name_of(variant) + ": top level: \"" + compiled.top_fault + "\", stock Lua: \"" + stock.error + "\""};
      if (!compiled.shader) continue;
      const std::string where = difference(lua, run(*compiled.shader, 0, inputs), Precision::F64);
      if (!where.empty()) return {Verdict::Differs, name_of(variant) + " against stock Lua: " + where};
      continue;
    }
    if (!narrow.shader && narrow.top_fault.empty()) {
      narrow = make(checked, {Precision::F32, 1, 0});
      if (!narrow.error.empty()) return {Verdict::Broken, "f32 w1 O0: " + narrow.error};
      if (narrow.shader) lane = run(*narrow.shader, 0, inputs);
    }
    if (narrow.top_fault != compiled.top_fault)
      return {Verdict::Differs,
              name_of(variant) + ": top level: \"" + compiled.top_fault + "\", one lane: \"" + narrow.top_fault + "\""};
    if (!compiled.shader) continue;
    const std::string where = difference(lane, run(*compiled.shader, 0, inputs), Precision::F32);
    if (!where.empty()) return {Verdict::Differs, name_of(variant) + " against one lane at -O0: " + where};
  }
  return agreed;
}

Verdict verdict_in_child(const std::string& text, const std::vector<Variant>& variants, uint64_t point_seed) {
  const pid_t child = fork();
  if (child == 0) _exit(static_cast<int>(compare(text, variants, point_seed).verdict));
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) < static_cast<int>(Verdict::Crashed)
             ? static_cast<Verdict>(WEXITSTATUS(status))
             : Verdict::Crashed;
}

} // namespace moonshade::oracle
