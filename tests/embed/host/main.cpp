// A host of its own: compiles a shader from a string and shades a million points.
#include "runtime/shader.h"

#include <chrono>
#include <iostream>

int main() {
  const char* source = R"lua(
    local scale = param("scale", 4.0, { min = 0.1, max = 40 })
    function color(p, time)
      local t = 0.5 + 0.5 * noise(p * scale + vec3(0, 0, time))
      return mix(rgb(0.1, 0.2, 0.5), rgb(1, 0.9, 0.6), t)
    end
  )lua";
  moonshade::CompileOptions options;
  options.uniform_inputs = {"time"};
  const auto compiled = moonshade::compile("sky.lua", source, options);
  std::cerr << compiled.diagnostics;
  if (!compiled.program) return 1;
  const auto instance = compiled.program->instantiate({{"scale", 8.0}});
  if (!instance.shader) return std::cerr << instance.error << '\n', 1;

  constexpr size_t side = 1000, count = side * side;
  std::vector<float> x(count), y(count), z(count), red(count), green(count), blue(count);
  for (size_t i = 0; i < count; ++i) {
    x[i] = static_cast<float>(i % side) / side;
    y[i] = static_cast<float>(i / side) / side;
  }
  const float time = 0.25f;
  const void* inputs[] = {x.data(), y.data(), z.data(), &time};
  void* outputs[] = {red.data(), green.data(), blue.data()};
  moonshade::FaultReport faults;
  const auto begin = std::chrono::steady_clock::now();
  instance.shader->run(0, {count, inputs, outputs, &faults});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

  double mean = 0;
  for (const float value : red)
    mean += value / count;
  std::cout << moonshade::version() << ", " << instance.shader->width() << " lanes: " << count / seconds.count() / 1e6
            << " million points a second, mean red " << mean << ", " << faults.count << " faults\n";
  return mean > 0.4 && mean < 0.7 && faults.count == 0 ? 0 : 1;
}
