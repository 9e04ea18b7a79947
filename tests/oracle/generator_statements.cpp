// Statements: declarations, assignments, branches, every kind of loop with the ways out of it.
#include "tests/oracle/generator_impl.h"

namespace moonshade::oracle {

// ---- declarations and assignments ----------------------------------------------------------------------------------

void Generator::declare(T type, int depth) {
  const std::string value = expression(type, depth);
  const bool constant = random_.chance(0.15);
  const std::string name = fresh("v");
  line("local " + name + (constant ? " <const> = " : " = ") + value);
  scope_.push_back({name, type, !constant, level()});
}

void Generator::assign() {
  if (random_.chance(0.2)) return assign_several();
  const T type = any_type();
  if (random_.chance(0.4))
    if (const std::string place = element(type, true, 2); !place.empty())
      return line(place + " = " + expression(type, 3));
  const auto targets = in_scope(type, true);
  if (targets.empty()) return declare(type, 2);
  const Variable target = *random_.pick(targets);
  note_effect(target.level);
  line(target.name + " = " + expression(type, 3));
}

/// Two targets that are certainly two places: variables, or a variable and an element.
void Generator::assign_several() {
  const T type = any_type(), other = any_type();
  const auto targets = in_scope(type, true);
  if (targets.empty()) return declare(type, 2);
  const Variable target = *random_.pick(targets);
  std::string second;
  if (random_.chance(0.5)) {
    second = element(other, true, 2);
  } else if (const auto others = in_scope(other, true); !others.empty()) {
    const Variable variable = *random_.pick(others);
    if (variable.name != target.name) second = variable.name;
    note_effect(variable.level);
  }
  if (second.empty()) return declare(type, 2);
  note_effect(target.level);
  std::string values = expression(type, 2) + ", " + expression(other, 2);
  for (const Function& candidate : functions_)
    if (candidate.table == nullptr && candidate.same < 0 && candidate.results == std::vector<T>{type, other} &&
        can_call(candidate, false) && calls_ < kMaxCalls && random_.chance(0.5)) {
      ++calls_;
      values = call_text(Function(candidate), 2);
      break;
    }
  line(target.name + ", " + second + " = " + values);
}

// ---- blocks --------------------------------------------------------------------------------------------------------

void Generator::block(int statements, int depth) {
  const Mark before = mark();
  for (int i = 0; i < statements; ++i)
    statement(depth);
  leave(before);
}

void Generator::if_statement(int depth) {
  open("if " + expression(T::B, 2) + " then");
  block(random_.between(1, 3), depth - 1);
  if (random_.chance(0.3)) {
    close("elseif " + expression(T::B, 2) + " then");
    ++indent_;
    block(random_.between(1, 2), depth - 1);
  }
  if (random_.chance(0.5)) {
    close("else");
    ++indent_;
    block(random_.between(1, 2), depth - 1);
  }
  close();
}

/// Statements of a loop body, with breaks, continues and returns among them.
void Generator::loop_body(int depth) {
  const Mark before = mark();
  const std::string label = random_.chance(0.35) ? fresh("continue") : "";
  if (!label.empty()) open("do");
  const int statements = random_.between(1, 3);
  for (int i = 0; i < statements; ++i) {
    if (random_.chance(0.15))
      line("if " + expression(T::B, 2) + " then break end");
    else if (!label.empty() && random_.chance(0.4))
      line("if " + expression(T::B, 2) + " then goto " + label + " end");
    else if (!frames_.empty() && frames_.back().table == nullptr && random_.chance(0.06))
      line("if " + expression(T::B, 2) + " then return " + result_list() + " end");
    else
      statement(depth);
  }
  leave(before);
  if (!label.empty()) {
    close();
    line("::" + label + "::");
  }
}

// ---- loops ---------------------------------------------------------------------------------------------------------

void Generator::numeric_for(int depth) {
  const std::string name = fresh("i");
  T type = T::I;
  switch (random_.below(11)) {
  case 0:
    open("for " + name + " = 0.0, " + expression(T::N, 1) + " % 3.0, 0.5 do");
    type = T::N;
    break;
  case 1:
    open("for " + name + " = 5, 1, -2 do");
    break;
  case 2:
    open("for " + name + " = 1, " + expression(T::I, 1) + " % 5 do");
    break;
  case 3:
    open("for " + name + " = math.maxinteger - 2, math.maxinteger do");
    break;
  case 4:
    open("for " + name + " = math.mininteger, math.mininteger + " + std::to_string(random_.between(0, 3)) + " do");
    break;
  case 5: // a float limit of an integer loop
    open("for " + name + " = 1, " + expression(T::N, 1) + " % 4.5 do");
    break;
  case 6: // a step that depends on the point, and may be 0 where it says so
    open("for " + name + " = " + expression(T::I, 1) + " % 4, 7, " + expression(T::I, 1) + " % 3" +
         (random_.chance(0.2) ? "" : " + 1") + " do");
    break;
  case 7: // it would step over the last integer
    open("for " + name + " = math.maxinteger - 7, math.maxinteger - " + expression(T::I, 1) + " % 3, 3 do");
    break;
  case 8:
    open("for " + name + " = " + expression(T::N, 1) + " % 2.0, -1.0, -0.7 do");
    type = T::N;
    break;
  default:
    open("for " + name + " = 1, " + std::to_string(random_.between(0, 6)) + " do");
    break;
  }
  const Mark before = mark();
  scope_.push_back({name, type, random_.chance(0.3), level()});
  loop_body(depth - 1);
  leave(before);
  close();
}

void Generator::while_loop(int depth) {
  const std::string counter = fresh("w");
  line("local " + counter + " = 0");
  open("while " + counter + " < " + std::to_string(random_.between(1, 6)) + " and " + expression(T::B, 2) + " do");
  line(counter + " = " + counter + " + 1");
  loop_body(depth - 1);
  close();
}

void Generator::repeat_loop(int depth) {
  const std::string counter = fresh("w");
  line("local " + counter + " = 0");
  open("repeat");
  line(counter + " = " + counter + " + 1");
  const Mark before = mark();
  const T type = any_type();
  declare(is_matrix(type) ? T::N : type, 2);
  if (random_.chance(0.3)) declare_table(1);
  const Mark inside = mark();
  block(random_.between(1, 2), depth - 1);
  if (random_.chance(0.2)) line("if " + expression(T::B, 2) + " then break end");
  leave(inside);
  const std::string condition = expression(T::B, 2);
  leave(before);
  close("until " + counter + " > " + std::to_string(random_.between(1, 5)) + " or " + condition);
}

/// Two loops, and a goto out of both.
void Generator::nested_break(int depth) {
  const std::string label = fresh("out"), outer = fresh("i"), inner = fresh("i");
  const Mark before = mark();
  open("for " + outer + " = 1, " + std::to_string(random_.between(1, 4)) + " do");
  scope_.push_back({outer, T::I, false, level()});
  open("for " + inner + " = " + outer + ", " + std::to_string(random_.between(2, 5)) + " do");
  const Mark inside = mark();
  scope_.push_back({inner, T::I, false, level()});
  block(1, depth - 2);
  line("if " + expression(T::B, 2) + " then goto " + label + " end");
  block(1, depth - 2);
  leave(inside);
  close();
  block(1, depth - 2);
  close();
  leave(before);
  line("::" + label + "::");
}

// ---- any statement -------------------------------------------------------------------------------------------------

void Generator::statement(int depth) {
  if (depth <= 0) {
    if (random_.chance(0.55)) return assign();
    if (random_.chance(0.15)) return declare_table(1);
    return declare(any_type(), 3);
  }
  switch (random_.below(26)) {
  case 0:
  case 1:
  case 2:
    return if_statement(depth);
  case 3:
  case 4:
    return numeric_for(depth);
  case 5:
    return while_loop(depth);
  case 6:
    return repeat_loop(depth);
  case 7:
  case 8:
    return call_statement();
  case 9:
    open("do");
    block(random_.between(1, 3), depth - 1);
    return close();
  case 10:
    if (!frames_.empty() && random_.chance(0.5))
      return line("if " + expression(T::B, 2) + " then return " + result_list() + " end");
    return assign();
  case 11:
    return function(random_.between(1, 3), 1);
  case 12:
    if (!frames_.empty() && random_.chance(0.2)) return line("assert(" + expression(T::B, 1) + " or true, \"never\")");
    if (!frames_.empty() && random_.chance(0.1)) return line("if " + expression(T::B, 2) + " then error(\"here\") end");
    return assign();
  case 13:
  case 14:
    return loop_over_table(depth);
  case 15:
  case 16:
    return declare_table(2);
  case 17:
    return closure_instance();
  case 18:
    switch (random_.below(5)) {
    case 0:
      return alias_function();
    case 1:
      return function_in_record();
    case 2:
      return closure_maker();
    case 3:
      return nested_break(depth);
    default:
      return swap_elements();
    }
  case 19:
  case 20:
    return declare(any_type(), 4);
  default:
    return assign();
  }
}

} // namespace moonshade::oracle
