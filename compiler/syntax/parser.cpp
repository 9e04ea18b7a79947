// Tokens, errors and recovery of the parser, and its entry.
#include "compiler/syntax/parser.h"

#include "compiler/base/printable.h"
#include "compiler/syntax/parser_impl.h"

namespace moonshade::syntax {

Parser::Parser(const SourceSet& sources, FileId file, std::string_view text, Arena& arena, Diagnostics& diagnostics)
    : sources_(sources), file_(file), text_(text), arena_(arena), diagnostics_(diagnostics),
      lexer_(file, text, arena, diagnostics), scopes_(diagnostics) {
  token_ = lexer_.next();
}

// chunk ::= block <eof>
Chunk* Parser::chunk() {
  const auto size = static_cast<uint32_t>(text_.size());
  auto* main = make<Function>({file_, 0, 0});
  main->is_vararg = true;
  functions_.push_back(main);
  scopes_.open_function(*main);
  main->body = block(BlockKind::Chunk);
  scopes_.close_function();
  main->span = {file_, 0, size};
  main->end_span = {file_, size, size};
  with_height(main, main->body->height);

  auto* chunk = arena_.make<Chunk>();
  chunk->file = file_;
  chunk->main = main;
  chunk->node_count = node_count_;
  chunk->local_count = local_count_;
  chunk->functions = arena_.copy(functions_);
  return chunk;
}

// ---- tokens --------------------------------------------------------------------------------------------------------

const Token& Parser::lookahead() {
  if (!has_lookahead_) lookahead_ = lexer_.next();
  has_lookahead_ = true;
  return lookahead_;
}

/// The current token, and goes on to the next.
Token Parser::advance() {
  const Token token = token_;
  previous_end_ = token.span.end;
  switch (token.kind) {
  case TokenKind::LeftParen:
  case TokenKind::LeftBrace:
  case TokenKind::LeftBracket:
    ++open_brackets_;
    break;
  case TokenKind::RightParen:
  case TokenKind::RightBrace:
  case TokenKind::RightBracket:
    --open_brackets_;
    break;
  default:
    break;
  }
  if (!gave_up_) token_ = has_lookahead_ ? lookahead_ : lexer_.next();
  has_lookahead_ = false;
  return token;
}

bool Parser::accept(TokenKind kind) {
  if (!at(kind)) return false;
  advance();
  return true;
}

bool Parser::expect(TokenKind kind) {
  if (accept(kind)) return true;
  syntax_error("'" + std::string(spelling_of(kind)) + "' expected");
  return false;
}

Name Parser::expect_name() {
  if (at(TokenKind::Name)) {
    const Token token = advance();
    return {token.text, token.span};
  }
  syntax_error("<name> expected");
  return {"?", {file_, token_.span.begin, token_.span.begin}};
}

Span Parser::expect_closing(TokenKind closing, TokenKind opening, Span opening_span) {
  if (at(closing)) return advance().span;
  const uint32_t opening_line = sources_.line_of(opening_span);
  if (opening_line == sources_.line_of(token_.span)) {
    expect(closing);
  } else if (may_report_here()) {
    diagnostics_
        .report(DiagnosticCode::UnclosedBlock, token_.span,
                {std::string(spelling_of(closing)), std::string(spelling_of(opening)), std::to_string(opening_line),
                 near()})
        .note(DiagnosticCode::NoteOpenedHere, opening_span);
  }
  start_panic();
  return {file_, token_.span.begin, token_.span.begin};
}

Span Parser::span_from(Span begin) const { return {file_, begin.begin, std::max(begin.begin, previous_end_)}; }

CommentLines Parser::comments_of(const Token& token) {
  std::vector<Comment> comments;
  for (uint32_t i = token.comments_begin; i < token.comments_end; ++i) {
    const Span span = lexer_.comments()[i];
    comments.push_back({span, text_.substr(span.begin, span.size())});
  }
  return arena_.copy(comments);
}

// ---- errors --------------------------------------------------------------------------------------------------------

/// The token as the source has it, cut where it is long.
std::string Parser::near() const {
  constexpr size_t kMaxShown = 40;
  if (token_.kind == TokenKind::EndOfFile) return "<eof>";
  const std::string_view whole = text_.substr(token_.span.begin, token_.span.size());
  const std::string_view line = whole.substr(0, whole.find_first_of("\r\n"));
  const std::string shown = printable(line.substr(0, kMaxShown));
  return line.size() < whole.size() || line.size() > kMaxShown ? "'" + shown + "...'" : "'" + shown + "'";
}

/// Not where the lexer has reported the token, not twice at one token, and not at the end of the file behind another
/// error, which may well be the cause.
bool Parser::may_report_here() {
  if (panicking_ || gave_up_) return false;
  const bool is_repeated = last_error_at_ == token_.span.begin;
  last_error_at_ = token_.span.begin;
  const bool is_consequence = token_.kind == TokenKind::EndOfFile && (had_syntax_error_ || lexer_.had_errors());
  return token_.kind != TokenKind::Invalid && !is_repeated && !is_consequence;
}

void Parser::start_panic() {
  panicking_ = true;
  had_syntax_error_ = true;
  scopes_.note_syntax_error();
}

void Parser::syntax_error(const std::string& message) {
  if (may_report_here()) {
    Diagnostic& diagnostic = diagnostics_.report(DiagnosticCode::SyntaxError, token_.span, {message, near()});
    suggest_operator(diagnostic);
  }
  start_panic();
}

/// Operators of C: `!=` fails at its first byte, `&&` and `||` at their second, the first being an operator of Lua.
void Parser::suggest_operator(Diagnostic& diagnostic) const {
  const uint32_t at = token_.span.begin;
  const std::string_view here = text_.substr(at, 2);
  const std::string_view around = text_.substr(at == 0 ? 0 : at - 1, 2);
  if (here == "!=") diagnostic.suggest({file_, at, at + 2}, "~=");
  if (around == "&&") diagnostic.suggest({file_, at - 1, at + 1}, "and");
  if (around == "||") diagnostic.suggest({file_, at - 1, at + 1}, "or");
}

/// Beyond a limit nothing more is read: the text counts as ended.
void Parser::too_large(std::string what, size_t limit) {
  if (!gave_up_) diagnostics_.report(DiagnosticCode::TooLarge, token_.span, {std::move(what), std::to_string(limit)});
  start_panic();
  gave_up_ = true;
  token_ = {};
  token_.span = {file_, previous_end_, previous_end_};
  has_lookahead_ = false;
}

Parser::Level::Level(Parser& parser) : parser_(parser) {
  if (++parser.nesting_ > kMaxNesting) parser.too_large("nested too deeply", kMaxNesting);
}

void Parser::check_height(unsigned height) {
  if (height > kMaxTreeHeight) too_large("nested too deeply, or too long a chain of operators", kMaxTreeHeight);
}

// ---- recovery ------------------------------------------------------------------------------------------------------

bool Parser::at_statement_start() {
  switch (token_.kind) {
  case TokenKind::Break:
  case TokenKind::Do:
  case TokenKind::For:
  case TokenKind::Goto:
  case TokenKind::If:
  case TokenKind::Local:
  case TokenKind::Repeat:
  case TokenKind::Return:
  case TokenKind::While:
  case TokenKind::DoubleColon:
  case TokenKind::Semicolon:
    return true;
  case TokenKind::Function:
    return lookahead().kind == TokenKind::Name;
  case TokenKind::Name:
    return token_.is_first_on_line && open_brackets_ <= 0;
  default:
    return false;
  }
}

/// Skips one token, or a whole nameless function, so that its `end` is not taken for another's. False at the end.
bool Parser::skip_token() {
  if (token_.kind == TokenKind::EndOfFile) return false;
  const Token token = advance();
  if (token.kind != TokenKind::Function || token_.kind != TokenKind::LeftParen) return true;
  panicking_ = false;
  Level level(*this);
  function_body(token.span, {}, nullptr);
  return !gave_up_;
}

void Parser::synchronise() {
  while (!at_statement_start() && !closes_open_block() && skip_token()) {
  }
  panicking_ = gave_up_;
  open_brackets_ = 0;
}

void Parser::expect_head_end(TokenKind keyword) {
  if (accept(keyword)) return;
  syntax_error("'" + std::string(spelling_of(keyword)) + "' expected");
  const auto is_head_end = [&] { return token_.kind == TokenKind::Then || token_.kind == TokenKind::Do; };
  while (!is_head_end() && !at_statement_start() && !closes_open_block() && skip_token()) {
  }
  panicking_ = gave_up_;
  open_brackets_ = 0;
  if (is_head_end()) advance();
}

bool Parser::closes(BlockKind block) const {
  switch (token_.kind) {
  case TokenKind::EndOfFile:
    return true;
  case TokenKind::End:
    return block == BlockKind::Function || block == BlockKind::End || block == BlockKind::If;
  case TokenKind::Else:
  case TokenKind::Elseif:
    return block == BlockKind::If;
  case TokenKind::Until:
    return block == BlockKind::Repeat;
  default:
    return false;
  }
}

/// The current token closes the innermost block, or one around it in the same function (then something is missing here,
/// which the innermost block's statement reports).
bool Parser::closes_open_block() const {
  for (size_t i = open_blocks_.size(); i-- > 0;) {
    if (closes(open_blocks_[i])) return true;
    if (open_blocks_[i] == BlockKind::Function) return false;
  }
  return false;
}

// ---- nodes ---------------------------------------------------------------------------------------------------------

Expr* Parser::error_expr() { return make<ErrorExpr>({file_, token_.span.begin, token_.span.begin}); }

Local* Parser::make_local(Name name, LocalKind kind) {
  auto* local = arena_.make<Local>();
  local->name = name.text;
  local->span = name.span;
  local->id = local_count_++;
  local->kind = kind;
  local->function = scopes_.current_function();
  return local;
}

Chunk* parse(SourceSet& sources, FileId file, Arena& arena, Diagnostics& diagnostics) {
  std::string_view text = sources.text(file);
  if (text.size() > kMaxSourceBytes) {
    diagnostics.report(DiagnosticCode::TooLarge, {file, 0, 0},
                       {"the file has " + std::to_string(text.size()) + " bytes", std::to_string(kMaxSourceBytes)});
    text = {};
  }
  return Parser(sources, file, text, arena, diagnostics).chunk();
}

} // namespace moonshade::syntax
