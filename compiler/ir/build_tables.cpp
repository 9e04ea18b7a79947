// `build`, tables: constructors, copies, elements and fields. The tables that one of sema's Tables stands for are
// numbered from 0 (there are several only inside arrays); slot i of number n is n * length + i in each leaf's variable.
#include "compiler/ir/build_function.h"

#include <algorithm>

namespace moonshade::ir {

using namespace syntax;
using sema::Table;

namespace {

bool is_array(const Table& table) { return table.kind == Table::Kind::Array; }

sema::Type type_of(const Table::Field& field) {
  if (field.inner == nullptr) return field.variable.type;
  sema::Type type;
  type.kind = sema::Type::Kind::Table;
  type.table = field.inner;
  return type;
}

} // namespace

// ---- slots ---------------------------------------------------------------------------------------------------------

ValueId FunctionBuild::slot_number(const Table& table, ValueId element, ValueId index) {
  if (!is_array(table)) return element;
  if (element == kNone) return index;
  return b_.binary(Op::Add, b_.binary(Op::Mul, element, b_.integer(table.length)), index);
}

ValueId FunctionBuild::load_leaf(const Table::Field& field, ValueId slot) {
  const auto found = specialisation_.leaves.find(&field);
  if (found == specialisation_.leaves.end()) return kNone; // functions and strings
  const sema::Place& place = found->second;
  if (place.slot != nullptr) {
    const VariableId variable = variable_of(*place.slot);
    return place.slot->count == 1 ? b_.load(variable) : b_.load_element(variable, slot);
  }
  const Global& global = shared_.module.globals[place.global];
  const ValueType type = global.type;
  return global.count == 1 ? b_.load_global(place.global, type) : b_.load_global_element(place.global, type, slot);
}

void FunctionBuild::store_leaf(const Table::Field& field, ValueId slot, ValueId value) {
  const auto found = specialisation_.leaves.find(&field);
  if (found == specialisation_.leaves.end() || value == kNone) return;
  if (found->second.slot == nullptr) {
    defect("an assignment to a constant");
    return;
  }
  const sema::Slot& leaf = *found->second.slot;
  const VariableId variable = variable_of(leaf);
  value = converted(value, leaf.type);
  if (leaf.count == 1)
    b_.store(variable, value);
  else
    b_.store_element(variable, slot, value);
}

// ---- constructors --------------------------------------------------------------------------------------------------

ValueId FunctionBuild::table(const TableExpr& expr) {
  const sema::Type& type = fact(expr).type;
  if (type.kind != sema::Type::Kind::Table || type.table->is_data) return kNone;
  construct(expr, *type.table, kNone);
  return kNone;
}

/// Fills number `element` of the table.
void FunctionBuild::construct(const TableExpr& expr, const Table& table, ValueId element) {
  const At at(b_, expr.span);
  if (!is_array(table)) {
    for (const TableField& given : expr.fields) {
      const auto* key = try_as<StringExpr>(given.key);
      const Table::Field* field = key != nullptr ? table.find(key->value) : nullptr;
      if (field != nullptr) construct_slot(table, *field, element, *given.value);
    }
    return;
  }
  int64_t index = 0;
  for (const TableField& given : expr.fields) {
    const bool is_last_call = &given == &expr.fields.back() &&
                              (given.value->kind == ExprKind::Call || given.value->kind == ExprKind::MethodCall);
    if (!is_last_call) {
      construct_slot(table, *table.fields[0], slot_number(table, element, b_.integer(index++)), *given.value);
      continue;
    }
    const Values values = evaluate_all(*given.value);
    Expr* const list[] = {given.value};
    const std::vector<sema::Type> types = types_of(list);
    for (size_t i = 0; i < values.size(); ++i)
      give_slot(table, *table.fields[0], slot_number(table, element, b_.integer(index++)), values[i], types[i]);
  }
}

void FunctionBuild::construct_slot(const Table& table, const Table::Field& field, ValueId slot, const Expr& value) {
  if (const auto* constructor = try_as<TableExpr>(&strip_parentheses(value));
      constructor != nullptr && field.inner != nullptr) {
    construct(*constructor, *field.inner, field.inner->is_element() ? slot : kNone);
    return;
  }
  give_slot(table, field, slot, evaluate(value), fact(value).type);
}

void FunctionBuild::give_slot(const Table&, const Table::Field& field, ValueId slot, ValueId value,
                              const sema::Type& type) {
  if (field.inner != nullptr) {
    copy_table(*field.inner, field.inner->is_element() ? slot : kNone, *type.table, value);
  } else {
    store_leaf(field, slot, value);
  }
}

// ---- copies --------------------------------------------------------------------------------------------------------

ValueId FunctionBuild::as_table(const sema::Type& to, ValueId value, const sema::Type& from) {
  if (to.table == from.table || from.kind != sema::Type::Kind::Table) return value;
  copy_table(*to.table, kNone, *from.table, value);
  return kNone;
}

void FunctionBuild::copy_table(const Table& to, ValueId to_element, const Table& from, ValueId from_element) {
  if (&to == &from) return;
  if (!is_array(to)) {
    copy_fields(to, to_element, from, from_element);
    return;
  }
  constexpr uint32_t kMostUnrolled = 16;
  const auto copy_slot = [&](ValueId index) {
    copy_fields(to, slot_number(to, to_element, index), from, slot_number(from, from_element, index));
  };
  if (to.length <= kMostUnrolled) {
    for (uint32_t i = 0; i < to.length; ++i)
      copy_slot(b_.integer(i));
    return;
  }
  const VariableId counter = b_.variable("", ValueType::Integer);
  const LabelId label = b_.label();
  b_.store(counter, b_.integer(0));
  b_.loop(label, b_.block([&] {
    const ValueId index = b_.load(counter);
    copy_slot(index);
    const ValueId next = b_.binary(Op::Add, index, b_.integer(1));
    b_.store(counter, next);
    break_if(b_.compare(Op::Le, b_.integer(to.length), next), label);
  }));
}

void FunctionBuild::copy_fields(const Table& to, ValueId to_slot, const Table& from, ValueId from_slot) {
  for (const Table::Field* target : to.fields) {
    const Table::Field* source = from.find(target->name);
    if (source == nullptr) continue;
    const sema::Type type = type_of(*source);
    if (target->inner == nullptr) {
      store_leaf(*target, to_slot, load_leaf(*source, from_slot));
      continue;
    }
    if (type.kind != sema::Type::Kind::Table) continue;
    // A table inside, or one that the record refers to.
    ValueId element = kNone;
    if (type.table->is_element()) element = source->inner != nullptr ? from_slot : load_leaf(*source, from_slot);
    copy_table(*target->inner, target->inner->is_element() ? to_slot : kNone, *type.table, element);
  }
}

// ---- access --------------------------------------------------------------------------------------------------------

FunctionBuild::Access FunctionBuild::access(const IndexExpr& expr) {
  const sema::ExpressionFact& known = fact(expr);
  if (known.field == nullptr) return {};
  Access access{known.field, fact(*expr.object).type.table, evaluate(*expr.object), kNone, expr.key->span};
  if (is_array(*access.table)) access.key = evaluate(*expr.key);
  return access;
}

ValueId FunctionBuild::checked_slot(const Access& access) {
  if (!is_array(*access.table)) return access.element;
  const At at(b_, access.place);
  const uint32_t length = access.table->length;
  ValueId index = access.key;
  if (index != kNone && b_.type_of(index) == ValueType::Number) {
    for (const LibraryFunction& row : library_overloads("math.tointeger"))
      if (row.parameters[0] == ValueType::Number && row.result_count == 2) {
        const ValueId call = b_.call_library(row, ValueType::Integer, {index});
        b_.fault(b_.unary(Op::Not, b_.result(call, 1, ValueType::Boolean)), FaultCode::IntegerRange);
        index = call;
        break;
      }
  }
  if (index == kNone || b_.type_of(index) != ValueType::Integer) {
    defect("an index that is no number");
    return b_.integer(0);
  }
  const std::optional<int64_t> known = known_integer(index);
  if (known && *known >= 1 && *known <= int64_t{length})
    return slot_number(*access.table, access.element, b_.integer(*known - 1));
  const ValueId below = b_.compare(Op::Lt, index, b_.integer(1));
  const ValueId above = b_.compare(Op::Lt, b_.integer(length), index);
  b_.fault(b_.binary(Op::Or, below, above), FaultCode::Index);
  return slot_number(*access.table, access.element, b_.binary(Op::Sub, index, b_.integer(1)));
}

ValueId FunctionBuild::table_index(const IndexExpr& expr) {
  const Access found = access(expr);
  const ValueId slot = checked_slot(found);
  if (found.field->inner != nullptr) return found.field->inner->is_element() ? slot : kNone;
  return load_leaf(*found.field, slot);
}

/// for i, v in ipairs(t): the length is fixed and no element is nil.
void FunctionBuild::ipairs_loop(const GenericForStat& stat) {
  const auto* call = try_as<CallExpr>(stat.values[0]);
  const sema::ExpressionFact& known = fact(*call);
  if (known.call != sema::CallKind::Ipairs || known.field == nullptr) {
    defect("a statement that sema should have refused");
    return;
  }
  const Values arguments = evaluate_list(call->args);
  const Table& table = *known.type.table;
  const LabelId label = b_.label();
  labels_.emplace(&stat, label);
  const VariableId counter = b_.variable("", ValueType::Integer);
  b_.store(counter, b_.integer(1));
  ir::Block body = b_.block([&] {
    b_.step();
    const ValueId index = b_.load(counter);
    store_local(*stat.variables[0], index, sema::Type::of(ValueType::Integer));
    if (stat.variables.size() > 1) {
      const ValueId slot = slot_number(table, arguments[0], b_.binary(Op::Sub, index, b_.integer(1)));
      const bool is_part = known.field->inner != nullptr;
      store_local(*stat.variables[1], is_part ? slot : load_leaf(*known.field, slot), type_of(*known.field));
    }
    statements(*stat.body);
    if (b_.terminated()) return;
    const ValueId now = b_.load(counter);
    break_if(b_.compare(Op::Le, b_.integer(table.length), now), label);
    b_.store(counter, b_.binary(Op::Add, now, b_.integer(1)));
  });
  b_.loop(label, std::move(body));
}

} // namespace moonshade::ir
