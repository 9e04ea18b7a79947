// Expressions but for operators and calls: literals, names, fields and components.
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

Type Walker::record(const Expr& expr, ExpressionFact fact) {
  const Type type = fact.type;
  if (!context_.report || work_.spec == nullptr) return type;
  if (++context_.facts > kMaxFacts) {
    context_.too_large(expr.span, "the specialisations of this shader have too many expressions", kMaxFacts);
    return type;
  }
  if (is_unknown(type) && context_.collect && context_.untyped == nullptr) context_.untyped = &expr;
  work_.spec->expressions.insert_or_assign(expr.id, std::move(fact));
  return type;
}

Type Walker::record(const Expr& expr, const Type& type) {
  if (context_.report) {
    ExpressionFact fact;
    fact.type = type;
    record(expr, std::move(fact));
  }
  return type;
}

Type Walker::expression(const Expr& expr) {
  const TypeList list = values(expr);
  const Type type = list.at(0);
  if (type.kind != Type::Kind::None) return type;
  error(Code::NoValue, expr.span);
  return unknown_type();
}

TypeList Walker::values(const Expr& expr) {
  if (++context_.visits > kMaxVisits) context_.too_large(expr.span, "type inference takes too many steps", kMaxVisits);
  if (++context_.walk_depth > kMaxWalkDepth)
    context_.too_large(expr.span, "calls and expressions inside each other are too many", kMaxWalkDepth);
  TypeList list{{}, true};
  const auto one = [](const Type& type) { return TypeList{{type}, false}; };
  if (!context_.exhausted) {
    switch (expr.kind) {
    case ExprKind::Nil:
      error(Code::NilValue, expr.span, {"declare a variable without a value and assign it on every path"});
      break;
    case ExprKind::Boolean:
      list = one(record(expr, boolean_type()));
      break;
    case ExprKind::Integer:
      list = one(record(expr, integer_type()));
      break;
    case ExprKind::Number:
      list = one(record(expr, number_type()));
      break;
    case ExprKind::String:
      list = one(record(expr, string_type(static_cast<const StringExpr&>(expr).value)));
      break;
    case ExprKind::Vararg:
      error(Code::Varargs, expr.span);
      break;
    case ExprKind::Function:
      list = one(function_expression(static_cast<const Function&>(expr)));
      break;
    case ExprKind::Name:
      list = one(name(static_cast<const NameExpr&>(expr)));
      break;
    case ExprKind::Index:
      list = one(index(static_cast<const IndexExpr&>(expr)));
      break;
    case ExprKind::Call:
      list = call(static_cast<const CallExpr&>(expr));
      break;
    case ExprKind::MethodCall:
      list = method_call(static_cast<const MethodCallExpr&>(expr));
      break;
    case ExprKind::Paren:
      list = one(record(expr, expression(*static_cast<const ParenExpr&>(expr).inner)));
      break;
    case ExprKind::Unary:
      list = one(unary(static_cast<const UnaryExpr&>(expr)));
      break;
    case ExprKind::Binary:
      list = one(binary(static_cast<const BinaryExpr&>(expr)));
      break;
    case ExprKind::Table:
      list = one(table(static_cast<const TableExpr&>(expr)));
      break;
    case ExprKind::Error:
      break;
    }
  }
  --context_.walk_depth;
  return list;
}

TypeList Walker::expression_list(std::span<Expr* const> exprs) {
  TypeList list;
  for (size_t i = 0; i < exprs.size(); ++i) {
    if (i + 1 < exprs.size()) {
      list.types.push_back(expression(*exprs[i]));
      continue;
    }
    const TypeList last = values(*exprs[i]);
    list.types.insert(list.types.end(), last.types.begin(), last.types.end());
    list.open = last.open;
  }
  return list;
}

// ---- names ---------------------------------------------------------------------------------------------------------

Variable& Walker::variable_of(const Local& local) {
  Variable* variable = context_.find_variable(work_, local);
  return variable != nullptr ? *variable : work_.variables[&local];
}

void Walker::set_place(ExpressionFact& fact, Variable& variable, std::string_view name) {
  if (!context_.report || !has_storage(fact.type)) return;
  const Place place = context_.place_for(work_, variable, name);
  fact.name = place.slot != nullptr ? NameKind::Local : NameKind::Global;
  fact.slot = place.slot;
  fact.index = place.global;
}

Type Walker::name(const NameExpr& expr) {
  if (expr.local != nullptr) return local_name(expr);
  if (expr.environment != nullptr || expr.name == "_ENV") {
    error(Code::EnvironmentTable, expr.span, {"_ENV"});
    return unknown_type();
  }
  return global_name(expr);
}

Type Walker::local_name(const NameExpr& expr) {
  Variable& variable = variable_of(*expr.local);
  ExpressionFact fact;
  fact.type = variable.type;
  if (fact.type.kind == Type::Kind::Function) fact.name = NameKind::Function;
  if (fact.type.kind == Type::Kind::Library) fact.name = NameKind::Library;
  set_place(fact, variable, expr.name);
  return record(expr, std::move(fact));
}

Type Walker::global_name(const NameExpr& expr) {
  bool is_open = false;
  Global* const global = context_.find_global(work_, expr, &is_open);
  if (is_open) {
    error(Code::NameOfOtherFile, expr.span, {std::string(expr.name)})
        .note(Code::NoteFirstDefinition, global->definition, {std::string(expr.name)});
    return unknown_type();
  }
  if (global != nullptr) return global_of_shader(expr, *global);
  ExpressionFact fact;
  if (expr.name == "math" || is_library_function(expr.name)) {
    fact.name = NameKind::Library;
    fact.type = library_type(expr.name);
    return record(expr, std::move(fact));
  }
  if (!context_.globals.assigned_inside.contains(expr.name)) refuse_name(expr.span, expr.name);
  return unknown_type();
}

Type Walker::global_of_shader(const NameExpr& expr, Global& global) {
  if (global.is_broken) return unknown_type();
  ExpressionFact fact;
  if (global.function != nullptr) {
    fact.name = NameKind::Function;
    fact.type = function_type(global.function, context_.top_level_of(*global.function));
    return record(expr, std::move(fact));
  }
  fact.type = global.variable.type;
  global.variable.owner = context_.top;
  if (fact.type.kind == Type::Kind::Function) fact.name = NameKind::Function;
  if (fact.type.kind == Type::Kind::Library) fact.name = NameKind::Library;
  set_place(fact, global.variable, expr.name);
  return record(expr, std::move(fact));
}

void Walker::refuse_name(Span span, std::string_view name) {
  if (!context_.report || context_.is_reported(span)) return;
  const std::string text(name);
  const RefusedName* refused = find_refused_name(name);
  if (refused == nullptr) {
    const auto near = nearest_visible(name);
    suggest_fix(error(Code::UnknownName, span, {text, suggestion(near)}), near);
  } else if (refused->code == Code::NotAvailableYet) {
    error(Code::NotAvailableYet, span,
          {refused->advice.empty() ? "the library's '" + text + "' is" : std::string(refused->advice)});
  } else if (refused->code == Code::StringBuilding) {
    error(Code::StringBuilding, span, {std::string(refused->advice)});
  } else {
    error(refused->code, span, {text, std::string(refused->advice)});
  }
}

std::optional<std::string_view> Walker::nearest_visible(std::string_view name) const {
  if (context_.diagnostics.error_count() >= Diagnostics::kMaxErrors) return std::nullopt;
  std::vector<std::string_view> candidates;
  for (const Work* at = &work_; at != nullptr; at = at->parent)
    for (const auto& [local, variable] : at->variables)
      candidates.push_back(local->name);
  for (const auto& [global_name, global] : context_.globals.by_name)
    candidates.push_back(global_name);
  const std::vector<std::string_view> library = library_names("");
  candidates.insert(candidates.end(), library.begin(), library.end());
  return nearest(name, candidates);
}

// ---- fields and components -----------------------------------------------------------------------------------------

Type Walker::index(const IndexExpr& expr) {
  const Type object = expression(*expr.object);
  if (object.kind == Type::Kind::Library && object.text == "math") return library_field(expr, object.text);
  if (is_vector(object)) return vector_component(expr, object);
  if (is_matrix(object)) return matrix_column(expr, object);
  if (is_table(object)) return table_index(expr, object);
  if (!expr.is_dotted) expression(*expr.key);
  if (is_unknown(object)) return unknown_type();
  if (object.kind == Type::Kind::String) {
    error(Code::StringBuilding, expr.span, {"the library 'string'"});
  } else {
    type_error(Code::NoFields, expr.object->span, {describe(object)});
  }
  return unknown_type();
}

Type Walker::library_field(const IndexExpr& expr, std::string_view table) {
  const auto* key = try_as<StringExpr>(expr.key);
  if (key == nullptr) {
    expression(*expr.key);
    error(Code::UnknownField, expr.key->span, {"the library's table '" + std::string(table) + "'", "[...]", ""});
    return unknown_type();
  }
  const std::string full = std::string(table) + "." + std::string(key->value);
  ExpressionFact fact;
  if (const LibraryConstant* constant = find_library_constant(full)) {
    fact.name = NameKind::Constant;
    fact.type = constant->is_integer ? integer_type() : number_type();
    fact.constant = constant->number;
    fact.integer_constant = constant->integer;
    return record(expr, std::move(fact));
  }
  if (is_library_function(full)) {
    fact.name = NameKind::Library;
    fact.type = library_type(permanent_library_name(full));
    return record(expr, std::move(fact));
  }
  if (!context_.report) return unknown_type();
  if (find_refused_name(full) != nullptr) {
    refuse_name(expr.span, full);
  } else {
    const auto near = expr.is_dotted ? nearest(key->value, library_names("math.")) : std::nullopt;
    suggest_fix(
        error(Code::UnknownField, key->span, {"the library's table 'math'", std::string(key->value), suggestion(near)}),
        near);
  }
  return unknown_type();
}

namespace {

/// Index of a component's letter in one of the two sets, or -1.
int component_letter(char letter, std::string_view set) {
  const size_t at = set.find(letter);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// The components that a swizzle names; empty where it is none.
std::vector<uint8_t> swizzle(std::string_view text, unsigned size) {
  std::vector<uint8_t> components;
  if (text.empty() || text.size() > 4) return {};
  for (const std::string_view set : {"xyzw", "rgba"}) {
    components.clear();
    for (const char letter : text) {
      const int at = component_letter(letter, set);
      if (at >= 0 && at < static_cast<int>(size)) components.push_back(static_cast<uint8_t>(at));
    }
    if (components.size() == text.size()) return components;
  }
  return {};
}

} // namespace

Type Walker::vector_component(const IndexExpr& expr, const Type& object) {
  const unsigned size = component_count(object.value);
  ExpressionFact fact;
  if (const auto* key = try_as<StringExpr>(expr.key)) {
    fact.components = swizzle(key->value, size);
    if (fact.components.empty()) {
      type_error(Code::UnknownField, key->span,
                 {describe(object), std::string(key->value),
                  "; its components are " + std::string("xyzw").substr(0, size) + " or " +
                      std::string("rgba").substr(0, size)});
      return unknown_type();
    }
  } else if (const auto* number = try_as<IntegerExpr>(&strip_parentheses(*expr.key))) {
    if (number->value < 1 || number->value > static_cast<int64_t>(size)) {
      type_error(Code::ComponentOutside, expr.key->span, {type_name(object), std::to_string(size)});
      return unknown_type();
    }
    fact.components = {static_cast<uint8_t>(number->value - 1)};
  } else {
    const Type key_type = expression(*expr.key);
    if (!is_unknown(key_type) && !is_scalar(key_type))
      type_error(Code::OperandType, expr.key->span, {"[]", describe(key_type)});
    fact.type = number_type();
    fact.is_dynamic = true;
    return record(expr, std::move(fact));
  }
  const size_t count = fact.components.size();
  fact.type = count == 1 ? number_type() : Type::of(vector_type(static_cast<unsigned>(count)));
  return record(expr, std::move(fact));
}

Type Walker::function_expression(const Function& function) {
  if (function.is_vararg) error(Code::Varargs, function.vararg_span);
  return record(function, function_type(&function, &work_));
}

} // namespace moonshade::sema
