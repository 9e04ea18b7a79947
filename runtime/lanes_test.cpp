// Code generation end to end, from modules built by hand: every width and precision gives the bits of one lane.
#include "runtime/module_fixture.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace moonshade {
namespace {

using enum ValueType;
using ir::Op;
using namespace testing;

using Lanes = DomainTest;
INSTANTIATE_TEST_SUITE_P(, Lanes, both_precisions(), precision_name);

TEST_P(Lanes, ComputeStraightCode) {
  const ir::Module module = one_entry({Vec3, Number}, {Vec3, Boolean}, [](ir::Builder& b) {
    const auto p = b.argument(0), s = b.argument(1);
    const auto scaled = b.binary(Op::Mul, p, b.convert(s, Vec3));
    const auto sum = b.binary(Op::Add, scaled, b.construct(Vec3, {b.number(0.25)}));
    b.return_values({sum, b.compare(Op::Lt, b.component(p, 1), s)});
  });
  const size_t count = 100;
  const auto x = some_numbers(count), y = some_numbers(count + 1), z = some_numbers(count + 2), s = some_numbers(1);
  std::vector<double> scale(count, 1.5);
  const Outcome outcome =
      same_everywhere(module, precision(), {numbers(x), numbers(y), numbers(z), numbers(scale)}, count);
  for (size_t i = 0; i < count; ++i) {
    EXPECT_EQ(outcome.number(0, i, precision()),
              precision() == Precision::F32 ? static_cast<float>(x[i]) * 1.5f + 0.25f : x[i] * 1.5 + 0.25);
    EXPECT_EQ(outcome.integer(3, i), y[i] < 1.5);
  }
}

TEST_P(Lanes, HandleTailsOfEveryCount) {
  const ir::Module module = one_entry({Number, Integer, Boolean}, {Number, Integer, Boolean}, [](ir::Builder& b) {
    const auto x = b.argument(0), k = b.argument(1), c = b.argument(2);
    b.return_values({b.unary(Op::Neg, x), b.binary(Op::Add, k, b.integer(7)), b.unary(Op::Not, c)});
  });
  for (const unsigned width : kWidths) {
    codegen::Options options;
    options.precision = precision();
    options.width = width;
    const CompiledModule compiled(module, options);
    for (uint64_t count = 0; count <= 2 * width + 1; ++count) {
      Column flags{Boolean, {}, {}};
      std::vector<int64_t> keys;
      for (uint64_t i = 0; i < count; ++i) {
        flags.integers.push_back(i % 3 == 0);
        keys.push_back(static_cast<int64_t>(i) * 1'000'000'007);
      }
      const auto x = some_numbers(count);
      const Outcome outcome = compiled.run({numbers(x), integers(keys), flags}, count);
      for (uint64_t i = 0; i < count; ++i) {
        EXPECT_EQ(outcome.number(0, i, precision()), -x[i]);
        EXPECT_EQ(outcome.integer(1, i), keys[i] + 7);
        EXPECT_EQ(outcome.integer(2, i), i % 3 != 0);
      }
    }
  }
}

TEST_P(Lanes, LeaveNestedLoopsByThemselves) {
  // for each lane: collatz steps of k, an inner loop that may leave the outer one, and a return from within
  const ir::Module module = one_entry({Integer, Number}, {Integer, Number}, [](ir::Builder& b) {
    const auto k = b.argument(0), x = b.argument(1);
    const auto n = b.variable("n", Integer), steps = b.variable("steps", Integer), sum = b.variable("sum", Number);
    b.store(n, k);
    b.store(steps, b.integer(0));
    b.store(sum, b.number(0));
    const auto outer = b.label(), inner = b.label();
    b.loop(outer, b.block([&] {
      b.step();
      b.if_else(b.compare(Op::Le, b.load(n), b.integer(1)), b.block([&] { b.break_to(outer); }));
      const auto odd = b.compare(Op::Eq, b.binary(Op::And, b.load(n), b.integer(1)), b.integer(1));
      b.if_else(odd, b.block([&] {
        b.store(n, b.binary(Op::Add, b.binary(Op::Mul, b.load(n), b.integer(3)), b.integer(1)));
      }),
                b.block([&] { b.store(n, b.call_library(row("op_shr"), Integer, {b.load(n), b.integer(1)})); }));
      b.store(steps, b.binary(Op::Add, b.load(steps), b.integer(1)));
      const auto i = b.variable("i", Integer);
      b.store(i, b.integer(0));
      b.loop(inner, b.block([&] {
        b.step();
        b.if_else(b.compare(Op::Le, b.integer(3), b.load(i)), b.block([&] { b.break_to(inner); }));
        b.store(sum, b.binary(Op::Add, b.load(sum), b.binary(Op::Mul, x, b.convert(b.load(i), Number))));
        b.if_else(b.compare(Op::Lt, b.number(100), b.load(sum)), b.block([&] { b.break_to(outer); }));
        b.if_else(b.compare(Op::Lt, b.load(sum), b.number(-100)),
                  b.block([&] { b.return_values({b.integer(-1), b.load(sum)}); }));
        b.store(i, b.binary(Op::Add, b.load(i), b.integer(1)));
      }));
    }));
    b.return_values({b.load(steps), b.load(sum)});
  });
  std::vector<int64_t> keys;
  for (int64_t i = 0; i < 150; ++i)
    keys.push_back(i % 40);
  const Outcome outcome = same_everywhere(module, precision(), {integers(keys), numbers(some_numbers(150, 3))}, 150);
  EXPECT_EQ(outcome.fault_count, 0u);
  EXPECT_EQ(outcome.integer(0, 1), 0);
  EXPECT_THAT(outcome.bits[0], ::testing::Contains(static_cast<uint64_t>(-1)));
}

TEST_P(Lanes, CallTheLibrary) {
  const ir::Module module = one_entry({Vec3, Number}, {Number, Vec3, Integer, Boolean, Vec3}, [](ir::Builder& b) {
    const auto p = b.argument(0), t = b.argument(1);
    const auto uniform = b.call_library(row("sin"), Number, {b.number(0.5)});
    const auto noise = b.call_library(row("noise_vec3"), Number, {p});
    const auto floor = b.call_library(row("math_floor"), Integer, {b.binary(Op::Mul, noise, b.number(10))});
    b.return_values({b.binary(Op::Add, noise, uniform), b.call_library(row("smoothstep"), Vec3, {b.number(0), t, p}),
                     floor, b.result(floor, 1, Boolean), b.call_library(row("normalize_vec3"), Vec3, {p})});
  });
  const size_t count = 77;
  const Outcome outcome = same_everywhere(module, precision(),
                                          {numbers(some_numbers(count)), numbers(some_numbers(count + 1)),
                                           numbers(some_numbers(count + 2)), numbers(some_numbers(count + 3))},
                                          count);
  EXPECT_NEAR(outcome.number(0, 0, precision()), std::sin(0.5), 1.01);
  EXPECT_EQ(outcome.integer(5, 0), 1);
}

TEST_P(Lanes, ComputeEdgesOfIntegers) {
  const auto both = [](std::string_view symbol) {
    return one_entry({Integer, Integer}, {Integer}, [&](ir::Builder& b) {
      b.return_values({b.call_library(row(symbol), Integer, {b.argument(0), b.argument(1)})});
    });
  };
  constexpr int64_t low = std::numeric_limits<int64_t>::min(), high = std::numeric_limits<int64_t>::max();
  std::vector<int64_t> a, c;
  for (const int64_t x : {low, low + 1, int64_t{-7}, int64_t{-1}, int64_t{0}, int64_t{1}, int64_t{7}, high})
    for (const int64_t y : {low, int64_t{-64}, int64_t{-63}, int64_t{-3}, int64_t{-1}, int64_t{1}, int64_t{3},
                            int64_t{63}, int64_t{64}, high}) {
      a.push_back(x);
      c.push_back(y);
    }
  const auto run = [&](std::string_view symbol) {
    return same_everywhere(both(symbol), precision(), {integers(a), integers(c)}, a.size());
  };
  const Outcome quotient = run("op_idiv_integer"), rest = run("op_mod_integer"), shifted = run("op_shl");
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] == low && c[i] == -1) {
      EXPECT_EQ(quotient.integer(0, i), low);
      EXPECT_EQ(rest.integer(0, i), 0);
    }
    if (a[i] == -7 && c[i] == 3) {
      EXPECT_EQ(quotient.integer(0, i), -3);
      EXPECT_EQ(rest.integer(0, i), 2);
    }
    if (c[i] == 64 || c[i] == high) {
      EXPECT_EQ(shifted.integer(0, i), 0);
    }
    if (a[i] == 1 && c[i] == 63) {
      EXPECT_EQ(shifted.integer(0, i), low);
    }
  }
}

TEST_P(Lanes, IndexArraysByLane) {
  const ir::Module module = one_entry({Integer, Number}, {Number, Vec2, Boolean}, [](ir::Builder& b) {
    const auto k = b.argument(0), x = b.argument(1);
    const auto table = b.variable("table", Number, 5), squares = b.variable("squares", Vec2, 9);
    const auto flags = b.variable("flags", Boolean, 4);
    for (int i = 0; i < 5; ++i)
      store_element(b, table, b.integer(i), b.number(i * 10));
    for (int i = 0; i < 9; ++i)
      store_element(b, squares, b.integer(i), b.construct(Vec2, {x, b.number(i)}));
    for (int i = 0; i < 4; ++i)
      store_element(b, flags, b.integer(i), b.compare(Op::Lt, x, b.number(i)));
    const auto inside = b.binary(Op::And, k, b.integer(3));
    b.if_else(b.compare(Op::Lt, x, b.number(0)), b.block([&] {
      store_element(b, squares, inside, b.construct(Vec2, {b.number(-1), b.number(-1)}));
      store_element(b, flags, inside, b.boolean(false));
    }));
    b.return_values({load_element(b, table, inside, Number), load_element(b, squares, inside, Vec2),
                     load_element(b, flags, inside, Boolean)});
  });
  std::vector<int64_t> keys;
  for (int64_t i = 0; i < 70; ++i)
    keys.push_back(i * 5);
  const auto x = some_numbers(70, 6);
  const Outcome outcome = same_everywhere(module, precision(), {integers(keys), numbers(x)}, 70);
  for (size_t i = 0; i < 70; ++i) {
    EXPECT_EQ(outcome.number(0, i, precision()), static_cast<double>(keys[i] % 4) * 10);
    EXPECT_EQ(outcome.number(2, i, precision()), x[i] < 0 ? -1 : static_cast<double>(keys[i] % 4));
    EXPECT_EQ(outcome.integer(3, i), x[i] >= 0 && x[i] < static_cast<double>(keys[i] % 4));
  }
}

TEST_P(Lanes, SeeUniformInputsAndConstants) {
  ir::Module module = one_entry({Number, Number}, {Number, Vec3}, [](ir::Builder& b) {
    b.return_values({b.binary(Op::Add, b.argument(0), b.argument(1)), b.load_global(1, Vec3)});
  });
  module.globals = {{"scale", Number, 1, 0}, {"tint", Vec3, 1, ir::kNone}, {"flag", Boolean, 1, ir::kNone}};
  {
    ir::Builder b(module.functions[module.init]);
    b.store_global(1, b.construct(Vec3, {b.load_global(0, Number), b.number(2), b.number(3)}));
    b.store_global(2, b.compare(Op::Lt, b.load_global(0, Number), b.number(1)));
  }
  ASSERT_THAT(ir::verify(module), ::testing::IsEmpty());
  for (const unsigned width : kWidths) {
    codegen::Options options;
    options.precision = precision();
    options.width = width;
    options.uniform_inputs = {"x1"};
    CompiledModule compiled(module, options);
    const float scale = 0.5f;
    const double wide_scale = 0.5;
    std::byte* parameter = compiled.constants.data() + compiled.info().global_offsets[0];
    if (precision() == Precision::F32)
      std::memcpy(parameter, &scale, sizeof scale);
    else
      std::memcpy(parameter, &wide_scale, sizeof wide_scale);
    EXPECT_EQ(compiled.initialise(), 0u);
    EXPECT_EQ(compiled.constants[compiled.info().global_offsets[2]], std::byte{1});
    const auto x = some_numbers(45);
    const Outcome outcome = compiled.run({numbers(x), numbers({64})}, 45);
    for (size_t i = 0; i < 45; ++i) {
      EXPECT_NEAR(outcome.number(0, i, precision()), x[i] + 64, 1e-5);
      EXPECT_EQ(outcome.number(1, i, precision()), 0.5);
      EXPECT_EQ(outcome.number(3, i, precision()), 3);
    }
  }
}

} // namespace
} // namespace moonshade
