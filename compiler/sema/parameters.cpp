// param(name, default, meta): a parameter of the shader. The meta table is constant and read here, never evaluated.
#include "compiler/sema/constants.h"
#include "compiler/sema/names.h"
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

std::optional<ValueType> type_of(const Constant& constant) {
  if (std::holds_alternative<bool>(constant)) return ValueType::Boolean;
  if (std::holds_alternative<int64_t>(constant)) return ValueType::Integer;
  if (std::holds_alternative<double>(constant)) return ValueType::Number;
  if (const auto* vector = std::get_if<std::vector<double>>(&constant))
    return vector_type(static_cast<unsigned>(vector->size()));
  return std::nullopt;
}

/// Reads the meta table of one parameter into its description.
class MetadataReader {
public:
  MetadataReader(Context& context, ParameterInfo& info, const LibraryNameOf& library_name)
      : context_(context), info_(info), library_name_(library_name) {}

  void read(const Expr& expr) {
    const auto* table = try_as<TableExpr>(&expr);
    if (table == nullptr) {
      refuse(expr.span, "the metadata of a parameter is a table constructor, as in { min = 0, max = 1 }");
      return;
    }
    for (const TableField& field : table->fields)
      this->field(field);
  }

private:
  static constexpr std::string_view kFields[] = {"min", "max", "step", "doc", "label", "choices"};

  void refuse(Span span, std::string message) { context_.error(Code::ParameterMetadata, span, {std::move(message)}); }

  void field(const TableField& field) {
    const auto* key = field.kind == FieldKind::Named ? try_as<StringExpr>(field.key) : nullptr;
    if (key == nullptr) {
      refuse(field.span, "the metadata of a parameter has named fields: min, max, step, doc, label, choices");
      return;
    }
    if (std::ranges::find(kFields, key->value) == std::end(kFields)) {
      refuse(key->span, "the metadata of a parameter has no '" + std::string(key->value) + "'" +
                            suggestion(nearest(key->value, kFields)));
      return;
    }
    if (key->value == "doc" || key->value == "label") {
      text(*key, *field.value);
    } else if (key->value == "choices") {
      choices(*field.value);
    } else {
      number(*key, *field.value);
    }
  }

  void text(const StringExpr& key, const Expr& value) {
    const auto constant = evaluate_constant(value, library_name_);
    const auto* string = constant ? std::get_if<std::string>(&*constant) : nullptr;
    if (string == nullptr) {
      refuse(value.span, "'" + std::string(key.value) + "' is a constant string");
    } else {
      (key.value == "doc" ? info_.doc : info_.label) = *string;
    }
  }

  void number(const StringExpr& key, const Expr& value) {
    const auto constant = evaluate_constant(value, library_name_);
    const auto number = constant ? number_of(*constant) : std::nullopt;
    if (!number) {
      refuse(value.span, "'" + std::string(key.value) + "' is a constant number");
    } else if (!info_.type || *info_.type == ValueType::Boolean) {
      refuse(key.span, "'" + std::string(key.value) + "' fits only a parameter of numbers");
    } else {
      (key.value == "min" ? info_.min : key.value == "max" ? info_.max : info_.step) = number;
    }
  }

  void choices(const Expr& value) {
    const auto* table = try_as<TableExpr>(&value);
    if (table == nullptr) {
      refuse(value.span, "'choices' is a table constructor of constants");
      return;
    }
    for (const TableField& choice : table->fields) {
      const auto constant =
          choice.kind == FieldKind::Positional ? evaluate_constant(*choice.value, library_name_) : std::nullopt;
      if (!constant) {
        refuse(choice.span, "'choices' is a table constructor of constants");
        continue;
      }
      ParameterInfo plain = info_;
      plain.min = plain.max = std::nullopt;
      plain.choices.clear();
      const CheckedConstant checked = check_override(plain, *constant);
      if (!checked.error.empty()) {
        refuse(choice.span, "a choice of another type than the parameter's default");
      } else {
        info_.choices.push_back(checked.value);
      }
    }
  }

  Context& context_;
  ParameterInfo& info_;
  const LibraryNameOf& library_name_;
};

} // namespace

/// Names in constants mean the library's things unless the shader defines them.
std::string_view Walker::constant_name(const Expr& expr) {
  const auto is_library = [&](const NameExpr* name) {
    return name != nullptr && name->is_global() && context_.find_global(work_, *name) == nullptr;
  };
  if (const auto* name = try_as<NameExpr>(&expr))
    return is_library(name) && is_built_in(name->name) ? name->name : std::string_view{};
  const auto* index = try_as<IndexExpr>(&expr);
  if (index == nullptr) return {};
  const auto* table = try_as<NameExpr>(index->object);
  const auto* key = try_as<StringExpr>(index->key);
  if (!is_library(table) || table->name != "math" || key == nullptr) return {};
  const LibraryConstant* constant = find_library_constant("math." + std::string(key->value));
  return constant != nullptr ? constant->name : std::string_view{};
}

TypeList Walker::parameter(const CallExpr& expr) {
  TypeList unknown{{}, true};
  if (!at_top_level() || loop_depth_ != 0) {
    error(Code::ParameterPlace, expr.span);
    return unknown;
  }
  if (expr.args.size() < 2) {
    error(Code::MissingArgument, expr.span,
          {std::to_string(expr.args.size() + 1), "param", expr.args.empty() ? "name" : "default"});
    return unknown;
  }
  const LibraryNameOf library_name = [&](const Expr& at) { return constant_name(at); };
  const auto name_value = evaluate_constant(*expr.args[0], library_name);
  const auto* name = name_value ? std::get_if<std::string>(&*name_value) : nullptr;
  if (name == nullptr) error(Code::ParameterName, expr.args[0]->span);
  const auto value = evaluate_constant(*expr.args[1], library_name);
  if (!value) error(Code::ParameterDefault, expr.args[1]->span);
  if (expr.args.size() > 3) error(Code::TooManyArguments, expr.args[3]->span, {"param", "3"});
  if (!value) return unknown;

  ParameterInfo info;
  if (name != nullptr) info.name = *name;
  info.span = expr.span;
  info.type = type_of(*value);
  info.default_value = *value;
  const auto* literal = try_as<StringExpr>(&strip_parentheses(*expr.args[0]));
  Type type = info.type ? Type::of(*info.type) : string_type(literal != nullptr ? literal->value : std::string_view{});
  type.is_parameter = !info.type;
  if (!context_.report || name == nullptr) return {{type}, false};

  if (expr.args.size() > 2) MetadataReader(context_, info, library_name).read(*expr.args[2]);
  const CheckedConstant checked = check_override(info, *value);
  if (!checked.error.empty()) error(Code::ParameterRange, expr.args[1]->span, {checked.error});
  ExpressionFact fact;
  fact.type = type;
  fact.results = {type};
  fact.call = CallKind::Parameter;
  fact.index = add_parameter(expr, std::move(info));
  record(expr, std::move(fact));
  return {{type}, false};
}

/// Its index in the program's list; a name that is taken is refused.
uint32_t Walker::add_parameter(const CallExpr& expr, ParameterInfo info) {
  std::vector<ParameterInfo>& parameters = context_.program.info.parameters;
  if (parameters.size() >= kMaxParameters)
    context_.too_large(expr.span, "the shader has too many parameters", kMaxParameters);
  for (const ParameterInfo& other : parameters)
    if (other.name == info.name)
      error(Code::ParameterTwice, expr.args[0]->span, {info.name})
          .note(Code::NoteFirstDefinition, other.span, {info.name});
  parameters.push_back(std::move(info));
  return static_cast<uint32_t>(parameters.size() - 1);
}

// ---- what depends on parameters ------------------------------------------------------------------------------------

bool Walker::depends_on_parameter(const Expr& expr) const {
  const auto any = [&](std::span<Expr* const> exprs) {
    return std::ranges::any_of(exprs, [&](const Expr* each) { return depends_on_parameter(*each); });
  };
  return visit(expr,
               Overloaded{
                   [&](const NameExpr& name) {
                     if (name.local != nullptr) return context_.from_parameters.contains(name.local);
                     if (name.name == "param") return true;
                     const Global* global = context_.find_global(work_, name);
                     return global != nullptr && context_.from_parameters.contains(global);
                   },
                   [&](const IndexExpr& index) { return depends_on_parameter(*index.object); },
                   [&](const CallExpr& call) { return depends_on_parameter(*call.callee) || any(call.args); },
                   [&](const MethodCallExpr& call) { return depends_on_parameter(*call.object) || any(call.args); },
                   [&](const ParenExpr& paren) { return depends_on_parameter(*paren.inner); },
                   [&](const UnaryExpr& unary) { return depends_on_parameter(*unary.operand); },
                   [&](const BinaryExpr& binary) {
                     return depends_on_parameter(*binary.left) || depends_on_parameter(*binary.right);
                   },
                   [](const auto&) { return false; },
               });
}

void Walker::trace_parameter(const void* variable, const Expr* given) {
  if (parameter_branches_ == 0 && (given == nullptr || !depends_on_parameter(*given))) return;
  if (context_.from_parameters.insert(variable).second) context_.changed = true;
}

void Walker::refuse_function(Span span, std::string_view name, const Expr* given) {
  if (!context_.report) return;
  const std::string text = name.empty() ? "this" : "'" + std::string(name) + "'";
  if (parameter_branches_ != 0 || (given != nullptr && depends_on_parameter(*given))) {
    error(Code::DependsOnParameter, span, {text});
  } else if (name.empty()) {
    error(Code::FunctionChoice, span);
  } else {
    error(Code::FunctionNotKnown, span, {std::string(name)});
  }
}

} // namespace moonshade::sema
