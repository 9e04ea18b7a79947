// The points of a benchmark.
#include "tools/moonbench/inputs.h"

#include <array>
#include <cmath>

namespace moonshade::moonbench {

namespace {

using Vector = std::array<double, 4>;

Vector unit(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length, 0};
}

Vector input_at(const std::string& name, double u, double v) {
  if (name == "p" || name == "P") return {8 * u, 8 * v, 0.37, 0};
  if (name == "n" || name == "ng") return unit(u - 0.5, v - 0.5, 1);
  if (name == "i") return unit(0.5 - u, 0.5 - v, -2);
  if (name == "uv") return {u, v, 0, 0};
  if (name == "dpdu") return {8, 0, 0, 0};
  if (name == "dpdv") return {0, 8, 0, 0};
  if (name == "time") return {0.5, 0, 0, 0};
  if (name == "fw") return {8.0 / 1024, 0, 0, 0};
  return {1, 0, 0, 0}; // frame, id
}

} // namespace

void fill_inputs(const EntryInfo& entry, tools::Points& points) {
  const size_t side = std::max<size_t>(1, size_t(std::sqrt(double(points.capacity()))));
  for (size_t row = 0; row < points.capacity(); ++row) {
    const double u = (double(row % side) + 0.5) / double(side);
    const double v = std::fmod((double(row / side) + 0.5) / double(side), 1.0);
    size_t component = 0;
    for (const InputInfo& input : entry.inputs) {
      const Vector value = input_at(input.name, u, v);
      for (unsigned i = 0; i < component_count(input.type); ++i, ++component) {
        tools::Scalar scalar{};
        if (input.type == ValueType::Boolean)
          scalar.boolean = false;
        else if (input.type == ValueType::Integer)
          scalar.integer = 1;
        else
          scalar.number = double(float(value[i]));
        points.set_input(component, row, scalar);
      }
    }
  }
}

} // namespace moonshade::moonbench
