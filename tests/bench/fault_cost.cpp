// What the bookkeeping of faults and steps costs: each shader as it is, against the same code without its `fault` and
// `step` instructions, over points that do not fault. The two run by turns; the least time of each counts.
#include "compiler/codegen/batch.h"
#include "compiler/ir/walk.h"
#include "runtime/floating_point.h"
#include "runtime/frontend_parts.h"
#include "runtime/jit.h"

#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

namespace {

using namespace moonshade;

constexpr size_t kPoints = 4096;
constexpr int kRounds = 400;

struct Subject {
  const char* name;
  const char* entry;
  std::string text;
};

std::string gallery(const char* name) {
  std::ifstream file(std::string(MOONSHADE_SHADERS "/") + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<Subject> subjects() {
  return {
      {"copper.lua", "color", gallery("copper.lua")},
      {"planet.lua", "height", gallery("planet.lua")},
      {"assert", "height", R"(function height(p)
  assert(p.x < 1e9, "far away")
  return fbm(p, 4)
end)"},
      {"divide by a variable", "height", R"(function height(p, id)
  local row = math.floor(p.y * 8)
  return noise(p) * (row % id) + row // id
end)"},
      {"vector by an index", "height", R"(function height(p)
  local s = 0.0
  for i = 1, 3 do s = s + p[math.floor(fract(p[i]) * 2.9) + 1] end
  return s + noise(p)
end)"},
      {"loop to a parameter", "height", R"(local octaves = param("octaves", 5)
function height(p)
  local s, a = 0.0, 1.0
  for i = 1, octaves do
    s = s + a * noise(p)
    p, a = p * 2, a * 0.5
  end
  return s
end)"},
      {"Mandelbrot, open end", "height", R"(local bailout = param("bailout", 4.0)
function height(p)
  local x, y, n = 0.0, 0.0, 0
  while n < 256 and x * x + y * y < bailout do
    x, y = x * x - y * y + p.x * 0.5, 2 * x * y + p.y * 0.5
    n = n + 1
  end
  return n
end)"},
  };
}

/// Without faults and steps: how many there were.
size_t strip(ir::Module& module) {
  size_t removed = 0;
  for (ir::Function& function : module.functions) {
    ir::rewrite_blocks(function, [&](ir::ValueId id, std::vector<ir::ValueId>& result) {
      const ir::Op op = function.instructions[id].op;
      const bool is_bookkeeping = op == ir::Op::Fault || op == ir::Op::Step;
      if (!is_bookkeeping) result.push_back(id);
      removed += is_bookkeeping ? 1 : 0;
      return true;
    });
    ir::remove_dead_code(function);
  }
  return removed;
}

/// Code for one entry.
struct Code {
  codegen::CodeInfo info;
  std::optional<JitCode> jit;
  codegen::Kernel kernel = nullptr;
  std::vector<uint64_t> constants;
};

bool generate(const ir::Module& module, const CompileOptions& options, Code& code) {
  codegen::Generated generated = codegen::generate(module, codegen_options(options));
  std::string object = generated.error.empty() ? generated.object() : "";
  if (!generated.error.empty()) {
    std::fprintf(stderr, "%s\n", generated.error.c_str());
    return false;
  }
  code.info = std::move(generated.info);
  code.jit = JitCode::load(std::move(object));
  code.kernel = reinterpret_cast<codegen::Kernel>(code.jit->function(code.info.entries[0].symbol));
  code.constants.assign(code.info.constants_size / 8 + 1, 0);
  return code.kernel != nullptr;
}

/// The values of parameters, and what the top level makes of them.
void fill_constants(Code& code, const ir::Module& module, const ShaderInfo& info) {
  auto* bytes = reinterpret_cast<unsigned char*>(code.constants.data());
  for (size_t i = 0; i < module.globals.size(); ++i) {
    if (module.globals[i].parameter == ir::kNone) continue;
    const Constant& value = info.parameters[module.globals[i].parameter].default_value;
    unsigned char* to = bytes + code.info.global_offsets[i];
    if (const auto* integer = std::get_if<int64_t>(&value)) std::memcpy(to, integer, sizeof *integer);
    if (const auto* number = std::get_if<double>(&value)) {
      const auto narrow = static_cast<float>(*number);
      std::memcpy(to, &narrow, sizeof narrow);
    }
  }
  if (code.info.init_symbol.empty()) return;
  uint32_t fault = 0;
  codegen::call_init(reinterpret_cast<codegen::Init>(code.jit->function(code.info.init_symbol)), bytes, fault);
}

/// Arrays of points: numbers in -2..2, integers in 1..9.
struct Arrays {
  std::vector<std::vector<uint64_t>> columns;
  std::vector<const void*> inputs;
  std::vector<void*> outputs;
};

Arrays make_arrays(const EntryInfo& entry) {
  Arrays arrays;
  std::mt19937 random(3);
  for (const InputInfo& input : entry.inputs)
    for (unsigned c = 0; c < component_count(input.type); ++c) {
      auto& column = arrays.columns.emplace_back(kPoints);
      for (size_t i = 0; i < kPoints; ++i) {
        const auto number = std::uniform_real_distribution<float>(-2, 2)(random);
        const int64_t integer = static_cast<int64_t>(random() % 9) + 1;
        if (input.type == ValueType::Integer)
          column[i] = static_cast<uint64_t>(integer);
        else
          std::memcpy(reinterpret_cast<char*>(column.data()) + i * sizeof number, &number, sizeof number);
      }
    }
  const size_t first_output = arrays.columns.size();
  for (const ValueType type : entry.results)
    for (unsigned c = 0; c < component_count(type); ++c)
      arrays.columns.emplace_back(kPoints);
  for (size_t i = 0; i < arrays.columns.size(); ++i)
    if (i < first_output)
      arrays.inputs.push_back(arrays.columns[i].data());
    else
      arrays.outputs.push_back(arrays.columns[i].data());
  return arrays;
}

/// Nanoseconds a point of this thread's time.
double measure(const Code& code, Arrays& arrays, uint64_t& faults) {
  const auto now = [] {
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
  };
  codegen::BatchFaults found;
  const double begin = now();
  codegen::run_batch(code.kernel, code.info.entries[0].info,
                     {kPoints, arrays.inputs.data(), arrays.outputs.data(), code.constants.data(), nullptr}, found,
                     nullptr);
  faults = found.count;
  return (now() - begin) / kPoints;
}

bool compare(const Subject& subject, unsigned width) {
  const CheckedShader checked(subject.name, subject.text, {subject.entry});
  CompileOptions options;
  options.entries = {subject.entry};
  options.width = width;
  if (!checked.ok()) return false;
  ir::Module with = build_module(checked, options), without = with;
  const size_t removed = strip(without);
  if (removed == 0) {
    std::printf("%-22s %5u   no fault is possible: no bookkeeping\n", subject.name, width);
    return true;
  }
  Code plain, kept;
  if (!generate(without, options, plain) || !generate(with, options, kept)) return false;
  fill_constants(plain, without, checked.info());
  fill_constants(kept, with, checked.info());
  Arrays arrays = make_arrays(checked.info().entries[0]);
  double least_plain = 1e30, least_kept = 1e30;
  uint64_t faults = 0, ignored = 0;
  for (int round = 0; round < kRounds; ++round) {
    least_plain = std::min(least_plain, measure(plain, arrays, ignored));
    least_kept = std::min(least_kept, measure(kept, arrays, faults));
  }
  std::printf("%-22s %5u %9.2f %9.2f %+8.1f %%%s\n", subject.name, width, least_plain, least_kept,
              (least_kept / least_plain - 1) * 100, faults != 0 ? "  (points fault!)" : "");
  return true;
}

} // namespace

int main() {
  const DefaultFloatingPoint environment;
  std::printf("%-22s %5s %9s %9s %8s\n", "nanoseconds a point", "lanes", "without", "with", "cost");
  bool ok = true;
  for (const Subject& subject : subjects())
    for (const unsigned width : {1u, native_width(Precision::F32)})
      ok = compare(subject, width) && ok;
  return ok ? 0 : 1;
}
