// Arithmetic here is Lua's, in double. Integer `//` and `%` are left out: nobody writes them into a default.
#include "compiler/sema/constants.h"

#include "compiler/sema/names.h"

#include <cmath>

namespace moonshade::sema {

using namespace syntax;

std::optional<double> number_of(const Constant& constant) {
  if (const auto* integer = std::get_if<int64_t>(&constant)) return static_cast<double>(*integer);
  if (const auto* number = std::get_if<double>(&constant)) return *number;
  return std::nullopt;
}

namespace {

std::optional<Constant> negate(const std::optional<Constant>& operand) {
  if (!operand) return std::nullopt;
  if (const auto* integer = std::get_if<int64_t>(&*operand))
    return static_cast<int64_t>(0 - static_cast<uint64_t>(*integer));
  if (const auto* number = std::get_if<double>(&*operand)) return -*number;
  if (const auto* vector = std::get_if<std::vector<double>>(&*operand)) {
    std::vector<double> result;
    for (const double component : *vector)
      result.push_back(-component);
    return result;
  }
  return std::nullopt;
}

std::optional<Constant> arithmetic(BinaryOp op, const Constant& left, const Constant& right) {
  const auto* left_integer = std::get_if<int64_t>(&left);
  const auto* right_integer = std::get_if<int64_t>(&right);
  if (left_integer != nullptr && right_integer != nullptr) {
    const auto a = static_cast<uint64_t>(*left_integer);
    const auto b = static_cast<uint64_t>(*right_integer);
    switch (op) {
    case BinaryOp::Add:
      return static_cast<int64_t>(a + b);
    case BinaryOp::Sub:
      return static_cast<int64_t>(a - b);
    case BinaryOp::Mul:
      return static_cast<int64_t>(a * b);
    default:
      break;
    }
  }
  const auto a = number_of(left);
  const auto b = number_of(right);
  if (!a || !b) return std::nullopt;
  switch (op) {
  case BinaryOp::Add:
    return *a + *b;
  case BinaryOp::Sub:
    return *a - *b;
  case BinaryOp::Mul:
    return *a * *b;
  case BinaryOp::Div:
    return *a / *b;
  case BinaryOp::Pow:
    return *b == 2 ? *a * *a : std::pow(*a, *b);
  default:
    return std::nullopt;
  }
}

std::optional<Constant> construct(const CallExpr& call, const LibraryNameOf& library_name) {
  const std::string_view name = library_name(*call.callee);
  const size_t size = name == "vec2" ? 2 : name == "vec3" || name == "rgb" ? 3 : name == "vec4" ? 4 : 0;
  if (size == 0) return std::nullopt;
  std::vector<double> components;
  for (const Expr* arg : call.args) {
    const auto value = evaluate_constant(*arg, library_name);
    if (!value) return std::nullopt;
    if (const auto number = number_of(*value)) {
      components.push_back(*number);
    } else if (const auto* vector = std::get_if<std::vector<double>>(&*value)) {
      components.insert(components.end(), vector->begin(), vector->end());
    } else {
      return std::nullopt;
    }
  }
  if (components.size() == 1 && call.args.size() == 1) components.resize(size, components[0]);
  if (components.size() != size) return std::nullopt;
  return components;
}

} // namespace

std::optional<Constant> evaluate_constant(const Expr& expr, const LibraryNameOf& library_name) {
  return visit(expr, Overloaded{
                         [](const BooleanExpr& node) -> std::optional<Constant> { return node.value; },
                         [](const IntegerExpr& node) -> std::optional<Constant> { return node.value; },
                         [](const NumberExpr& node) -> std::optional<Constant> { return node.value; },
                         [](const StringExpr& node) -> std::optional<Constant> { return std::string(node.value); },
                         [&](const ParenExpr& node) { return evaluate_constant(*node.inner, library_name); },
                         [&](const UnaryExpr& node) -> std::optional<Constant> {
                           if (node.op != UnaryOp::Neg) return std::nullopt;
                           return negate(evaluate_constant(*node.operand, library_name));
                         },
                         [&](const BinaryExpr& node) -> std::optional<Constant> {
                           const auto left = evaluate_constant(*node.left, library_name);
                           const auto right = evaluate_constant(*node.right, library_name);
                           if (!left || !right) return std::nullopt;
                           return arithmetic(node.op, *left, *right);
                         },
                         [&](const IndexExpr& node) -> std::optional<Constant> {
                           const LibraryConstant* constant = find_library_constant(library_name(node));
                           if (constant == nullptr) return std::nullopt;
                           if (constant->is_integer) return constant->integer;
                           return constant->number;
                         },
                         [&](const CallExpr& node) { return construct(node, library_name); },
                         [](const auto&) -> std::optional<Constant> { return std::nullopt; },
                     });
}

} // namespace moonshade::sema
