// The stock-Lua oracle behind the Shader interface: a pool of Lua states, one for each call of run() under way.
#include "runtime/interpret.h"

#include "compiler/base/arena.h"
#include "compiler/base/diagnostics.h"
#include "compiler/syntax/parser.h"
#include "runtime/frontend_parts.h"
#include "runtime/interpret_state.h"
#include "runtime/interpret_steps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cfenv>
#include <mutex>

namespace moonshade {

namespace {

/// What Lua's loader of files skips: a byte order mark and a first line that begins with `#`. Lines keep their numbers.
std::string without_prologue(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with("#")) text.erase(0, std::min(text.find('\n'), text.size()));
  return text;
}

std::string counted_text(const std::string& name, const std::string& text, CountedSteps steps) {
  SourceSet sources;
  Arena arena;
  Diagnostics diagnostics;
  const FileId file = sources.add(name, text);
  const syntax::Chunk* chunk = syntax::parse(sources, file, arena, diagnostics);
  return with_counted_steps(*chunk, sources.text(file), steps);
}

/// Shading happens in the default floating-point environment, whatever the host's is.
class DefaultFloatingPoint {
public:
  DefaultFloatingPoint() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatingPoint() { std::fesetenv(&saved_); }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

private:
  std::fenv_t saved_;
};

class InterpretedShader final : public Shader {
public:
  explicit InterpretedShader(InterpretSource source) : source_(std::move(source)) {}

  /// Opens the first state, so that what is wrong with the top level shows at once.
  std::string start() {
    std::string error;
    if (auto state = InterpretState::open(source_, error)) idle_.push_back(std::move(state));
    return error;
  }

  const ShaderInfo& info() const override { return source_.info; }
  Precision precision() const override { return Precision::F64; }
  unsigned width() const override { return 1; }

  void run(size_t entry, const Batch& batch) const override {
    DefaultFloatingPoint environment;
    std::unique_ptr<InterpretState> state = borrow();
    if (!state) return fail(entry, batch);
    for (uint64_t row = 0; row < batch.count; ++row) {
      const uint64_t limit = step_limit();
      const FaultCode code = state->call(entry, batch, row, limit);
      note_steps(code, limit, state->steps_left());
      if (batch.fault_codes) batch.fault_codes[row] = uint8_t(code);
      if (code != FaultCode::None && batch.faults)
        report(*batch.faults, code, row, [&] { return state->last_fault(); });
    }
    std::lock_guard lock(mutex_);
    idle_.push_back(std::move(state));
  }

  bool has_prints() const override {
    for (size_t i = 0; i < source_.files.size(); ++i)
      if ((i == 0 || i != source_.library) && source_.files[i].text.find("print") != std::string::npos) return true;
    return false;
  }

  void print(size_t entry, const Batch& batch, uint64_t point, const PrintSink& sink) const override {
    DefaultFloatingPoint environment;
    std::unique_ptr<InterpretState> state = borrow();
    if (!state) return;
    std::vector<const void*> inputs;
    size_t column = 0;
    for (const InputInfo& input : source_.info.entries[entry].inputs)
      for (unsigned i = 0; i < component_count(input.type); ++i, ++column)
        inputs.push_back(static_cast<const std::byte*>(batch.inputs[column]) +
                         point * (input.type == ValueType::Boolean ? 1 : sizeof(uint64_t)));
    // The results were stored by run(); these go nowhere.
    std::vector<std::array<std::byte, sizeof(uint64_t)>> results;
    for (const ValueType type : source_.info.entries[entry].results)
      results.resize(results.size() + component_count(type));
    std::vector<void*> outputs;
    for (auto& result : results)
      outputs.push_back(result.data());
    state->call(entry, {1, inputs.data(), outputs.data(), nullptr, nullptr}, 0, source_.step_limit, &sink);
    std::lock_guard lock(mutex_);
    idle_.push_back(std::move(state));
  }

  FaultSite fault_site(uint32_t site) const override {
    std::lock_guard lock(mutex_);
    if (site >= sites_.size()) return {};
    const InterpretFault& fault = sites_[site];
    return {fault.file, fault.place.line, fault.place.column, fault.message};
  }

private:
  static constexpr uint64_t kPatience = 64, kAllowance = 20, kLeast = 1000;

  uint64_t step_limit() const {
    if (!source_.impatient || overruns_.load(std::memory_order_relaxed) < kPatience) return source_.step_limit;
    return std::min(source_.step_limit, kLeast + kAllowance * longest_.load(std::memory_order_relaxed));
  }
  void note_steps(FaultCode code, uint64_t limit, uint64_t left) const {
    if (!source_.impatient) return;
    if (code == FaultCode::StepLimit) {
      overruns_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    uint64_t longest = longest_.load(std::memory_order_relaxed);
    while (limit - left > longest &&
           !longest_.compare_exchange_weak(longest, limit - left, std::memory_order_relaxed)) {
    }
  }

  std::unique_ptr<InterpretState> borrow() const {
    {
      std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto state = std::move(idle_.back());
        idle_.pop_back();
        return state;
      }
    }
    std::string error;
    return InterpretState::open(source_, error);
  }

  template <class Describe> void report(FaultReport& report, FaultCode code, uint64_t row, Describe describe) const {
    if (report.count++ != 0) return;
    report.first_point = row;
    report.first_code = code;
    report.first_site = add_site(describe());
  }

  uint32_t add_site(InterpretFault fault) const {
    std::lock_guard lock(mutex_);
    for (size_t i = 0; i < sites_.size(); ++i)
      if (sites_[i].code == fault.code && sites_[i].place == fault.place && sites_[i].file == fault.file &&
          sites_[i].message == fault.message)
        return uint32_t(i);
    sites_.push_back(std::move(fault));
    return uint32_t(sites_.size() - 1);
  }

  /// No state could be had (memory): every point faults.
  void fail(size_t entry, const Batch& batch) const {
    size_t component = 0;
    for (ValueType type : source_.info.entries[entry].results)
      for (unsigned i = 0; i < component_count(type); ++i, ++component) {
        const size_t size = type == ValueType::Boolean ? 1 : 8;
        std::fill_n(static_cast<char*>(batch.outputs[component]), size * batch.count, 0);
      }
    for (uint64_t row = 0; row < batch.count; ++row) {
      if (batch.fault_codes) batch.fault_codes[row] = uint8_t(FaultCode::Error);
      if (batch.faults)
        report(*batch.faults, FaultCode::Error, row, [&] {
          return InterpretFault{FaultCode::Error, source_.files[0].name, {}, "no memory for a Lua state"};
        });
    }
  }

  const InterpretSource source_;
  mutable std::mutex mutex_; // guards the two below
  mutable std::vector<std::unique_ptr<InterpretState>> idle_;
  mutable std::vector<InterpretFault> sites_;
  mutable std::atomic<uint64_t> overruns_ = 0, longest_ = 0;
};

} // namespace

Instantiation interpret(const CheckedShader& shader, const std::map<std::string, Constant>& parameters,
                        const InterpretOptions& options) {
  InterpretSource source;
  const CountedSteps steps = options.count_steps ? CountedSteps::All : CountedSteps::Loops;
  const bool unguarded = !options.count_steps && options.step_limit == 0;
  const auto add = [&](const std::string& module, FileId file) {
    InterpretSource::File added{module, std::string(shader.sources().name(file)),
                                without_prologue(std::string(shader.sources().text(file))), ""};
    added.loaded = unguarded ? added.text : counted_text(added.name, added.text, steps);
    source.files.push_back(std::move(added));
  };
  add("", FileId{0});
  for (const auto& module : shader.parts().modules)
    add(module.name, module.chunk->file);
  if (const syntax::Chunk* library = shader.parts().library) {
    // Its loops count, its calls do not.
    source.library = uint32_t(source.files.size());
    const std::string text(shader.sources().text(library->file));
    source.files.push_back({"", std::string(shader.sources().name(library->file)), text,
                            unguarded ? text : counted_text("", text, CountedSteps::Loops)});
  }
  source.info = shader.info();
  source.step_limit = options.step_limit;
  source.impatient = options.impatient;
  for (const auto& [name, value] : parameters) {
    const ParameterInfo* parameter = nullptr;
    for (const ParameterInfo& candidate : source.info.parameters)
      if (candidate.name == name) parameter = &candidate;
    if (!parameter) return {nullptr, "the shader has no parameter '" + name + "'"};
    CheckedConstant checked = check_override(*parameter, value);
    if (!checked.error.empty()) return {nullptr, checked.error};
    source.parameters.emplace(name, std::move(checked.value));
  }
  std::vector<Constant> values;
  for (const ParameterInfo& parameter : source.info.parameters) {
    const auto given = source.parameters.find(parameter.name);
    values.push_back(given == source.parameters.end() ? parameter.default_value : given->second);
  }
  std::string error;
  source.images = ImageSet::open(source.info, values, options.images, error);
  if (source.images == nullptr) return {nullptr, error};
  auto interpreted = std::make_shared<InterpretedShader>(std::move(source));
  DefaultFloatingPoint environment;
  if (error = interpreted->start(); !error.empty()) return {nullptr, error};
  return {interpreted, ""};
}

} // namespace moonshade
