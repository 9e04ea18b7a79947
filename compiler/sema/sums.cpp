// Sums of a noise that is given as a function: fbm(f, p, octaves, ...), turbulence, ridged, hybrid, warp. They are Lua
// (stdlib/sums.lua), specialised for the function and the type of the point as a function of the shader would be; what
// is not given has the defaults of the sum without a function, which is a row of the table.
#include "stdlib/sums.h"
#include "compiler/sema/library_calls.h"
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

TypeList unknown_values() { return {{}, true}; }

bool is_row(const Type& type) {
  return type.kind == Type::Kind::Library && !is_built_in(type.text) && !library_overloads(type.text).empty();
}

} // namespace

bool is_sum(std::string_view name, const TypeList& args) {
  if (find_noise_sum(name) == nullptr || args.types.empty()) return false;
  return args.types[0].kind == Type::Kind::Function || args.types[0].kind == Type::Kind::Library;
}

bool Walker::takes_sum_arguments(const CallExpr& expr, std::string_view name, const TypeList& args, size_t most) {
  const std::string text(name);
  const auto place = [&](size_t i) { return expr.args[std::min(i, expr.args.size() - 1)]->span; };
  if (args.types.size() < 2) {
    type_error(Code::MissingArgument, expr.span, {"2", text, "p"});
    return false;
  }
  if (args.types.size() > most) {
    error(Code::TooManyArguments, place(most), {text, std::to_string(most)});
    return false;
  }
  if (std::ranges::any_of(args.types, is_unknown)) return false;
  for (size_t i = 1; i < args.types.size(); ++i) {
    if (is_scalar(args.types[i]) || (i == 1 && is_vector(args.types[i]))) continue;
    type_error(Code::ArgumentType, place(i),
               {std::to_string(i + 1), text, describe(args.types[i]), i == 1 ? "a number or a vector" : "a number"});
    return false;
  }
  return true;
}

/// A function of the point that gives a number first (worley's F1 of three numbers).
bool Walker::is_summable(const CallExpr& expr, std::string_view name, const Type& function, const Type& point) {
  const auto refuse = [&](std::string what) {
    type_error(Code::SumFunction, expr.args[0]->span, {std::string(name), describe(point), std::move(what)});
    return false;
  };
  if (function.kind == Type::Kind::Library) {
    const std::string quoted = "('" + std::string(function.text) + "') ";
    if (!is_row(function)) return refuse(quoted + "is none");
    const LibraryChoice choice = choose_row(library_overloads(function.text), {point});
    if (choice.row == nullptr) return refuse(quoted + "does not take one");
    const bool is_number =
        !choice.by_component && choice.row->result_count != 0 &&
        (choice.row->results[0] == ValueType::Number || choice.row->results[0] == ValueType::Integer);
    return is_number ||
           refuse(quoted + "gives " + describe(Type::of(choice.by_component.value_or(choice.row->results[0]))));
  }
  if (function.function->params.size() > 1)
    return refuse("takes " + std::to_string(function.function->params.size()) + " arguments");
  const TypeList results = call_function(expr, function, {{point}, false});
  if (results.open) return false;
  if (results.types.empty()) return refuse("gives no value");
  return is_unknown(results.types[0]) || is_scalar(results.types[0]) || refuse("gives " + describe(results.types[0]));
}

TypeList Walker::sum_call(const CallExpr& expr, std::string_view name, const TypeList& args) {
  const LibraryFunction& row = library_overloads(name).front();
  // f, what the row takes, and the mean.
  const size_t most = row.parameter_count + 2u;
  const TypeList number{{number_type()}, false};
  if (!takes_sum_arguments(expr, name, args, most)) return unknown_values();
  const Type point = is_vector(args.types[1]) ? args.types[1] : number_type();
  if (!is_summable(expr, name, args.types[0], point)) return number;
  const unsigned dimensions = component_count(point.value);
  const Function* function = context_.library_function(lua_name(*find_noise_sum(name), dimensions));
  if (function == nullptr) {
    error(Code::NotAvailableYet, expr.span, {"for this host, the sum of a function is"});
    return number;
  }
  TypeList passed{{args.types[0], point}, false};
  passed.types.resize(most, number_type());
  call_function(expr, function_type(function, context_.library_chunk->work), std::move(passed));
  if (!context_.report || work_.spec == nullptr) return number;
  const auto fact = work_.spec->expressions.find(expr.id);
  if (fact == work_.spec->expressions.end()) return number;
  for (size_t i = args.types.size(); i < most; ++i) {
    const std::string_view noise = is_row(args.types[0]) ? args.types[0].text : std::string_view{};
    fact->second.trailing.push_back(i + 1 < most ? row.defaults[i - 1]
                                                 : default_mean(*find_noise_sum(name), noise, dimensions));
  }
  return number;
}

} // namespace moonshade::sema
