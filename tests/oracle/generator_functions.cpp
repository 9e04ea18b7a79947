// Functions: what they take, give and assign; their calls. A call that assigns something stands as a statement of its
// own, since Lua leaves the order of evaluation inside an expression open.
#include "tests/oracle/generator_impl.h"

#include <algorithm>
#include <utility>

namespace moonshade::oracle {

// ---- calls ---------------------------------------------------------------------------------------------------------

bool Generator::can_call(const Function& callee, bool is_statement) const {
  if (callee.closure != nullptr || !callee.fields.empty() || !is_callable(callee)) return false;
  if (callee.effect != kNoEffect && (!is_statement || !may_assign(callee.effect))) return false;
  return std::ranges::none_of(callee.parameters, [&](const Parameter& parameter) {
    return parameter.is_mutated && (!is_statement || callee.table != nullptr);
  });
}

std::string Generator::call(T type, int depth) {
  std::vector<const Function*> fits;
  for (const Function& candidate : functions_)
    if (candidate.table == nullptr && candidate.same < 0 && !candidate.results.empty() &&
        candidate.results[0] == type && can_call(candidate, false))
      fits.push_back(&candidate);
  if (fits.empty() || calls_ >= kMaxCalls) return {};
  ++calls_;
  const Function callee = *random_.pick(fits);
  const std::string text = call_text(callee, depth);
  return callee.results.size() > 1 ? "(" + text + ")" : text;
}

/// A closure called where it is made: mk(a)(b).
std::string Generator::call_at_once(T type, int depth) {
  std::vector<const Function*> fits;
  for (const Function& maker : functions_) {
    if (maker.closure == nullptr || maker.effect != kNoEffect || !is_callable(maker)) continue;
    const Function& made = *maker.closure;
    const bool assigns_its_own = made.effect == kNoEffect || made.effect == kOwnState;
    const bool is_fit = assigns_its_own && made.table == nullptr && made.same < 0 &&
                        made.results == std::vector<T>{type} &&
                        std::ranges::none_of(made.parameters, &Parameter::is_mutated);
    if (is_fit) fits.push_back(&maker);
  }
  if (fits.empty() || calls_ >= kMaxCalls) return {};
  ++calls_;
  const Function maker = *random_.pick(fits);
  Function made = *maker.closure;
  made.name = call_text(maker, depth);
  made.effect = kNoEffect;
  return call_text(made, depth);
}

std::string Generator::call_text(const Function& callee, int depth) {
  if (callee.effect != kNoEffect) note_effect(callee.effect);
  std::string text = callee.name + "(";
  for (size_t i = 0; i < callee.parameters.size(); ++i)
    text += (i ? ", " : "") + argument(callee, i, depth);
  return text + ")";
}

std::string Generator::argument(const Function& callee, size_t i, int depth) {
  const Parameter& parameter = callee.parameters[i];
  if (!parameter.signature.empty()) {
    // What is defined behind the callee may call it: a recursion.
    const auto place = std::ranges::find(functions_, callee.name, &Function::name) - functions_.begin();
    const size_t before = std::exchange(callable_, std::min(callable_, static_cast<size_t>(place)));
    std::string text = function_argument(parameter.signature, depth);
    callable_ = before;
    return text;
  }
  if (parameter.type.shape != nullptr) return table_argument(parameter, depth);
  return expression(parameter.type.base, depth - 1);
}

std::string Generator::table_argument(const Parameter& parameter, int depth) {
  std::vector<const TableVariable*> fits;
  for (const TableVariable& table : tables_)
    if (table.shape == parameter.type.shape && (!parameter.is_mutated || is_writable(table))) fits.push_back(&table);
  if (fits.empty() || random_.chance(0.15)) return fresh_table(*parameter.type.shape, std::min(depth - 1, 1));
  const TableVariable table = *random_.pick(fits);
  if (parameter.is_mutated) note_write(table);
  return table.name;
}

/// A function of the program, of the library, or one written here.
std::string Generator::function_argument(const std::vector<T>& signature, int depth) {
  std::vector<std::string> fits;
  for (const Function& candidate : functions_) {
    bool is_fit = candidate.table == nullptr && candidate.same < 0 && candidate.results.size() == 1 &&
                  candidate.effect == kNoEffect && can_call(candidate, false) &&
                  candidate.parameters.size() + 1 == signature.size() && candidate.results[0] == signature.back();
    for (size_t i = 0; is_fit && i < candidate.parameters.size(); ++i)
      is_fit = candidate.parameters[i].signature.empty() && candidate.parameters[i].type.shape == nullptr &&
               candidate.parameters[i].type.base == signature[i];
    if (is_fit) fits.push_back(candidate.name);
  }
  if (!fits.empty() && random_.chance(0.5)) return random_.pick(fits);
  if (random_.chance(0.3)) {
    if (signature == std::vector<T>{T::N, T::N})
      return random_.pick(std::vector<std::string>{"sin", "sqrt", "abs", "floor", "fract", "math.cos", "saturate"});
    if (signature == std::vector<T>{T::N, T::N, T::N})
      return random_.pick(std::vector<std::string>{"min", "max", "mod", "pow", "step", "atan"});
    if (signature == std::vector<T>{T::V3, T::N}) return "length";
    if (signature == std::vector<T>{T::V3, T::V3}) return "normalize";
  }
  const Mark before = mark();
  std::string list;
  frames_.emplace_back();
  for (size_t i = 0; i + 1 < signature.size(); ++i) {
    const std::string name = fresh("x");
    list += (i ? ", " : "") + name;
    scope_.push_back({name, signature[i], true, level()});
  }
  const std::string text = "function(" + list + ") return " + expression(signature.back(), std::min(depth, 2)) + " end";
  frames_.pop_back();
  leave(before);
  return text;
}

/// A call whose results are named, assigned or left.
void Generator::call_statement() {
  std::vector<const Function*> fits;
  for (const Function& candidate : functions_)
    if (can_call(candidate, true)) fits.push_back(&candidate);
  if (fits.empty() || calls_ >= kMaxCalls) return assign();
  ++calls_;
  const Function callee = *random_.pick(fits);
  std::string kept;
  if (callee.same >= 0) { // the table that comes back is one that is known
    const Shape* shape = callee.parameters[static_cast<size_t>(callee.same)].type.shape;
    for (const TableVariable& table : tables_)
      if (table.shape == shape && is_writable(table) && !table.is_element) kept = table.name;
    if (kept.empty()) return assign();
  }
  std::string text;
  TableVariable same{};
  if (callee.same >= 0) {
    if (callee.effect != kNoEffect) note_effect(callee.effect);
    for (const TableVariable& table : tables_)
      if (table.name == kept) same = table;
    note_write(same);
    text = callee.name + "(";
    for (size_t i = 0; i < callee.parameters.size(); ++i)
      text += (i ? ", " : "") + (static_cast<int>(i) == callee.same ? kept : argument(callee, i, 2));
    text += ")";
  } else {
    text = call_text(callee, 2);
  }
  if ((callee.effect != kNoEffect || callee.same >= 0) && random_.chance(0.4)) return line(text);
  const bool has_table = callee.table != nullptr || callee.same >= 0;
  if (!has_table && callee.results.size() == 1 && random_.chance(0.3)) {
    const auto targets = in_scope(callee.results[0], true);
    if (!targets.empty()) {
      const Variable target = *random_.pick(targets);
      note_effect(target.level);
      return line(target.name + " = " + text);
    }
  }
  if (!has_table && !callee.results.empty() && callee.results[0] == T::B && random_.chance(0.5)) {
    open("if " + text + " then");
    block(1, 0);
    return close();
  }
  std::string names;
  const Mark before = mark();
  std::vector<Variable> made;
  if (has_table) {
    names = fresh("t");
    if (callee.table != nullptr) same = {names, callee.table, level(), true, true};
    same.name = names;
    if (callee.same >= 0) same.is_own = false;
  }
  const size_t wanted = callee.results.empty() ? 0 : 1 + random_.below(callee.results.size());
  for (size_t i = 0; i < wanted; ++i) {
    made.push_back({fresh("v"), callee.results[i], true, level()});
    names += (names.empty() ? "" : ", ") + made.back().name;
  }
  (void)before;
  if (names.empty()) return line(text);
  line("local " + names + " = " + text);
  scope_.insert(scope_.end(), made.begin(), made.end());
  if (has_table) tables_.push_back(same);
}

// ---- definitions ---------------------------------------------------------------------------------------------------

std::string Generator::result_list() {
  const Frame frame = frames_.back();
  std::string text;
  if (frame.table != nullptr) text = fresh_table(*frame.table, 1);
  if (frame.same >= 0) text = frame.same_name;
  if (text.empty() && random_.chance(0.15)) // all results of another function
    for (const Function& candidate : functions_)
      if (candidate.table == nullptr && candidate.same < 0 && candidate.results == frame.results &&
          can_call(candidate, false) && calls_ < kMaxCalls) {
        ++calls_;
        return call_text(Function(candidate), 2);
      }
  for (const T type : frame.results)
    text += (text.empty() ? "" : ", ") + expression(type, 2);
  return text;
}

void Generator::parameter_list(Function& made, std::string& list) {
  static const std::vector<std::vector<T>> signatures = {{T::N, T::N},  {T::N, T::N},   {T::N, T::N, T::N},
                                                         {T::V3, T::N}, {T::V3, T::V3}, {T::I, T::I}};
  const int count = random_.between(0, 3);
  for (int i = 0; i < count; ++i) {
    Parameter parameter;
    const std::string name = fresh("a");
    list += (list.empty() ? "" : ", ") + name;
    if (random_.chance(0.25)) {
      parameter.type.shape = &shapes_[random_.below(shapes_.size())];
      const int index = static_cast<int>(made.parameters.size());
      tables_.push_back({name, parameter.type.shape, level(), random_.chance(0.7), false, index, true});
    } else if (random_.chance(0.15)) {
      parameter.signature = random_.pick(signatures);
      Function value{name, {}, nullptr, -1, {parameter.signature.back()}, kNoEffect, nullptr, {}};
      for (size_t k = 0; k + 1 < parameter.signature.size(); ++k)
        value.parameters.push_back({{parameter.signature[k]}, {}, false});
      functions_.push_back(value);
    } else {
      parameter.type.base = any_type();
      scope_.push_back({name, parameter.type.base, true, level()});
    }
    made.parameters.push_back(parameter);
  }
}

std::string Generator::begin_function(const std::string& name, const std::string& list) {
  return random_.chance(0.3) ? "local " + name + " = function(" + list + ")"
                             : "local function " + name + "(" + list + ")";
}

/// Takes over what the frame has learnt.
void Generator::end_function(Function& made, const Mark& before) {
  const Frame frame = frames_.back();
  made.results = frame.results;
  made.table = frame.table;
  made.same = frame.same;
  made.effect = frame.effect;
  for (const int index : frame.mutated)
    made.parameters[static_cast<size_t>(index)].is_mutated = true;
  frames_.pop_back();
  leave(before);
}

void Generator::function(int statements, int depth) {
  if (nesting_ > 2) return assign();
  ++nesting_;
  Function made{fresh("f"), {}, nullptr, -1, {}, kNoEffect, nullptr, {}};
  const Mark before = mark();
  frames_.emplace_back();
  std::string list;
  parameter_list(made, list);
  Frame& frame = frames_.back();
  if (random_.chance(0.2)) {
    frame.table = &shapes_[random_.below(shapes_.size())];
    if (random_.chance(0.4)) frame.results.push_back(any_type());
  } else {
    for (size_t i = 0; i < made.parameters.size(); ++i)
      if (made.parameters[i].type.shape != nullptr && random_.chance(0.3)) {
        frame.same = static_cast<int>(i);
        for (const TableVariable& table : tables_)
          if (table.level == level() && table.parameter == frame.same) frame.same_name = table.name;
        frame.mutated.insert(frame.same); // its caller asks for a table that may be written
      }
    const int results = random_.chance(0.3) ? 2 : 1;
    for (int i = 0; i < results && (frame.same < 0 || random_.chance(0.3)); ++i)
      frame.results.push_back(any_type());
  }
  open(begin_function(made.name, list));
  for (int i = 0; i < statements; ++i)
    statement(depth);
  line("return " + result_list());
  close();
  end_function(made, before);
  functions_.push_back(made);
  --nesting_;
}

} // namespace moonshade::oracle
