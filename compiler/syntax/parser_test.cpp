#include "compiler/syntax/parser_fixture.h"

#include <gtest/gtest.h>

namespace moonshade::syntax {
namespace {

std::string tree(std::string text) {
  const Parsed parsed(std::move(text));
  EXPECT_EQ(parsed.errors(), "");
  return parsed.tree();
}

TEST(Parser, PrintsEveryStatement) {
  EXPECT_EQ(tree("local a <const>, b = 1\n"
                 "a.x, t[1] = 2, ...\n"
                 "f(a)\n"
                 "do end\n"
                 "while a do break end\n"
                 "repeat local c until c\n"
                 "if a then elseif b then else end\n"
                 "for i = 1, 2 do end\n"
                 "for i = 1, 2, 3 do end\n"
                 "for k, v in f, b do end\n"
                 "goto l ::l::\n"
                 "return a, nil\n"),
            R"(  LocalStat a <const> #0, b #1
    IntegerExpr 1
  AssignStat
    targets
      IndexExpr dotted
        NameExpr a local #0
        StringExpr "x"
      IndexExpr
        NameExpr t global
        IntegerExpr 1
    values
      IntegerExpr 2
      VarargExpr
  CallStat
    CallExpr
      NameExpr f global
      args
        NameExpr a local #0
  DoStat
  WhileStat
    condition
      NameExpr a local #0
    body
      BreakStat
  RepeatStat
    body
      LocalStat c #2
    condition
      NameExpr c local #2
  IfStat
    condition
      NameExpr a local #0
    then
    condition
      NameExpr b local #1
    then
    else
  NumericForStat i #3
    start
      IntegerExpr 1
    limit
      IntegerExpr 2
    body
  NumericForStat i #4
    start
      IntegerExpr 1
    limit
      IntegerExpr 2
    step
      IntegerExpr 3
    body
  GenericForStat k #5, v #6
    in
      NameExpr f global
      NameExpr b local #1
    body
  GotoStat l
  LabelStat l
  ReturnStat
    NameExpr a local #0
    NilExpr
)");
}

TEST(Parser, PrintsEveryExpression) {
  EXPECT_EQ(tree("x = {1, a = 2.0, [nil] = 'q\\0\"'; f\"s\", o:m{}, (true), -false}\n"
                 "function a.b:c(d, ...) return self end\n"
                 "local function g() return g end\n"
                 "y = function() end"),
            R"(  AssignStat
    targets
      NameExpr x global
    values
      TableExpr
        field
          IntegerExpr 1
        field a
          NumberExpr 2.0
        field keyed
          NilExpr
          StringExpr "q\000\""
        field
          CallExpr
            NameExpr f global
            args
              StringExpr "s"
        field
          MethodCallExpr m
            NameExpr o global
            args
              TableExpr
        field
          ParenExpr
            BooleanExpr true
        field
          UnaryExpr -
            BooleanExpr false
  FunctionStat
    IndexExpr dotted
      IndexExpr dotted
        NameExpr a global
        StringExpr "b"
      StringExpr "c"
    Function a.b:c (self #0, d #1, ...)
      ReturnStat
        NameExpr self local #0
  LocalFunctionStat g #2
    Function g ()
      ReturnStat
        NameExpr g upvalue #2
  AssignStat
    targets
      NameExpr y global
    values
      Function y ()
)");
}

/// An expression with all its operations in parentheses.
std::string grouped(const Expr& expr) {
  return visit(expr, Overloaded{[](const BinaryExpr& e) {
                                  return "(" + grouped(*e.left) + " " + std::string(spelling_of(e.op)) + " " +
                                         grouped(*e.right) + ")";
                                },
                                [](const UnaryExpr& e) {
                                  return "(" + std::string(spelling_of(e.op)) + " " + grouped(*e.operand) + ")";
                                },
                                [](const NameExpr& e) { return std::string(e.name); },
                                [](const auto&) { return std::string("?"); }});
}
std::string grouped(std::string text) {
  const Parsed parsed("return " + std::move(text));
  EXPECT_EQ(parsed.errors(), "");
  return grouped(*parsed.stat<ReturnStat>(0).values[0]);
}

TEST(Parser, OperatorsBindAsInLua) {
  EXPECT_EQ(grouped("a + b * c - d"), "((a + (b * c)) - d)");
  EXPECT_EQ(grouped("a ^ b ^ c"), "(a ^ (b ^ c))");
  EXPECT_EQ(grouped("a .. b .. c + d"), "(a .. (b .. (c + d)))");
  EXPECT_EQ(grouped("- a ^ - b"), "(- (a ^ (- b)))");
  EXPECT_EQ(grouped("- a * b"), "((- a) * b)");
  EXPECT_EQ(grouped("not a == b"), "((not a) == b)");
  EXPECT_EQ(grouped("a or b and c < d | e ~ f & g << h .. i + j * - k ^ l"),
            "(a or (b and (c < (d | (e ~ (f & (g << (h .. (i + (j * (- (k ^ l))))))))))))");
  EXPECT_EQ(grouped("a < b <= c ~= d == e > f >= g"), "((((((a < b) <= c) ~= d) == e) > f) >= g)");
  EXPECT_EQ(grouped("a / b // c % d"), "(((a / b) // c) % d)");
  EXPECT_EQ(grouped("a << b >> c"), "((a << b) >> c)");
  EXPECT_EQ(grouped("~ # a"), "(~ (# a))");
}

TEST(Parser, SpansCoverTheNodes) {
  const Parsed parsed("local x = (a + b.c) * f(1) -- tail\nif x then g() end\nfunction m() end");
  const auto& product = *try_as<BinaryExpr>(parsed.stat<LocalStat>(0).values[0]);
  EXPECT_EQ(parsed.text_of(product.span), "(a + b.c) * f(1)");
  EXPECT_EQ(parsed.text_of(product.op_span), "*");
  EXPECT_EQ(parsed.text_of(product.left->span), "(a + b.c)");
  EXPECT_EQ(parsed.text_of(product.right->span), "f(1)");
  EXPECT_EQ(parsed.text_of(parsed.stat<LocalStat>(0).span), "local x = (a + b.c) * f(1)");
  EXPECT_EQ(parsed.text_of(parsed.stat<IfStat>(1).span), "if x then g() end");
  EXPECT_EQ(parsed.text_of(parsed.stat<IfStat>(1).clauses[0].span), "if x then g()");
  EXPECT_EQ(parsed.text_of(parsed.stat<FunctionStat>(2).function->end_span), "end");
  EXPECT_EQ(parsed.chunk->main->span.end, parsed.sources.text(parsed.file).size());
}

TEST(Parser, FunctionsKnowTheirPlace) {
  const Parsed parsed("function f() local g = function() end end");
  ASSERT_EQ(parsed.chunk->functions.size(), 3u);
  const Function *main = parsed.chunk->functions[0], *f = parsed.chunk->functions[1], *g = parsed.chunk->functions[2];
  EXPECT_EQ(main, parsed.chunk->main);
  EXPECT_TRUE(main->is_vararg);
  EXPECT_EQ(f->parent, main);
  EXPECT_EQ(g->parent, f);
  EXPECT_EQ(g->name, "g");
  EXPECT_EQ(parsed.text_of(f->span), "function f() local g = function() end end");
}

TEST(Parser, KeepsTheCommentLinesAboveDeclarations) {
  const Parsed parsed("---@param p vec3\n---@return number\nfunction f(p) end\n\n-- old\n\n--- a size\nlocal s = 1\n"
                      "--- b\nlocal function g() end\n--- c\nx = 1");
  const auto lines = [&](CommentLines comments) {
    std::string result;
    for (const Comment& comment : comments)
      result += std::string(parsed.text_of(comment.span)) + "|";
    return result;
  };
  EXPECT_EQ(lines(parsed.stat<FunctionStat>(0).comments), "---@param p vec3|---@return number|");
  EXPECT_EQ(lines(parsed.stat<LocalStat>(1).comments), "--- a size|");
  EXPECT_EQ(lines(parsed.stat<LocalFunctionStat>(2).comments), "--- b|");
  EXPECT_EQ(lines(parsed.stat<AssignStat>(3).comments), "--- c|");
}

TEST(Parser, TakesWhatTheManualPromises) {
  std::string locals = "local a0", arguments = "return f(0";
  for (int i = 1; i < 1000; ++i) {
    locals += ", a" + std::to_string(i);
    arguments += ", " + std::to_string(i);
  }
  EXPECT_EQ(Parsed(locals).errors(), "");
  EXPECT_EQ(Parsed(arguments + ")").errors(), "");
  EXPECT_EQ(Parsed(locals + " return function() return a0, a1, a254, a255, a999 end").errors(), "");
  const auto nested = [](std::string open, std::string middle, std::string close) {
    std::string text = "";
    for (int i = 0; i < 190; ++i)
      text += open;
    text += middle;
    for (int i = 0; i < 190; ++i)
      text += close;
    return Parsed(text).errors();
  };
  EXPECT_EQ(nested("do ", "", " end"), "");
  EXPECT_EQ(nested("if a then ", "", " end"), "");
  EXPECT_EQ(nested("for i = 1, 2 do ", "", " end"), "");
  EXPECT_EQ(nested("return function() ", "", " end"), "");
  EXPECT_EQ(nested("function f() ", "", " end"), "");
  EXPECT_EQ(Parsed("x = " + std::string(190, '(') + "1" + std::string(190, ')')).errors(), "");
  EXPECT_EQ(Parsed("x = " + std::string(190, '{') + std::string(190, '}')).errors(), "");
  EXPECT_EQ(Parsed("x = " + std::string(190, '~') + "1").errors(), "");
}

} // namespace
} // namespace moonshade::syntax
