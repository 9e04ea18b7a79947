// Functions of the library that go through an array: ramp(x, t), palette(x, t), catmullrom(x, t), bspline(x, t). The
// last three have rows of the table too, of other arguments.
#include "compiler/sema/library_calls.h"
#include "compiler/sema/walker.h"

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

struct Entry {
  std::string_view name;
  TableFunction function;
  std::string_view row;
  uint32_t least; ///< elements
};
constexpr Entry kEntries[] = {{"ramp", TableFunction::Ramp, "mix", 1},
                              {"palette", TableFunction::Palette, "mix", 1},
                              {"catmullrom", TableFunction::Catmullrom, "catmullrom", 4},
                              {"bspline", TableFunction::Bspline, "bspline", 4}};

const Entry* find(std::string_view name) {
  for (const Entry& entry : kEntries)
    if (entry.name == name) return &entry;
  return nullptr;
}

} // namespace

bool Walker::is_table_function(std::string_view name, const TypeList& types) const {
  if (find(name) == nullptr) return false;
  return name == "ramp" || (types.types.size() == 2 && is_table(types.types[1]));
}

TypeList Walker::table_function(const CallExpr& expr, std::string_view name, const TypeList& types) {
  const Entry& entry = *find(name);
  const TypeList unknown{{}, true};
  const std::string text(name);
  if (types.types.size() < 2) {
    const size_t missing = types.types.size();
    type_error(Code::MissingArgument, expr.span, {std::to_string(missing + 1), text, missing == 0 ? "x" : "values"});
    return unknown;
  }
  if (types.types.size() > 2) {
    error(Code::TooManyArguments, expr.args[std::min<size_t>(2, expr.args.size() - 1)]->span, {text, "2"});
    return unknown;
  }
  const auto refuse = [&](size_t i, std::string expected) {
    if (!is_unknown(types.types[i]))
      type_error(Code::ArgumentType, expr.args[std::min(i, expr.args.size() - 1)]->span,
                 {std::to_string(i + 1), text, describe(types.types[i]), std::move(expected)});
    return unknown;
  };
  if (!is_scalar(types.types[0])) return refuse(0, "a number");
  const std::string expected =
      std::string(entry.least == 1 ? "an array of" : "an array of at least four") + " numbers or vectors";
  const Type& given = types.types[1];
  if (!is_table(given) || expr.args.size() < 2) return refuse(1, expected);
  const Table& array = *given.table;
  if (array.kind == Table::Kind::Unknown) return unknown;
  const Table::Field* field = array.kind == Table::Kind::Array && !array.fields.empty() ? array.fields[0] : nullptr;
  if (field == nullptr || field->inner != nullptr || array.length < entry.least) return refuse(1, expected);
  const Type& element = field->variable.type;
  if (is_unknown(element)) return unknown;
  if (!is_scalar(element) && !is_vector(element)) return refuse(1, expected);
  ExpressionFact fact;
  fact.type = is_vector(element) ? element : number_type();
  fact.results = {fact.type};
  fact.call = CallKind::TableFunction;
  fact.table_function = entry.function;
  fact.field = field;
  fact.library = &library_overloads(entry.row)[0];
  if (context_.report && work_.spec != nullptr) place_leaves(*given.table);
  return {{record(expr, std::move(fact))}, false};
}

} // namespace moonshade::sema
