// Tables. Which table an expression stands for is known while compiling: a constructor makes one table for each call of
// its function that can outlive the call (Table, program.h). Constructors inside a constructor fill parts of the outer
// table. A table that exists already may become part of another, or be one of several that meet in a conditional, a
// variable or a result, only where nobody can tell its copy from it: where it has no other name, or nothing in it is
// ever assigned. A record outside of arrays just refers to it.
#include "compiler/sema/constants.h"
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"

#include <algorithm>
#include <set>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

Table::Field* add_field(Table& table, std::string_view name, Span span) {
  table.storage.push_back(std::make_unique<Table::Field>());
  Table::Field* field = table.storage.back().get();
  field->name = name;
  field->span = span;
  field->variable.table = &table;
  table.fields.push_back(field);
  return field;
}

Type type_of(const Table::Field& field) {
  return field.inner != nullptr ? table_type(field.inner) : field.variable.type;
}

uint64_t element_count(const Table& table) {
  uint64_t count = 0;
  for (const Table::Field* field : table.fields)
    count += field->inner != nullptr ? element_count(*field->inner)
                                     : table.instances() * std::max<uint64_t>(table.length, 1);
  return count;
}

/// What is known while compiling alone: functions and strings.
bool is_constant(const Type& type) { return is_function(type) || type.kind == Type::Kind::String; }

bool is_multiple(const Expr& expr) { return expr.kind == ExprKind::Call || expr.kind == ExprKind::MethodCall; }

} // namespace

std::string Walker::describe_shape(const Table& table) const {
  if (table.kind == Table::Kind::Array) return "an array of " + std::to_string(table.length);
  std::string names;
  for (const Table::Field* field : table.fields)
    names += (names.empty() ? "" : ", ") + std::string(field->name);
  return "a record of " + names;
}

// ---- constructors --------------------------------------------------------------------------------------------------

Type Walker::table(const TableExpr& expr) {
  Table& table = *context_.table_of(work_, &expr, 0, expr.span);
  construct_table(expr, table);
  return record(expr, table.kind == Table::Kind::Unknown ? unknown_type() : table_type(&table));
}

void Walker::construct_table(const TableExpr& expr, Table& table) {
  if (expr.fields.empty()) {
    error(Code::EmptyTable, expr.span);
    return;
  }
  if (expr.fields[0].kind == FieldKind::Named && expr.fields.size() > kMaxRecordFields)
    context_.too_large(expr.span, "a record has too many fields", kMaxRecordFields);
  if (context_.exhausted) return;
  const Table::Kind kind = expr.fields[0].kind == FieldKind::Positional ? Table::Kind::Array : Table::Kind::Record;
  bool is_fine = true;
  for (const TableField& field : expr.fields) {
    if (field.kind == FieldKind::Keyed) {
      expression(*field.key);
      error(Code::KeyedField, field.span);
      is_fine = false;
    } else if ((field.kind == FieldKind::Positional) != (kind == Table::Kind::Array)) {
      error(Code::MixedTable, field.span);
      is_fine = false;
    }
  }
  if (!is_fine || (table.kind != Table::Kind::Unknown && table.kind != kind)) {
    for (const TableField& field : expr.fields)
      values(*field.value);
    if (is_fine) error(Code::TableShapes, expr.span, {"an array and a record"});
    return;
  }
  if (table.kind != kind) context_.changed = true;
  table.kind = kind;
  kind == Table::Kind::Array ? construct_array(expr, table) : construct_record(expr, table);
  if (context_.report && table.outer == nullptr) {
    table.is_data = !table.is_mutated && read_data(expr, table, 0);
    if (!table.is_data) context_.constructed_elements += element_count(table);
    if (context_.constructed_elements > kMaxConstructedElements)
      context_.too_large(expr.span, "tables have too many elements that are no constants", kMaxConstructedElements);
  }
  if (table.outer == nullptr) place_leaves(table);
}

bool Walker::read_data(const TableExpr& expr, Table& table, uint64_t number) {
  for (size_t i = 0; i < expr.fields.size(); ++i) {
    const bool is_array = table.kind == Table::Kind::Array;
    const auto* key = try_as<StringExpr>(expr.fields[i].key);
    Table::Field* field = is_array ? table.fields[0] : key != nullptr ? table.find(key->value) : nullptr;
    const uint64_t slot = is_array ? number * table.length + i : number;
    if (field == nullptr || !read_datum(*expr.fields[i].value, table, *field, slot)) return false;
  }
  return true;
}

bool Walker::read_datum(const Expr& value, const Table& table, Table::Field& field, uint64_t slot) {
  if (const auto* constructor = try_as<TableExpr>(&strip_parentheses(value)))
    return field.inner != nullptr && read_data(*constructor, *field.inner, field.inner->is_element() ? slot : 0);
  if (field.inner != nullptr || !field.variable.type.is_value()) return is_constant(field.variable.type);
  const auto constant = evaluate_constant(value, [&](const Expr& at) { return constant_name(at); });
  if (!constant) return false;
  const uint64_t count = table.instances() * std::max<uint64_t>(table.length, 1);
  if (count > kMaxTableElements || slot >= count) return false; // of a length that is not known, or another one
  field.data.resize(count);
  field.data[slot] = *constant;
  return true;
}

void Walker::construct_array(const TableExpr& expr, Table& table) {
  if (table.fields.empty()) add_field(table, {}, expr.span);
  Table::Field& element = *table.fields[0];
  uint64_t length = 0;
  bool is_open = false;
  for (size_t i = 0; i < expr.fields.size(); ++i) {
    const Expr& value = *expr.fields[i].value;
    if (i + 1 == expr.fields.size() && is_multiple(value)) {
      const TypeList list = values(value);
      for (const Type& type : list.types)
        construct_field(table, element, value, type);
      length += list.types.size();
      is_open = list.open;
    } else {
      construct_field(table, element, value);
      ++length;
    }
  }
  if (is_open) return;
  if (length == 0) {
    error(Code::EmptyTable, expr.span);
  } else if (table.length == 0) {
    table.length = static_cast<uint32_t>(length);
    context_.changed = true;
  } else if (table.length != length) {
    error(Code::TableShapes, expr.span,
          {"an array of " + std::to_string(table.length) + " and an array of " + std::to_string(length)});
  }
}

void Walker::construct_record(const TableExpr& expr, Table& table) {
  const bool is_first = table.fields.empty();
  bool is_twice = false;
  std::vector<std::string_view> names;
  for (const TableField& given : expr.fields) {
    const auto* key = try_as<StringExpr>(given.key);
    if (key == nullptr) continue;
    Table::Field* field = table.find(key->value);
    if (std::ranges::find(names, key->value) != names.end()) {
      error(Code::FieldTwice, key->span, {std::string(key->value)});
      is_twice = true;
    } else if (field == nullptr && is_first) {
      field = add_field(table, key->value, key->span);
    }
    names.push_back(key->value);
    if (field != nullptr) {
      construct_field(table, *field, *given.value);
    } else {
      expression(*given.value);
    }
  }
  const bool is_same = names.size() == table.fields.size() &&
                       std::ranges::all_of(names, [&](std::string_view name) { return table.find(name) != nullptr; });
  const bool is_reported = names.size() != expr.fields.size() || is_twice;
  if (is_same || is_reported) return;
  std::string text;
  for (const std::string_view name : names)
    text += (text.empty() ? "" : ", ") + std::string(name);
  error(Code::TableShapes, expr.span, {describe_shape(table) + " and a record of " + text});
}

void Walker::construct_field(Table& table, Table::Field& field, const Expr& value) {
  const auto* constructor = try_as<TableExpr>(&strip_parentheses(value));
  if (constructor == nullptr) {
    construct_field(table, field, value, expression(value));
    return;
  }
  if (!is_unknown(field.variable.type)) {
    values(value);
    refuse_element(table, field, value, table_type(context_.table_of(work_, constructor, 0, value.span)));
    return;
  }
  Table& inner = *context_.inner_table(table, field, value.span);
  construct_table(*constructor, inner);
  for (const Expr* at = &value; at != constructor; at = static_cast<const ParenExpr*>(at)->inner)
    record(*at, table_type(&inner));
  record(*constructor, table_type(&inner));
}

void Walker::refuse_element(Table& table, const Table::Field& field, const Expr& value, const Type& type) {
  const Type before = type_of(field);
  type_error(Code::TypeConflict, value.span,
             {table.kind == Table::Kind::Array ? "an element of this array" : std::string(field.name), describe(before),
              describe(type)});
}

void Walker::construct_field(Table& table, Table::Field& field, const Expr& value, const Type& type) {
  if (is_unknown(type)) return;
  if (type.kind == Type::Kind::None) {
    error(Code::NoValue, value.span);
  } else if (is_constant(type) && table.kind == Table::Kind::Array) {
    error(Code::ArrayElement, value.span, {describe(type)});
  } else if (is_table(type)) {
    const bool is_part = table.kind == Table::Kind::Array || table.is_element();
    if (field.inner == nullptr && !is_unknown(field.variable.type) && !is_table(field.variable.type)) {
      refuse_element(table, field, value, type);
    } else if (is_part) {
      copy_table(type, *context_.inner_table(table, field, value.span), value);
    } else {
      if (type.table->stands_in == nullptr) type.table->stands_in = &field;
      if (type.table->stands_in == &field)
        give(field.variable, type, value.span, &value, field.name);
      else
        refuse_second_slot(value); // nor placed twice: records of such records would double
    }
  } else if (field.inner != nullptr || is_table(field.variable.type)) {
    refuse_element(table, field, value, type);
  } else {
    give(field.variable, type, value.span, &value,
         table.kind == Table::Kind::Array ? std::string_view("an element of this array") : field.name);
  }
}

void Walker::refuse_second_slot(const Expr& value) {
  const auto* name = try_as<NameExpr>(&strip_parentheses(value));
  error(Code::TableTwice, value.span, {name != nullptr ? std::string(name->name) : "this table"});
}

// ---- copies --------------------------------------------------------------------------------------------------------

bool Walker::is_fresh(const Expr& value, const Type& type) const {
  const Expr& expr = strip_parentheses(value);
  if (expr.kind == ExprKind::Table) return true;
  if (expr.kind == ExprKind::Binary) return type.table->syntax == &expr; // of branches that were fresh
  const auto callee = callees_.find(expr.id);
  if (!is_multiple(expr) || callee == callees_.end()) return false;
  const Work* maker = type.table->outermost()->maker;
  while (maker != nullptr && maker != callee->second)
    maker = maker->site;
  return maker != nullptr;
}

void Walker::copy_table(const Type& from, Table& to, const Expr& value) {
  const bool is_constant = !from.table->is_mutated && !to.is_mutated;
  if (!is_fresh(value, from) && !is_constant) refuse_second_slot(value);
  join_shapes(to, *from.table, value.span);
  place_leaves(*from.table);
  place_leaves(to);
}

bool Walker::join_shapes(Table& to, const Table& from, Span place) {
  if (from.kind == Table::Kind::Unknown) return true;
  if (to.kind == Table::Kind::Unknown) {
    to.kind = from.kind;
    to.length = from.length;
    for (const Table::Field* field : from.fields)
      add_field(to, field->name, field->span);
    context_.changed = true;
  }
  if (to.length == 0) to.length = from.length;
  bool fits =
      to.kind == from.kind && to.fields.size() == from.fields.size() && (to.length == from.length || from.length == 0);
  for (const Table::Field* field : from.fields)
    fits = fits && to.find(field->name) != nullptr;
  if (!fits) {
    error(Code::TableShapes, place, {describe_shape(to) + " and " + describe_shape(from)});
    return false;
  }
  for (const Table::Field* field : from.fields) {
    Table::Field& target = *to.find(field->name);
    const Type type = type_of(*field);
    if (is_unknown(type)) continue;
    const Type before = type_of(target);
    if (is_table(type) && (is_unknown(before) || is_table(before))) {
      join_shapes(*context_.inner_table(to, target, field->span), *type.table, place);
    } else if (is_table(before) || is_table(type)) {
      error(Code::TableShapes, place,
            {"'" + std::string(field->name) + "' is " + describe(before) + " and " + describe(type)});
    } else {
      give(target.variable, type, place, nullptr, field->name);
    }
  }
  return true;
}

Type Walker::merge_tables(const Type& before, const Type& given, const void* syntax, unsigned which, const Expr& value,
                          Span place) {
  if (before == given && !before.table->is_element()) return before;
  Table& merged = *context_.table_of(work_, syntax, which, value.span);
  merged.syntax = syntax;
  if (!is_fresh(value, given)) error(Code::TableNotKnown, place, {"this stands"});
  if (before.table != &merged) join_shapes(merged, *before.table, value.span);
  join_shapes(merged, *given.table, value.span);
  place_leaves(*given.table);
  place_leaves(merged);
  return table_type(&merged);
}

void Walker::place_leaves(Table& table) {
  if (!context_.report || work_.spec == nullptr) return;
  const uint64_t count = table.instances() * std::max<uint64_t>(table.length, 1);
  context_.table_elements += work_.spec->placed.insert(&table).second ? count * table.fields.size() : 0;
  if (count > kMaxTableElements || context_.table_elements > kMaxFacts)
    context_.too_large(table.span, "a table has too many elements", kMaxTableElements);
  if (context_.exhausted) return;
  for (Table::Field* field : table.fields) {
    if (field->inner != nullptr) {
      place_leaves(*field->inner);
    } else if (has_storage(field->variable.type)) {
      work_.spec->leaves[field] =
          context_.place_for(work_, field->variable, field->name.empty() ? "element" : field->name);
    } else if (is_table(field->variable.type)) {
      place_leaves(*field->variable.type.table);
    }
  }
}

// ---- access --------------------------------------------------------------------------------------------------------

Table::Field* Walker::accessed_field(const IndexExpr& expr, const Table& table) {
  const Type key =
      expr.is_dotted ? string_type(static_cast<const StringExpr&>(*expr.key).value) : expression(*expr.key);
  // A name for a constant string is as good as the string; of others the parts would have to be evaluated.
  const ExprKind written = strip_parentheses(*expr.key).kind;
  const bool is_name =
      key.kind == Type::Kind::String && !key.is_parameter && (written == ExprKind::String || written == ExprKind::Name);
  if (table.kind == Table::Kind::Array && !is_name) {
    if (is_scalar(key)) return table.fields.empty() ? nullptr : table.fields[0];
    if (!is_unknown(key)) type_error(Code::IndexType, expr.key->span, {describe(key)});
    return nullptr;
  }
  if (!is_name) {
    if (!is_unknown(key)) type_error(Code::RecordIndex, expr.key->span);
    return nullptr;
  }
  Table::Field* field = table.kind == Table::Kind::Record ? table.find(key.text) : nullptr;
  if (field != nullptr || !context_.report) return field;
  std::vector<std::string_view> names;
  for (const Table::Field* each : table.fields)
    names.push_back(each->name);
  const auto near = nearest(key.text, names);
  std::string advice = suggestion(near);
  if (table.kind == Table::Kind::Record && advice.empty()) advice = "; it is " + describe_shape(table);
  if (table.kind == Table::Kind::Array) advice = "; its elements are [1] to [" + std::to_string(table.length) + "]";
  suggest_fix(
      type_error(Code::UnknownField, expr.key->span,
                 {table.kind == Table::Kind::Array ? "an array" : "this record", std::string(key.text), advice}),
      near);
  return nullptr;
}

Type Walker::table_index(const IndexExpr& expr, const Type& object) {
  Table::Field* field = accessed_field(expr, *object.table);
  if (field == nullptr) return unknown_type();
  ExpressionFact fact;
  fact.type = type_of(*field);
  fact.field = field;
  if (fact.type.kind == Type::Kind::Function) fact.name = NameKind::Function;
  if (fact.type.kind == Type::Kind::Library) fact.name = NameKind::Library;
  if (context_.report && work_.spec != nullptr && field->inner == nullptr && has_storage(field->variable.type))
    work_.spec->leaves[field] =
        context_.place_for(work_, field->variable, field->name.empty() ? "element" : field->name);
  return record(expr, std::move(fact));
}

void Walker::assign_element(const IndexExpr& target, const Type& object, const Type& type, const Expr& given,
                            Span statement) {
  Table& table = *object.table;
  Table::Field* field = accessed_field(target, table);
  if (field == nullptr) return;
  const auto* object_name = try_as<NameExpr>(&strip_parentheses(*target.object));
  std::string name = object_name != nullptr ? std::string(object_name->name) : "this table";
  if (context_.is_frozen_for(work_, field->variable)) {
    refuse_memory(context_, work_, name, table.outermost()->span, statement);
    return;
  }
  const Type before = type_of(*field);
  if (is_table(before) || is_constant(before) || is_table(type) || is_constant(type)) {
    const Type& wrong = is_table(before) || is_constant(before) ? before : type;
    if (!is_unknown(before)) error(Code::TableSlot, statement, {describe(wrong)});
    return;
  }
  name += target.is_dotted ? "." + std::string(field->name) : "[...]";
  give(field->variable, type, given.span, &given, name);
  for (Table* at = &table; at != nullptr; at = at->outer) {
    context_.changed = context_.changed || !at->is_mutated;
    at->is_mutated = true;
  }
  table_index(target, object);
  if (context_.report && context_.home_of(field->variable) != &work_) work_.outer_writes.insert(&field->variable);
}

// ---- what outlives a call ------------------------------------------------------------------------------------------

/// Something of this call's outlives it: true where the one caller to take it over is known.
bool Walker::leaves_call() {
  if (work_.site != nullptr) return true;
  if (context_.makers.insert(work_.function).second) context_.changed = true;
  return false;
}

void Walker::escape(const Type& type) {
  std::set<const Work*> seen;
  escape(type, seen);
}

void Walker::escape(Table& table, std::set<const Work*>& seen) {
  Table* outermost = &table;
  while (outermost->outer != nullptr)
    outermost = outermost->outer;
  if (outermost->owner == &work_ && work_.function->parent != nullptr && leaves_call()) {
    outermost->owner = context_.residence(work_.site);
    context_.changed = true;
  }
  for (const Table::Field* field : table.fields)
    escape(type_of(*field), seen);
}

/// A function takes along what it captures: variables, and the tables and functions that those stand for.
void Walker::escape(const Type& type, std::set<const Work*>& seen) {
  if (is_table(type)) escape(*type.table, seen);
  if (type.kind != Type::Kind::Function) return;
  for (Work* frame = type.frame; frame != nullptr && seen.insert(frame).second; frame = frame->parent) {
    const Work* home = frame->frame_home != nullptr ? frame->frame_home : frame;
    if (home == &work_ && leaves_call()) {
      frame->frame_home = context_.residence(work_.site);
      context_.changed = true;
    } else if (work_.site == nullptr || home != context_.residence(work_.site)) {
      continue;
    }
    for (const auto& [local, variable] : frame->variables)
      if (variable.is_captured) escape(variable.type, seen);
  }
}

} // namespace moonshade::sema
