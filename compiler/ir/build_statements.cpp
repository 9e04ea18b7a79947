// `build`, statements: variables, and Lua's loops and jumps as loop, scope and break.
//
//   while c do B end      loop L { if c {} else { break L }  step  B }
//   repeat B until c      loop L { step  B  if c { break L } }
//   goto l ... ::l::      scope S { ... break S ... } for a label behind its gotos
//   for                   see integer_for and float_for: forprep and forloop of lvm.c
#include "compiler/ir/build_function.h"

#include <algorithm>
#include <limits>

namespace moonshade::ir {

using namespace syntax;

namespace {

constexpr int64_t kMinInteger = std::numeric_limits<int64_t>::min();
/// `elseif`s that become nested ifs; the nesting of IR is what functions over it recurse on.
constexpr size_t kMaxNestedClauses = 32;
constexpr int64_t kMaxInteger = std::numeric_limits<int64_t>::max();

void collect_goto_targets(const syntax::Block& block, std::unordered_set<const LabelStat*>& targets) {
  for (const Stat* stat : block.stats)
    visit(*stat, Overloaded{
                     [&](const GotoStat& jump) { targets.insert(jump.target); },
                     [&](const DoStat& inner) { collect_goto_targets(*inner.body, targets); },
                     [&](const WhileStat& inner) { collect_goto_targets(*inner.body, targets); },
                     [&](const RepeatStat& inner) { collect_goto_targets(*inner.body, targets); },
                     [&](const NumericForStat& inner) { collect_goto_targets(*inner.body, targets); },
                     [&](const GenericForStat& inner) { collect_goto_targets(*inner.body, targets); },
                     [&](const IfStat& inner) {
                       for (const IfClause& clause : inner.clauses)
                         collect_goto_targets(*clause.body, targets);
                       if (inner.else_body != nullptr) collect_goto_targets(*inner.else_body, targets);
                     },
                     [](const auto&) {},
                 });
}

} // namespace

void FunctionBuild::find_goto_targets(const syntax::Block& block) { collect_goto_targets(block, goto_targets_); }

void FunctionBuild::statements(const syntax::Block& block) { statements(block.stats); }

void FunctionBuild::statements(std::span<Stat* const> stats) {
  // A label that a goto names is the end of a scope around all that stands before it in its block; the last label
  // first, since its scope holds the others.
  size_t first = 0;
  for (size_t i = stats.size(); i-- > 0;) {
    const auto* label = try_as<LabelStat>(stats[i]);
    if (label == nullptr || !goto_targets_.contains(label)) continue;
    const At at(b_, label->span);
    const LabelId id = b_.label();
    labels_.emplace(label, id);
    ir::Block body = b_.block([&] { statements(stats.first(i)); });
    b_.scope(id, std::move(body));
    first = i + 1;
    break;
  }
  for (Stat* stat : stats.subspan(first)) {
    if (b_.terminated()) return; // what follows a break, goto or return is never executed
    statement(*stat);
  }
}

void FunctionBuild::statement(const Stat& stat) {
  const At at(b_, stat.span);
  if (specialisation_.function->parent == nullptr)
    if (const auto modules = shared_.program.modules_before.find(&stat);
        modules != shared_.program.modules_before.end())
      for (const sema::Specialisation* module : modules->second)
        b_.call(module->id, {}, {}, captures_of(*module));
  visit(stat, Overloaded{
                  [&](const LocalStat& s) { local(s); },
                  [&](const AssignStat& s) { assign(s); },
                  [&](const CallStat& s) { evaluate_all(*s.call); },
                  [&](const DoStat& s) { statements(*s.body); },
                  [&](const WhileStat& s) { while_loop(s); },
                  [&](const RepeatStat& s) { repeat_loop(s); },
                  [&](const IfStat& s) { s.clauses.size() > kMaxNestedClauses ? if_chain(s) : if_clauses(s, 0); },
                  [&](const NumericForStat& s) { numeric_for(s); },
                  [&](const GenericForStat& s) { ipairs_loop(s); },
                  [&](const ReturnStat& s) { return_statement(s); },
                  [&](const BreakStat& s) { b_.break_to(labels_.at(s.loop)); },
                  [&](const GotoStat& s) {
                    if (const auto label = labels_.find(s.target); label != labels_.end())
                      b_.break_to(label->second);
                    else
                      defect("a goto that sema should have refused");
                  },
                  [](const FunctionStat&) {}, // functions are known at compile time
                  [](const LocalFunctionStat&) {},
                  [](const LabelStat&) {},
                  [&](const auto&) { defect("a statement that sema should have refused"); },
              });
}

void FunctionBuild::local(const LocalStat& stat) {
  const Values values = evaluate_list(stat.values);
  const std::vector<sema::Type> types = types_of(stat.values);
  for (size_t i = 0; i < stat.locals.size() && i < values.size(); ++i)
    store_local(*stat.locals[i], values[i], types[i]);
}

void FunctionBuild::assign(const AssignStat& stat) {
  // Objects and indices, then values, then the assignments, from right to left; sema refuses what could tell.
  std::vector<Access> elements(stat.targets.size());
  for (size_t i = 0; i < stat.targets.size(); ++i)
    if (const auto* target = try_as<IndexExpr>(stat.targets[i])) elements[i] = access(*target);
  const Values values = evaluate_list(stat.values);
  const std::vector<sema::Type> types = types_of(stat.values);
  for (size_t i = std::min(stat.targets.size(), values.size()); i-- > 0;) {
    if (elements[i].field != nullptr) {
      store_leaf(*elements[i].field, checked_slot(elements[i]), values[i]);
      continue;
    }
    const auto* target = try_as<NameExpr>(stat.targets[i]);
    if (target == nullptr) {
      defect("an assignment that sema should have refused");
      continue;
    }
    const sema::ExpressionFact& known = fact(*target);
    ValueId value = values[i];
    if (known.type.kind == sema::Type::Kind::Table) value = as_table(known.type, value, types[i]);
    if (value != kNone && known.slot != nullptr) store_slot(*known.slot, value);
  }
}

/// A chain too long to be nested: scope { if c1 { B1 break } if c2 { B2 break } ... else }.
void FunctionBuild::if_chain(const IfStat& stat) {
  const LabelId label = b_.label();
  ir::Block body = b_.block([&] {
    for (const IfClause& clause : stat.clauses) {
      const At at(b_, clause.condition->span);
      const ValueId condition = evaluate_as(*clause.condition, ValueType::Boolean);
      ir::Block taken = b_.block([&] {
        statements(*clause.body);
        if (!b_.terminated()) b_.break_to(label);
      });
      b_.if_else(condition, std::move(taken));
    }
    if (stat.else_body != nullptr) statements(*stat.else_body);
  });
  b_.scope(label, std::move(body));
}

void FunctionBuild::if_clauses(const IfStat& stat, size_t clause) {
  if (clause == stat.clauses.size()) {
    if (stat.else_body != nullptr) statements(*stat.else_body);
    return;
  }
  const At at(b_, stat.clauses[clause].condition->span);
  const ValueId condition = evaluate_as(*stat.clauses[clause].condition, ValueType::Boolean);
  ir::Block then_block = b_.block([&] { statements(*stat.clauses[clause].body); });
  ir::Block else_block = b_.block([&] { if_clauses(stat, clause + 1); });
  b_.if_else(condition, std::move(then_block), std::move(else_block));
}

void FunctionBuild::break_if(ValueId condition, LabelId label) {
  ir::Block leave = b_.block([&] { b_.break_to(label); });
  b_.if_else(condition, std::move(leave));
}

void FunctionBuild::while_loop(const WhileStat& stat) {
  const LabelId label = b_.label();
  labels_.emplace(&stat, label);
  ir::Block body = b_.block([&] {
    const ValueId condition = evaluate_as(*stat.condition, ValueType::Boolean);
    break_if(b_.unary(Op::Not, condition), label);
    b_.step();
    statements(*stat.body);
  });
  b_.loop(label, std::move(body));
}

void FunctionBuild::repeat_loop(const RepeatStat& stat) {
  const LabelId label = b_.label();
  labels_.emplace(&stat, label);
  ir::Block body = b_.block([&] {
    b_.step();
    statements(*stat.body);
    if (b_.terminated()) return;
    break_if(evaluate_as(*stat.condition, ValueType::Boolean), label);
  });
  b_.loop(label, std::move(body));
}

void FunctionBuild::return_statement(const ReturnStat& stat) {
  const Values values = evaluate_list(stat.values);
  if (specialisation_.id == 0) store_globals();
  const std::vector<sema::Type> types = types_of(stat.values);
  Values results;
  for (size_t i = 0; i < specialisation_.results.size(); ++i) {
    const sema::Type& result = specialisation_.results[i];
    ValueId value = i < values.size() ? values[i] : kNone;
    if (result.kind == sema::Type::Kind::Table) value = as_table(result, value, types[i]);
    if (const auto type = run_time_type(result)) results.push_back(converted(value, *type));
  }
  b_.return_values(results);
}

// ---- numeric for
// -----------------------------------------------------------------------------------------------------

void FunctionBuild::numeric_for(const NumericForStat& stat) {
  ValueId start = evaluate(*stat.start);
  ValueId limit = evaluate(*stat.limit);
  ValueId step = stat.step != nullptr ? evaluate(*stat.step) : b_.integer(1);
  labels_.emplace(&stat, b_.label());
  if (b_.type_of(start) == ValueType::Integer && b_.type_of(step) == ValueType::Integer)
    return integer_for(stat, start, limit, step);
  limit = converted(limit, ValueType::Number);
  step = converted(step, ValueType::Number);
  start = converted(start, ValueType::Number);
  float_for(stat, start, limit, step);
}

ValueId FunctionBuild::is_positive(ValueId step) {
  const Instruction& instruction = b_.at(step);
  if (instruction.op == Op::ConstInteger) return b_.boolean(instruction.integer > 0);
  if (instruction.op == Op::ConstNumber) return b_.boolean(instruction.number > 0);
  return b_.compare(Op::Lt, b_.zero(instruction.type), step);
}

/// As forlimit: the number is rounded towards the start; one that no integer represents is clipped, or skips the loop.
FunctionBuild::Limit FunctionBuild::clip_limit(ValueId limit, ValueId step) {
  const ValueId positive_step = is_positive(step);
  const auto rounded = [&](std::string_view function) -> std::pair<ValueId, ValueId> {
    for (const LibraryFunction& row : library_overloads(function))
      if (row.parameters[0] == ValueType::Number && row.result_count == 2) {
        const ValueId call = b_.call_library(row, ValueType::Integer, {limit});
        return {call, b_.result(call, 1, ValueType::Boolean)};
      }
    defect("rounding without its row of the library");
    return {b_.integer(0), b_.boolean(true)};
  };
  const auto [down, down_fits] = rounded("math.floor");
  const auto [up, up_fits] = rounded("math.ceil");
  const ValueId value = b_.select(positive_step, down, up);
  const ValueId fits = b_.select(positive_step, down_fits, up_fits);
  const ValueId above = b_.compare(Op::Lt, b_.number(0), limit); // false for NaN, as in forlimit
  const ValueId clipped = b_.select(above, b_.integer(kMaxInteger), b_.integer(kMinInteger));
  const ValueId skip = b_.binary(Op::And, b_.unary(Op::Not, fits), b_.binary(Op::Xor, above, positive_step));
  return {b_.select(fits, value, clipped), skip};
}

/// Whether the iteration with this counter is the last: the distance to the limit is less than the step. It is compared
/// without overflow; lvm.c counts the iterations beforehand for the same reason, with a division.
ValueId FunctionBuild::is_last_iteration(ValueId counter, ValueId limit, ValueId step) {
  const std::optional<int64_t> known_step = known_integer(step);
  if (known_step == 1) return b_.compare(Op::Le, limit, counter);
  if (known_step == -1) return b_.compare(Op::Le, counter, limit);
  const std::optional<int64_t> known_limit = known_integer(limit);
  int64_t last = 0;
  if (known_step && known_limit && !__builtin_sub_overflow(*known_limit, *known_step, &last))
    return *known_step > 0 ? b_.compare(Op::Lt, b_.integer(last), counter)
                           : b_.compare(Op::Lt, counter, b_.integer(last));
  const ValueId positive = is_positive(step);
  const ValueId distance = b_.select(positive, b_.binary(Op::Sub, limit, counter), b_.binary(Op::Sub, counter, limit));
  const ValueId stride = b_.select(positive, step, b_.unary(Op::Neg, step));
  // Unsigned: both with the sign bit flipped.
  const ValueId flip = b_.integer(kMinInteger);
  return b_.compare(Op::Lt, b_.binary(Op::Xor, distance, flip), b_.binary(Op::Xor, stride, flip));
}

void FunctionBuild::loop_body(const NumericForStat& stat, VariableId counter) {
  b_.step();
  {
    const At at(b_, stat.variable->span);
    const ValueId value = b_.load(counter);
    store_local(*stat.variable, value,
                sema::Type::of(b_.type_of(value))); // a copy: assigning it does not disturb the loop
  }
  statements(*stat.body);
}

void FunctionBuild::integer_for(const NumericForStat& stat, ValueId start, ValueId limit, ValueId step) {
  const std::optional<int64_t> known_step = known_integer(step);
  if (!known_step || *known_step == 0) {
    const At at(b_, stat.step->span);
    b_.fault(b_.compare(Op::Eq, step, b_.integer(0)), FaultCode::ForStepZero);
  }
  Limit clipped{limit, kNone};
  if (b_.type_of(limit) == ValueType::Number) clipped = clip_limit(limit, step);
  limit = clipped.value;
  ValueId enter = kNone;
  if (known_step)
    enter = *known_step > 0 ? b_.compare(Op::Le, start, limit) : b_.compare(Op::Le, limit, start);
  else
    enter = b_.select(is_positive(step), b_.compare(Op::Le, start, limit), b_.compare(Op::Le, limit, start));
  if (clipped.skip != kNone) enter = b_.binary(Op::And, enter, b_.unary(Op::Not, clipped.skip));

  ir::Block whole = b_.block([&] {
    const VariableId counter = b_.variable("", ValueType::Integer);
    const LabelId label = labels_.at(&stat);
    b_.store(counter, start);
    ir::Block body = b_.block([&] {
      loop_body(stat, counter);
      if (b_.terminated()) return;
      const ValueId now = b_.load(counter);
      break_if(is_last_iteration(now, limit, step), label);
      b_.store(counter, b_.binary(Op::Add, now, step));
    });
    b_.loop(label, std::move(body));
  });
  b_.if_else(enter, std::move(whole));
}

void FunctionBuild::float_for(const NumericForStat& stat, ValueId start, ValueId limit, ValueId step) {
  const Instruction& known_step = b_.at(step);
  if (known_step.op != Op::ConstNumber || known_step.number == 0) {
    const At at(b_, stat.step != nullptr ? stat.step->span : stat.span);
    b_.fault(b_.compare(Op::Eq, step, b_.number(0)), FaultCode::ForStepZero);
  }
  const ValueId positive = is_positive(step);
  const ValueId skip = b_.select(positive, b_.compare(Op::Lt, limit, start), b_.compare(Op::Lt, start, limit));
  ir::Block whole = b_.block([&] {
    const VariableId counter = b_.variable("", ValueType::Number);
    const LabelId label = labels_.at(&stat);
    b_.store(counter, start);
    ir::Block body = b_.block([&] {
      loop_body(stat, counter);
      if (b_.terminated()) return;
      const ValueId next = b_.binary(Op::Add, b_.load(counter), step);
      const ValueId goes_on = b_.select(positive, b_.compare(Op::Le, next, limit), b_.compare(Op::Le, limit, next));
      break_if(b_.unary(Op::Not, goes_on), label);
      b_.store(counter, next);
    });
    b_.loop(label, std::move(body));
  });
  b_.if_else(b_.unary(Op::Not, skip), std::move(whole));
}

} // namespace moonshade::ir
