// Overloads are tried in three rounds, so that the order of rows of different kinds in the table does not matter:
// exact types, integers converted to numbers, by component.
#include "compiler/sema/library_calls.h"

#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

bool count_fits(const LibraryFunction& row, size_t count) {
  return count >= row.required_count && count <= row.parameter_count;
}

bool is_exact(const Type& type, ValueType parameter) { return type.is(parameter); }

bool converts(const Type& type, ValueType parameter) {
  return type.is(parameter) || (parameter == ValueType::Number && is_scalar(type));
}

template <class Takes> bool row_takes(const LibraryFunction& row, const std::vector<Type>& types, Takes takes) {
  if (!count_fits(row, types.size())) return false;
  for (size_t i = 0; i < types.size(); ++i)
    if (!takes(types[i], row.parameters[i])) return false;
  return true;
}

/// The vector type of a call by component: all vectors alike, the rest scalars. Nothing where they do not fit.
std::optional<ValueType> common_vector(const LibraryFunction& row, const std::vector<Type>& types) {
  std::optional<ValueType> vector;
  for (size_t i = 0; i < types.size(); ++i) {
    if (row.parameters[i] != ValueType::Number) {
      if (!is_exact(types[i], row.parameters[i])) return std::nullopt;
    } else if (is_vector(types[i])) {
      if (vector && *vector != types[i].value) return std::nullopt;
      vector = types[i].value;
    } else if (!is_scalar(types[i])) {
      return std::nullopt;
    }
  }
  return vector;
}

/// The first argument that the row cannot take, in whatever way; the count of arguments where it can take each.
size_t first_misfit(const LibraryFunction& row, const std::vector<Type>& types) {
  for (size_t i = 0; i < types.size(); ++i) {
    const bool by_component = row.componentwise && row.parameters[i] == ValueType::Number && is_vector(types[i]);
    if (!is_unknown(types[i]) && !converts(types[i], row.parameters[i]) && !by_component) return i;
  }
  return types.size();
}

/// The nth of names separated by blanks.
std::string nth_name(std::string_view names, size_t index) {
  for (; index > 0 && !names.empty(); --index) {
    const size_t blank = names.find(' ');
    names = blank == std::string_view::npos ? std::string_view{} : names.substr(blank + 1);
  }
  return std::string(names.substr(0, names.find(' ')));
}

} // namespace

LibraryChoice choose_row(std::span<const LibraryFunction> rows, const std::vector<Type>& types) {
  LibraryChoice choice;
  for (const LibraryFunction& row : rows)
    if (choice.row == nullptr && row_takes(row, types, is_exact)) choice.row = &row;
  for (const LibraryFunction& row : rows)
    if (choice.row == nullptr && row_takes(row, types, converts)) choice.row = &row;
  for (const LibraryFunction& row : rows) {
    if (choice.row != nullptr || !row.componentwise || !count_fits(row, types.size())) continue;
    if (const auto vector = common_vector(row, types)) {
      choice.row = &row;
      choice.by_component = vector;
    }
  }
  if (choice.row == nullptr) return choice;
  // Could Lua mean a row of integers here? An integer beside a number (math.max) is as undecided as a mixed number.
  const auto may_be_integer = [](const Type& type, ValueType parameter) {
    return parameter == ValueType::Integer && (type.mixed || type.is(ValueType::Integer));
  };
  for (const LibraryFunction& row : rows) {
    if (&row == choice.row || row.result_count == 0 || !row_takes(row, types, may_be_integer)) continue;
    (row.results[0] == ValueType::Integer ? choice.is_mixed : choice.depends_on_kind) = true;
  }
  return choice;
}

LibraryMisfit explain_misfit(std::span<const LibraryFunction> rows, const std::vector<Type>& types) {
  LibraryMisfit misfit;
  size_t least = SIZE_MAX;
  const LibraryFunction* shortest = nullptr;
  for (const LibraryFunction& row : rows) {
    misfit.most = std::max<size_t>(misfit.most, row.parameter_count);
    if (row.required_count < least) shortest = &row;
    least = std::min<size_t>(least, row.required_count);
  }
  if (types.size() > misfit.most) {
    misfit.kind = LibraryMisfit::Kind::TooMany;
    misfit.argument = misfit.most;
    return misfit;
  }
  // The rows that get furthest say what is expected there; those of a fitting count come first.
  bool any_count = false;
  for (const LibraryFunction& row : rows)
    any_count = any_count || count_fits(row, types.size());
  size_t furthest = 0;
  std::vector<std::string> expected;
  for (const LibraryFunction& row : rows) {
    if (any_count ? !count_fits(row, types.size()) : row.parameter_count < types.size()) continue;
    const size_t at = first_misfit(row, types);
    if (at < furthest) continue;
    if (at > furthest) expected.clear();
    furthest = at;
    if (at == types.size()) continue;
    std::string text = describe(Type::of(row.parameters[at]));
    if (row.componentwise && row.parameters[at] == ValueType::Number) text += " or a vector";
    if (std::ranges::find(expected, text) == expected.end()) expected.push_back(text);
  }
  misfit.argument = furthest;
  if (furthest < types.size()) {
    for (size_t i = 0; i < expected.size(); ++i)
      misfit.expected += (i == 0 ? "" : i + 1 == expected.size() ? " or " : ", ") + expected[i];
    return misfit;
  }
  misfit.kind = any_count ? LibraryMisfit::Kind::Sizes : LibraryMisfit::Kind::TooFew;
  if (shortest != nullptr) misfit.name = nth_name(shortest->parameter_names, types.size());
  return misfit;
}

/// math.max and math.min take any number of arguments, though their rows have two: all integers give an integer, a
/// number among integers a mixed number.
TypeList Walker::extremum(const CallExpr& expr, std::string_view name) {
  const TypeList args = arguments(expr.args);
  if (args.open || std::ranges::any_of(args.types, is_unknown)) return {{}, true};
  if (args.types.empty()) {
    error(Code::MissingArgument, expr.span, {"1", std::string(name), "a"});
    return {{}, true};
  }
  bool any_number = false, any_integer = false;
  for (size_t i = 0; i < args.types.size(); ++i) {
    const Type& type = args.types[i];
    if (!is_scalar(type)) {
      type_error(Code::ArgumentType, expr.args[std::min(i, expr.args.size() - 1)]->span,
                 {std::to_string(i + 1), std::string(name), describe(type), "a number"});
      return {{}, true};
    }
    any_number = any_number || type.is(ValueType::Number);
    any_integer = any_integer || type.is(ValueType::Integer) || type.mixed;
  }
  ExpressionFact fact;
  fact.type = !any_number ? integer_type() : any_integer ? mixed_type() : number_type();
  fact.results = {fact.type};
  fact.call = CallKind::Library;
  const std::vector<Type> pair(2, Type::of(fact.type.value));
  fact.library = choose_row(library_overloads(name), pair).row;
  return {{record(expr, std::move(fact))}, false};
}

TypeList Walker::call_table_row(const Expr& expr, std::string_view name, const std::vector<const Expr*>& args,
                                const std::vector<Type>& types) {
  const auto rows = library_overloads(name);
  if (std::ranges::any_of(types, is_unknown)) return {{}, true};
  const LibraryChoice choice = choose_row(rows, types);
  if (choice.row == nullptr) {
    if (!context_.report) return {{}, true};
    const LibraryMisfit misfit = explain_misfit(rows, types);
    const Span argument = args.empty() ? expr.span : args[std::min(misfit.argument, args.size() - 1)]->span;
    const std::string text(name);
    switch (misfit.kind) {
    case LibraryMisfit::Kind::TooFew:
      type_error(Code::MissingArgument, expr.span, {std::to_string(types.size() + 1), text, misfit.name});
      break;
    case LibraryMisfit::Kind::TooMany:
      error(Code::TooManyArguments, argument, {text, std::to_string(misfit.most)});
      break;
    case LibraryMisfit::Kind::Argument:
      type_error(Code::ArgumentType, argument,
                 {std::to_string(misfit.argument + 1), text, describe(types[misfit.argument]), misfit.expected});
      break;
    case LibraryMisfit::Kind::Sizes: {
      std::string list;
      for (const Type& type : types)
        list += (list.empty() ? "" : ", ") + type_name(type);
      type_error(Code::ArgumentsDoNotFit, expr.span, {text, list});
      break;
    }
    }
    return {{}, true};
  }
  const auto mixed = std::ranges::find_if(types, &Type::mixed);
  if (choice.depends_on_kind || (name == "math.fmod" && choice.is_mixed)) {
    const auto at = static_cast<size_t>(mixed - types.begin());
    if (mixed != types.end()) refuse_mixed(*args[std::min(at, args.size() - 1)], name);
    return {{number_type()}, false};
  }
  ExpressionFact fact;
  fact.call = CallKind::Library;
  fact.library = choice.row;
  for (unsigned i = 0; i < choice.row->result_count; ++i) {
    Type type = Type::of(choice.row->results[i]);
    if (choice.by_component && type.is(ValueType::Number)) type = Type::of(*choice.by_component);
    if (choice.is_mixed && type.is(ValueType::Number)) type = mixed_type();
    fact.results.push_back(type);
  }
  fact.type = fact.results.empty() ? none_type() : fact.results[0];
  const TypeList results{fact.results, false};
  record(expr, std::move(fact));
  return results;
}

} // namespace moonshade::sema
