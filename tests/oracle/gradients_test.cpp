// Gradients of generated programs: beside the function's own values and faults, the same bits at every width and level,
// and, under f64, what central differences give wherever the program is smooth.
#include "runtime/shader.h"
#include "tests/oracle/generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace moonshade::oracle {
namespace {

constexpr size_t kPoints = 67; // no multiple of a width
constexpr uint64_t kPrograms = 40;

const Gradient kGradient{"probe", {"p", "uv", "P", "n", "time", "fw"}}; // 13 components

using Column = std::vector<double>;

bool is_number(ValueType type) { return type != ValueType::Boolean && type != ValueType::Integer; }

/// One component of a value for each point, as it lies in a batch.
class Elements {
public:
  Elements(ValueType type, Precision precision) : type_(type), precision_(precision), bytes_(kPoints * 8) {}
  void* data() { return bytes_.data(); }

  void set(size_t point, double value) {
    if (type_ == ValueType::Boolean)
      store(point, uint8_t(value > 0));
    else if (type_ == ValueType::Integer)
      store(point, int64_t(value * 3));
    else if (precision_ == Precision::F32)
      store(point, float(value));
    else
      store(point, value);
  }
  double get(size_t point) const {
    if (type_ == ValueType::Boolean) return load<uint8_t>(point);
    if (type_ == ValueType::Integer) return double(load<int64_t>(point));
    return precision_ == Precision::F32 ? double(load<float>(point)) : load<double>(point);
  }

private:
  template <class T> void store(size_t point, T value) {
    std::memcpy(bytes_.data() + point * sizeof value, &value, sizeof value);
  }
  template <class T> T load(size_t point) const {
    T value;
    std::memcpy(&value, bytes_.data() + point * sizeof value, sizeof value);
    return value;
  }
  ValueType type_;
  Precision precision_;
  std::vector<unsigned char> bytes_;
};

/// A program's entry, compiled in one way.
struct Probe {
  std::shared_ptr<const Shader> shader;
  size_t plain = 0, gradient = 0; ///< entries
  const EntryInfo& info(size_t entry) const { return shader->info().entries[entry]; }
};

Probe compile_probe(uint64_t seed, Precision precision, unsigned width, int level) {
  CompileOptions options;
  options.precision = precision;
  options.width = width;
  options.optimization = level;
  options.gradients = {kGradient};
  const Compilation compilation = compile("probe.lua", generate_program(seed), options);
  if (compilation.program == nullptr) return {};
  Probe probe{compilation.program->instantiate({}).shader};
  if (probe.shader == nullptr) return {};
  const std::vector<EntryInfo>& entries = probe.shader->info().entries;
  for (size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].name == "probe") probe.plain = i;
    if (entries[i].name == gradient_name(kGradient)) probe.gradient = i;
  }
  return probe;
}

struct Results {
  std::vector<Column> columns;
  std::vector<uint8_t> faults;
};

Results run(const Probe& probe, size_t entry, const std::vector<Column>& inputs) {
  const EntryInfo& info = probe.info(entry);
  const Precision precision = probe.shader->precision();
  std::vector<Elements> in, out;
  for (const InputInfo& input : info.inputs)
    in.insert(in.end(), component_count(input.type), Elements(input.type, precision));
  for (const ValueType type : info.results)
    out.insert(out.end(), component_count(type), Elements(type, precision));
  std::vector<const void*> in_pointers;
  std::vector<void*> out_pointers;
  for (size_t i = 0; i < in.size(); ++i) {
    for (size_t point = 0; point < kPoints; ++point)
      in[i].set(point, inputs[i][point]);
    in_pointers.push_back(in[i].data());
  }
  for (Elements& elements : out)
    out_pointers.push_back(elements.data());
  Results results;
  results.faults.resize(kPoints);
  FaultReport report;
  probe.shader->run(entry, {kPoints, in_pointers.data(), out_pointers.data(), &report, results.faults.data()});
  for (const Elements& elements : out) {
    results.columns.emplace_back();
    for (size_t point = 0; point < kPoints; ++point)
      results.columns.back().push_back(elements.get(point));
  }
  return results;
}

/// All NaNs are one.
bool same(double a, double b) { return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same(const Results& a, const Results& b, uint64_t seed) {
  EXPECT_EQ(a.faults, b.faults) << "seed " << seed;
  for (size_t i = 0; i < std::min(a.columns.size(), b.columns.size()); ++i)
    for (size_t point = 0; point < kPoints; ++point)
      EXPECT_TRUE(same(a.columns[i][point], b.columns[i][point]))
          << "seed " << seed << " component " << i << " point " << point << ": " << a.columns[i][point] << " and "
          << b.columns[i][point];
}

std::vector<Column> random_inputs(const EntryInfo& info, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Column> inputs;
  for (const InputInfo& input : info.inputs)
    for (unsigned c = 0; c < component_count(input.type); ++c) {
      inputs.emplace_back();
      for (size_t point = 0; point < kPoints; ++point)
        inputs.back().push_back(float(double(random() >> 11) * 0x1p-53 * 10 - 5));
    }
  return inputs;
}

/// The inputs' components that the gradient is by, in its order, as indices of components of all inputs.
std::vector<size_t> directions_of(const EntryInfo& info) {
  std::vector<size_t> directions;
  for (const std::string& name : kGradient.inputs) {
    size_t component = 0;
    for (const InputInfo& input : info.inputs) {
      for (unsigned c = 0; input.name == name && c < component_count(input.type); ++c)
        directions.push_back(component + c);
      component += component_count(input.type);
    }
  }
  return directions;
}

/// How many derivatives were compared with differences, and how many of them are not finite.
struct Compared {
  size_t all = 0, infinite = 0;
};

Compared expect_limits(const Probe& probe, const std::vector<Column>& inputs, uint64_t seed) {
  const Results plain = run(probe, probe.plain, inputs), exact = run(probe, probe.gradient, inputs);
  const std::vector<size_t> directions = directions_of(probe.info(probe.plain));
  std::vector<size_t> rows;
  Compared compared;
  size_t component = 0;
  for (const ValueType type : probe.info(probe.plain).results)
    for (unsigned c = 0; c < component_count(type); ++c, ++component)
      if (is_number(type)) rows.push_back(component);
  for (size_t k = 0; k < directions.size(); ++k) {
    constexpr double h = 1e-6;
    const auto at = [&](double offset) {
      std::vector<Column> moved = inputs;
      for (double& x : moved[directions[k]])
        x += offset;
      return run(probe, probe.plain, moved);
    };
    const Results far_below = at(-2 * h), below = at(-h), above = at(h), far_above = at(2 * h);
    // At no simple ratio to h: what oscillates faster than h may give one value at all of the others.
    constexpr double near = 0.0371 * h;
    const Results near_below = at(-near), near_above = at(near);
    for (size_t r = 0; r < rows.size(); ++r)
      for (size_t i = 0; i < kPoints; ++i) {
        if (plain.faults[i] || far_below.faults[i] || below.faults[i] || above.faults[i] || far_above.faults[i])
          continue;
        const size_t row = rows[r];
        const double narrow = (above.columns[row][i] - below.columns[row][i]) / (2 * h);
        const double wide = (far_above.columns[row][i] - far_below.columns[row][i]) / (4 * h);
        const double scale = 1 + std::abs(narrow) + std::abs(plain.columns[row][i]);
        const double nearest = (near_above.columns[row][i] - near_below.columns[row][i]) / (2 * near);
        if (!(std::abs(narrow - wide) < 1e-5 * scale) || scale > 1e6) continue;
        if (!(std::abs(narrow - nearest) < 1e-2 * scale)) continue;
        const double derivative = exact.columns[plain.columns.size() + r * directions.size() + k][i];
        ++compared.all;
        if (!std::isfinite(derivative)) { // a constant behind something that overflows: 0 * infinity
          ++compared.infinite;
          continue;
        }
        EXPECT_NEAR(derivative, narrow, 1e-4 * scale)
            << "seed " << seed << " result " << row << " direction " << k << " point " << i;
      }
  }
  return compared;
}

TEST(GeneratedGradients, AreTheFunctionsOwnAndTheSameEverywhere) {
  Compared compared;
  size_t programs = 0;
  for (uint64_t seed = 1; seed <= kPrograms; ++seed)
    for (const Precision precision : {Precision::F32, Precision::F64}) {
      const Probe narrow = compile_probe(seed, precision, 1, 0), wide = compile_probe(seed, precision, 16, 2);
      if (narrow.shader == nullptr || wide.shader == nullptr) continue;
      ++programs;
      const std::vector<Column> inputs = random_inputs(narrow.info(narrow.plain), seed);
      const Results gradient = run(narrow, narrow.gradient, inputs);
      expect_same(run(narrow, narrow.plain, inputs), gradient, seed);
      expect_same(run(wide, wide.gradient, inputs), gradient, seed);
      if (precision == Precision::F64) {
        const Compared more = expect_limits(narrow, inputs, seed);
        compared.all += more.all;
        compared.infinite += more.infinite;
      }
      if (HasFailure()) return;
    }
  EXPECT_GT(programs, kPrograms);
  EXPECT_GT(compared.all, 10000u);
  EXPECT_LT(compared.infinite, compared.all / 400); // logarithms to base 1, and the like
}

} // namespace
} // namespace moonshade::oracle
