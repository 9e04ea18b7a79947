// The parser's class. One function for each rule of the grammar: statements in parse_stat.cpp, expressions in
// parse_expr.cpp, tokens, errors and recovery in parser.cpp.
//
// How errors are survived: a rule that cannot go on reports once and sets `panicking_`. From then on no token matches
// anything, so every rule returns at once with an error node. The innermost block then skips to where a statement can
// begin (or to the end of a block), and goes on.
#pragma once

#include "compiler/base/arena.h"
#include "compiler/base/diagnostics.h"
#include "compiler/syntax/ast.h"
#include "compiler/syntax/lexer.h"
#include "compiler/syntax/scopes.h"

#include <vector>

namespace moonshade::syntax {

class Parser {
public:
  Parser(const SourceSet& sources, FileId file, std::string_view text, Arena& arena, Diagnostics& diagnostics);

  Chunk* chunk();

private:
  // ---- parser.cpp: tokens
  /// While panicking no token matches.
  TokenKind kind() const { return panicking_ ? TokenKind::Invalid : token_.kind; }
  bool at(TokenKind kind) const { return !panicking_ && token_.kind == kind; }
  const Token& lookahead();
  Token advance();
  bool accept(TokenKind kind);
  bool expect(TokenKind kind);
  Name expect_name();
  /// `end` and the like, which close what `opening` opened.
  Span expect_closing(TokenKind closing, TokenKind opening, Span opening_span);
  Span span_from(Span begin) const;
  CommentLines comments_of(const Token& token);

  // ---- parser.cpp: errors and recovery
  void syntax_error(const std::string& message);
  void suggest_operator(Diagnostic& diagnostic) const;
  bool may_report_here();
  void start_panic();
  void too_large(std::string what, size_t limit);
  std::string near() const;
  /// Skips to where a statement can begin; ends the panic.
  void synchronise();
  /// Ends a panic within a statement's head by skipping to the head's last keyword, where there is one before the next
  /// statement.
  void expect_head_end(TokenKind keyword);
  bool skip_token();
  bool at_statement_start();

  /// What closes an open block.
  enum class BlockKind : uint8_t { Chunk, Function, End, If, Repeat };
  bool closes(BlockKind block) const;
  bool closes_open_block() const;

  // ---- parser.cpp: nodes
  template <class T> T* make(Span begin) {
    T* node = arena_.make<T>();
    node->span = begin;
    node->id = node_count_++;
    return node;
  }
  /// The node is complete: its span ends with the last token read, and it is one higher than its highest child.
  template <class T> T* finish(T* node, unsigned height_of_children) {
    node->span = span_from(node->span);
    return with_height(node, height_of_children);
  }
  template <class T> T* with_height(T* node, unsigned height_of_children) {
    check_height(height_of_children + 1);
    node->height = static_cast<uint16_t>(height_of_children + 1);
    return node;
  }
  void check_height(unsigned height);
  Expr* error_expr();
  Local* make_local(Name name, LocalKind kind);

  /// One more level of recursion, while it lives.
  class Level {
  public:
    explicit Level(Parser& parser);
    ~Level() { --parser_.nesting_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

  private:
    Parser& parser_;
  };

  // ---- parse_stat.cpp
  Block* block(BlockKind kind);
  Block* scoped_block(BlockKind kind, Stat* loop = nullptr);
  Stat* statement();
  void add_labels(std::vector<LabelStat*>& labels);
  Stat* if_stat();
  IfClause if_clause();
  Stat* while_stat();
  Stat* do_stat();
  Stat* for_stat();
  Stat* numeric_for(Span begin, Name variable);
  Stat* generic_for(Span begin, Name first);
  Block* for_body(Stat* loop, Span begin, std::span<Local* const> variables);
  Stat* repeat_stat();
  Stat* function_stat();
  Stat* local_function(Token local_token);
  Stat* local_stat(Token local_token);
  Attrib attrib(bool& has_close);
  LabelStat* label_stat();
  Stat* return_stat();
  Stat* break_stat();
  Stat* goto_stat();
  Stat* expr_stat();
  Stat* assignment(Token first_token, Expr* first);
  Stat* error_stat(Span begin);
  void check_target(const Expr& target);
  void assign_to(const Expr& target, Span statement);

  // ---- parse_expr.cpp
  struct ExprList {
    std::span<Expr* const> exprs;
    unsigned height = 0;
  };
  ExprList expr_list();
  Expr* expr() { return subexpr(0); }
  Expr* subexpr(unsigned limit);
  Expr* unary_or_simple_expr();
  Expr* simple_expr();
  template <class T> Expr* leaf();
  Expr* suffixed_expr();
  Expr* primary_expr();
  Expr* paren_expr();
  Expr* name_expr(Name name);
  StringExpr* name_as_string(Name name);
  Expr* dotted(Expr* object);
  Expr* bracketed(Expr* object);
  Expr* call(Expr* callee);
  Expr* method_call(Expr* object);
  ExprList call_args();
  Expr* table();
  TableField field(unsigned& height);
  Function* function_body(Span begin, std::string_view name, const Name* self);
  std::span<Local* const> parameters(Function& function, const Name* self);

  const SourceSet& sources_;
  FileId file_;
  std::string_view text_;
  Arena& arena_;
  Diagnostics& diagnostics_;
  Lexer lexer_;
  Scopes scopes_;

  Token token_;
  Token lookahead_;
  bool has_lookahead_ = false;
  uint32_t previous_end_ = 0; // where the last token that was read ends

  bool panicking_ = false;
  bool gave_up_ = false; // too large: nothing more is read
  bool had_syntax_error_ = false;
  uint32_t last_error_at_ = UINT32_MAX;
  int open_brackets_ = 0; // in the current statement
  unsigned nesting_ = 0;
  std::vector<BlockKind> open_blocks_;

  uint32_t node_count_ = 0;
  uint32_t local_count_ = 0;
  std::vector<Function*> functions_;
};

} // namespace moonshade::syntax
