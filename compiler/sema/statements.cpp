// Statements. Scopes were resolved by the parser; here variables get their types, and assignments to what a shader may
// not assign are refused.
#include "compiler/sema/entries.h"
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

void Walker::function_body() {
  const Function& function = *work_.function;
  work_.has_open_return = false;
  if (&work_ == context_.top) infer_modules();
  if (function.is_vararg && !at_top_level()) error(Code::Varargs, function.vararg_span);
  for (size_t i = 0; i < function.params.size(); ++i)
    declare(*function.params[i], i < work_.arguments.size() ? work_.arguments[i] : unknown_type(),
            function.params[i]->span, nullptr);
  block(*function.body);
}

void Walker::block(const Block& block) {
  if (context_.report) collect_labels(block);
  blocks_.push_back(&block);
  positions_.push_back(0);
  for (const Stat* stat : block.stats) {
    statement(*stat);
    ++positions_.back();
  }
  positions_.pop_back();
  blocks_.pop_back();
}

void Walker::statement(const Stat& stat) {
  if (context_.exhausted) return;
  if (++context_.visits > kMaxVisits) context_.too_large(stat.span, "type inference takes too many steps", kMaxVisits);
  if (++context_.walk_depth > kMaxWalkDepth)
    context_.too_large(stat.span, "calls and blocks inside each other are too many", kMaxWalkDepth);
  if (context_.exhausted) return;
  if (context_.report && at_top_level()) run_modules_before(stat);
  visit(stat, Overloaded{
                  [&](const LocalStat& node) { local(node); },
                  [&](const AssignStat& node) { assign(node); },
                  [&](const CallStat& node) { values(*node.call); },
                  [&](const DoStat& node) { block(*node.body); },
                  [&](const WhileStat& node) {
                    ++loop_depth_;
                    branch(*node.condition, *node.body);
                    --loop_depth_;
                  },
                  [&](const RepeatStat& node) {
                    ++loop_depth_;
                    block(*node.body);
                    condition(*node.condition);
                    --loop_depth_;
                  },
                  [&](const IfStat& node) {
                    for (const IfClause& clause : node.clauses)
                      branch(*clause.condition, *clause.body);
                    if (node.else_body == nullptr) return;
                    const bool depends = std::ranges::any_of(
                        node.clauses, [&](const IfClause& clause) { return depends_on_parameter(*clause.condition); });
                    parameter_branches_ += depends;
                    block(*node.else_body);
                    parameter_branches_ -= depends;
                  },
                  [&](const NumericForStat& node) { numeric_for(node); },
                  [&](const GenericForStat& node) { generic_for(node); },
                  [&](const FunctionStat& node) { define_function(node); },
                  [&](const LocalFunctionStat& node) {
                    if (node.function->is_vararg) error(Code::Varargs, node.function->vararg_span);
                    declare(*node.local, function_type(node.function, &work_), node.local->span, nullptr);
                  },
                  [&](const ReturnStat& node) { return_values(node); },
                  [&](const GotoStat& node) { check_goto(node); },
                  [](const auto&) {},
              });
  --context_.walk_depth;
}

// ---- variables -----------------------------------------------------------------------------------------------------

void Walker::give(Variable& variable, const Type& type, Span place, const Expr* given, std::string_view name) {
  if (is_table(type) && (is_unknown(variable.type) || is_table(variable.type))) {
    // A name is bound to a table once; which one it is may become clearer from round to round.
    if (variable.type != type) context_.changed = true;
    variable.type = variable.first_type = type;
    variable.first = place;
    return;
  }
  // So may a closure be: of another specialisation of its maker.
  if (type.kind == Type::Kind::Function && variable.first_type.kind == Type::Kind::Function &&
      variable.first == place && variable.type.function == type.function) {
    if (variable.type != type) context_.changed = true;
    variable.type = variable.first_type = type;
    return;
  }
  if (type.is(ValueType::Integer) && variable.integer_given == nullptr) variable.integer_given = given;
  if (is_unknown(variable.first_type) && !is_unknown(type)) {
    variable.first_type = type;
    variable.first = place;
  }
  const bool fits = join(variable.first_type, type).has_value();
  const Type joined = fits ? join(variable.type, type).value_or(conflicting_type()) : conflicting_type();
  if (joined != variable.type) {
    variable.type = joined;
    context_.changed = true;
  }
  if (fits) return;
  if (is_unknown(variable.conflict_type)) {
    variable.conflict_type = type;
    variable.conflict = place;
  }
  if (!is_function(variable.first_type) && !is_function(type)) {
    refuse_conflict(context_, work_, variable, name, type, place);
  } else {
    refuse_function(place, name, given);
  }
}

void Walker::declare(const Local& local, const Type& type, Span given_at, const Expr* given) {
  Variable& variable = variable_of(local);
  trace_parameter(&local, given);
  give(variable, type, given_at, given, local.name);
  if (context_.report && has_storage(variable.type)) context_.place_for(work_, variable, local.name);
}

void Walker::local(const LocalStat& stat) {
  const TypeList list = expression_list(stat.values);
  for (size_t i = 0; i < stat.locals.size(); ++i) {
    const Local& local = *stat.locals[i];
    if (local.attrib == Attrib::Close) error(Code::CloseVariable, local.span, {std::string(local.name)});
    const Type type = list.at(i);
    const Expr* given = stat.values.empty() ? nullptr : stat.values[std::min(i, stat.values.size() - 1)];
    const Span place = given != nullptr ? given->span : local.span;
    if (type.kind == Type::Kind::None) {
      context_.unset_locals.insert(&local);
      declare(local, unknown_type(), place, nullptr);
    } else {
      declare(local, type, place, given);
    }
  }
  // A captured constant that is just a parameter needs no code at the top level.
  if (!context_.report || stat.locals.size() != 1 || stat.values.size() != 1 || stat.locals[0]->is_assigned) return;
  const Expr& value = strip_parentheses(*stat.values[0]);
  const auto fact = work_.spec->expressions.find(value.id);
  if (fact != work_.spec->expressions.end() && value.kind == ExprKind::Call &&
      fact->second.call == CallKind::Parameter && fact->second.type.is_value())
    variable_of(*stat.locals[0]).parameter = fact->second.index;
}

void Walker::assign(const AssignStat& stat) {
  // A function given to a global at the top level is a definition of it.
  work_.has_several_targets = work_.has_several_targets || stat.targets.size() > 1;
  const TypeList list = expression_list(stat.values);
  for (size_t i = 0; i < stat.targets.size(); ++i) {
    const Expr& target = *stat.targets[i];
    if (const auto* indexed = try_as<IndexExpr>(&target)) {
      const Type type = list.at(i);
      if (type.kind == Type::Kind::None) error(Code::MissingValue, target.span, {"this"});
      assign_index(stat, *indexed, type.kind == Type::Kind::None ? unknown_type() : type,
                   *stat.values[std::min(i, stat.values.size() - 1)]);
      continue;
    }
    const auto* name = try_as<NameExpr>(&target);
    if (name == nullptr) continue;
    const Expr& given = *stat.values[std::min(i, stat.values.size() - 1)];
    Type type = list.at(i);
    if (type.kind == Type::Kind::None) {
      error(Code::MissingValue, target.span, {std::string(name->name)});
      type = unknown_type();
    }
    assign_name(stat, *name, type, given);
    for (size_t j = 0; j < i; ++j) {
      const auto* other = try_as<NameExpr>(stat.targets[j]);
      if (other != nullptr && other->local == name->local && other->name == name->name)
        error(Code::SameTargetTwice, target.span, {std::string(name->name)});
    }
  }
}

void Walker::assign_name(const AssignStat& stat, const NameExpr& target, const Type& type, const Expr& given) {
  const std::string text(target.name);
  if (target.local != nullptr) {
    const Local& local = *target.local;
    Variable& variable = variable_of(local);
    if (context_.is_frozen_for(work_, variable)) {
      refuse_memory(context_, work_, text, local.span, stat.span);
      return;
    }
    if (is_table(type) || is_table(variable.type)) {
      bind_table(stat, target, type, given);
      return;
    }
    const bool is_declaration = context_.globals.assigned_once.contains(&local);
    if (!is_declaration && (is_function(type) || is_function(variable_of(local).type))) {
      refuse_function(stat.span, text, &given);
      return;
    }
    trace_parameter(&local, &given);
    give(variable, type, given.span, &given, local.name);
    local_name(target);
    if (context_.report && context_.home_of(variable) != &work_) work_.outer_writes.insert(&variable);
    return;
  }
  if (target.environment != nullptr || target.name == "_ENV") {
    error(Code::EnvironmentTable, target.span, {"_ENV"});
    return;
  }
  if (!at_top_level()) {
    error(Code::GlobalAssignment, stat.span, {text});
    return;
  }
  Global* global = context_.globals.find(target.name);
  if (global == nullptr) return;
  if (global->is_broken) refuse_definition(*global, target.span);
  if (global->is_broken || global->function != nullptr) return;
  // A name for what the library has is known, if it is no entry point; functions of the shader are defined.
  const bool is_alias =
      type.kind == Type::Kind::Library && global->is_single && !global->in_branch && !is_entry_of_table(target.name);
  if (is_function(type) && !is_alias) {
    refuse_function(stat.span, text, &given);
    return;
  }
  if (is_table(global->variable.type) && global->definition != target.span) {
    error(Code::TableRebound, stat.span, {text});
    return;
  }
  trace_parameter(global, &given);
  give(global->variable, type, given.span, &given, target.name);
  global_of_shader(target, *global);
}

/// `local t` without a value, and the table in the same block or in each branch of an `if`.
void Walker::bind_table(const AssignStat& stat, const NameExpr& target, const Type& type, const Expr& given) {
  const Local& local = *target.local;
  Variable& variable = variable_of(local);
  if (is_unknown(type)) return;
  if (!is_table(type) || (!is_table(variable.type) && !is_unknown(variable.type))) {
    refuse_conflict(context_, work_, variable, target.name, type, given.span);
    return;
  }
  trace_parameter(&local, &given);
  if (context_.globals.assigned_once.contains(&local) && work_.function == local.function) {
    give(variable, type, given.span, &given, local.name);
  } else if (context_.globals.assigned_in_branches.contains(&local) && work_.function == local.function) {
    const Type before = is_table(variable.type) ? variable.type : type;
    give(variable, merge_tables(before, type, &local, 1, given, given.span), given.span, &given, local.name);
  } else {
    error(Code::TableRebound, stat.span, {std::string(target.name)});
    return;
  }
  local_name(target);
}

/// Two `return`s with tables: each is fresh, or they give the same one.
Type Walker::merge_results(const ReturnStat& stat, size_t index, const Type& type) {
  const Expr& value = *stat.values[std::min(index, stat.values.size() - 1)];
  return merge_tables(work_.results[index], type, work_.function, static_cast<unsigned>(index + 2), value, value.span);
}

namespace {

/// "'v = vec3(1, v.y, v.z)'", as far as the target is as simple as that.
std::string component_proposal(const Expr& object, const Type& type, std::string_view component,
                               const AssignStat& stat) {
  const auto* name = try_as<NameExpr>(&object);
  const std::string variable = name != nullptr ? std::string(name->name) : "v";
  std::string value = "...";
  if (stat.targets.size() == 1 && stat.values.size() == 1) {
    if (const auto* integer = try_as<IntegerExpr>(stat.values[0])) value = std::to_string(integer->value);
    if (const auto* given = try_as<NameExpr>(stat.values[0])) value = given->name;
  }
  const std::string_view letters = component.find_first_of("rgba") != std::string_view::npos ? "rgba" : "xyzw";
  std::string text = "'" + variable + " = " + type_name(type) + "(";
  for (unsigned i = 0; i < component_count(type.value); ++i) {
    if (i > 0) text += ", ";
    text += letters[i] == component[0] ? value : variable + "." + letters[i];
  }
  return text + ")'";
}

} // namespace

void Walker::assign_index(const AssignStat& stat, const IndexExpr& target, const Type& type, const Expr& given) {
  const Type object = expression(*target.object);
  if (is_table(object)) {
    assign_element(target, object, type, given, stat.span);
    return;
  }
  if (!target.is_dotted) expression(*target.key);
  if (is_unknown(object)) return;
  if (is_vector(object)) {
    std::string component = "x";
    if (const auto* key = try_as<StringExpr>(target.key); key != nullptr && key->value.size() == 1)
      component = key->value;
    if (const auto* key = try_as<IntegerExpr>(target.key); key != nullptr && key->value >= 1 && key->value <= 4)
      component = "xyzw"[key->value - 1];
    type_error(Code::VectorComponent, stat.span, {component_proposal(*target.object, object, component, stat)});
  } else if (is_matrix(object)) {
    type_error(Code::VectorComponent, stat.span, {"a new one, as by '" + type_name(object) + "(...)' of its columns"});
  } else if (object.kind == Type::Kind::Library) {
    error(Code::LibraryAssignment, stat.span);
  } else {
    type_error(Code::NoFields, target.object->span, {describe(object)});
  }
}

void Walker::define_function(const FunctionStat& stat) {
  if (stat.function->is_method) {
    error(Code::MethodDefinition, stat.target->span);
    return;
  }
  const auto* name = try_as<NameExpr>(stat.target);
  if (name == nullptr) {
    if (const auto* target = try_as<IndexExpr>(stat.target)) {
      const Type object = expression(*target->object);
      if (object.kind == Type::Kind::Library) {
        error(Code::LibraryAssignment, stat.span);
      } else if (is_table(object)) {
        assign_element(*target, object, function_type(stat.function, &work_), *stat.function, stat.span);
      } else if (!is_unknown(object)) {
        type_error(Code::NoFields, target->object->span, {describe(object)});
      }
    }
    return;
  }
  if (stat.function->is_vararg) error(Code::Varargs, stat.function->vararg_span);
  const std::string text(name->name);
  if (name->local != nullptr) {
    if (context_.is_frozen_for(work_, variable_of(*name->local))) {
      refuse_memory(context_, work_, text, name->local->span, stat.span);
    } else if (context_.globals.assigned_once.contains(name->local)) {
      give(variable_of(*name->local), function_type(stat.function, &work_), name->span, nullptr, text);
    } else {
      refuse_function(stat.span, text, nullptr);
    }
  } else if (name->environment != nullptr || name->name == "_ENV") {
    error(Code::EnvironmentTable, name->span, {"_ENV"});
  } else if (!at_top_level()) {
    error(Code::GlobalAssignment, stat.span, {text});
  } else if (const Global* global = context_.globals.find(text); global != nullptr && global->is_broken) {
    refuse_definition(*global, name->span);
  }
}

/// A function's name is defined once, and on every path.
void Walker::refuse_definition(const Global& global, Span span) {
  if (!context_.report || (span == global.definition && !global.in_branch)) return;
  if (span == global.definition && parameter_branches_ == 0)
    error(Code::FunctionInBranch, span, {std::string(global.name)});
  else
    refuse_function(span, global.name, nullptr);
}

// ---- loops and results ---------------------------------------------------------------------------------------------

void Walker::branch(const Expr& condition, const Block& body) {
  this->condition(condition);
  const bool depends = depends_on_parameter(condition);
  parameter_branches_ += depends;
  block(body);
  parameter_branches_ -= depends;
}

void Walker::numeric_for(const NumericForStat& stat) {
  const auto bound = [&](const Expr* expr, const char* role) -> Type {
    if (expr == nullptr) return integer_type();
    const Type type = expression(*expr);
    if (is_unknown(type) || is_scalar(type)) return type;
    type_error(Code::LoopNumber, expr->span, {role, describe(type)});
    return unknown_type();
  };
  const Type start = bound(stat.start, "start");
  bound(stat.limit, "limit");
  const Type step = bound(stat.step, "step");
  // Integers only where both the start and the step are; the limit does not matter.
  Type type = number_type();
  if (is_unknown(start) || is_unknown(step)) {
    type = unknown_type();
  } else if (start.is(ValueType::Integer) && step.is(ValueType::Integer)) {
    type = integer_type();
  } else {
    const auto may_be_integer = [](const Type& bound) { return bound.mixed || bound.is(ValueType::Integer); };
    if (may_be_integer(start) && may_be_integer(step)) type = mixed_type();
  }
  ++loop_depth_;
  declare(*stat.variable, type, stat.start->span, stat.start);
  block(*stat.body);
  --loop_depth_;
}

/// The array of `ipairs(array)`; null for any other list of values.
const CallExpr* Walker::ipairs_call(const GenericForStat& stat) const {
  const auto* call = stat.values.size() == 1 ? try_as<CallExpr>(stat.values[0]) : nullptr;
  const auto* name = call != nullptr ? try_as<NameExpr>(call->callee) : nullptr;
  const bool is_library = name != nullptr && name->is_global() && name->environment == nullptr &&
                          context_.find_global(work_, *name) == nullptr;
  return is_library && name->name == "ipairs" ? call : nullptr;
}

void Walker::generic_for(const GenericForStat& stat) {
  Type element;
  if (const CallExpr* call = ipairs_call(stat)) {
    const TypeList list = arguments(call->args);
    const Type array = list.at(0);
    if (list.types.size() == 1 && is_table(array) && array.table->kind == Table::Kind::Array) {
      const Table::Field* field = array.table->fields.empty() ? nullptr : array.table->fields[0];
      ExpressionFact fact;
      fact.type = array;
      fact.call = CallKind::Ipairs;
      fact.field = field;
      if (field != nullptr) element = field->inner != nullptr ? table_type(field->inner) : field->variable.type;
      if (context_.report && work_.spec != nullptr) place_leaves(*array.table);
      record(*call, std::move(fact));
    } else if (!list.open && !is_unknown(array)) {
      type_error(Code::IpairsArgument, call->args.empty() ? call->span : call->args[0]->span,
                 {list.types.size() == 1 ? describe(array) : std::to_string(list.types.size()) + " values"});
    }
  } else {
    refuse_generic_for(stat);
  }
  ++loop_depth_;
  for (size_t i = 0; i < stat.variables.size(); ++i) {
    const Local& variable = *stat.variables[i];
    if (i > 1) context_.unset_locals.insert(&variable); // ipairs gives two values
    declare(variable, i == 0 ? integer_type() : i == 1 ? element : unknown_type(), variable.span, nullptr);
  }
  block(*stat.body);
  --loop_depth_;
}

/// `pairs(...)` is refused by name; anything else as such.
void Walker::refuse_generic_for(const GenericForStat& stat) {
  const auto* call = stat.values.empty() ? nullptr : try_as<CallExpr>(stat.values[0]);
  const auto* name = call != nullptr ? try_as<NameExpr>(call->callee) : nullptr;
  const bool is_named = name != nullptr && name->is_global() && context_.find_global(work_, *name) == nullptr &&
                        (name->name == "pairs" || name->name == "next");
  if (is_named) {
    refuse_name(name->span, name->name);
  } else if (!stat.values.empty()) {
    const auto* first = try_as<NameExpr>(stat.values[0]);
    if (first != nullptr && first->is_global() && first->name == "next") {
      refuse_name(first->span, "next");
    } else {
      error(Code::GenericForLoop, stat.values[0]->span);
    }
  }
}

namespace {

std::string count_of_values(size_t count) {
  return count == 0 ? "no value" : count == 1 ? "1 value" : std::to_string(count) + " values";
}

} // namespace

void Walker::return_values(const ReturnStat& stat) {
  const TypeList list = expression_list(stat.values);
  if (at_top_level()) {
    if (&work_ != context_.top) return_from_module(stat, list); // what the shader's own file returns nobody reads
    return;
  }
  join_results(stat, list);
  if (work_.site != nullptr || work_.caller == nullptr || !context_.makers.contains(work_.function)) return;
  // From the next round on each call has a specialisation of its own.
  work_.has_results = false;
  work_.has_open_return = true;
}

void Walker::join_results(const ReturnStat& stat, const TypeList& list) {
  if (list.open) {
    work_.has_open_return = true;
    return;
  }
  const auto span_of = [&](size_t i) {
    return stat.values.empty() ? stat.span : stat.values[std::min(i, stat.values.size() - 1)]->span;
  };
  if (!work_.has_results) {
    work_.has_results = true;
    work_.results = work_.first_results = list.types;
    work_.first_return = stat.span;
    work_.result_spans.clear();
    for (size_t i = 0; i < list.types.size(); ++i)
      work_.result_spans.push_back(span_of(i));
    context_.changed = true;
    for (const Type& type : work_.results)
      escape(type);
    return;
  }
  if (list.types.size() != work_.results.size()) {
    work_.has_unequal_returns = true;
    type_error(Code::ResultCount, stat.span,
               {count_of_values(list.types.size()), count_of_values(work_.results.size())})
        .note(Code::NoteOtherReturn, work_.first_return);
    return;
  }
  for (size_t i = 0; i < list.types.size(); ++i) {
    if (is_table(work_.results[i]) && is_table(list.types[i])) {
      const Type merged = merge_results(stat, i, list.types[i]);
      if (merged != work_.results[i]) context_.changed = true;
      work_.results[i] = work_.first_results[i] = merged;
      escape(merged);
      continue;
    }
    const bool fits = join(work_.first_results[i], list.types[i]).has_value();
    if (!fits) refuse_result(context_, work_, i, list.types[i], span_of(i));
    if (!fits && is_unknown(work_.conflict_type)) {
      work_.conflict_type = list.types[i];
      work_.conflict = span_of(i);
      work_.conflict_index = i;
    }
    if (is_unknown(work_.first_results[i])) work_.first_results[i] = list.types[i];
    const Type joined = fits ? join(work_.results[i], list.types[i]).value_or(conflicting_type()) : conflicting_type();
    if (joined != work_.results[i]) context_.changed = true;
    work_.results[i] = joined;
    escape(joined);
  }
}

} // namespace moonshade::sema
