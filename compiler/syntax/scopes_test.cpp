#include "compiler/syntax/parser_fixture.h"

#include <gtest/gtest.h>

namespace moonshade::syntax {
namespace {

const NameExpr& returned_name(const Parsed& parsed, size_t stat, size_t value = 0) {
  const auto* name = try_as<NameExpr>(static_cast<const Expr*>(parsed.stat<ReturnStat>(stat).values[value]));
  if (name == nullptr) throw std::logic_error("no name is returned");
  return *name;
}

TEST(Scopes, ALocalIsNotVisibleInItsOwnValue) {
  const Parsed parsed("local x = 1 local x = x return x");
  const Local* first = parsed.stat<LocalStat>(0).locals[0];
  const Local* second = parsed.stat<LocalStat>(1).locals[0];
  EXPECT_EQ(try_as<NameExpr>(parsed.stat<LocalStat>(1).values[0])->local, first);
  EXPECT_EQ(returned_name(parsed, 2).local, second);
}

TEST(Scopes, BlocksEndScopes) {
  const Parsed parsed("local x do local x end return x, y");
  EXPECT_EQ(returned_name(parsed, 2).local, parsed.stat<LocalStat>(0).locals[0]);
  EXPECT_TRUE(returned_name(parsed, 2, 1).is_global());
}

TEST(Scopes, UpvaluesAreCapturedLocals) {
  const Parsed parsed("local x, y = 1, 2 local function f() local z = y return function() return x end end x = 3");
  const auto& locals = parsed.stat<LocalStat>(0).locals;
  EXPECT_TRUE(locals[0]->is_captured);
  EXPECT_TRUE(locals[0]->is_assigned);
  EXPECT_TRUE(locals[1]->is_captured);
  EXPECT_FALSE(locals[1]->is_assigned);
  EXPECT_EQ(locals[0]->function, parsed.chunk->main);
  EXPECT_FALSE(parsed.stat<LocalFunctionStat>(1).local->is_captured);
}

TEST(Scopes, LocalsSayWhatDeclaredThem) {
  const Parsed parsed("for i = 1, 2 do end for k in f do end local function g(p) end function o:m() end local v");
  EXPECT_EQ(parsed.stat<NumericForStat>(0).variable->kind, LocalKind::NumericFor);
  EXPECT_EQ(parsed.stat<GenericForStat>(1).variables[0]->kind, LocalKind::GenericFor);
  EXPECT_EQ(parsed.stat<LocalFunctionStat>(2).local->kind, LocalKind::Function);
  EXPECT_EQ(parsed.stat<LocalFunctionStat>(2).function->params[0]->kind, LocalKind::Parameter);
  EXPECT_EQ(parsed.stat<FunctionStat>(3).function->params[0]->kind, LocalKind::Self);
  EXPECT_TRUE(parsed.stat<FunctionStat>(3).function->is_method);
  EXPECT_EQ(parsed.stat<LocalStat>(4).locals[0]->kind, LocalKind::Variable);
}

TEST(Scopes, GlobalsAreFieldsOfAVisibleEnv) {
  const Parsed parsed("local _ENV = {} return x, _ENV");
  EXPECT_TRUE(returned_name(parsed, 1).is_global());
  EXPECT_EQ(returned_name(parsed, 1).environment, parsed.stat<LocalStat>(0).locals[0]);
  EXPECT_EQ(returned_name(parsed, 1, 1).local, parsed.stat<LocalStat>(0).locals[0]);
  const Parsed captured("local _ENV = {} function f() end return function() return x end");
  EXPECT_TRUE(captured.stat<LocalStat>(0).locals[0]->is_captured);
  const Parsed plain("return x, _ENV");
  EXPECT_EQ(returned_name(plain, 0).environment, nullptr);
  EXPECT_TRUE(returned_name(plain, 0, 1).is_global());
}

TEST(Scopes, ABreakKnowsItsLoop) {
  const Parsed parsed("while a do repeat break until b break end");
  const auto& loop = parsed.stat<WhileStat>(0);
  const auto* inner = try_as<RepeatStat>(loop.body->stats[0]);
  EXPECT_EQ(try_as<BreakStat>(inner->body->stats[0])->loop, inner);
  EXPECT_EQ(try_as<BreakStat>(loop.body->stats[1])->loop, &loop);
}

TEST(Scopes, AGotoKnowsItsLabel) {
  const Parsed parsed("::a:: do goto a goto b end ::b::");
  const auto& body = parsed.stat<DoStat>(1).body->stats;
  EXPECT_EQ(try_as<GotoStat>(body[0])->target, &parsed.stat<LabelStat>(0));
  EXPECT_EQ(try_as<GotoStat>(body[1])->target, &parsed.stat<LabelStat>(2));
}

TEST(Scopes, RefusesWhatLuaRefuses) {
  EXPECT_EQ(Parsed("goto l").errors(), "1:6 undefined-label");
  EXPECT_EQ(Parsed("do ::l:: end\ngoto l").errors(), "2:6 undefined-label");
  EXPECT_EQ(Parsed("function f() goto l end ::l::").errors(), "1:19 undefined-label");
  EXPECT_EQ(Parsed("::l:: do ::l:: end").errors(), "1:12 duplicate-label");
  EXPECT_EQ(Parsed("goto l local x ::l:: x = 1").errors(), "1:1 goto-into-scope");
  EXPECT_EQ(Parsed("repeat goto l local x ::l:: until x").errors(), "1:8 goto-into-scope");
  EXPECT_EQ(Parsed("break").errors(), "1:1 break-outside-loop");
  EXPECT_EQ(Parsed("while x do f(function() break end) end").errors(), "1:25 break-outside-loop");
  EXPECT_EQ(Parsed("local x <const> = 1\na, x = 1, 2").errors(), "2:1 assign-to-const");
  EXPECT_EQ(Parsed("local x <close> = nil function f() x = 1 end").errors(), "1:36 assign-to-const");
  EXPECT_EQ(Parsed("local x <const> = 1 function x() end").errors(), "1:21 assign-to-const");
  EXPECT_EQ(Parsed("local x <foo> = 1").errors(), "1:10 unknown-attribute");
  EXPECT_EQ(Parsed("local x <close>, y <close> = 1").errors(), "1:21 several-close");
  EXPECT_EQ(Parsed("function f() return ... end").errors(), "1:21 vararg-outside");
}

TEST(Scopes, MessagesNameTheOtherPlace) {
  const Parsed parsed("local x <const> = 1\nx = 2");
  EXPECT_EQ(parsed.message(), "cannot assign to 'x': it is declared <const>");
  const auto& notes = parsed.diagnostics.sorted()[0]->notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(parsed.text_of(notes[0].span), "x");
  EXPECT_EQ(Parsed("goto l local x ::l:: x = 1").message(), "this 'goto l' jumps into the scope of local 'x'");
}

TEST(Scopes, EndOfBlockIsOutsideItsLocals) {
  EXPECT_EQ(Parsed("do goto l; local x; ::l:: ; ::m:: end").errors(), "");
  EXPECT_EQ(Parsed("do goto l; local x; ::l:: ; do end end").errors(), "1:4 goto-into-scope");
}

} // namespace
} // namespace moonshade::syntax
