// Derivatives: gradient(f, p) and fwidth(f, p, fw). `f` is specialised for the type of `p`, as if it were called with
// it, and is `callee` of the fact (or a row of the library, `library`): whatever else looks at calls, captures and
// definite assignment among them, sees a call of it.
#include "compiler/sema/library_calls.h"
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"
#include "stdlib/images.h"

#include <algorithm>
#include <set>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

TypeList unknown_values() { return {{}, true}; }

/// What a function gives, for messages.
std::string describe_results(const TypeList& results) {
  if (results.types.empty()) return "no value";
  if (results.types.size() > 1) return std::to_string(results.types.size()) + " values";
  return describe(results.types[0]);
}

/// The rows of the library that a specialisation and what it calls use; with `differentiated`, inside gradients alone.
void collect_rows(const Specialisation& specialisation, bool differentiated, std::set<const LibraryFunction*>& rows,
                  std::set<std::pair<const Specialisation*, bool>>& seen) {
  if (!seen.insert({&specialisation, differentiated}).second) return;
  for (const auto& [id, fact] : specialisation.expressions) {
    const bool is_gradient = fact.call == CallKind::Gradient || fact.call == CallKind::Fwidth;
    const bool counts = !differentiated || is_gradient;
    if (fact.library != nullptr && counts) rows.insert(fact.library);
    if (fact.callee != nullptr) collect_rows(*fact.callee, !counts, rows, seen);
  }
}

} // namespace

bool is_derivative(std::string_view name) { return name == "gradient" || name == "fwidth"; }

bool Walker::takes_derivative_arguments(const CallExpr& expr, std::string_view name, const TypeList& args) {
  const size_t count = name == "gradient" ? 2 : 3;
  constexpr std::string_view kNames[] = {"f", "p", "fw"};
  if (args.open) return false;
  if (args.types.size() < count) {
    const size_t missing = args.types.size();
    type_error(Code::MissingArgument, expr.span,
               {std::to_string(missing + 1), std::string(name), std::string(kNames[missing])});
    return false;
  }
  const auto place = [&](size_t i) { return expr.args[std::min(i, expr.args.size() - 1)]->span; };
  if (expr.args.size() > count) {
    error(Code::TooManyArguments, place(count), {std::string(name), std::to_string(count)});
    return false;
  }
  const auto refuse = [&](size_t i, std::string expected) {
    type_error(Code::ArgumentType, place(i),
               {std::to_string(i + 1), std::string(name), describe(args.types[i]), std::move(expected)});
    return false;
  };
  if (std::ranges::any_of(args.types.begin(), args.types.begin() + static_cast<ptrdiff_t>(count), is_unknown))
    return false;
  const Type& function = args.types[0];
  const bool is_row =
      function.kind == Type::Kind::Library && !is_built_in(function.text) && !library_overloads(function.text).empty();
  if (function.kind != Type::Kind::Function && !is_row) return refuse(0, "a function that gives a number");
  if (!is_scalar(args.types[1]) && !is_vector(args.types[1])) return refuse(1, "a number or a vector");
  if (count == 3 && !is_scalar(args.types[2])) return refuse(2, "a number");
  return true;
}

/// The function must only compute: the derivative moves `p` alone, and stock Lua calls the function many times.
bool Walker::is_free_of_effects(const Expr& function, const Work& callee, std::string_view name) {
  const Variable* assigned = nullptr;
  for (const Variable* variable : callee.outer_writes)
    if (assigned == nullptr || variable->slot->id < assigned->slot->id) assigned = variable;
  if (assigned == nullptr) return true;
  error(Code::GradientAssigns, function.span, {std::string(name), assigned->slot->name})
      .note(Code::NoteDeclaredHere, assigned->first, {assigned->slot->name});
  return false;
}

/// Rows inside gradients inside the function are differentiated twice.
void Walker::refuse_rows(const CallExpr& expr, const Specialisation& function, std::string_view name) {
  std::set<const LibraryFunction*> rows;
  std::set<std::pair<const Specialisation*, bool>> seen;
  collect_rows(function, true, rows, seen);
  const auto is_refused = [&](const LibraryFunction& row) {
    return rows.contains(&row) && !has_second_derivatives(row);
  };
  const auto found = std::ranges::find_if(library(), is_refused); // in the library's order
  const LibraryFunction* refused = found != library().end()    ? &*found
                                   : is_refused(texture_row()) ? &texture_row()
                                                               : nullptr;
  if (refused != nullptr)
    type_error(Code::NoSecondDerivative, expr.span, {std::string(name), std::string(refused->name)});
}

TypeList Walker::derivative_call(const CallExpr& expr, std::string_view name) {
  const TypeList args = expression_list(expr.args);
  if (!takes_derivative_arguments(expr, name, args)) return unknown_values();
  const Type point = is_vector(args.types[1]) ? args.types[1] : number_type();
  const Type type = name == "gradient" ? point : number_type();
  const Expr& function = *expr.args[0];

  ExpressionFact fact;
  TypeList results;
  if (args.types[0].kind == Type::Kind::Library) {
    const std::string_view row = args.types[0].text;
    results = call_table_row(expr, row, {expr.args[std::min<size_t>(1, expr.args.size() - 1)]}, {point});
    if (results.open) return {{type}, false};
    fact.library = choose_row(library_overloads(row), {point}).row;
  } else {
    results = call_function(expr, args.types[0], {{point}, false});
    if (results.open || !context_.report) return {{type}, false};
    const auto callee = work_.callees.find(expr.id);
    if (callee == work_.callees.end()) return {{type}, false};
    fact.callee = callee->second.work->spec;
    if (!is_free_of_effects(function, *callee->second.work, name)) return {{type}, false};
    const unsigned order = callee->second.work->derivative_order + 1;
    if (order > kMaxDerivativeOrder)
      type_error(Code::GradientOrder, expr.span, {std::string(name), std::to_string(kMaxDerivativeOrder)});
    if (order == 2) refuse_rows(expr, *fact.callee, name);
    work_.derivative_order = std::max(work_.derivative_order, order);
  }
  if (results.types.size() != 1 || (!is_unknown(results.types[0]) && !is_scalar(results.types[0]))) {
    type_error(Code::GradientResult, function.span, {std::string(name), describe_results(results)});
    return {{type}, false};
  }
  fact.type = type;
  fact.results = {type};
  fact.call = name == "gradient" ? CallKind::Gradient : CallKind::Fwidth;
  return {{record(expr, std::move(fact))}, false};
}

} // namespace moonshade::sema
