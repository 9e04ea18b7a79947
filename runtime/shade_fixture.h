// For tests: shaders of the point alone, compiled and run over some points.
#pragma once

#include "runtime/shader.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

namespace moonshade::testing {

/// All that a call gives, as bits.
struct Shaded {
  std::vector<std::vector<uint32_t>> outputs; ///< by component
  std::vector<uint8_t> fault_codes;
  uint64_t fault_count = 0;
  bool operator==(const Shaded&) const = default;
};

/// Points without a pattern, near 0 and far from it.
inline std::vector<float> some_points(size_t count) {
  std::vector<float> values;
  uint32_t state = 12345;
  for (size_t i = 0; i < count; ++i) {
    state = state * 1664525u + 1013904223u;
    values.push_back(static_cast<float>(static_cast<int32_t>(state)) / (i % 7 == 0 ? 1e5F : 4e8F));
  }
  return values;
}

/// Runs an entry under f32 that takes points only and gives numbers and vectors only. `between` is called before each
/// batch of `batch` points.
template <class Between>
Shaded shade_batches(const Shader& shader, size_t entry, size_t count, size_t batch, Between&& between) {
  size_t inputs = 0, outputs = 0;
  for (const InputInfo& input : shader.info().entries[entry].inputs)
    inputs += component_count(input.type);
  for (const ValueType type : shader.info().entries[entry].results)
    outputs += component_count(type);
  std::vector<std::vector<float>> columns;
  for (size_t i = 0; i < inputs; ++i) {
    columns.push_back(some_points(count + i));
    columns.back().erase(columns.back().begin(), columns.back().begin() + static_cast<ptrdiff_t>(i));
  }
  Shaded result{std::vector<std::vector<uint32_t>>(outputs, std::vector<uint32_t>(count)), std::vector<uint8_t>(count),
                0};
  for (size_t first = 0; first < count; first += batch) {
    between();
    std::vector<const void*> in;
    std::vector<void*> out;
    for (const std::vector<float>& column : columns)
      in.push_back(column.data() + first);
    for (std::vector<uint32_t>& column : result.outputs)
      out.push_back(column.data() + first);
    FaultReport faults;
    shader.run(entry, {std::min(batch, count - first), in.data(), out.data(), &faults, &result.fault_codes[first]});
    result.fault_count += faults.count;
  }
  for (std::vector<uint32_t>& column : result.outputs)
    for (uint32_t& bits : column)
      if (std::isnan(std::bit_cast<float>(bits))) bits = 0x7fc00000; // all NaNs count as one
  return result;
}
inline Shaded shade_all(const Shader& shader, size_t entry = 0, size_t count = 1003) {
  return shade_batches(shader, entry, count, count, [] {});
}

/// A shader of everything that is archived: parameters of every kind, faults, entries, tables, loops, a warning,
/// modules.
inline constexpr const char* kRichShader = R"(local stone = require "stone"
local scale = param("scale", 2.0, { min = 0.5, max = 10, doc = "size" })
local count = param("count", 3, { choices = { 1, 2, 3 } })
local on = param("on", true)
local tint = param("tint", rgb(0.25, 0.5, 1))
local kind = param("kind", "wood")
local weights = { 0.5, 0.25, 0.125 }
local doubled = scale * 2
local unused = 1
function color(p)
  local sum = 0.0
  for i = 1, count do sum = sum + weights[i] * noise(p * doubled * i) end
  if kind == "wood" then sum = sum * stone.hardness(p) end
  if on then return tint * sum end
  return vec3(fbm(p * scale, 4), turbulence(p, 3), (worley(p)))
end
function height(p)
  assert(p.x < 9000, "too far")
  return 0.04 * turbulence(p * scale, 5) + weights[count]
end
)";
inline constexpr const char* kStoneModule = R"(local function hardness(p) return 0.5 + 0.5 * perlin(p) end
return { hardness = hardness }
)";
inline ModuleReader stone_reader(const std::string& text = kStoneModule) {
  return [text](const std::string& name) {
    return name == "stone" ? ModuleText{"stone.lua", text, ""} : ModuleText{"", "", "there is none"};
  };
}

inline std::shared_ptr<const Shader> instantiated(const Compilation& compilation,
                                                  const std::map<std::string, Constant>& parameters = {}) {
  if (compilation.program == nullptr) {
    ADD_FAILURE() << compilation.diagnostics;
    return nullptr;
  }
  const Instantiation instance = compilation.program->instantiate(parameters);
  EXPECT_EQ(instance.error, "");
  return instance.shader;
}

} // namespace moonshade::testing
