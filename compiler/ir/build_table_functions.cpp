// `build`: ramp(x, t) and the like (sema::TableFunction), by the same steps as stdlib/spline.h, which stock Lua runs.
#include "compiler/ir/build_function.h"

namespace moonshade::ir {

using sema::TableFunction;

namespace {

const LibraryFunction& row_of(std::string_view name) {
  for (const LibraryFunction& row : library_overloads(name))
    if (row.parameters[0] == ValueType::Number) return row;
  return library_overloads(name)[0];
}

} // namespace

ValueId FunctionBuild::table_function(const sema::ExpressionFact& known, const sema::Type& array,
                                      const Values& arguments) {
  const sema::Table& table = *array.table;
  const TableFunction kind = known.table_function;
  const bool is_spline = kind == TableFunction::Catmullrom || kind == TableFunction::Bspline;
  const bool is_cyclic = kind == TableFunction::Palette;
  const uint32_t length = table.length;
  const uint32_t spans = is_spline ? length - 3 : is_cyclic ? length : length > 1 ? length - 1 : 1;
  const auto call = [&](std::string_view name, Values operands) {
    return b_.call_library(row_of(name), ValueType::Number, std::move(operands));
  };
  // The span and the place in it; NaN lies in the first.
  const ValueId x = converted(arguments[0], ValueType::Number);
  const ValueId scaled = b_.binary(Op::Mul, call(is_cyclic ? "fract" : "saturate", {x}), b_.number(spans));
  const ValueId span = call("clamp", {call("floor", {scaled}), b_.number(0), b_.number(spans - 1)});
  const ValueId place = b_.binary(Op::Sub, scaled, span);
  const ValueId first = b_.call_library(row_of("math.floor"), ValueType::Integer, {span});
  const auto value = [&](uint32_t offset) {
    ValueId index = offset == 0 || length == 1 ? first : b_.binary(Op::Add, first, b_.integer(offset));
    if (is_cyclic && offset != 0 && length > 1)
      index = b_.select(b_.compare(Op::Eq, index, b_.integer(length)), b_.integer(0), index);
    return converted(load_leaf(*known.field, slot_number(table, arguments[1], index)), known.type.value);
  };
  if (!is_spline) return b_.call_library(*known.library, known.type.value, {value(0), value(1), place});
  return b_.call_library(*known.library, known.type.value, {place, value(0), value(1), value(2), value(3)});
}

} // namespace moonshade::ir
