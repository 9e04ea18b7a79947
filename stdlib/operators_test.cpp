// Operators and math.* against stock Lua itself, over all pairs of awkward values.
#include "stdlib/numbers.h"
#include "stdlib/operators.h"

#include <gtest/gtest.h>
#include <lua.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace moonshade::stdlib {
namespace {

const std::vector<int64_t> kIntegers = {0,
                                        1,
                                        -1,
                                        2,
                                        -2,
                                        3,
                                        -3,
                                        5,
                                        7,
                                        -7,
                                        62,
                                        63,
                                        64,
                                        65,
                                        -62,
                                        -63,
                                        -64,
                                        -65,
                                        100,
                                        1000003,
                                        (int64_t(1) << 53) - 1,
                                        int64_t(1) << 53,
                                        (int64_t(1) << 53) + 1,
                                        -(int64_t(1) << 53) - 1,
                                        INT64_MAX,
                                        INT64_MAX - 1,
                                        INT64_MIN,
                                        INT64_MIN + 1};
const std::vector<double> kNumbers = {0.0,
                                      -0.0,
                                      0.5,
                                      -0.5,
                                      1,
                                      -1,
                                      1.5,
                                      -1.5,
                                      2,
                                      -2,
                                      3,
                                      -3,
                                      5.3,
                                      -5.3,
                                      1e-300,
                                      -1e-300,
                                      1e300,
                                      -1e300,
                                      0x1p53,
                                      -0x1p53,
                                      0x1p53 + 2,
                                      0x1p62,
                                      0x1p63,
                                      -0x1p63,
                                      0x1p64,
                                      1e10 + 0.5,
                                      4.9e-324,
                                      std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::quiet_NaN()};

/// Stock Lua's answers.
class Lua {
public:
  Lua() : state_(luaL_newstate(), lua_close) { luaL_openlibs(state_.get()); }

  template <class A, class B> double number(int op, A a, B b) { return arithmetic(op, a, b), take_number(); }
  int64_t integer(int op, int64_t a, int64_t b) { return arithmetic(op, a, b), take_integer(); }
  template <class A, class B> bool compare(int op, A a, B b) {
    push(a), push(b);
    bool result = lua_compare(state_.get(), -2, -1, op);
    lua_pop(state_.get(), 2);
    return result;
  }
  /// math.<name>(...), left on the stack.
  template <class... A> void call(const char* name, A... arguments) {
    lua_getglobal(state_.get(), "math");
    lua_getfield(state_.get(), -1, name);
    lua_remove(state_.get(), -2);
    (push(arguments), ...);
    if (lua_pcall(state_.get(), sizeof...(A), 1, 0) != LUA_OK) throw std::runtime_error(lua_tostring(state_.get(), -1));
  }
  bool has_integer() { return lua_isinteger(state_.get(), -1); }
  double take_number() { return taken(lua_tonumber(state_.get(), -1)); }
  int64_t take_integer() { return taken(lua_tointeger(state_.get(), -1)); }
  bool take_boolean() { return taken(bool(lua_toboolean(state_.get(), -1))); }

private:
  void push(double x) { lua_pushnumber(state_.get(), x); }
  void push(int64_t i) { lua_pushinteger(state_.get(), i); }
  template <class A, class B> void arithmetic(int op, A a, B b) { push(a), push(b), lua_arith(state_.get(), op); }
  template <class T> T taken(T value) { return lua_pop(state_.get(), 1), value; }

  std::unique_ptr<lua_State, void (*)(lua_State*)> state_;
};

/// Equal bits, or both NaN.
testing::AssertionResult same(double found, double expected) {
  bool equal =
      std::isnan(expected) ? std::isnan(found) : found == expected && std::signbit(found) == std::signbit(expected);
  if (equal) return testing::AssertionSuccess();
  return testing::AssertionFailure() << found << " instead of " << expected;
}

TEST(Operators, OfNumbersAreLuas) {
  Lua lua;
  for (double a : kNumbers)
    for (double b : kNumbers) {
      EXPECT_TRUE(same(mod(a, b), lua.number(LUA_OPMOD, a, b))) << a << " % " << b;
      EXPECT_TRUE(same(floor_divide(a, b), lua.number(LUA_OPIDIV, a, b))) << a << " // " << b;
      EXPECT_TRUE(same(power(a, b), lua.number(LUA_OPPOW, a, b))) << a << " ^ " << b;
    }
}

TEST(Operators, OfIntegersAreLuas) {
  Lua lua;
  for (int64_t a : kIntegers)
    for (int64_t b : kIntegers) {
      EXPECT_EQ(shift_left<double>(a, b), lua.integer(LUA_OPSHL, a, b)) << a << " << " << b;
      EXPECT_EQ(shift_right<double>(a, b), lua.integer(LUA_OPSHR, a, b)) << a << " >> " << b;
      if (b == 0) {
        EXPECT_EQ(integer_mod<double>(a, b), 0);
        EXPECT_EQ(integer_idiv<double>(a, b), 0);
        EXPECT_EQ(integer_fmod<double>(a, b), 0);
        continue;
      }
      EXPECT_EQ(integer_mod<double>(a, b), lua.integer(LUA_OPMOD, a, b)) << a << " % " << b;
      EXPECT_EQ(integer_idiv<double>(a, b), lua.integer(LUA_OPIDIV, a, b)) << a << " // " << b;
      lua.call("fmod", a, b);
      EXPECT_EQ(integer_fmod<double>(a, b), lua.take_integer()) << a << " fmod " << b;
    }
}

/// Many lanes divide as doubles where all of them are below 2^51: awkward pairs in that part and beyond it, and
/// dividends next to a multiple of the divisor, where a quotient could be rounded over it.
TEST(Operators, ManyLanesDivideAsOne) {
  constexpr int kWidth = 4;
  using L = Wide<float, kWidth>;
  std::mt19937_64 random(5);
  const auto integer = [&](int bits) {
    const auto magnitude = static_cast<int64_t>(random() >> (64 - bits));
    return (random() & 1) != 0 ? magnitude : -magnitude;
  };
  for (int round = 0; round < 200'000; ++round) {
    const int most = round % 4 == 0 ? 63 : 51; // bits
    Int<L> m, n;
    for (int i = 0; i < kWidth; ++i) {
      n[i] = integer(1 + static_cast<int>(random() % unsigned(most)));
      m[i] = integer(1 + static_cast<int>(random() % unsigned(most)));
      if (round % 8 == 0) m[i] = kIntegers[random() % kIntegers.size()], n[i] = kIntegers[random() % kIntegers.size()];
      if (round % 4 == 1 && n[i] != 0) m[i] = m[i] / n[i] * n[i] + static_cast<int64_t>(random() % 3) - 1;
    }
    const Int<L> quotient = integer_idiv<L>(m, n), rest = integer_mod<L>(m, n), fmod = integer_fmod<L>(m, n);
    for (int i = 0; i < kWidth; ++i) {
      ASSERT_EQ(quotient[i], integer_idiv<float>(m[i], n[i])) << m[i] << " // " << n[i];
      ASSERT_EQ(rest[i], integer_mod<float>(m[i], n[i])) << m[i] << " % " << n[i];
      ASSERT_EQ(fmod[i], integer_fmod<float>(m[i], n[i])) << m[i] << " fmod " << n[i];
    }
  }
}

TEST(Operators, CompareIntegersWithNumbersExactly) {
  Lua lua;
  for (int64_t i : kIntegers)
    for (double x : kNumbers) {
      EXPECT_EQ(integer_less_number<double>(i, x).bits, lua.compare(LUA_OPLT, i, x)) << i << " < " << x;
      EXPECT_EQ(integer_less_equal_number<double>(i, x).bits, lua.compare(LUA_OPLE, i, x)) << i << " <= " << x;
      EXPECT_EQ(number_less_integer<double>(x, i).bits, lua.compare(LUA_OPLT, x, i)) << x << " < " << i;
      EXPECT_EQ(number_less_equal_integer<double>(x, i).bits, lua.compare(LUA_OPLE, x, i)) << x << " <= " << i;
      EXPECT_EQ(integer_equals_number<double>(i, x).bits, lua.compare(LUA_OPEQ, i, x)) << i << " == " << x;
    }
  // Under float numbers the comparison is as exact.
  EXPECT_TRUE(number_less_integer<float>(16777216.0f, 16777217).bits);
  EXPECT_FALSE(integer_equals_number<float>(16777217, 16777216.0f).bits);
  EXPECT_TRUE(integer_less_number<float>(INT64_MAX, 0x1p63f).bits);
}

/// Where Lua gives a float because no integer fits, ours says so.
TEST(Operators, NumbersToIntegersAsLua) {
  Lua lua;
  for (double x : kNumbers) {
    auto check = [&](const char* name, Results<int64_t, Mask<double>> result) {
      lua.call(name, x);
      bool is_integer = lua.has_integer();
      int64_t expected = is_integer ? lua.take_integer() : (lua.take_number(), 0);
      EXPECT_EQ(result.second.bits, is_integer) << name << " " << x;
      EXPECT_EQ(result.first, expected) << name << " " << x;
    };
    check("floor", floor_to_integer<double>(x));
    check("ceil", ceil_to_integer<double>(x));
    check("tointeger", exact_integer<double>(x));
  }
}

TEST(Operators, MathOfIntegersIsLuas) {
  Lua lua;
  for (int64_t a : kIntegers) {
    lua.call("abs", a);
    EXPECT_EQ(integer_abs<double>(a), lua.take_integer()) << a;
    for (int64_t b : kIntegers) {
      lua.call("min", a, b);
      EXPECT_EQ(integer_min<double>(a, b), lua.take_integer());
      lua.call("max", a, b);
      EXPECT_EQ(integer_max<double>(a, b), lua.take_integer());
      lua.call("ult", a, b);
      EXPECT_EQ(unsigned_less<double>(a, b).bits, lua.take_boolean()) << a << " " << b;
    }
  }
}

TEST(Operators, MathOfNumbersIsLuas) {
  Lua lua;
  auto check = [&](double found, const char* name, auto... arguments) {
    lua.call(name, arguments...);
    EXPECT_TRUE(same(found, lua.take_number())) << name << " " << testing::PrintToString(std::make_tuple(arguments...));
  };
  for (double a : kNumbers) {
    check(stdlib::sin(a), "sin", a);
    check(stdlib::cos(a), "cos", a);
    check(stdlib::tan(a), "tan", a);
    check(stdlib::asin(a), "asin", a);
    check(stdlib::acos(a), "acos", a);
    check(stdlib::exp(a), "exp", a);
    check(stdlib::log(a), "log", a);
    check(stdlib::sqrt(a), "sqrt", a);
    check(stdlib::abs(a), "abs", a);
    check(degrees(a), "deg", a);
    check(radians(a), "rad", a);
    for (double b : kNumbers) {
      check(stdlib::atan2(a, b), "atan", a, b);
      check(log_to_base(a, b), "log", a, b);
      check(stdlib::fmod(a, b), "fmod", a, b);
      check(stdlib::min(a, b), "min", a, b);
      check(stdlib::max(a, b), "max", a, b);
    }
  }
}

TEST(Numbers, RoundHalvesAwayFromZero) {
  for (double x : {0.5, -0.5, 1.5, 2.5, -2.5, 0.49999999999999994, 4503599627370497.0, 0x1p52 + 1, -0.2, 1e300})
    EXPECT_TRUE(same(stdlib::round(x), std::round(x))) << x;
  for (float x : {0.49999997f, 8388609.0f, 2.5f, -3.5f})
    EXPECT_EQ(stdlib::round(x), std::round(x)) << x;
}

TEST(Numbers, FractionsStayBelowOne) {
  EXPECT_LT(fract(-1e-20), 1);
  EXPECT_LT(fract(-1e-20f), 1);
  EXPECT_EQ(fract(-0.25), 0.75);
  EXPECT_TRUE(std::isnan(fract(double(INFINITY))));
}

TEST(Numbers, ShapersMeetTheirEnds) {
  EXPECT_EQ(mix(0.1, 0.7, 0.0), 0.1);
  EXPECT_EQ(mix(0.1, 0.7, 1.0), 0.7);
  EXPECT_EQ(mix(0.1f, 0.7f, 1.0f), 0.7f);
  EXPECT_EQ(smoothstep(2.0, 4.0, 3.0), 0.5);
  EXPECT_EQ(smoothstep(2.0, 4.0, 1.0), 0);
  EXPECT_EQ(smootherstep(2.0, 4.0, 9.0), 1);
  EXPECT_EQ(linearstep(4.0, 2.0, 3.5), 0.25) << "edges may be in reverse order";
  for (double edge : {0.0, 3.0}) {
    EXPECT_EQ(smoothstep(edge, edge, edge), 1) << "a step where the edges coincide";
    EXPECT_EQ(smoothstep(edge, edge, edge - 1e-9), 0);
  }
  EXPECT_EQ(pulse(1.0, 2.0, 1.0), 1);
  EXPECT_EQ(pulse(1.0, 2.0, 2.0), 0);
  EXPECT_DOUBLE_EQ(bias(0.5, 0.3), 0.3);
  EXPECT_DOUBLE_EQ(gain(0.25, 0.3), 0.15);
  EXPECT_EQ(clamp(5.0, 0.0, 1.0), 1);
  EXPECT_EQ(stdlib::sign(-2.0), -1);
  EXPECT_TRUE(same(stdlib::sign(-0.0), -0.0));
}

} // namespace
} // namespace moonshade::stdlib
