// Calls: of the shader's functions, which are specialised for the types of their arguments, and of what the compiler
// itself knows of the library. The library's table is library_calls.cpp's matter.
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

TypeList one(const Type& type) { return {{type}, false}; }
TypeList unknown_values() { return {{}, true}; }

bool is_call(const Expr& expr) { return expr.kind == ExprKind::Call || expr.kind == ExprKind::MethodCall; }

/// What messages call a function.
std::string spoken_name(const Function& function) {
  return function.name.empty() ? "function" : std::string(function.name);
}

} // namespace

TypeList Walker::arguments(std::span<Expr* const> args) {
  TypeList list = expression_list(args);
  for (Type& type : list.types)
    if (type.kind == Type::Kind::None) type = unknown_type();
  return list;
}

TypeList Walker::call(const CallExpr& expr) {
  const Type callee = expression(*expr.callee);
  switch (callee.kind) {
  case Type::Kind::Function:
    return call_function(expr, callee, arguments(expr.args));
  case Type::Kind::Library:
    if (callee.text != "math") return call_library(expr, callee.text);
    break;
  case Type::Kind::Unknown:
    expression_list(expr.args);
    return unknown_values();
  default:
    break;
  }
  expression_list(expr.args);
  type_error(Code::NotCallable, expr.callee->span, {describe(callee)});
  return unknown_values();
}

/// A call of a function from within itself. With functions or tables among the arguments it may be another function in
/// all but name (`twice(function(x) return twice(f, x) end, x)`), so then only a few such calls make a recursion.
bool Walker::is_recursive(const CallExpr& expr, const WorkKey& key) {
  constexpr size_t kMostInside = 32;
  std::vector<const Work*> chain;
  size_t inside = 0;
  const Work* at = &work_;
  for (; at != nullptr; at = at->caller) {
    if (at->function == key.function) {
      const auto is_reference = [](const Type& type) { return is_function(type) || is_table(type); };
      const bool is_other = at->parent != key.parent ||
                            (at->arguments != key.arguments && std::ranges::any_of(key.arguments, is_reference));
      if (!is_other || ++inside == kMostInside) break;
    }
    chain.push_back(at);
  }
  if (at == nullptr) return false;
  const Function& function = *key.function;
  if (!context_.report || !context_.recursions.insert({work_.function, &function}).second) return true;
  std::string text = spoken_name(function);
  for (auto link = chain.rbegin(); link != chain.rend(); ++link)
    text += " calls " + spoken_name(*(*link)->function);
  Diagnostic& diagnostic = error(Code::Recursion, expr.span, {text + " calls " + spoken_name(function)});
  for (auto link = chain.rbegin(); link != chain.rend(); ++link)
    diagnostic.note(Code::NoteCalledFrom, (*link)->call_span, {spoken_name(*(*link)->function)});
  return true;
}

TypeList Walker::call_function(const CallExpr& expr, const Type& called, TypeList args) {
  const Function& function = *called.function;
  const size_t count = function.params.size();
  const bool is_complete = args.open || args.types.size() >= count;
  const size_t given = args.types.size();
  args.types.resize(count);
  WorkKey key{&function, called.frame, work_.is_init, nullptr, 0, args.types};
  key.moment = context_.moment_of(work_, expr.span);
  if (context_.makers.contains(&function)) {
    key.site = &work_;
    key.call = expr.id;
  }
  if (is_recursive(expr, key)) return unknown_values();
  if (function.is_vararg) return unknown_values(); // refused where it is defined
  if (!is_complete) {
    type_error(Code::MissingArgument, expr.span,
               {std::to_string(given + 1), spoken_name(function), std::string(function.params[given]->name)});
    return unknown_values();
  }
  if (!context_.specialise_unknown && std::ranges::any_of(args.types, is_unknown)) return unknown_values();

  Work* callee = context_.find_or_make(std::move(key), expr.span);
  if (callee == nullptr) return unknown_values();
  if (callee->round != context_.round) {
    callee->caller = &work_;
    callee->call_span = expr.span;
    context_.analyse(*callee);
  }
  callees_[expr.id] = callee;
  TypeList results;
  if (callee->has_results && !callee->has_unequal_returns) {
    results.types = callee->results;
  } else if (callee->has_open_return || callee->has_unequal_returns) {
    results.open = true;
  }
  if (context_.report && callee->spec != nullptr) {
    work_.callees[expr.id] = {callee, expr.span};
    ExpressionFact fact;
    fact.type = results.at(0);
    fact.results = results.types;
    fact.call = CallKind::Specialisation;
    fact.callee = callee->spec;
    record(expr, std::move(fact));
  }
  return results;
}

TypeList Walker::call_library(const CallExpr& expr, std::string_view name) {
  if (name == "param") return parameter(expr);
  if (name == "require") return require_module(expr);
  if (name == "assert") return assertion(expr);
  if (name == "error") return error_call(expr);
  if (name == "vec2" || name == "vec3" || name == "vec4" || name == "rgb") return construct(expr, name);
  if (name == "mat3" || name == "mat4") return construct_matrix(expr, name);
  if (name == "math.floor" || name == "math.ceil" || name == "math.tointeger") return to_integer(expr, name);
  if (name == "math.max" || name == "math.min") return extremum(expr, name);
  if (name == "math.type") return math_type(expr);
  if (name == "math.modf") return modf(expr);
  if (is_derivative(name)) return derivative_call(expr, name);
  if (name == "print") return print(expr);
  if (name == "texture") return texture_call(expr);
  const TypeList types = arguments(expr.args);
  if (types.open) return unknown_values();
  if (is_sum(name, types)) return sum_call(expr, name, types);
  if (is_table_function(name, types)) return table_function(expr, name, types);
  return call_table_row(expr, name, {expr.args.begin(), expr.args.end()}, types.types);
}

TypeList Walker::method_call(const MethodCallExpr& expr) {
  const Type object = expression(*expr.object);
  TypeList types = arguments(expr.args);
  if (is_unknown(object)) return unknown_values();
  if (object.kind == Type::Kind::String) {
    error(Code::StringBuilding, expr.span, {"the library 'string'"});
    return unknown_values();
  }
  if (is_table(object)) {
    const auto* name = try_as<NameExpr>(&strip_parentheses(*expr.object));
    error(Code::OwnMethod, expr.method.span,
          {name != nullptr ? std::string(name->name) : "r", std::string(expr.method.text)});
    return unknown_values();
  }
  if (!is_vector(object) && !is_matrix(object)) {
    type_error(Code::OperandType, expr.object->span, {":" + std::string(expr.method.text), describe(object)});
    return unknown_values();
  }
  std::vector<std::string_view> methods;
  bool is_method = false;
  for (const LibraryFunction& row : library()) {
    if (row.parameter_count == 0 || row.name.find('.') != std::string_view::npos) continue;
    const bool is_matrix_method = is_matrix(object) && is_matrix(row.parameters[0]);
    if (!is_matrix_method && (is_matrix(object) || (!is_vector(row.parameters[0]) && !row.componentwise))) continue;
    methods.push_back(row.name);
    is_method = is_method || row.name == expr.method.text;
  }
  if (!is_method) {
    if (context_.report) {
      const RefusedName* refused = find_refused_name(expr.method.text);
      if (refused != nullptr && refused->code == Code::NotAvailableYet) {
        refuse_name(expr.method.span, expr.method.text);
      } else {
        const auto near = nearest(expr.method.text, methods);
        suggest_fix(type_error(Code::UnknownMethod, expr.method.span,
                               {std::string(expr.method.text), type_name(object), suggestion(near)}),
                    near);
      }
    }
    return unknown_values();
  }
  if (types.open) return unknown_values();
  types.types.insert(types.types.begin(), object);
  std::vector<const Expr*> args = {expr.object};
  args.insert(args.end(), expr.args.begin(), expr.args.end());
  return call_table_row(expr, expr.method.text, args, types.types);
}

// ---- what the compiler itself knows --------------------------------------------------------------------------------

TypeList Walker::construct(const CallExpr& expr, std::string_view name) {
  const unsigned size = name == "vec2" ? 2 : name == "vec4" ? 4 : 3;
  const Type result = Type::of(vector_type(size));
  const TypeList args = arguments(expr.args);
  unsigned components = 0;
  bool is_known = !args.open;
  for (size_t i = 0; i < args.types.size(); ++i) {
    const Type& type = args.types[i];
    if (is_scalar(type) || is_vector(type)) {
      components += component_count(type.value);
    } else {
      if (!is_unknown(type))
        type_error(Code::ArgumentType, expr.args[std::min(i, expr.args.size() - 1)]->span,
                   {std::to_string(i + 1), std::string(name), describe(type), "a number or a vector"});
      is_known = false;
    }
  }
  if (!is_known) return one(result);
  const bool is_broadcast = args.types.size() == 1 && is_scalar(args.types[0]);
  if (components != size && !is_broadcast) {
    type_error(Code::ConstructorComponents, expr.span,
               {std::string(name), std::to_string(size), std::to_string(components)});
    return one(result);
  }
  ExpressionFact fact;
  fact.type = result;
  fact.results = {result};
  fact.call = CallKind::Construct;
  return one(record(expr, std::move(fact)));
}

TypeList Walker::to_integer(const CallExpr& expr, std::string_view name) {
  const TypeList args = arguments(expr.args);
  if (args.open || (args.types.size() == 1 && is_unknown(args.types[0]))) return one(integer_type());
  if (args.types.empty()) {
    type_error(Code::MissingArgument, expr.span, {"1", std::string(name), "x"});
    return one(integer_type());
  }
  if (args.types.size() > 1) {
    error(Code::TooManyArguments, expr.args[std::min<size_t>(1, expr.args.size() - 1)]->span, {std::string(name), "1"});
    return one(integer_type());
  }
  const Type& type = args.types[0];
  if (!is_scalar(type)) {
    type_error(Code::ArgumentType, expr.args[0]->span, {"1", std::string(name), describe(type), "a number"});
    return one(integer_type());
  }
  ExpressionFact fact;
  fact.type = integer_type();
  fact.results = {fact.type};
  fact.call = type.is(ValueType::Integer) ? CallKind::Convert : CallKind::ToInteger;
  if (fact.call == CallKind::ToInteger) {
    const auto rows = library_overloads(name);
    for (const LibraryFunction& row : rows)
      if (row.parameter_count == 1 && row.parameters[0] == ValueType::Number) fact.library = &row;
    if (fact.library == nullptr)
      error(Code::NotAvailableYet, expr.span, {"'" + std::string(name) + "' of a number is"});
  }
  return one(record(expr, std::move(fact)));
}

/// Of an integer too, and of what may be one: Lua gives the same values for 3 and 3.0.
TypeList Walker::modf(const CallExpr& expr) {
  const std::string name = "math.modf";
  const TypeList args = arguments(expr.args);
  ExpressionFact fact;
  fact.type = integer_type();
  fact.results = {integer_type(), number_type()};
  fact.call = CallKind::Modf;
  const TypeList results{fact.results, false};
  if (args.open) return results;
  if (args.types.empty()) {
    type_error(Code::MissingArgument, expr.span, {"1", name, "x"});
  } else if (args.types.size() > 1) {
    error(Code::TooManyArguments, expr.args[std::min<size_t>(1, expr.args.size() - 1)]->span, {name, "1"});
  } else if (!is_unknown(args.types[0]) && !is_scalar(args.types[0])) {
    type_error(Code::ArgumentType, expr.args[0]->span, {"1", name, describe(args.types[0]), "a number"});
  } else {
    record(expr, std::move(fact));
  }
  return results;
}

TypeList Walker::math_type(const CallExpr& expr) {
  const TypeList args = arguments(expr.args);
  if (args.open || args.types.size() != 1 || is_unknown(args.types[0])) {
    if (!args.open && args.types.empty()) type_error(Code::MissingArgument, expr.span, {"1", "math.type", "x"});
    return one(unknown_type());
  }
  const Type& type = args.types[0];
  if (type.mixed) {
    refuse_mixed(*expr.args[0], "math.type");
    return one(unknown_type());
  }
  if (!is_scalar(type)) {
    type_error(Code::ArgumentType, expr.args[0]->span, {"1", "math.type", describe(type), "a number"});
    return one(unknown_type());
  }
  const Type result = string_type(type.is(ValueType::Integer) ? "integer" : "float");
  ExpressionFact fact;
  fact.type = result;
  fact.results = {result};
  fact.call = CallKind::Convert; // evaluates its argument; nobody looks at the value
  return one(record(expr, std::move(fact)));
}

TypeList Walker::print(const CallExpr& expr) {
  const TypeList args = expression_list(expr.args);
  for (size_t i = 0; i < args.types.size(); ++i) {
    const Type& type = args.types[i];
    const Expr& arg = *expr.args[std::min(i, expr.args.size() - 1)];
    if (type.mixed && type.is_value()) {
      refuse_mixed(arg, "print");
    } else if (!is_unknown(type) && !type.is_value() && (type.kind != Type::Kind::String || type.is_parameter)) {
      type_error(Code::ArgumentType, arg.span,
                 {std::to_string(i + 1), "print", type.is_parameter ? "a string that is a parameter" : describe(type),
                  "a boolean, integer, number, vector, matrix or constant string"});
    }
  }
  ExpressionFact fact;
  fact.type = none_type();
  fact.call = CallKind::Print;
  record(expr, std::move(fact));
  return {};
}

/// As Lua's, it passes on what it gets, all values of a call at the end of its arguments included. What is no boolean
/// always holds: that is no condition but in a call's value, which it lets pass.
TypeList Walker::assertion(const CallExpr& expr) {
  const TypeList list = expression_list(expr.args);
  const std::vector<Type>& types = list.types;
  if (types.empty()) {
    if (!list.open) error(Code::MissingArgument, expr.span, {"1", "assert", "condition"});
    return unknown_values();
  }
  const bool is_condition = types[0].is(ValueType::Boolean) || !is_call(strip_parentheses(*expr.args[0]));
  if (is_condition) require_condition(*expr.args[0], types[0]);
  if (is_condition && expr.args.size() > 1) require_message(*expr.args[1], list.at(1), "assert");
  if (list.open) return list;
  ExpressionFact fact;
  fact.type = types[0];
  fact.results = types;
  fact.call = CallKind::Assert;
  record(expr, std::move(fact));
  return list;
}

TypeList Walker::error_call(const CallExpr& expr) {
  for (const Expr* arg : expr.args) {
    const Type type = expression(*arg);
    if (arg == expr.args[0]) require_message(*arg, type, "error");
  }
  if (expr.args.size() > 1) error(Code::TooManyArguments, expr.args[1]->span, {"error", "1"});
  ExpressionFact fact;
  fact.type = none_type();
  fact.call = CallKind::Error;
  record(expr, std::move(fact));
  return {};
}

void Walker::require_message(const Expr& expr, const Type& type, std::string_view name) {
  if (!is_unknown(type) && (type.kind != Type::Kind::String || type.is_parameter))
    type_error(Code::MessageConstant, expr.span, {std::string(name)});
}

} // namespace moonshade::sema
