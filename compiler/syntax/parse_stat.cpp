// Statements (the rules are those of the manual's section 9).
#include "compiler/syntax/folded_integer.h"
#include "compiler/syntax/parser_impl.h"

#include <algorithm>

namespace moonshade::syntax {
namespace {

bool is_block_closer(TokenKind kind) {
  return kind == TokenKind::End || kind == TokenKind::Else || kind == TokenKind::Elseif || kind == TokenKind::Until;
}

template <class T> unsigned height_of(const T* node) { return node == nullptr ? 0 : node->height; }

} // namespace

// block ::= {stat} [retstat]
Block* Parser::block(BlockKind block_kind) {
  open_blocks_.push_back(block_kind);
  auto* block = make<Block>(token_.span);
  std::vector<Stat*> stats;
  std::vector<LabelStat*> labels; // those directly before the current token
  unsigned height = 0;
  while (true) {
    if (panicking_) synchronise();
    open_brackets_ = 0;
    if (accept(TokenKind::Semicolon)) continue;
    if (!at(TokenKind::DoubleColon)) add_labels(labels);
    if (gave_up_ || closes_open_block()) break;
    if (is_block_closer(kind())) {
      // Behind an error this is most likely its consequence.
      had_syntax_error_ ? start_panic() : syntax_error("there is no block to close");
      continue;
    }
    Stat* stat = statement();
    stats.push_back(stat);
    height = std::max<unsigned>(height, stat->height);
    if (auto* label = try_as<LabelStat>(stat); label != nullptr && !panicking_) labels.push_back(label);
    const bool must_end = stat->kind == StatKind::Return && !panicking_ && !gave_up_;
    if (must_end && !is_block_closer(kind()) && !at(TokenKind::EndOfFile))
      syntax_error("'return' must be the last statement of its block");
  }
  add_labels(labels);
  open_blocks_.pop_back();
  block->stats = arena_.copy(stats);
  if (stats.empty()) block->span = {file_, previous_end_, previous_end_};
  return stats.empty() ? with_height(block, 0) : finish(block, height);
}

/// A label is known where the run of labels and semicolons that it belongs to ends: at the end of a block its locals
/// are then out of scope already (but not before `until`, whose condition sees them).
void Parser::add_labels(std::vector<LabelStat*>& labels) {
  const bool is_last = is_block_closer(token_.kind) || token_.kind == TokenKind::EndOfFile;
  for (LabelStat* label : labels)
    scopes_.add_label(*label, is_last && token_.kind != TokenKind::Until);
  labels.clear();
}

Block* Parser::scoped_block(BlockKind block_kind, Stat* loop) {
  scopes_.open_block(loop);
  Block* result = block(block_kind);
  scopes_.close_block();
  return result;
}

// stat ::= ifstat | whilestat | dostat | forstat | repeatstat | funcstat | localstat | labelstat | retstat | breakstat
// |
//          gotostat | exprstat
Stat* Parser::statement() {
  Level level(*this);
  switch (kind()) {
  case TokenKind::If:
    return if_stat();
  case TokenKind::While:
    return while_stat();
  case TokenKind::Do:
    return do_stat();
  case TokenKind::For:
    return for_stat();
  case TokenKind::Repeat:
    return repeat_stat();
  case TokenKind::Function:
    return function_stat();
  case TokenKind::Local: {
    const Token local_token = advance();
    return at(TokenKind::Function) ? local_function(local_token) : local_stat(local_token);
  }
  case TokenKind::DoubleColon:
    return label_stat();
  case TokenKind::Return:
    return return_stat();
  case TokenKind::Break:
    return break_stat();
  case TokenKind::Goto:
    return goto_stat();
  default:
    return expr_stat();
  }
}

Stat* Parser::error_stat(Span begin) { return finish(make<ErrorStat>(begin), 0); }

// ---- structured control flow ---------------------------------------------------------------------------------------

// ifstat ::= 'if' exp 'then' block {'elseif' exp 'then' block} ['else' block] 'end'
Stat* Parser::if_stat() {
  auto* stat = make<IfStat>(token_.span);
  const Span if_span = token_.span;
  std::vector<IfClause> clauses;
  do {
    clauses.push_back(if_clause());
  } while (at(TokenKind::Elseif));
  if (accept(TokenKind::Else)) stat->else_body = scoped_block(BlockKind::End);
  expect_closing(TokenKind::End, TokenKind::If, if_span);
  unsigned height = height_of(stat->else_body);
  for (const IfClause& clause : clauses)
    height = std::max({height, height_of(clause.condition), height_of(clause.body)});
  stat->clauses = arena_.copy(clauses);
  return finish(stat, height);
}

// ('if' | 'elseif') exp 'then' block
IfClause Parser::if_clause() {
  IfClause clause;
  clause.span = advance().span;
  clause.condition = expr();
  expect_head_end(TokenKind::Then);
  clause.body = scoped_block(BlockKind::If);
  clause.span = span_from(clause.span);
  return clause;
}

// whilestat ::= 'while' exp 'do' block 'end'
Stat* Parser::while_stat() {
  auto* stat = make<WhileStat>(token_.span);
  const Span while_span = advance().span;
  stat->condition = expr();
  expect_head_end(TokenKind::Do);
  stat->body = scoped_block(BlockKind::End, stat);
  expect_closing(TokenKind::End, TokenKind::While, while_span);
  return finish(stat, std::max(height_of(stat->condition), height_of(stat->body)));
}

// dostat ::= 'do' block 'end'
Stat* Parser::do_stat() {
  auto* stat = make<DoStat>(token_.span);
  const Span do_span = advance().span;
  stat->body = scoped_block(BlockKind::End);
  expect_closing(TokenKind::End, TokenKind::Do, do_span);
  return finish(stat, height_of(stat->body));
}

// repeatstat ::= 'repeat' block 'until' exp
Stat* Parser::repeat_stat() {
  auto* stat = make<RepeatStat>(token_.span);
  const Span repeat_span = advance().span;
  scopes_.open_block(stat);
  scopes_.open_block();
  stat->body = block(BlockKind::Repeat);
  expect_closing(TokenKind::Until, TokenKind::Repeat, repeat_span);
  stat->condition = expr();
  scopes_.close_block();
  scopes_.close_block();
  return finish(stat, std::max(height_of(stat->condition), height_of(stat->body)));
}

// forstat ::= 'for' NAME ('=' ... | {',' NAME} 'in' ...)
Stat* Parser::for_stat() {
  const Span begin = advance().span;
  const Name first = expect_name();
  if (at(TokenKind::Comma) || at(TokenKind::In)) return generic_for(begin, first);
  if (!at(TokenKind::Equal)) syntax_error("'=' or 'in' expected");
  return numeric_for(begin, first);
}

// '=' exp ',' exp [',' exp] 'do' block 'end'
Stat* Parser::numeric_for(Span begin, Name variable) {
  auto* stat = make<NumericForStat>(begin);
  accept(TokenKind::Equal);
  stat->start = expr();
  expect(TokenKind::Comma);
  stat->limit = expr();
  if (accept(TokenKind::Comma)) stat->step = expr();
  stat->variable = make_local(variable, LocalKind::NumericFor);
  stat->body = for_body(stat, begin, {&stat->variable, 1});
  return finish(
      stat, std::max({height_of(stat->start), height_of(stat->limit), height_of(stat->step), height_of(stat->body)}));
}

// {',' NAME} 'in' explist 'do' block 'end'
Stat* Parser::generic_for(Span begin, Name first) {
  auto* stat = make<GenericForStat>(begin);
  std::vector<Local*> variables = {make_local(first, LocalKind::GenericFor)};
  while (accept(TokenKind::Comma))
    variables.push_back(make_local(expect_name(), LocalKind::GenericFor));
  expect(TokenKind::In);
  const ExprList values = expr_list();
  stat->variables = arena_.copy(variables);
  stat->values = values.exprs;
  stat->body = for_body(stat, begin, stat->variables);
  return finish(stat, std::max(values.height, height_of(stat->body)));
}

// 'do' block 'end', where the block sees the loop's variables
Block* Parser::for_body(Stat* loop, Span begin, std::span<Local* const> variables) {
  const Span for_span = {file_, begin.begin, begin.begin + 3};
  expect_head_end(TokenKind::Do);
  scopes_.open_block(loop);
  scopes_.open_block();
  for (Local* variable : variables)
    scopes_.declare(*variable);
  Block* body = block(BlockKind::End);
  scopes_.close_block();
  scopes_.close_block();
  expect_closing(TokenKind::End, TokenKind::For, for_span);
  return body;
}

// retstat ::= 'return' [explist] [';']
Stat* Parser::return_stat() {
  auto* stat = make<ReturnStat>(token_.span);
  advance();
  unsigned height = 0;
  const bool is_bare = is_block_closer(kind()) || at(TokenKind::EndOfFile) || at(TokenKind::Semicolon);
  if (!is_bare) {
    const ExprList values = expr_list();
    stat->values = values.exprs;
    height = values.height;
  }
  finish(stat, height);
  accept(TokenKind::Semicolon);
  return stat;
}

// breakstat ::= 'break'
Stat* Parser::break_stat() {
  auto* stat = make<BreakStat>(advance().span);
  scopes_.add_break(*stat);
  return stat;
}

// gotostat ::= 'goto' NAME
Stat* Parser::goto_stat() {
  auto* stat = make<GotoStat>(advance().span);
  stat->label = expect_name();
  finish(stat, 0);
  if (!panicking_) scopes_.add_goto(*stat);
  return stat;
}

// labelstat ::= '::' NAME '::'
LabelStat* Parser::label_stat() {
  auto* stat = make<LabelStat>(advance().span);
  stat->label = expect_name();
  expect(TokenKind::DoubleColon);
  return finish(stat, 0);
}

// ---- declarations --------------------------------------------------------------------------------------------------

// funcstat ::= 'function' NAME {'.' NAME} [':' NAME] funcbody
Stat* Parser::function_stat() {
  auto* stat = make<FunctionStat>(token_.span);
  const Token function_token = advance();
  stat->comments = comments_of(function_token);
  const Name first = expect_name();
  stat->target = name_expr(first);
  while (at(TokenKind::Dot))
    stat->target = dotted(stat->target);
  Name method;
  const bool is_method = accept(TokenKind::Colon);
  if (is_method) {
    method = expect_name();
    auto* target = make<IndexExpr>(stat->target->span);
    target->object = stat->target;
    target->key = name_as_string(method);
    target->is_dotted = true;
    stat->target = finish(target, height_of(target->object));
  }
  const Span name_span = join(first.span, stat->target->span);
  const std::string_view name = text_.substr(name_span.begin, name_span.size());
  stat->function = function_body(function_token.span, name, is_method ? &method : nullptr);
  finish(stat, std::max(height_of(stat->target), height_of(stat->function)));
  assign_to(*stat->target, stat->span);
  return stat;
}

// 'local' 'function' NAME funcbody
Stat* Parser::local_function(Token local_token) {
  auto* stat = make<LocalFunctionStat>(local_token.span);
  const Span function_span = advance().span;
  stat->comments = comments_of(local_token);
  stat->local = make_local(expect_name(), LocalKind::Function);
  scopes_.declare(*stat->local); // the body may call it
  stat->function = function_body(function_span, stat->local->name, nullptr);
  return finish(stat, height_of(stat->function));
}

// 'local' NAME attrib {',' NAME attrib} ['=' explist]
Stat* Parser::local_stat(Token local_token) {
  auto* stat = make<LocalStat>(local_token.span);
  stat->comments = comments_of(local_token);
  std::vector<Local*> locals;
  bool has_close = false;
  do {
    locals.push_back(make_local(expect_name(), LocalKind::Variable));
    locals.back()->attrib = attrib(has_close);
  } while (accept(TokenKind::Comma));
  ExprList values;
  if (accept(TokenKind::Equal)) values = expr_list();
  for (Local* local : locals)
    scopes_.declare(*local); // not visible in the values
  for (size_t i = 0; i < std::min(locals.size(), values.exprs.size()); ++i)
    if (auto* function = try_as<Function>(values.exprs[i])) function->name = locals[i]->name;
  // As Lua does, of the last name alone.
  if (locals.size() == values.exprs.size() && locals.back()->attrib == Attrib::Const)
    locals.back()->folded_integer = folded_integer(*values.exprs.back());
  stat->locals = arena_.copy(locals);
  stat->values = values.exprs;
  return finish(stat, values.height);
}

// attrib ::= ['<' NAME '>']
Attrib Parser::attrib(bool& has_close) {
  if (!accept(TokenKind::Less)) return Attrib::None;
  const Name name = expect_name();
  if (panicking_) return Attrib::None;
  Attrib result = Attrib::None;
  if (name.text == "const") {
    result = Attrib::Const;
  } else if (name.text == "close") {
    result = Attrib::Close;
    if (has_close) diagnostics_.report(DiagnosticCode::SeveralClose, name.span);
    has_close = true;
  } else {
    diagnostics_.report(DiagnosticCode::UnknownAttribute, name.span, {std::string(name.text)});
  }
  expect(TokenKind::Greater);
  return result;
}

// ---- calls and assignments -----------------------------------------------------------------------------------------

// exprstat ::= functioncall | varlist '=' explist
Stat* Parser::expr_stat() {
  const Token first_token = token_;
  Expr* first = suffixed_expr();
  if (at(TokenKind::Equal) || at(TokenKind::Comma)) return assignment(first_token, first);
  const bool is_call = first->kind == ExprKind::Call || first->kind == ExprKind::MethodCall;
  if (!is_call) {
    if (may_report_here()) diagnostics_.report(DiagnosticCode::NotAStatement, token_.span, {near()});
    start_panic();
    return error_stat(first_token.span);
  }
  auto* stat = make<CallStat>(first_token.span);
  stat->call = first;
  return finish(stat, height_of(first));
}

// varlist '=' explist, varlist ::= var {',' var}
Stat* Parser::assignment(Token first_token, Expr* first) {
  auto* stat = make<AssignStat>(first_token.span);
  stat->comments = comments_of(first_token);
  std::vector<Expr*> targets = {first};
  check_target(*first);
  while (accept(TokenKind::Comma)) {
    targets.push_back(suffixed_expr());
    check_target(*targets.back());
  }
  ExprList values;
  if (expect(TokenKind::Equal)) values = expr_list();
  unsigned height = values.height;
  for (const Expr* target : targets)
    height = std::max(height, height_of(target));
  for (size_t i = 0; i < std::min(targets.size(), values.exprs.size()); ++i) {
    const auto* name = try_as<NameExpr>(targets[i]);
    auto* function = try_as<Function>(values.exprs[i]);
    if (name != nullptr && function != nullptr) function->name = name->name;
  }
  stat->targets = arena_.copy(targets);
  stat->values = values.exprs;
  finish(stat, height);
  for (const Expr* target : targets)
    assign_to(*target, stat->span);
  return stat;
}

/// The current token shows that the expression before it is meant as a target: only variables and fields can be.
void Parser::check_target(const Expr& target) {
  if (panicking_ || target.kind == ExprKind::Name || target.kind == ExprKind::Index) return;
  if (may_report_here()) diagnostics_.report(DiagnosticCode::CannotAssign, token_.span, {near()});
}

/// Marks the local that is assigned; refuses constants.
void Parser::assign_to(const Expr& target, Span statement) {
  const auto* name = try_as<NameExpr>(&target);
  if (name == nullptr || name->local == nullptr) return;
  Local& local = *name->local;
  local.is_assigned = true;
  if (local.attrib == Attrib::None) return;
  const std::string_view attribute = local.attrib == Attrib::Const ? "const" : "close";
  diagnostics_.report(DiagnosticCode::AssignToConst, statement, {std::string(local.name), std::string(attribute)})
      .note(DiagnosticCode::NoteDeclaredHere, local.span, {std::string(local.name)});
}

} // namespace moonshade::syntax
