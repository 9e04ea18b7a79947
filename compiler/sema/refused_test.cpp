// Every refusal: a source that must fail with these codes, each at the place of a `$` (which is no character of Lua),
// and with nothing else.
#include "compiler/sema/checked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace moonshade::sema {
namespace {

struct Refusal {
  const char* source;
  std::vector<std::string> codes;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.source; }

class RefusalTest : public testing::TestWithParam<Refusal> {};

TEST_P(RefusalTest, StandsAtItsPlace) {
  std::string source;
  std::vector<std::string> expected;
  unsigned line = 1, column = 1;
  for (const char* at = GetParam().source; *at != 0; ++at) {
    if (*at == '$') {
      ASSERT_LT(expected.size(), GetParam().codes.size()) << "more marks than codes";
      expected.push_back(std::to_string(line) + ":" + std::to_string(column) + " " + GetParam().codes[expected.size()]);
      continue;
    }
    source += *at;
    column = *at == '\n' ? 1 : column + 1;
    line += *at == '\n';
  }
  ASSERT_EQ(expected.size(), GetParam().codes.size()) << "fewer marks than codes";
  const Checked checked(source);
  EXPECT_THAT(checked.errors(), testing::ElementsAreArray(expected)) << checked.text;
}

using testing::Values;

INSTANTIATE_TEST_SUITE_P(
    LeftOut, RefusalTest,
    Values(
        Refusal{"function height(p) return $height(p) end", {"recursion"}},
        Refusal{"local function a(n) if n < 1 then return 0 end return $b(n) end\n"
                "function b(n) return a(n - 1) end\nfunction height(p) return b(3) end",
                {"recursion"}},
        Refusal{"local function f(x) return $f(x) end", {"recursion"}},
        Refusal{"local function f(x) if x < 0 then return $f(x + 1) end return f(x - 1) end", {"recursion"}},
        Refusal{"local function f($...) return 1 end", {"varargs"}}, Refusal{"local x = $...", {"varargs"}},
        Refusal{"local n = $select(1, 2)", {"varargs"}},
        Refusal{"$setmetatable(${}, 1)", {"metatables", "empty-table"}},
        Refusal{"local v = vec3(1)\nfunction $v:f() return 1 end", {"method-definition"}},
        Refusal{"function height(p) $coroutine.yield(1) return 1 end", {"coroutines"}},
        Refusal{"function height(p) $pcall(height) return 1 end", {"protected-calls"}},
        Refusal{"local f = $load('return 1')", {"loading-code"}}, Refusal{"local s = $'a' .. 'b'", {"string-building"}},
        Refusal{"local s = $tostring(1)", {"string-building"}}, Refusal{"local s = $('x'):rep(3)", {"string-building"}},
        Refusal{"local s = $string.rep('x', 3)", {"library-left-out"}},
        Refusal{"local t = $os.time()", {"library-left-out"}}, Refusal{"$io.write('x')", {"library-left-out"}},
        Refusal{"local t = $type(1)", {"library-left-out"}}, Refusal{"for k, v in $pairs(t) do end", {"pairs"}},
        Refusal{"for k in $next, x do end", {"pairs"}}, Refusal{"for k in $f() do end", {"generic-for"}},
        Refusal{"for i, v in ipairs($t) do local x = $nil end", {"unknown-name", "nil-value"}},
        Refusal{"local $x <close> = 1", {"close-variable"}}, Refusal{"::top:: local x = 1\n$goto top", {"goto-form"}},
        Refusal{
            "function height(p)\n  local x = 1\n  if p.x > 0 then $goto skip end\n  x = 2\n  ::skip::\n  x = x + 1\n"
            "  return x\nend",
            {"goto-form"}},
        Refusal{"local r = $math.random()", {"random-numbers"}}, Refusal{"local x = $nil", {"nil-value"}},
        Refusal{"function height(p) local b = p == $nil return 1 end", {"nil-value"}},
        Refusal{"local g = $_G", {"environment-table"}}, Refusal{"local g = $_ENV", {"environment-table"}},
        Refusal{"local _ENV = 1; local y = $x", {"environment-table"}},
        Refusal{"function height(p) $x = 1 return 1 end", {"global-assignment"}},
        Refusal{"function height(p) $function g() end return 1 end", {"global-assignment"}},
        Refusal{"local count = 0\nfunction height(p)\n  $count = count + 1\n  return count\nend",
                {"shader-has-no-memory"}},
        Refusal{"local count = 0\nlocal function add() $count = count + 1 end\nadd()\n"
                "function height(p) add() return count end",
                {"shader-has-no-memory"}},
        Refusal{"function height(p) $x = 1 return x + y() end\nfunction y() return 1 end", {"global-assignment"}},
        Refusal{"$math.pi = 3", {"library-assignment"}}, Refusal{"$function math.f() end", {"library-assignment"}}));

INSTANTIATE_TEST_SUITE_P(NotYet, RefusalTest,
                         Values(Refusal{"local m = require $'m'", {"module-not-found"}},
                                Refusal{"local m = require $'../m'", {"module-name"}},
                                Refusal{"local m = require($1)", {"module-name"}},
                                Refusal{"function color(p) return texture($3, p.xy).rgb end", {"argument-type"}},
                                Refusal{"function height(p) return math.max(1, $p) end", {"argument-type"}}));

INSTANTIATE_TEST_SUITE_P(
    Tables, RefusalTest,
    Values(
        Refusal{"local t = { 1, ${ 2, $nil } }", {"type-conflict", "nil-value"}},
        Refusal{"local t = ${}", {"empty-table"}}, Refusal{"local t = { $[1] = 2 }", {"keyed-field"}},
        Refusal{"local t = { 1, $x = 2 }", {"mixed-table"}}, Refusal{"local t = { x = 1, $x = 2 }", {"field-twice"}},
        Refusal{"local t = { 1, $vec3(1) }", {"type-conflict"}},
        Refusal{"local t = { $sin, $cos }", {"array-element", "array-element"}},
        Refusal{"local t = { $'a' }", {"array-element"}}, Refusal{"local t = { { 1, 2 }, ${ 1 } }", {"table-shapes"}},
        Refusal{"local t = { { x = 1 }, ${ y = 1 } }", {"table-shapes"}},
        Refusal{"local t = { 1 }\nlocal x = t.$x", {"unknown-field"}},
        Refusal{"local t = { red = 1 }\nlocal x = t.$rad", {"unknown-field"}},
        Refusal{"local t = { red = 1 }\nlocal x = t[$1]", {"record-index"}},
        Refusal{"local t = { 1 }\nlocal x = t[$true]", {"index-type"}},
        Refusal{"local t = { x = { 1 } }\n$t.x = { 2 }", {"table-slot"}},
        Refusal{"local t = { f = sin }\n$t.f = cos", {"table-slot"}},
        Refusal{"local t = { 1 }\n$t = { 2 }", {"table-not-known"}},
        Refusal{"local t = { 1 }\nt = $2", {"type-conflict"}},
        Refusal{"function height(p)\n  local a, b = { 1 }, { 2 }\n  local c = $p.x > 0 and a or b\n  return c[1]\nend",
                {"table-not-known"}},
        Refusal{"function height(p)\n  local a, b = { 1 }, { 2 }\n  local c\n  if p.x > 0 then c = $a else c = $b end\n"
                "  return c[1]\nend",
                {"table-not-known", "table-not-known"}},
        Refusal{"local function f(x)\n  local a, b = { 1 }, { 2 }\n  if x > 0 then return $a end\n  return $b\nend\n"
                "function height(p) return f(p.x)[1] end",
                {"table-not-known", "table-not-known"}},
        Refusal{"local a = { 1 }\nlocal m, n = { $a }, { x = a }\nm[1][1] = 2", {"table-twice"}},
        Refusal{"local a = { 1 }\nlocal m, n = { x = a }, { x = $a }", {"table-twice"}},
        Refusal{"local t = { 1, 2 }\nfunction height(p)\n  $t[1] = p.x\n  return t[1]\nend", {"shader-has-no-memory"}},
        Refusal{"local t = { x = { 1, 2 } }\nlocal u = t.x\nlocal function set(a) $a[1] = 2 end\n"
                "function height(p)\n  set(u)\n  return t.x[1]\nend",
                {"shader-has-no-memory"}},
        Refusal{"local function counter()\n  local n = 0\n  return function() $n = n + 1 return n end\nend\n"
                "local count = counter()\nfunction height(p) return count() end",
                {"shader-has-no-memory"}},
        Refusal{"function height(p)\n  local a = { 1, 2 }\n  local i, j = math.floor(p.x), math.floor(p.y)\n"
                "  a[i], $a[j] = 1, 2\n  return a[1]\nend",
                {"order-of-evaluation"}},
        Refusal{"function height(p)\n  local a = { 1, 2 }\n  local function set() a[1] = 5 return 1 end\n"
                "  return $a[1] + set()\nend",
                {"order-of-evaluation"}},
        Refusal{"function height(p)\n  for i, v in ipairs($p) do end\n  return 1\nend", {"ipairs-argument"}},
        Refusal{"function height(p)\n  local f = $ipairs\n  return 1\nend", {"library-left-out"}},
        Refusal{"function color(p) return $sin end", {"entry-result"}},
        Refusal{"function f(p) return ${ 1 } end", {"entry-result"}},
        Refusal{
            "local function f(x) if x > 0 then return sin end return $cos end\nfunction height(p) return f(p.x)(1) end",
            {"function-not-known"}}));

INSTANTIATE_TEST_SUITE_P(
    Names, RefusalTest,
    Values(Refusal{"function height(p) return $nois(p) end", {"unknown-name"}},
           Refusal{"function height(p) return $heigth end", {"unknown-name"}},
           Refusal{"local x = math.$sine(1)", {"unknown-field"}},
           Refusal{"function height(p) return p.$q end", {"unknown-field"}},
           Refusal{"function height(p) return p.$xg end", {"unknown-field"}},
           Refusal{"function height(uv) return uv.$z end", {"unknown-field"}},
           Refusal{"function height(p) return p[$4] end", {"component-outside"}},
           Refusal{"function height(p) return p:$lenght() end", {"unknown-method"}},
           Refusal{"function height(p) local x; return $x end", {"unassigned-variable"}},
           Refusal{"function height(p)\n  local x\n  if p.x > 0 then x = 1 end\n  return $x\nend",
                   {"unassigned-variable"}},
           Refusal{"function height(p)\n  local x\n  local function f() return $x end\n  local y = f()\n  x = 1\n"
                   "  return y\nend",
                   {"unassigned-variable"}},
           Refusal{"local y = $f(1)\nfunction f(x) return x end", {"unassigned-variable"}},
           Refusal{"function f(x) return $g(x) end\nlocal y = f(1)\nfunction g(x) return x end",
                   {"unassigned-variable"}},
           Refusal{"local s\nif param('a', true) then s = 1 end\nfunction height(p) return $s end",
                   {"unassigned-variable"}},
           Refusal{"function height(p)\n  local x\n  while p.x > 0 do x = 1 break end\n  return $x\nend",
                   {"unassigned-variable"}},
           Refusal{"function f(x) return x end\nfunction $f(x) return 2 end", {"function-not-known"}},
           Refusal{"if param('a', true) then function $f() return 1 end end", {"depends-on-parameter"}},
           Refusal{"if param('a', true) then return end\nfunction $height(p) return 1 end", {"function-not-known"}},
           Refusal{"do\n  goto done\n  function $height(p) return 1 end\n  ::done::\nend", {"function-not-known"}},
           Refusal{"function height(p)\n  local f\n  $f = sin\n  $f = cos\n  return f(1)\nend",
                   {"function-not-known", "function-not-known"}},
           Refusal{"local f\nlocal x = $f(1)\nfunction f(x) return x end", {"unassigned-variable"}},
           Refusal{"for i = 1, 2 do function $f() return 1 end end", {"function-not-known"}},
           Refusal{"local fancy = param('fancy', true)\nlocal much = fancy and 2 or 1\nlocal f\n"
                   "if much > 1 then\n  $f = function(x) return x end\nelse\n  $f = sin\nend",
                   {"depends-on-parameter", "depends-on-parameter"}},
           Refusal{"local fancy = param('fancy', true)\nlocal f = $fancy and sin or cos", {"depends-on-parameter"}},
           Refusal{"function height(p)\n  local f\n  for k = 1, 1 do $f = function() return k end end\n"
                   "  return $f()\nend",
                   {"function-not-known", "unassigned-variable"}},
           Refusal{"function height(p)\n  local f = function() return 1 end\n  $f = function() return 2 end\n"
                   "  return 1\nend",
                   {"function-not-known"}},
           Refusal{"function height(p) local f = $p.x > 0 and sin or cos return 1 end", {"function-not-known"}}));

INSTANTIATE_TEST_SUITE_P(
    Types, RefusalTest,
    Values(
        Refusal{"function height(p)\n  local x = 1\n  x = $p\n  return 1\nend", {"type-conflict"}},
        Refusal{"function color(p)\n  local c = 60\n  c = $mix(c, p, 0.5)\n  return c\nend", {"type-conflict"}},
        Refusal{"function color(p)\n  local y\n  if p.x > 0 then return p end\n  error('x')\n  y = $y\n"
                "  return p\nend",
                {"unassigned-variable"}},
        Refusal{"function height(p) if $p.x then return 1 end return 2 end", {"number-as-condition"}},
        Refusal{"local function f() while $1 do end end",
                {
                    "number-as-condition",
                }},
        Refusal{"function height(p) if $p then return 1 end return 2 end", {"condition-type"}},
        Refusal{"function height(p) local b = not $1 return 1 end", {"number-as-condition"}},
        Refusal{"function height(p) local b = p.x > 0 and $p.y return 1 end", {"and-without-or"}},
        Refusal{"function height(p) local b = p.x > 0 or $p.y return 1 end", {"or-operand"}},
        Refusal{"function height(p) return $p.x or 1 end", {"number-as-condition"}},
        Refusal{"function height(p) return $p.x > 0 and p or 1 end", {"conditional-types"}},
        Refusal{"function height(p) return $p.x > 0 or p.y > 0 and 1 or 2 end", {"conditional-arm"}},
        Refusal{"function height(p) return p.x > 0 and 1 or p.y > 0 and $2 end", {"and-without-or"}},
        Refusal{"function height(p) return p.x + $true end", {"operand-type"}},
        Refusal{"function height(p) return -$'a' end", {"operand-type"}},
        Refusal{"function height(p) local b = $p < 1 return 1 end", {"operand-type"}},
        Refusal{"function height(p, uv) local v = $p + uv return 1 end", {"operands-do-not-fit"}},
        Refusal{"function height(p) local b = $p == 1 return 1 end", {"operands-do-not-fit"}},
        Refusal{"function height(p) return $p.x & 1 end", {"bitwise-number"}},
        Refusal{"function height(p) return 1 << $2.0 end", {"bitwise-number"}},
        Refusal{"function height(p) return 1 | $p end", {"operand-type"}},
        Refusal{"function height(p)\n  local s = 0\n  s = s + p.x\n  return $s % 2\nend", {"mixed-number"}},
        Refusal{"function height(p)\n  local s = 0\n  s = s + p.x\n  local t = s + 1\n  return 7 // $t\nend",
                {"mixed-number"}},
        Refusal{"function height(p)\n  local s = 0\n  s = s + p.x\n  local b = math.type($s) == 'float'\n  return s\n"
                "end",
                {"mixed-number"}},
        Refusal{"function height(p) local v = p; $v.x = 1; return v.x end", {"vector-component"}},
        Refusal{"function height(p) $p[1] = 2; return p.x end", {"vector-component"}},
        Refusal{"function height(p) local x = 1; return $x.y end", {"no-fields"}},
        Refusal{"function height(p) local x = 1; return $x() end", {"not-callable"}},
        Refusal{"local function f() end\nfunction height(p) return $f() + 1 end", {"no-value"}},
        Refusal{"local function f(a, b) return a + b end\nfunction height(p) return $f(1) end", {"missing-argument"}},
        Refusal{"function height(p) return $smoothstep(0, 1) end", {"missing-argument"}},
        Refusal{"function height(p) return sin(1, $2) end", {"too-many-arguments"}},
        Refusal{"function height(p) return sin($true) end", {"argument-type"}},
        Refusal{"function height(p) return dot(p, $1) end", {"argument-type"}},
        Refusal{"function color(p, uv) return $mix(p, uv, 0.5) end", {"arguments-do-not-fit"}},
        Refusal{"function color(p, uv) return $vec3(p, uv) end", {"constructor-components"}},
        Refusal{"function color(p) return vec3(1, 2, $true) end", {"argument-type"}},
        Refusal{"function height(p) local a, b = 1, 2; a, $b = 3 return a end", {"missing-value"}},
        Refusal{"function height(p) assert(p.x > 0, $p) return 1 end", {"message-constant"}},
        Refusal{"function height(p) assert($p.x) return 1 end", {"number-as-condition"}},
        Refusal{"function height(p) for i = 1, $p do end return 1 end", {"loop-number"}},
        Refusal{"function height(p)\n  if p.x > 0 then return 1 end\n  $return\nend", {"result-count"}},
        Refusal{"local function f(p)\n  if p.x > 0 then return 1 end\n  return $p\nend\n"
                "function height(p) local x = f(p) return 1 end",
                {"result-type"}},
        Refusal{"function height(p)\n  if p.x > 0 then return 1 end\n$end", {"missing-return"}},
        Refusal{"function height(p)\n  local x = 0\n  local function f() x = x + 1 return x end\n"
                "  return $x + f()\nend",
                {"order-of-evaluation"}},
        Refusal{"function height(p)\n  local x = 0\n  local function f() x = x + 1 return x end\n"
                "  return max(f(), $x)\nend",
                {"order-of-evaluation"}},
        Refusal{"function height(p) local a; a, $a = 1, 2 return a end", {"order-of-evaluation"}}));

INSTANTIATE_TEST_SUITE_P(EntriesAndParameters, RefusalTest,
                         Values(Refusal{"function color($q) return vec3(1) end", {"unknown-input"}},
                                Refusal{"function color(p) return $1 end", {"entry-result"}},
                                Refusal{"function height(p) return $p end", {"entry-result"}},
                                Refusal{"function height(p) return 1, $2 end", {"entry-result"}},
                                Refusal{"function height(p) $end", {"entry-result"}},
                                Refusal{"function height(p) return $param('x', 1) end", {"parameter-place"}},
                                Refusal{"for i = 1, 2 do local x = $param('x', 1) end", {"parameter-place"}},
                                Refusal{"local x = param($1, 1)", {"parameter-name"}},
                                Refusal{"local x = $param('x')", {"missing-argument"}},
                                Refusal{"local a = param('x', 1)\nlocal b = param($'x', 1)", {"parameter-twice"}},
                                Refusal{"local a = 1 local x = param('x', $a)", {"parameter-default"}},
                                Refusal{"local x = param('x', 1, { $mni = 2 })", {"parameter-metadata"}},
                                Refusal{"local x = param('x', 1, { min = $true })", {"parameter-metadata"}},
                                Refusal{"local x = param('x', 1, { doc = $1 })", {"parameter-metadata"}},
                                Refusal{"local x = param('x', 1, $2)", {"parameter-metadata"}},
                                Refusal{"local x = param('x', $1, { min = 2 })", {"parameter-range"}}));

INSTANTIATE_TEST_SUITE_P(
    Recovery, RefusalTest,
    Values(Refusal{"local function f(x) if x > 0 then return 1 end return $vec3(x) end\n"
                   "function height(p)\n  local a = 1\n  a = $p\n  local b = a + f(p.x)\n  return b & 1\nend",
                   {"result-type", "type-conflict"}},
           Refusal{"function color(p)\n  local a = $foo(p)\n  local b = a + 1\n  if b then return a end\n"
                   "  return $bar\nend\nfunction height(p) if $1 then end return 1 end",
                   {"unknown-name", "unknown-name", "number-as-condition"}},
           Refusal{"local function unused(a, b)\n  local c = a + b\n  return $c .. $nil\nend",
                   {"string-building", "nil-value"}}));

TEST(Refusals, NameTheChainOfSpecialisations) {
  const Checked checked("local function inner(x) return x & 1 end\n"
                        "local function outer(x) return inner(x) end\n"
                        "function height(p) return outer(3) + outer(p.x) end");
  ASSERT_THAT(checked.errors(), testing::ElementsAre("1:32 bitwise-number"));
  EXPECT_THAT(checked.text, testing::HasSubstr("in inner(number), called here"));
  EXPECT_THAT(checked.text, testing::HasSubstr("in outer(number), called here"));
}

TEST(Refusals, ShowThePathToAWriteOfTheTopLevel) {
  const Checked checked("local last = 0.0\nlocal function note(x) last = x end\nnote(1.5)\n"
                        "function height(p)\n  note(p.x)\n  return last\nend");
  ASSERT_THAT(checked.errors(), testing::ElementsAre("2:24 shader-has-no-memory"));
  EXPECT_THAT(checked.text, testing::HasSubstr("test.lua:5:3: note: in note(number), called here"));
}

TEST(Refusals, ProposeTheNearestName) {
  EXPECT_THAT(Checked("function height(p) return smoothstp(0, 1, p.x) end").text,
              testing::HasSubstr("did you mean 'smoothstep'"));
  EXPECT_THAT(Checked("function height(p) local amount = 1 return amuont end").text,
              testing::HasSubstr("did you mean 'amount'"));
}

TEST(Refusals, OfferTheNearestNameAsFix) {
  for (const char* source : {"function height(p) return smoothstp(0, 1, p.x) end", "local x = math.sim(1)",
                             "function height(p) return p:lenght() end"}) {
    const Checked checked(source);
    const Diagnostic& diagnostic = *checked.diagnostics.sorted().at(0);
    ASSERT_TRUE(diagnostic.fix.has_value()) << source;
    EXPECT_EQ(diagnostic.fix->span, diagnostic.span);
  }
}

TEST(Refusals, ProposeWhatToWriteInstead) {
  EXPECT_THAT(Checked("function height(p) local v = p; v.x = 1; return v.x end").text,
              testing::HasSubstr("v = vec3(1, v.y, v.z)"));
  EXPECT_THAT(Checked("function height(p) local s = 3; s = s + p.x; return s % 2 end").text, testing::HasSubstr("3.0"));
  EXPECT_THAT(Checked("function color(q) return vec3(1) end").text,
              testing::HasSubstr("p, P, n, ng, backface, i, uv, dpdu, dpdv, time, frame, id, fw"));
}

TEST(Refusals, AskedEntriesMustExist) {
  const Checked checked("function height(p) return 1 end", {"heigth"});
  EXPECT_THAT(checked.text, testing::HasSubstr("did you mean 'height'"));
}

// ---- limits: none of these may take long, or end in anything but a diagnostic

TEST(Limits, DoublingCallsAreLinear) {
  std::string source = "local function f0(x) return x end\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string n = std::to_string(i), m = std::to_string(i - 1);
    source += "local function f" + n + "(x) return f" + m + "(x) + f" + m + "(x) end\n";
  }
  const Checked checked(source + "function height(p) return f60(p.x) end");
  EXPECT_EQ(checked.text, "");
  EXPECT_EQ(checked.program.specialisations.size(), 63u);
}

TEST(Limits, DeepCallsAreTooLarge) {
  std::string source = "function f0(x) return x end\n";
  for (int i = 1; i <= 1000; ++i) {
    const std::string n = std::to_string(i), m = std::to_string(i - 1);
    source += "function f" + n + "(x) return f" + m + "(x) end\n";
  }
  const Checked checked(source + "function height(p) return f1000(p.x) end");
  EXPECT_THAT(checked.text, testing::HasSubstr("[too-large]"));
}

TEST(Limits, ManySpecialisationsAreTooLarge) {
  std::string params, numbers;
  for (int i = 0; i < 13; ++i)
    params += (i ? ", a" : "a") + std::to_string(i);
  std::string source = "local function f(" + params + ") return 1 end\nfunction height(p)\n  local x = 0\n";
  for (int i = 0; i < 5000; ++i) {
    numbers.clear();
    for (int bit = 0; bit < 13; ++bit)
      numbers += std::string(bit ? ", " : "") + ((i >> bit & 1) ? "1" : "1.5");
    source += "  x = f(" + numbers + ")\n";
  }
  EXPECT_THAT(Checked(source + "  return x\nend").text, testing::HasSubstr("[too-large]"));
}

TEST(Limits, SlowChainsOfInferenceEnd) {
  std::string source = "function height(p)\n";
  for (int i = 0; i < 190; ++i)
    source += "  local x" + std::to_string(i) + " = 0\n";
  source += "  for i = 1, 10 do\n";
  for (int i = 189; i > 0; --i)
    source += "    x" + std::to_string(i) + " = x" + std::to_string(i - 1) + "\n";
  const Checked checked(source + "    x0 = p.x\n  end\n  return x189\nend");
  EXPECT_EQ(checked.text, "");
  EXPECT_TRUE(checked.local_type("height", "x189").mixed);
}

} // namespace
} // namespace moonshade::sema
