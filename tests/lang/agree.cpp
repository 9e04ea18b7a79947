// Stock Lua against every variant of compiled code, over random points and edge values and at the points that the
// program names.
#include "runtime/frontend.h"
#include "runtime/interpret.h"
#include "tests/lang/checks.h"
#include "tools/support/images.h"
#include "tools/support/points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace moonshade::lang_test {

namespace {

using tools::Points;
using tools::Scalar;

/// No multiple of any width, so that every width has a tail.
constexpr size_t kPoints = 331;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kNumberEdges = {0.0,
                                     -0.0,
                                     1.0,
                                     -1.0,
                                     0.5,
                                     -0.5,
                                     2.0,
                                     1e-310,
                                     1e300,
                                     -1e300,
                                     kNan,
                                     kInfinity,
                                     -kInfinity,
                                     9007199254740992.0,
                                     9223372036854775808.0,
                                     -9223372036854775808.0,
                                     1e-40,
                                     16777217.0,
                                     255.0,
                                     256.0,
                                     -256.0};
constexpr std::array<int64_t, 12> kIntegerEdges = {
    0, 1, -1, 2, INT64_MAX, INT64_MIN, 63, 64, -64, int64_t{1} << 53, (int64_t{1} << 53) + 1, INT64_MIN + 1};

struct Variant {
  Precision precision;
  unsigned width;
  int optimization;
  std::string name() const {
    return std::string(name_of(precision)) + " width " + std::to_string(width) + " -O" + std::to_string(optimization);
  }
};

class Random {
public:
  double number(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  bool chance(double probability) { return number(0, 1) < probability; }
  template <class Array> auto pick(const Array& array) { return array[engine_() % array.size()]; }
  int64_t integer(int64_t low, int64_t high) { return low + int64_t(engine_() % uint64_t(high - low + 1)); }

private:
  std::mt19937_64 engine_{20240611};
};

Scalar random_scalar(ValueType type, const std::string& input, bool mild, Random& random) {
  Scalar scalar{};
  if (type == ValueType::Boolean)
    scalar.boolean = random.chance(0.5);
  else if (type == ValueType::Integer)
    scalar.integer = !mild && random.chance(0.2) ? random.pick(kIntegerEdges) : random.integer(-12, 12);
  else if (!mild && random.chance(0.08))
    scalar.number = random.pick(kNumberEdges);
  else if (random.chance(0.15))
    scalar.number = std::floor(random.number(-5, 6));
  else
    scalar.number = input == "uv" ? random.number(0, 1) : random.number(-4, 4);
  return scalar;
}

/// The same points for every shader and precision.
Points make_points(const EntryInfo& entry, Precision precision, bool mild) {
  Points points(entry, precision, kPoints);
  Random random;
  for (size_t row = 0; row < kPoints; ++row) {
    size_t component = 0;
    for (const InputInfo& input : entry.inputs)
      for (unsigned i = 0; i < component_count(input.type); ++i, ++component)
        points.set_input(component, row, random_scalar(input.type, input.name, mild, random));
  }
  return points;
}

/// The same bits, or numbers that are nearly the same where `near` is not 0.
bool same(ValueType type, Scalar a, Scalar b, double near) {
  if (type == ValueType::Boolean) return a.boolean == b.boolean;
  if (type == ValueType::Integer) return a.integer == b.integer;
  if (std::isnan(a.number) || std::isnan(b.number)) return std::isnan(a.number) && std::isnan(b.number);
  if (near != 0 && std::abs(a.number - b.number) <= near * std::max(1.0, std::abs(a.number))) return true;
  return std::bit_cast<uint64_t>(a.number) == std::bit_cast<uint64_t>(b.number);
}

/// The first row in which the results or faults differ, or capacity().
size_t first_difference(const Points& a, const Points& b, double near = 0) {
  for (size_t row = 0; row < a.capacity(); ++row) {
    if (a.fault(row) != b.fault(row)) return row;
    for (size_t i = 0; i < a.output_count(); ++i)
      if (!same(a.output_type(i), a.output(i, row), b.output(i, row), near)) return row;
  }
  return a.capacity();
}

class Agreement {
public:
  Agreement(const CheckedShader& checked, const Directives& directives)
      : checked_(checked), directives_(directives),
        images_(tools::images_of(std::string(checked.sources().name(FileId{0})))) {}

  std::string check() {
    if (checked_.info().entries.empty()) return "  the program has no entry\n";
    const Instantiation lua =
        interpret(checked_, {}, {.count_steps = true, .step_limit = directives_.step_limit, .images = images_});
    if (!lua.shader) return "  stock Lua: " + lua.error + "\n";
    for (size_t entry = 0; entry < checked_.info().entries.size(); ++entry) {
      doubles_.push_back(shaded(*lua.shader, entry));
      floats_.push_back(std::nullopt);
      near_doubles_.push_back(std::nullopt);
    }
    if (directives_.near == 0)
      check_runs("stock Lua", [&](const auto& parameters) {
        return interpret(checked_, parameters,
                         {.count_steps = true, .step_limit = directives_.step_limit, .images = images_});
      });
    for (int optimization : {2, 0})
      for (Precision precision : {Precision::F32, Precision::F64})
        for (unsigned width : kWidths)
          check_variant({precision, width, optimization});
    check_pieces({Precision::F32, 8, 2});
    check_pieces({Precision::F64, 16, 2});
    check_uniform_inputs({Precision::F32, 16, 2});
    check_uniform_inputs({Precision::F64, 4, 2});
    return findings_;
  }

private:
  Points shaded(const Shader& shader, size_t entry) const {
    Points points = make_points(shader.info().entries[entry], shader.precision(), directives_.mild);
    points.run(shader, entry, kPoints);
    return points;
  }

  void check_variant(const Variant& variant) {
    CompileOptions options;
    options.images = images_;
    options.precision = variant.precision;
    options.width = variant.width;
    options.optimization = variant.optimization;
    options.step_limit = directives_.step_limit;
    const Compilation compilation = compile(checked_, options);
    if (!compilation.program) return find(variant.name(), "does not compile\n" + compilation.diagnostics);
    const Instantiation instance = compilation.program->instantiate({});
    if (!instance.shader) return find(variant.name(), instance.error);
    for (size_t entry = 0; entry < doubles_.size(); ++entry)
      check_entry(variant, *instance.shader, entry);
    if (variant.precision == Precision::F64)
      check_runs(variant.name(), [&](const auto& parameters) { return compilation.program->instantiate(parameters); });
  }

  void check_entry(const Variant& variant, const Shader& shader, size_t entry) {
    Points points = shaded(shader, entry);
    if (variant.precision == Precision::F32 && !floats_[entry]) {
      floats_[entry] = std::move(points); // the first variant is what the others must equal
      return;
    }
    const bool is_first_near = directives_.near != 0 && variant.precision == Precision::F64 && !near_doubles_[entry];
    const bool has_near = directives_.near != 0 && !is_first_near;
    const Points& doubles = has_near && near_doubles_[entry] ? *near_doubles_[entry] : doubles_[entry];
    const Points& exact = variant.precision == Precision::F64 ? doubles : *floats_[entry];
    const size_t row = first_difference(exact, points, is_first_near ? directives_.near : 0);
    if (is_first_near) near_doubles_[entry] = points;
    if (row == kPoints) return;
    const EntryInfo& info = shader.info().entries[entry];
    std::string expected, found;
    exact.append_row(expected, row);
    points.append_row(found, row);
    find(variant.name(), info.name + " (" + describe_inputs(info, points, row) + ") gives " + found + " for " +
                             (variant.precision == Precision::F64 ? "stock Lua's " : "one lane's ") + expected);
  }

  std::shared_ptr<const Shader> compiled(const Variant& variant, const std::vector<std::string>& uniform_inputs) {
    CompileOptions options;
    options.images = images_;
    options.precision = variant.precision;
    options.width = variant.width;
    options.optimization = variant.optimization;
    options.step_limit = directives_.step_limit;
    options.uniform_inputs = uniform_inputs;
    const Compilation compilation = compile(checked_, options);
    return compilation.program ? compilation.program->instantiate({}).shader : nullptr;
  }

  void compare(const std::string& where, const EntryInfo& entry, const Points& expected, const Points& found) {
    const size_t row = first_difference(expected, found);
    if (row == kPoints) return;
    std::string expected_row, found_row;
    expected.append_row(expected_row, row);
    found.append_row(found_row, row);
    find(where,
         entry.name + " (" + describe_inputs(entry, found, row) + ") gives " + found_row + ", not " + expected_row);
  }

  /// Batches of any size give what one batch gives.
  void check_pieces(const Variant& variant) {
    const auto shader = compiled(variant, {});
    if (!shader) return; // reported already
    for (size_t entry = 0; entry < doubles_.size(); ++entry) {
      const EntryInfo& info = shader->info().entries[entry];
      const Points whole = shaded(*shader, entry);
      Points pieces = make_points(info, variant.precision, directives_.mild);
      for (size_t begin = 0, size = 1; begin < kPoints; begin += size, size = size * 2 + 1)
        pieces.run_range(*shader, entry, begin, std::min(size, kPoints - begin));
      compare(variant.name() + " in pieces", info, whole, pieces);
    }
  }

  /// An input with one value for the whole batch gives what that value gives in an array.
  void check_uniform_inputs(const Variant& variant) {
    const auto arrays = compiled(variant, {}), uniform = compiled(variant, {"time", "frame"});
    if (!arrays || !uniform) return;
    for (size_t entry = 0; entry < doubles_.size(); ++entry) {
      const EntryInfo& info = arrays->info().entries[entry];
      for (const size_t row : {size_t{0}, size_t{1}, size_t{7}, size_t{40}}) {
        Points expected = make_points(info, variant.precision, directives_.mild);
        if (!spread(info, expected, row)) break;
        Points found = expected;
        expected.run(*arrays, entry, kPoints);
        found.run(*uniform, entry, kPoints);
        compare(variant.name() + " with uniform inputs", info, expected, found);
      }
    }
  }

  /// Gives all rows the time and frame of one row; false where the entry has neither.
  static bool spread(const EntryInfo& entry, Points& points, size_t row) {
    size_t component = 0;
    bool any = false;
    for (const InputInfo& input : entry.inputs) {
      if (input.name == "time" || input.name == "frame") {
        any = true;
        const Scalar value = points.input(component, row);
        for (size_t other = 0; other < kPoints; ++other)
          points.set_input(component, other, value);
      }
      component += component_count(input.type);
    }
    return any;
  }

  /// The runs that the program names; `instantiate` makes a shader for parameters.
  template <class Instantiate> void check_runs(const std::string& who, Instantiate instantiate) {
    for (const Run& run : directives_.runs) {
      const std::string where = who + ", line " + std::to_string(run.line);
      std::map<std::string, Constant> parameters;
      std::string problem = read_parameters(run, parameters);
      const Instantiation instance = problem.empty() ? instantiate(parameters) : Instantiation{nullptr, problem};
      if (!instance.shader) {
        find(where, instance.error);
        continue;
      }
      const std::string found = run_point(*instance.shader, run);
      if (found != run.expected[0]) find(where, "gives " + found + ", not " + run.expected[0]);
    }
  }

  std::string read_parameters(const Run& run, std::map<std::string, Constant>& parameters) const {
    for (const auto& [name, text] : run.parameters)
      for (const ParameterInfo& parameter : checked_.info().parameters) {
        if (parameter.name != name) continue;
        const CheckedConstant checked = parse_override(parameter, text);
        if (!checked.error.empty()) return checked.error;
        parameters[name] = checked.value;
      }
    return parameters.size() == run.parameters.size() ? "" : "the shader has no such parameter";
  }

  static std::string run_point(const Shader& shader, const Run& run) {
    const auto& entries = shader.info().entries;
    const EntryInfo* entry = shader.info().find_entry(run.entry);
    if (!entry) return "no entry '" + run.entry + "'";
    Points points(*entry, shader.precision(), 1);
    size_t component = 0;
    for (const InputInfo& input : entry->inputs) {
      const auto given = std::find_if(run.inputs.begin(), run.inputs.end(),
                                      [&](const auto& pair) { return pair.first == input.name; });
      const auto value = given == run.inputs.end() ? std::nullopt : tools::parse_value(input.type, given->second);
      if (!value) return "no value for the input '" + input.name + "'";
      for (const Scalar& scalar : *value)
        points.set_input(component++, 0, scalar);
    }
    points.run(shader, size_t(entry - entries.data()), 1);
    std::string text;
    points.append_row(text, 0);
    return text;
  }

  void find(const std::string& where, const std::string& what) { findings_ += "  " + where + ": " + what + "\n"; }

  const CheckedShader& checked_;
  const Directives& directives_;
  const ImageOpener images_;
  std::vector<Points> doubles_;                     ///< stock Lua's, for each entry
  std::vector<std::optional<Points>> floats_;       ///< the first f32 variant's
  std::vector<std::optional<Points>> near_doubles_; ///< the first f64 variant's, where stock Lua is only near
  std::string findings_;
};

} // namespace

std::string check_agreement(const std::string& name, const std::string& text, const Directives& directives) {
  const CheckedShader checked(name, text, {}, modules_beside(name));
  if (!checked.ok()) {
    std::ostringstream messages;
    print_text(checked.diagnostics(), checked.sources(), messages);
    return messages.str();
  }
  if (!directives.warnings.empty() || directives.no_warnings) {
    std::string problem = compare_diagnostics(checked, Severity::Warning, directives.warnings);
    if (!problem.empty()) return problem;
  }
  return Agreement(checked, directives).check();
}

} // namespace moonshade::lang_test
