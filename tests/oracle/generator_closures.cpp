// Functions as values: makers of closures with state, records of closures, compositions, functions in records and by
// other names, functions that call what they are given.
#include "tests/oracle/generator_impl.h"

#include <algorithm>

namespace moonshade::oracle {

/// A second name for a function.
void Generator::alias_function() {
  if (functions_.empty()) return assign();
  Function alias = random_.pick(functions_);
  const std::string old = alias.name;
  alias.name = fresh("g");
  if (!alias.fields.empty() || alias.closure != nullptr) return assign();
  line("local " + alias.name + " = " + old);
  functions_.push_back(alias);
}

/// local r = { call = f, k = 1.5 }
void Generator::function_in_record() {
  const std::string name = fresh("r");
  std::vector<const Function*> fits;
  for (const Function& candidate : functions_)
    if (candidate.closure == nullptr && candidate.fields.empty()) fits.push_back(&candidate);
  Function field{name + ".call", {{{T::N}, {}, false}}, nullptr, -1, {T::N}, kNoEffect, nullptr, {}};
  std::string value;
  if (!fits.empty() && random_.chance(0.6)) {
    field = *random_.pick(fits);
    value = field.name;
    field.name = name + ".call";
  } else {
    value = function_argument({T::N, T::N}, 2);
  }
  line("local " + name + " = { call = " + value + ", k = " + expression(T::N, 2) + " }");
  Shape shape;
  shape.fields = {{"k", {T::N}}};
  tables_.push_back({name, add_shape(std::move(shape)), level(), true, false});
  functions_.push_back(field);
}

/// local function mk(a) local s = ... return function(x) s = ... return ... end end
void Generator::closure_maker() {
  if (nesting_ > 1) return assign();
  ++nesting_;
  Function made{fresh("mk"), {{{T::N}, {}, false}}, nullptr, -1, {}, kNoEffect, nullptr, {}};
  const Mark before = mark();
  const std::string parameter = fresh("a");
  open(begin_function(made.name, parameter));
  frames_.emplace_back();
  const int home = level();
  scope_.push_back({parameter, T::N, true, home});
  declare(any_type(), 2);
  if (random_.chance(0.5)) declare_table(1);
  if (random_.chance(0.3)) declare(any_type(), 2);

  Function inner{"", {}, nullptr, -1, {}, kNoEffect, nullptr, {}};
  const Mark inside = mark();
  frames_.emplace_back();
  std::string list;
  parameter_list(inner, list);
  frames_.back().results = {random_.chance(0.6) ? T::N : any_type()};
  open("return function(" + list + ")");
  const int statements = random_.between(1, 3);
  for (int i = 0; i < statements; ++i)
    statement(1);
  line("return " + result_list());
  close();
  end_function(inner, inside);
  close();
  frames_.back().effect = frames_.back().effect; // what the closure assigns beyond its maker is the closure's effect
  const int beyond = frames_.back().effect;
  end_function(made, before);
  made.effect = beyond;
  made.results.clear();
  if (inner.effect == home) inner.effect = kOwnState;
  made.closure = std::make_shared<Function>(inner);
  functions_.push_back(made);
  --nesting_;
}

/// A record of closures over one state, and a number.
void Generator::object_maker() {
  if (nesting_ > 1) return assign();
  ++nesting_;
  Function made{fresh("mk"), {{{T::N}, {}, false}}, nullptr, -1, {}, kNoEffect, nullptr, {}};
  const Mark before = mark();
  const std::string parameter = fresh("a");
  open(begin_function(made.name, parameter));
  frames_.emplace_back();
  const int home = level();
  scope_.push_back({parameter, T::N, true, home});
  scope_.push_back({fresh("v"), T::N, true, home});
  const std::string state = scope_.back().name;
  line("local " + state + " = " + parameter);
  if (random_.chance(0.5)) declare_table(1);
  std::vector<Function> fields;
  open("return {");
  for (const char* name : {"step", "get"}) {
    Function field{name, {}, nullptr, -1, {}, kNoEffect, nullptr, {}};
    const Mark inside = mark();
    frames_.emplace_back();
    std::string list;
    parameter_list(field, list);
    frames_.back().results = {random_.chance(0.7) ? T::N : any_type()};
    open(std::string(name) + " = function(" + list + ")");
    if (std::string_view(name) == "step") {
      note_effect(home);
      line(state + " = " + expression(T::N, 2));
      statement(1);
    }
    line("return " + result_list());
    end_function(field, inside);
    close("end,");
    if (field.effect == home) field.effect = kOwnState;
    fields.push_back(field);
  }
  line("k = " + parameter);
  close("}");
  close();
  end_function(made, before);
  made.fields = fields;
  functions_.push_back(made);
  --nesting_;
}

/// function compose(f, g) return function(x) return f(g(x)) end end, and one use of it.
void Generator::composer() {
  const std::string name = fresh("c"), f = fresh("a"), g = fresh("a");
  open("local function " + name + "(" + f + ", " + g + ")");
  line("return function(x) return " + f + "(" + g + "(x)) end");
  close();
  Function made{
      name, {{{T::N}, {T::N, T::N}, false}, {{T::N}, {T::N, T::N}, false}}, nullptr, -1, {}, kNoEffect, nullptr, {}};
  made.closure =
      std::make_shared<Function>(Function{"", {{{T::N}, {}, false}}, nullptr, -1, {T::N}, kNoEffect, nullptr, {}});
  functions_.push_back(made);
}

/// A closure or an object from a maker.
void Generator::closure_instance() {
  std::vector<const Function*> fits;
  for (const Function& candidate : functions_)
    if ((candidate.closure != nullptr || !candidate.fields.empty()) &&
        (candidate.effect == kNoEffect || may_assign(candidate.effect)))
      fits.push_back(&candidate);
  if (fits.empty() || calls_ >= kMaxCalls) return nesting_ > 0 ? assign() : closure_maker();
  ++calls_;
  const Function maker = *random_.pick(fits);
  const std::string name = fresh("g");
  line("local " + name + " = " + call_text(maker, 2));
  const auto placed = [&](Function instance, const std::string& instance_name) {
    instance.name = instance_name;
    if (instance.effect == kOwnState) instance.effect = level();
    functions_.push_back(instance);
  };
  if (maker.closure != nullptr) placed(*maker.closure, name);
  for (const Function& field : maker.fields)
    placed(field, name + "." + field.name);
  if (!maker.fields.empty()) {
    Shape shape;
    shape.fields = {{"k", {T::N}}};
    tables_.push_back({name, add_shape(std::move(shape)), level(), true, false});
  }
}

/// A function that calls what it is given, some times, among other statements.
void Generator::repeated_caller() {
  if (nesting_ > 1) return assign();
  const std::vector<T> signature = {T::N, T::N};
  const std::string name = fresh("h"), f = fresh("a"), start = fresh("a");
  Function made{name, {{{T::N}, signature, false}, {{T::N}, {}, false}}, nullptr, -1, {T::N}, kNoEffect, nullptr, {}};
  const Mark before = mark();
  open("local function " + name + "(" + f + ", " + start + ")");
  frames_.emplace_back();
  scope_.push_back({start, T::N, true, level()});
  functions_.push_back({f, {{{T::N}, {}, false}}, nullptr, -1, {T::N}, kNoEffect, nullptr, {}});
  frames_.back().results = {T::N};
  open("for i = 1, " + std::to_string(random_.between(1, 4)) + " do");
  line(start + " = " + f + "(" + start + ") + i");
  if (random_.chance(0.4)) line("if " + expression(T::B, 2) + " then return " + result_list() + " end");
  close();
  line("return " + start);
  close();
  end_function(made, before);
  functions_.push_back(made);
}

} // namespace moonshade::oracle
