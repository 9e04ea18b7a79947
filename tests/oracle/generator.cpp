// The program as a whole, its names and its top level.
#include "tests/oracle/generator.h"

#include "tests/oracle/generator_impl.h"

#include <algorithm>

namespace moonshade::oracle {

void Generator::line(const std::string& text) {
  text_.append(static_cast<size_t>(2 * indent_), ' ');
  text_ += text;
  text_ += '\n';
}

void Generator::open(const std::string& text) {
  line(text);
  ++indent_;
}

void Generator::close(const std::string& text) {
  --indent_;
  line(text);
}

T Generator::any_type() {
  static const std::vector<T> weighted = {T::N, T::N, T::N,  T::N,  T::N,  T::I,  T::I,  T::I,
                                          T::B, T::B, T::V3, T::V3, T::V2, T::V4, T::V3, T::V2};
  if (random_.chance(0.04)) return random_.chance(0.7) ? T::M3 : T::M4;
  return random_.pick(weighted);
}

void Generator::leave(const Mark& mark) {
  scope_.resize(mark.scope);
  tables_.erase(tables_.begin() + static_cast<std::ptrdiff_t>(mark.tables), tables_.end());
  functions_.erase(functions_.begin() + static_cast<std::ptrdiff_t>(mark.functions), functions_.end());
}

/// What the top level made is frozen for entries and what they call.
bool Generator::may_assign(int variable_level) const { return variable_level > 0 || frames_.empty() || writes_top_; }

void Generator::note_effect(int variable_level) {
  for (int i = variable_level; i < level(); ++i)
    frames_[static_cast<size_t>(i)].effect = std::min(frames_[static_cast<size_t>(i)].effect, variable_level);
}

std::vector<const Variable*> Generator::in_scope(T type, bool assignable) const {
  std::vector<const Variable*> result;
  for (const Variable& variable : scope_)
    if (variable.type == type && (!assignable || (variable.assignable && may_assign(variable.level))))
      result.push_back(&variable);
  return result;
}

// ---- the program's parts -------------------------------------------------------------------------------------------

std::string Generator::program() {
  make_shapes();
  parameters();
  const int constants = random_.between(0, 3);
  for (int i = 0; i < constants; ++i)
    top_level_constant();
  if (random_.chance(0.25)) top_level_loop();
  if (random_.chance(0.4)) declare_table(1);
  if (random_.chance(0.2)) closure_maker();
  if (random_.chance(0.12)) object_maker();
  if (random_.chance(0.1)) composer();
  if (random_.chance(0.15)) repeated_caller();
  const int functions = random_.between(0, 3);
  for (int i = 0; i < functions; ++i)
    function(random_.between(1, 4), 2);
  if (random_.chance(0.25)) top_level_state();
  entry();
  return std::move(text_);
}

void Generator::parameters() {
  const int count = random_.between(0, 2);
  for (int i = 0; i < count; ++i) {
    const T type = random_.pick(std::vector<T>{T::N, T::I, T::V3, T::B, T::V2});
    const std::string name = fresh("q");
    const std::string value = type == T::N    ? "0.75"
                              : type == T::I  ? "3"
                              : type == T::B  ? "true"
                              : type == T::V2 ? "vec2(-1.5, 3)"
                                              : "vec3(0.5, 0.25, 1.5)";
    line("local " + name + " = param(\"" + name + "\", " + value + ")");
    scope_.push_back({name, type, false, 0});
  }
}

void Generator::top_level_constant() {
  const T type = any_type();
  const std::string value = expression(type, 2);
  const std::string name = fresh("K");
  line("local " + name + (random_.chance(0.5) ? " <const> = " : " = ") + value);
  scope_.push_back({name, type, false, 0});
}

void Generator::top_level_loop() {
  const std::string name = fresh("K");
  line("local " + name + " = 0.0");
  open("for i = 1, " + std::to_string(random_.between(1, 5)) + " do");
  line(name + " = " + name + " + i * " + expression(T::N, 1));
  close();
  scope_.push_back({name, T::N, false, 0});
}

/// Functions that assign what the top level made, called while it runs; then statements of its own.
void Generator::top_level_state() {
  const size_t first = scope_.size();
  declare(T::N, 2);
  declare(random_.chance(0.5) ? T::I : T::V3, 2);
  for (size_t i = first; i < scope_.size(); ++i)
    if (!scope_[i].assignable) return;
  writes_top_ = true;
  function(random_.between(1, 2), 1);
  writes_top_ = false;
  for (int i = random_.between(1, 2); i > 0; --i)
    call_statement();
  if (random_.chance(0.5)) closure_instance();
  statement(1);
}

void Generator::entry() {
  Frame frame;
  const int results = random_.between(1, 3);
  while (frame.results.size() < static_cast<size_t>(results))
    if (const T type = any_type(); !is_matrix(type)) frame.results.push_back(type);
  open("function probe(p, uv, time, id, backface)");
  frames_.push_back(frame);
  scope_.push_back({"p", T::V3, true, 1});
  scope_.push_back({"uv", T::V2, true, 1});
  scope_.push_back({"time", T::N, true, 1});
  scope_.push_back({"id", T::I, true, 1});
  scope_.push_back({"backface", T::B, true, 1});
  if (random_.chance(0.6)) declare_table(2);
  if (random_.chance(0.5)) closure_instance();
  const int statements = random_.between(2, 8);
  for (int i = 0; i < statements; ++i)
    statement(3);
  line("return " + result_list());
  close();
}

std::string generate_program(uint64_t seed) { return Generator(seed * 0x2545f4914f6cdd1du + 1).program(); }

} // namespace moonshade::oracle
