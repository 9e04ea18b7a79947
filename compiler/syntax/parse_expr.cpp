// Expressions (the rules are those of the manual's section 9, the operators by the priorities of operators.def).
#include "compiler/syntax/parser_impl.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace moonshade::syntax {
namespace {

constexpr unsigned kUnaryPriority = 12;

struct BinaryRow {
  BinaryOp op;
  unsigned left, right;
};

std::optional<BinaryRow> binary_operator(TokenKind kind) {
  switch (kind) {
#define MOONSHADE_BINARY_OP(name, spelling, token, left, right)                                                        \
  case TokenKind::token:                                                                                               \
    return BinaryRow{BinaryOp::name, left, right};
#include "compiler/syntax/operators.def"
  default:
    return {};
  }
}

std::optional<UnaryOp> unary_operator(TokenKind kind) {
  switch (kind) {
#define MOONSHADE_UNARY_OP(name, spelling, token)                                                                      \
  case TokenKind::token:                                                                                               \
    return UnaryOp::name;
#include "compiler/syntax/operators.def"
  default:
    return {};
  }
}

} // namespace

// explist ::= exp {',' exp}
Parser::ExprList Parser::expr_list() {
  std::vector<Expr*> exprs;
  unsigned height = 0;
  do {
    exprs.push_back(expr());
    height = std::max<unsigned>(height, exprs.back()->height);
  } while (accept(TokenKind::Comma));
  return {arena_.copy(exprs), height};
}

// exp ::= (unop exp | simpleexp) {binop exp}, where each binop is of a priority above `limit`
Expr* Parser::subexpr(unsigned limit) {
  Level level(*this);
  const Span begin = token_.span;
  Expr* left = unary_or_simple_expr();
  while (const auto row = binary_operator(kind())) {
    if (row->left <= limit) break;
    auto* binary = make<BinaryExpr>(begin);
    binary->op = row->op;
    binary->op_span = advance().span;
    binary->left = left;
    binary->right = subexpr(row->right);
    left = finish(binary, std::max(left->height, binary->right->height));
  }
  return left;
}

// unop exp | simpleexp
Expr* Parser::unary_or_simple_expr() {
  const auto op = unary_operator(kind());
  if (!op) return simple_expr();
  auto* unary = make<UnaryExpr>(token_.span);
  unary->op = *op;
  unary->op_span = advance().span;
  unary->operand = subexpr(kUnaryPriority);
  return finish(unary, unary->operand->height);
}

template <class T> Expr* Parser::leaf() { return make<T>(advance().span); }

// simpleexp ::= 'nil' | 'false' | 'true' | INTEGER | NUMBER | STRING | '...' | function | table | suffixedexp
Expr* Parser::simple_expr() {
  switch (kind()) {
  case TokenKind::Nil:
    return leaf<NilExpr>();
  case TokenKind::True:
  case TokenKind::False: {
    auto* node = make<BooleanExpr>(token_.span);
    node->value = advance().kind == TokenKind::True;
    return node;
  }
  case TokenKind::Integer: {
    auto* node = make<IntegerExpr>(token_.span);
    node->value = advance().integer;
    return node;
  }
  case TokenKind::Number: {
    auto* node = make<NumberExpr>(token_.span);
    node->value = advance().number;
    return node;
  }
  case TokenKind::String: {
    auto* node = make<StringExpr>(token_.span);
    node->value = advance().text;
    return node;
  }
  case TokenKind::Dots:
    if (!scopes_.current_function()->is_vararg) diagnostics_.report(DiagnosticCode::VarargOutside, token_.span);
    return leaf<VarargExpr>();
  case TokenKind::LeftBrace:
    return table();
  case TokenKind::Function: {
    const Span begin = advance().span;
    return function_body(begin, {}, nullptr);
  }
  case TokenKind::Invalid:
    // A token that the lexer has reported stands for an operand; where it was none, the parser finds out.
    if (!panicking_) return leaf<ErrorExpr>();
    return error_expr();
  default:
    return suffixed_expr();
  }
}

// suffixedexp ::= primaryexp {'.' NAME | '[' exp ']' | ':' NAME callargs | callargs}
Expr* Parser::suffixed_expr() {
  Expr* result = primary_expr();
  while (true) {
    switch (kind()) {
    case TokenKind::Dot:
      result = dotted(result);
      break;
    case TokenKind::LeftBracket:
      result = bracketed(result);
      break;
    case TokenKind::Colon:
      result = method_call(result);
      break;
    case TokenKind::LeftParen:
    case TokenKind::LeftBrace:
    case TokenKind::String:
      result = call(result);
      break;
    default:
      return result;
    }
  }
}

// primaryexp ::= NAME | '(' exp ')'
Expr* Parser::primary_expr() {
  if (at(TokenKind::Name)) return name_expr(expect_name());
  if (at(TokenKind::LeftParen)) return paren_expr();
  syntax_error("unexpected symbol");
  return error_expr();
}

Expr* Parser::paren_expr() {
  auto* paren = make<ParenExpr>(token_.span);
  const Span opening = advance().span;
  paren->inner = expr();
  expect_closing(TokenKind::RightParen, TokenKind::LeftParen, opening);
  return finish(paren, paren->inner->height);
}

/// A local, an upvalue, or a global, which is a field of whatever `_ENV` is visible.
Expr* Parser::name_expr(Name name) {
  auto* node = make<NameExpr>(name.span);
  node->name = name.text;
  const Scopes::Resolved resolved = scopes_.resolve(name.text);
  node->local = resolved.local;
  node->is_upvalue = resolved.is_upvalue;
  if (node->is_global()) node->environment = scopes_.resolve("_ENV").local;
  return node;
}

StringExpr* Parser::name_as_string(Name name) {
  auto* key = make<StringExpr>(name.span);
  key->value = name.text;
  return key;
}

// '.' NAME
Expr* Parser::dotted(Expr* object) {
  auto* index = make<IndexExpr>(object->span);
  advance();
  index->object = object;
  index->key = name_as_string(expect_name());
  index->is_dotted = true;
  return finish(index, object->height);
}

// '[' exp ']'
Expr* Parser::bracketed(Expr* object) {
  auto* index = make<IndexExpr>(object->span);
  const Span opening = advance().span;
  index->object = object;
  index->key = expr();
  expect_closing(TokenKind::RightBracket, TokenKind::LeftBracket, opening);
  return finish(index, std::max(object->height, index->key->height));
}

Expr* Parser::call(Expr* callee) {
  auto* call = make<CallExpr>(callee->span);
  const ExprList args = call_args();
  call->callee = callee;
  call->args = args.exprs;
  return finish(call, std::max<unsigned>(callee->height, args.height));
}

// ':' NAME callargs
Expr* Parser::method_call(Expr* object) {
  auto* call = make<MethodCallExpr>(object->span);
  advance();
  call->object = object;
  call->method = expect_name();
  const ExprList args = call_args();
  call->args = args.exprs;
  return finish(call, std::max<unsigned>(object->height, args.height));
}

// callargs ::= '(' [explist] ')' | table | STRING
Parser::ExprList Parser::call_args() {
  const Span opening = token_.span;
  if (at(TokenKind::String) || at(TokenKind::LeftBrace)) {
    Expr* arg = simple_expr();
    return {arena_.copy(std::vector{arg}), arg->height};
  }
  if (!accept(TokenKind::LeftParen)) {
    syntax_error("function arguments expected");
    return {};
  }
  if (accept(TokenKind::RightParen)) return {};
  const ExprList args = expr_list();
  expect_closing(TokenKind::RightParen, TokenKind::LeftParen, opening);
  return args;
}

// table ::= '{' [field {(',' | ';') field} [',' | ';']] '}'
Expr* Parser::table() {
  auto* table = make<TableExpr>(token_.span);
  const Span opening = advance().span;
  std::vector<TableField> fields;
  unsigned height = 0;
  while (!panicking_ && !at(TokenKind::RightBrace)) {
    fields.push_back(field(height));
    if (!accept(TokenKind::Comma) && !accept(TokenKind::Semicolon)) break;
  }
  expect_closing(TokenKind::RightBrace, TokenKind::LeftBrace, opening);
  table->fields = arena_.copy(fields);
  return finish(table, height);
}

// field ::= '[' exp ']' '=' exp | NAME '=' exp | exp
TableField Parser::field(unsigned& height) {
  TableField field;
  field.span = token_.span;
  if (at(TokenKind::LeftBracket)) {
    const Span opening = advance().span;
    field.kind = FieldKind::Keyed;
    field.key = expr();
    height = std::max<unsigned>(height, field.key->height);
    expect_closing(TokenKind::RightBracket, TokenKind::LeftBracket, opening);
    expect(TokenKind::Equal);
  } else if (at(TokenKind::Name) && lookahead().kind == TokenKind::Equal) {
    const Name name = expect_name();
    field.kind = FieldKind::Named;
    field.key = name_as_string(name);
    height = std::max<unsigned>(height, field.key->height);
    advance();
  }
  field.value = expr();
  height = std::max<unsigned>(height, field.value->height);
  field.span = span_from(field.span);
  return field;
}

// funcbody ::= '(' parlist ')' block 'end'
Function* Parser::function_body(Span begin, std::string_view name, const Name* self) {
  auto* function = make<Function>(begin);
  const int open_brackets = std::exchange(open_brackets_, 0);
  function->name = name;
  function->is_method = self != nullptr;
  function->parent = scopes_.current_function();
  function->index = static_cast<uint32_t>(functions_.size());
  functions_.push_back(function);
  scopes_.open_function(*function);
  function->params = parameters(*function, self);
  if (panicking_ && !gave_up_) synchronise();
  function->body = block(BlockKind::Function);
  function->end_span = expect_closing(TokenKind::End, TokenKind::Function, {file_, begin.begin, begin.begin + 8});
  scopes_.close_function();
  open_brackets_ = open_brackets;
  return finish(function, function->body->height);
}

// '(' parlist ')', parlist ::= [{NAME ','} (NAME | '...')]
std::span<Local* const> Parser::parameters(Function& function, const Name* self) {
  std::vector<Local*> params;
  if (self != nullptr) params.push_back(make_local({"self", self->span}, LocalKind::Self));
  const Span opening = token_.span;
  if (expect(TokenKind::LeftParen) && !accept(TokenKind::RightParen)) {
    do {
      if (at(TokenKind::Dots)) function.vararg_span = token_.span;
      function.is_vararg = accept(TokenKind::Dots);
      if (!function.is_vararg) params.push_back(make_local(expect_name(), LocalKind::Parameter));
    } while (!function.is_vararg && accept(TokenKind::Comma));
    expect_closing(TokenKind::RightParen, TokenKind::LeftParen, opening);
  }
  for (Local* param : params)
    scopes_.declare(*param);
  return arena_.copy(params);
}

} // namespace moonshade::syntax
