// `build` and all passes against stock Lua: each shader is executed at several points by stock Lua, as IR, and as IR
// after `optimize` for f64; the three must give the same bits and fault at the same points.
#include "compiler/ir/passes.h"
#include "compiler/ir/print.h"
#include "compiler/ir/test_lanes.h"
#include "compiler/ir/test_shaders.h"
#include "compiler/ir/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::ir {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Faults are one to Lua.
std::string as_lua_says(const Outcome& outcome) {
  return outcome.fault != FaultCode::None ? "fault" : to_text(outcome);
}

void expect_agreement(const std::string& text) {
  const Checked checked = check(text);
  ASSERT_THAT(checked.errors, IsEmpty()) << text;
  const Module plain = build(checked.program);
  ASSERT_THAT(verify(plain), IsEmpty()) << to_text(plain);
  Module optimized = plain;
  optimize(optimized, Precision::F64);
  ASSERT_THAT(verify(optimized), IsEmpty()) << to_text(optimized);
  Module fused = plain;
  optimize(fused, Precision::F32);
  ASSERT_THAT(verify(fused), IsEmpty()) << to_text(fused);
  const std::vector<Value> parameters = parameters_of(checked.program.info);
  for (const EntryInfo& entry : checked.program.info.entries)
    for (unsigned point = 0; point < kPoints; ++point) {
      const std::vector<Value> inputs = inputs_at(entry, point);
      const std::string expected = run_lua(text, entry.name, inputs);
      const Outcome outcome = Interpreter(plain, parameters).run(entry.name, inputs);
      EXPECT_EQ(as_lua_says(outcome), expected) << text << "point " << point << '\n' << to_text(plain);
      const Outcome simplified = Interpreter(optimized, parameters).run(entry.name, inputs);
      EXPECT_EQ(to_text(simplified), to_text(outcome)) << text << "point " << point << '\n' << to_text(optimized);
    }
}

/// As many lanes as points, at once, every other input uniform: each lane must give what its point gives alone.
void expect_lanes_agree(const std::string& text) {
  const Checked checked = check(text);
  ASSERT_THAT(checked.errors, IsEmpty()) << text;
  Module module = build(checked.program);
  for (const bool optimized : {false, true}) {
    if (optimized) optimize(module, Precision::F64);
    const std::vector<Value> parameters = parameters_of(checked.program.info);
    for (size_t i = 0; i < module.entries.size(); ++i) {
      const EntryInfo& entry = checked.program.info.entries[i];
      for (const bool first_uniform : {false, true}) {
        std::vector<bool> uniform;
        for (size_t input = 0; input < entry.inputs.size(); ++input)
          uniform.push_back(input % 2 == (first_uniform ? 0 : 1));
        std::vector<std::vector<Value>> points;
        points.reserve(kPoints);
        for (unsigned point = 0; point < kPoints; ++point) {
          points.push_back(inputs_at(entry, point));
          for (size_t input = 0; input < entry.inputs.size(); ++input)
            if (uniform[input]) points.back()[input] = points[0][input];
        }
        const LanesOutcome lanes = run_lanes(module, parameters, module.entries[i].function, points, uniform);
        EXPECT_THAT(lanes.broken_promises, IsEmpty()) << text << to_text(module);
        for (unsigned point = 0; point < kPoints; ++point) {
          const Outcome alone = Interpreter(module, parameters).run(entry.name, points[point]);
          EXPECT_EQ(to_text(lanes.lanes[point]), to_text(alone)) << text << "lane " << point << '\n' << to_text(module);
          EXPECT_EQ(lanes.lanes[point].steps, alone.steps) << text << "lane " << point;
        }
      }
    }
  }
}

class Agreement : public testing::TestWithParam<const char*> {};

TEST_P(Agreement, WithStockLua) { expect_agreement(GetParam()); }
TEST_P(Agreement, OfLanesWithPoints) { expect_lanes_agree(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Expressions, Agreement,
    testing::Values(
        R"(function f(p, id) return p.x + p.y * p.z - p.x / p.y, -p.x, id + 1, id * id, -id, id - 7 end)",
        R"(function f(p, id) return p.x // p.y, p.x % p.y, p.x ^ p.y, p.x ^ 2, p.x ^ 0.5, p.z ^ 3 end)",
        R"(function f(id, frame) return id // frame, id % frame end)",
        R"(function f(id) return id // 3, id % -5, id // -1, id % -1, 7 // 2, -7 % 3 end)",
        R"(function f(id, frame) return id & frame, id | 12, id ~ frame, ~id, id << 3, id >> frame, id << frame end)",
        R"(function f(id, time) return id / 3, id + 0.5, id * time, id < time, id <= time, id == time, id ~= time, time > id end)",
        R"(function f(p, time) return p.x < p.y, p.x <= p.y, p.x > p.y, p.x >= p.y, p.x == p.y, p.x ~= p.y end)",
        R"(function f(p, n) return p + n, p - 2, 3 * p, p / n, -p, p * n, 1 / p, p ^ 2, p == n, p ~= n, p % n end)",
        R"(function f(p) return p.zyx, p.xy, p.rgb, p[1], p[3], vec2(p.x, 1), vec4(p, 1), vec3(2), rgb(1, 2, 3), vec4(p.xy, p.zx) end)",
        R"(function f(p) return p:length(), length(p), normalize(p), p:dot(vec3(1, 2, 3)), cross(p, vec3(0, 0, 1)) end)",
        R"(function f(p) return mix(p, vec3(1), 0.25), clamp(p, 0, 1), smoothstep(0, 1, p.x), sin(p), max(p.x, p.y) end)",
        R"(function f(p) return noise(p), perlin(p), fbm(p, 3), turbulence(p), hash(p.x), fbm(p.xy, 2, 2.1, 0.4) end)",
        R"(function f(id) return math.max(id, 3, -2), math.min(id, 7), math.abs(id), math.fmod(id, 3), math.ult(id, 9) end)",
        R"(function f(id, frame) return math.fmod(id, frame) end)",
        R"(function f(p) return math.floor(p.x), math.ceil(p.y), math.sqrt(p.z), math.pi, math.maxinteger, math.huge end)",
        R"(function f(id) return math.floor(id), math.mininteger, 0x7fffffffffffffff + 1, 1e308 * 10 end)",
        R"(function f(p, backface) return not backface, backface and p.x < 1, backface or p.x < 1, not (p.x < p.y) end)",
        R"(function f(p) return p.x < 1 and p.y < 1 and p.z < 1 or p.x > 2 and p.y > 2 end)",
        R"(function f(p) return p.x < 1 and 2.0 or 3.0, p.x < 1 and p or vec3(1), p.x < 0 and 1 or p.x < 1 and 2 or 3 end)",
        R"(function f(p) return (p.x < 0 and noise(p)) or p.y < 1 and perlin(p) or 0.5 end)",
        R"(function f(p, id) return p.x < 4, 3 <= p.y, 1 == p.x, p.x ~= 0, id < 9007199254740993, p.x < 9007199254740993 end)",
        R"(function f(id) return id ~= 0 and 10 // id > 2, id == 0 or 10 % id == 1 end)",
        R"(function f(id) return id ~= 0 and 10 // id or 7 end)",
        R"(function f(p, id) return 1 == 1.0, id == 1, id < 2.5, 2^53 == 2^53 + 1, -0.0, 0x.8p1, 3 | 4 end)"));

INSTANTIATE_TEST_SUITE_P(
    Statements, Agreement,
    testing::Values(
        R"(function f(p)
  local a, b = p.x, p.y
  a, b = b, a
  local c
  if a < b then c = a elseif a == b then c = 7 else c = b end
  do local a = 5.0; c = c + a end
  return a, b, c
end)",
        R"(function f(p)
  local s = 0
  for i = 1, 10 do s = s + i * p.x end
  for i = 10, 1, -3 do s = s - i end
  for i = 1, 0 do s = s + 1000 end
  for x = 0, 1, 0.125 do s = s + x end
  for x = 1.0, -1, -0.3 do s = s + x * 0.5 end
  return s
end)",
        R"(function f(id)
  local n = 0
  for i = math.maxinteger - 2, math.maxinteger do n = n + 1 end
  for i = math.mininteger + 1, math.mininteger, -1 do n = n + 10 end
  for i = math.mininteger, math.maxinteger, math.maxinteger do n = n + 100 end
  for i = 1, 3.7 do n = n + 1000 end
  for i = 3, 0.5, -1 do n = n + 10000 end
  for i = 1, -math.huge do n = n + 1 end
  for i = math.maxinteger - 1, math.huge do n = n + 100000 end
  for i = 0, 0 / 0 do n = n + 1 end
  return n
end)",
        R"(function f(frame)
  local n = 0
  local step = frame
  if step > 0 and step < 100 then for i = 1, 20, step do n = n * 3 + i end end
  if step < 0 and step > -100 then for i = 20, -5, step do n = n * 3 + i end end
  return n
end)",
        R"(function f(p, frame) local s = 0.0 for i = 1, 3, frame do s = s + 1 if i > 100 or i < -100 then break end end return s end)",
        R"(function f(p) local s = 0.0 for x = p.x, p.y, p.z do s = s + x if s > 50 or s < -50 then break end end return s end)",
        R"(function f(p)
  local s = 0.0
  for i = 1, 20 do
    if i % 2 == 0 then goto continue end
    if i > 15 then break end
    s = s + i
    for j = 1, 5 do
      if j == 3 then goto continue end
      if s > 60 then goto done end
      s = s + p.x + 0.5
    end
    ::continue::
  end
  ::done::
  return s
end)",
        R"(function f(p)
  local n, x = 0, p.x
  while x < 100 do
    x = x * 2 + 1
    n = n + 1
    if n > 20 then break end
  end
  repeat
    local last = n > 12
    n = n + 5
  until last or n > 40
  while true do n = n + 1 if n > 50 then return n, x end end
end)",
        R"(function f(p)
  for i = 1, 10 do
    for j = 1, 10 do
      if i * j > p.x + 20 then return i, j end
    end
  end
  return 0, 0
end)",
        R"(function f(p) local i = 5 for i = 1, 3 do i = i + p.x end return i end)",
        R"(function f(p)
  local total = 0.0
  for i = 1, 4 do
    local x = p.x
    if i > 2 then x = x + i end
    total = total * 2 + x
  end
  return total
end)",
        R"(function f(p) if p.x < 0 then return 1 end if p.x == 0 then return 2.5 end do return p.y end end)"));

INSTANTIATE_TEST_SUITE_P(
    Functions, Agreement,
    testing::Values(
        R"(local function two(x) return x, x * x end
function f(p) local a, b = two(p.x) local c, d = (two(p.y)) , 1 return a, b, c, d, two(p.z) end)",
        R"(local function pair(a, b) return b, a end
function f(p) return pair(pair(p.x, p.y)) end)",
        R"(function f(p)
  local count = 0
  local function bump(by) count = count + by return count end
  local a = bump(1)
  local b = bump(10)
  local function twice(by) bump(by) bump(by) end
  twice(100)
  return a, b, count
end)",
        R"(local function poly(x) return x * 2 + 1 end
function f(p, id) return poly(p.x), poly(id), poly(p) end)",
        R"(local function sign(x) if x < 0 then return -1 elseif x > 0 then return 1 end return 0 end
function f(p) return sign(p.x) * 0.5, sign(p.y) end)",
        R"(local function late(x, y) x = x + 0.5 return x * y end
function f(id) return late(id, 2), late(1, id) end)",
        R"(local OCTAVES <const> = 4
local COPPER <const> = rgb(0.72, 0.43, 0.20)
local gain = 0.5
local total = 0.0
for i = 1, OCTAVES do total = total + gain ^ i end
if total > 1 then total = 1.0 else total = total + 0.125 end
K = 3
function f(p) local s = 0.0 for i = 1, OCTAVES do s = s + noise(p * i) * gain end return s, COPPER * total, K end)",
        R"(local scale = param("scale", 4.0, { min = 0, max = 10 })
local n = param("n", 3)
local tint = param("tint", rgb(1, 0.5, 0.25))
local flag = param("flag", true)
local scaled = param("other", 2.5) * 2
function f(p) local s = 0 for i = 1, n do s = s + i * scale end return s, tint * p, flag and 1 or 2, scaled end)",
        R"(function color(p) return vec3(1) end
function roughness(p) return 1 end
function f(p) return roughness(p) + color(p).x end)"));

INSTANTIATE_TEST_SUITE_P(Faults, Agreement,
                         testing::Values(R"(function f(p) assert(p.x > 0, "x must be positive") return p.x end)",
                                         R"(function f(p) if p.x < 0 then error("negative") end return p.x end)",
                                         R"(function f(p) if p.x < 0 then error("negative") else return p.x end end)",
                                         R"(local function deep(x) assert(x < 3) return x end
function f(p) local s = 0.0 for i = 1, 3 do s = s + deep(p.x) end return s end)",
                                         R"(function f(id) local a = id // 2 local b = 10 // a return 1 end)"));

std::string text_of(const std::string& source, bool optimized = false, Precision precision = Precision::F64) {
  const Checked checked = check(source);
  EXPECT_THAT(checked.errors, IsEmpty());
  Module module = build(checked.program);
  if (optimized) optimize(module, precision);
  EXPECT_THAT(verify(module), IsEmpty());
  return "\n" + to_text(module);
}

uint64_t steps_of(const std::string& source) {
  const Checked checked = check(source);
  EXPECT_THAT(checked.errors, IsEmpty());
  const Module module = build(checked.program);
  return Interpreter(module).run("f", inputs_at(*checked.program.info.find_entry("f"), 0)).steps;
}

TEST(Build, CountsStepsOfCallsAndIterations) {
  EXPECT_EQ(steps_of("function f(p) return p.x end"), 1u);
  EXPECT_EQ(steps_of("local function g(x) return x end function f(p) return g(g(p.x)) end"), 3u);
  EXPECT_EQ(steps_of("function f(p) for i = 1, 10 do end return 1 end"), 11u);
  EXPECT_EQ(steps_of("function f(p) for i = 1, 0 do end return 1 end"), 1u);
  EXPECT_EQ(steps_of("function f(p) local n = 0 while n < 5 do n = n + 1 end return n end"), 6u);
  EXPECT_EQ(steps_of("function f(p) local n = 0 repeat n = n + 1 until n >= 5 return n end"), 6u);
  EXPECT_EQ(steps_of("function f(p) for i = 1, 10 do if i == 3 then break end end return 1 end"), 4u);
}

TEST(Build, FaultsHaveTheirKindsAndMessages) {
  const auto fault_of = [](const std::string& source) {
    const Checked checked = check(source);
    EXPECT_THAT(checked.errors, IsEmpty());
    const Module module = build(checked.program, {.step_limit = 1000});
    const Outcome outcome = Interpreter(module).run(
        "f", std::vector<Value>(checked.program.info.find_entry("f")->inputs.size(), Value::of(0.0)));
    return std::string(fault_name(outcome.fault)) + (outcome.message.empty() ? "" : ": ") + outcome.message;
  };
  EXPECT_EQ(fault_of("function f(time) assert(time > 1, 'too early') return time end"), "assert: too early");
  EXPECT_EQ(fault_of("function f(time) assert(time > 1) return time end"), "assert: assertion failed!");
  EXPECT_EQ(fault_of("function f(time) error('no') end"), "error: no");
  EXPECT_EQ(fault_of("function f(id) return 1 // id end"), "division");
  EXPECT_EQ(fault_of("function f(id) return 1 % id end"), "division");
  EXPECT_EQ(fault_of("function f(id) return math.fmod(1, id) end"), "division");
  EXPECT_EQ(fault_of("function f(id) for i = 1, 2, id do end return 1 end"), "for-step");
  EXPECT_EQ(fault_of("function f(time) for i = 1, 2, time do end return 1 end"), "for-step");
  EXPECT_EQ(fault_of("function f(time) while true do end end"), "step-limit");
  EXPECT_EQ(fault_of("function f(time) return math.floor(time + 1e300) end"), "integer-range");
  EXPECT_EQ(fault_of("function f(time) return math.floor(0 / time) end"), "integer-range");
}

TEST(Build, TopLevelFillsGlobals) {
  EXPECT_EQ(text_of(R"(
local scale = param("scale", 4.0)
local twice = scale * 2
function f(p) return p * twice end
)"),
            R"(
global @0 twice: number
global @1 scale: number, parameter 0
entry f = f

init top_level() {
  var $0.scale: number
  var $1.twice: number
  %0: number = load_global @1 scale
  store $0.scale, %0
  %1: number = load $0.scale
  %2: integer = const.i 2
  %3: number = const.n 2
  %4: number = mul %1, %3
  store $1.twice, %4
  %5: number = load $1.twice
  store_global @0 twice, %5
}

function f(p: vec3) -> vec3 {
  var $0.p: vec3
  step
  %0: vec3 = argument 0
  store $0.p, %0
  %1: vec3 = load $0.p
  %2: number = load_global @0 twice
  %3: vec3 = construct %2
  %4: vec3 = mul %1, %3
  return %4
}
)");
}

TEST(Build, LongChainsOfElseifAreNotNested) {
  std::string source = "function f(id) local x if id == 0 then x = 1";
  for (int i = 1; i < 3000; ++i)
    source += " elseif id == " + std::to_string(i) + " then x = " + std::to_string(i + 1);
  source += " else x = 0 end return x end";
  const Checked checked = check(source);
  ASSERT_THAT(checked.errors, IsEmpty());
  Module module = build(checked.program);
  EXPECT_THAT(verify(module), IsEmpty());
  optimize(module, Precision::F64);
  EXPECT_EQ(to_text(Interpreter(module).run("f", {Value::of(int64_t{2500})})), "2501");
  EXPECT_EQ(to_text(Interpreter(module).run("f", {Value::of(int64_t{-1})})), "0");
}

} // namespace
} // namespace moonshade::ir
