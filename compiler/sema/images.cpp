// texture(file, uv [, width] [, { raw = true }]): which image is known while compiling, as a file name or as a string
// parameter; the host opens it for each instance of the shader.
#include "stdlib/images.h"
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;
using Code = DiagnosticCode;

namespace {

/// The options, where the last argument is a table.
const TableExpr* options_of(const CallExpr& expr) {
  return expr.args.size() < 3 ? nullptr : try_as<TableExpr>(&strip_parentheses(*expr.args.back()));
}

} // namespace

std::span<Expr* const> texture_operands(const CallExpr& expr) {
  return {expr.args.data(), expr.args.size() - (options_of(expr) != nullptr ? 1 : 0)};
}

/// { raw = true }: constants, each by its name.
bool Walker::read_image_options(const TableExpr& options, bool& raw) {
  for (const TableField& field : options.fields) {
    const auto* name = field.kind == FieldKind::Named ? try_as<StringExpr>(field.key) : nullptr;
    if (name == nullptr || name->value != "raw") {
      error(Code::ImageOptions, field.span, {"there is 'raw' alone"});
      return false;
    }
    const auto* value = try_as<BooleanExpr>(&strip_parentheses(*field.value));
    if (value == nullptr) {
      error(Code::ImageOptions, field.value->span, {"'raw' is true or false"});
      return false;
    }
    raw = value->value;
  }
  return true;
}

bool Walker::takes_texture_arguments(const CallExpr& expr, const TypeList& args) {
  constexpr std::string_view kNames[] = {"file", "uv"};
  const auto place = [&](size_t i) { return expr.args[std::min(i, expr.args.size() - 1)]->span; };
  const auto refuse = [&](size_t i, std::string expected) {
    type_error(Code::ArgumentType, place(i),
               {std::to_string(i + 1), "texture", describe(args.types[i]), std::move(expected)});
    return false;
  };
  const size_t count = args.types.size();
  if (!args.open && count < 2) {
    type_error(Code::MissingArgument, expr.span, {std::to_string(count + 1), "texture", std::string(kNames[count])});
    return false;
  }
  if (count > 3) {
    if (count > 4)
      error(Code::TooManyArguments, place(4), {"texture", "4"});
    else
      error(Code::ImageOptions, place(3), {"write the table there"});
    return false;
  }
  if (args.open || std::ranges::any_of(args.types, is_unknown)) return false;
  if (args.types[0].kind != Type::Kind::String) return refuse(0, "the name of an image file, constant or a parameter");
  if (!args.types[1].is(ValueType::Vec2)) return refuse(1, "a vec2");
  if (count == 3 && is_table(args.types[2])) {
    error(Code::ImageOptions, place(2), {"write the table there"});
    return false;
  }
  return count < 3 || is_scalar(args.types[2]) || refuse(2, "a number");
}

/// The number of the image among the program's.
uint32_t Walker::add_image(const Expr& file, const Type& type, bool raw) {
  ImageInfo image{.file = std::string(type.text), .raw = raw, .span = file.span};
  if (type.is_parameter) {
    const auto& parameters = context_.program.info.parameters;
    const auto found = std::ranges::find(parameters, type.text, &ParameterInfo::name);
    if (found == parameters.end()) return 0;
    image.parameter = static_cast<size_t>(found - parameters.begin());
    image.file = std::get<std::string>(found->default_value);
  }
  std::vector<ImageInfo>& images = context_.program.info.images;
  for (uint32_t i = 0; i < images.size(); ++i)
    if (images[i].file == image.file && images[i].parameter == image.parameter && images[i].raw == raw &&
        images[i].span.file == file.span.file)
      return i;
  if (images.size() >= kMaxImages) {
    context_.too_large(file.span, "the shader looks up too many images", kMaxImages);
    return 0;
  }
  images.push_back(std::move(image));
  return static_cast<uint32_t>(images.size() - 1);
}

TypeList Walker::texture_call(const CallExpr& expr) {
  const Type vec4 = Type::of(ValueType::Vec4);
  const TypeList result{{vec4}, false};
  const TypeList args = expression_list(texture_operands(expr));
  bool raw = false;
  const TableExpr* options = options_of(expr);
  const bool is_read = options == nullptr || read_image_options(*options, raw);
  if (!takes_texture_arguments(expr, args) || !is_read) return result;
  ExpressionFact fact;
  fact.type = vec4;
  fact.results = {vec4};
  fact.call = CallKind::Texture;
  fact.library = &texture_row();
  if (context_.report && context_.collect) fact.index = add_image(*expr.args[0], args.types[0], raw);
  record(expr, std::move(fact));
  return result;
}

} // namespace moonshade::sema
