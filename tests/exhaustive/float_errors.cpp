// Errors of the library's functions of floats, in units in the last place: of one number over all 2^32 floats, of two
// over a sample (float_errors_for_test.h has the references). The rows come from the table: a function of one number
// without a reference is an error.
#include "stdlib/float_errors_for_test.h"
#include "stdlib/signature.h"
#include "tests/exhaustive/exhaustive.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>
#include <string_view>

namespace moonshade::exhaustive {
namespace {

using namespace stdlib;

constexpr int kLanes = 16;
constexpr size_t kBlock = 4096;
using W = Wide<float, kLanes>;

/// The greatest error of blocks.
struct Worst : test::WorstError {
  using WorstError::add;
  /// First by arithmetic that the compiler makes vectors of, then, where that found a greater error or no number, with
  /// care.
  void add(const float* found, const double* expected, const float* xs, const float* ys) {
    constexpr int kPart = 64;
    for (size_t first = 0; first < kBlock; first += kPart) {
      bool all = true;
      for (size_t i = first; i < first + kPart; ++i) {
        const uint64_t bits = std::bit_cast<uint64_t>(expected[i]), exponent = bits >> 52 & 2047;
        const uint64_t of_unit = (exponent < 1023 - 126 ? 1023 - 126 : exponent) - 23;
        const double unit = std::bit_cast<double>(of_unit << 52);
        const double difference = std::abs(double(found[i]) - expected[i]);
        const uint64_t sign = (bits >> 63) ^ (std::bit_cast<uint32_t>(found[i]) >> 31);
        all &= bool(int(difference <= error * unit) & int(difference < 0x1p1000) & int(sign == 0));
      }
      if (all) continue;
      for (size_t i = first; i < first + kPart; ++i)
        add(test::error_in_ulps(found[i], expected[i]), xs[i], ys == nullptr ? 0 : ys[i]);
    }
  }
  void add(const Worst& other) { add(other.error, other.x, other.y); }
};

// Functions of one number ---------------------------------------------------------------------------------------------

/// Noise over numbers: check_ranges looks at it.
constexpr std::string_view kNoises[] = {"noise", "perlin", "valuenoise", "cellnoise"};

/// body(first, count) over all floats, in blocks by their bits, on threads; `state` is one thread's.
template <class State, class Body> State over_all_floats(const Options& options, Body body) {
  std::vector<State> states(options.threads);
  const uint64_t blocks = (uint64_t(1) << 32) / (kBlock * options.stride);
  on_threads(options.threads, [&](unsigned thread) {
    std::array<float, kBlock> x;
    State state;
    // Every so many blocks, so that the slow exponents are shared out.
    for (uint64_t block = thread; block < blocks; block += options.threads) {
      for (size_t i = 0; i < kBlock; ++i)
        x[i] = std::bit_cast<float>(uint32_t((block * kBlock + i) * options.stride));
      body(state, x);
    }
    states[thread] = state;
  });
  for (unsigned i = 1; i < options.threads; ++i)
    states[0].add(states[i]);
  return states[0];
}

bool report(std::string_view function, const Worst& worst, double limit) {
  const bool holds = worst.error <= limit;
  std::printf("%.*s: %.3f ulp at %a%s\n", int(function.size()), function.data(), worst.error, double(worst.x),
              holds ? "" : ", which is too much");
  std::fflush(stdout);
  return holds;
}

template <class F> bool check_one(const Options& options, std::string_view function, F call) {
  const auto* const row = std::ranges::find(test::kOneNumber, function, &test::OneNumber::function);
  if (row == std::end(test::kOneNumber)) {
    std::printf("%.*s: there is no reference for it\n", int(function.size()), function.data());
    return false;
  }
  const Worst worst = over_all_floats<Worst>(options, [&](Worst& state, const std::array<float, kBlock>& x) {
    std::array<float, kBlock> found;
    std::array<double, kBlock> expected;
    for (size_t i = 0; i < kBlock; i += kLanes) {
      W lanes;
      std::memcpy(&lanes, &x[i], sizeof lanes);
      const W result = call(lanes);
      std::memcpy(&found[i], &result, sizeof result);
    }
    for (size_t i = 0; i < kBlock; ++i)
      expected[i] = row->reference(double(x[i]));
    state.add(found.data(), expected.data(), x.data(), nullptr);
  });
  return report(function, worst, row->limit);
}

/// Where a float becomes an integer: it is the one that C gives, or there is none.
struct Wrong {
  uint64_t count = 0;
  float x = 0;
  void add(const Wrong& other) {
    if (other.count) x = other.x;
    count += other.count;
  }
};
int64_t integer_of(double whole) { return whole >= -0x1p63 && whole < 0x1p63 ? int64_t(whole) : 0; }

template <class F> bool check_integer(const Options& options, std::string_view function, F call) {
  const Wrong wrong = over_all_floats<Wrong>(options, [&](Wrong& state, const std::array<float, kBlock>& x) {
    for (size_t i = 0; i < kBlock; i += kLanes) {
      W lanes;
      std::memcpy(&lanes, &x[i], sizeof lanes);
      const auto result = call(lanes);
      for (int lane = 0; lane < kLanes; ++lane) {
        const double at = double(lanes[lane]);
        const double whole = function == "ceil_to_integer" ? std::ceil(at) : std::floor(at);
        const bool is_one = whole >= -0x1p63 && whole < 0x1p63 && (function != "exact_integer" || whole == at);
        if (result.first[lane] != (is_one ? integer_of(whole) : 0) || (result.second.bits[lane] != 0) != is_one)
          ++state.count, state.x = lanes[lane];
      }
    }
  });
  std::printf("%.*s: %llu floats wrong", int(function.size()), function.data(),
              static_cast<unsigned long long>(wrong.count));
  std::printf(wrong.count ? ", as %a\n" : "\n", double(wrong.x));
  std::fflush(stdout);
  return wrong.count == 0;
}

/// A colour's components, whose greatest is 1, against the same formula in double: in units of 2^-24.
template <class F> bool check_color(const Options& options, std::string_view function, F call) {
  const Worst worst = over_all_floats<Worst>(options, [&](Worst& state, const std::array<float, kBlock>& x) {
    using D = Wide<double, kLanes>;
    for (size_t i = 0; i < kBlock; i += kLanes) {
      W lanes;
      std::memcpy(&lanes, &x[i], sizeof lanes);
      const Vec<3, W> found = call(lanes);
      const Vec<3, D> expected = blackbody<D>(convert<D>(lanes));
      for (int c = 0; c < 3; ++c) {
        const D error = abs(convert<D>(found[c]) - expected[c]);
        for (int lane = 0; lane < kLanes; ++lane)
          if (lanes[lane] == lanes[lane] || found[c][lane] == found[c][lane])
            state.add(error[lane] * 0x1p24, lanes[lane], 0);
      }
    }
  });
  return report(function, worst, 1);
}

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#include "stdlib/table.def"

/// The row's check, where it is a function of one number that is looked at here.
template <class Row>
bool check_row(const Options& options, std::string_view name, std::vector<std::string_view>& seen) {
  using Of = typename Row::template Of<W>;
  using Type = typename Of::Type;
  constexpr bool number = std::is_same_v<Type, W(W)>, integer = std::is_same_v<Type, Results<Int<W>, Mask<W>>(W)>;
  if (!options.wants(std::string(name)) || std::ranges::count(seen, name) || std::ranges::count(kNoises, name))
    return true;
  const auto call = [](const auto& x) { return Of::call(x); };
  if constexpr (number || integer) seen.push_back(name);
  if constexpr (number) return check_one(options, name, call);
  if constexpr (integer) return check_integer(options, name, call);
  if constexpr (std::is_same_v<Type, Vec<3, W>(W)>)
    if (name == "blackbody") return check_color(options, name, call);
  return true;
}

// Functions of two numbers --------------------------------------------------------------------------------------------

using Call = W (*)(W, W);
Call call_of(std::string_view symbol) {
  if (symbol == "pow") return [](W x, W y) { return stdlib::pow(x, y); };
  if (symbol == "atan2") return [](W y, W x) { return stdlib::atan2(y, x); };
  if (symbol == "math_log_to_base") return [](W x, W y) { return log_to_base(x, y); };
  if (symbol == "math_fmod") return [](W x, W y) { return stdlib::fmod(x, y); };
  if (symbol == "mod") return [](W x, W y) { return mod(x, y); };
  return nullptr;
}

Worst worst_of_two(const Options& options, const test::TwoNumbers& two, Call call) {
  std::vector<Worst> states(options.threads);
  const uint64_t blocks = (options.samples + kBlock - 1) / kBlock;
  on_threads(options.threads, [&](unsigned thread) {
    std::array<float, kBlock> x, y, found;
    std::array<double, kBlock> expected;
    Worst state;
    for (uint64_t block = thread; block < blocks; block += options.threads) {
      for (size_t i = 0; i < kBlock; ++i) {
        const uint64_t counter = 2 * (block * kBlock + i);
        x[i] = test::some_float(test::random_bits(counter)), y[i] = test::some_float(test::random_bits(counter + 1));
        if (!two.compares(x[i], y[i])) y[i] = x[i];
        expected[i] = two.reference(double(x[i]), double(y[i]));
      }
      for (size_t i = 0; i < kBlock; i += kLanes) {
        W a, b;
        std::memcpy(&a, &x[i], sizeof a);
        std::memcpy(&b, &y[i], sizeof b);
        const W result = call(a, b);
        std::memcpy(&found[i], &result, sizeof result);
      }
      state.add(found.data(), expected.data(), x.data(), y.data());
    }
    states[thread] = state;
  });
  for (const Worst& state : states)
    states[0].add(state);
  return states[0];
}

} // namespace

bool check_floats(const Options& options) {
  bool holds = true;
  std::vector<std::string_view> seen;
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  holds &= check_row<Row_##symbol>(options, #function, seen);
#include "stdlib/table.def"
  return holds;
}

bool check_pairs(const Options& options) {
  bool holds = true;
  for (const test::TwoNumbers& two : test::kTwoNumbers) {
    const Call call = call_of(two.symbol);
    if (!options.wants(std::string(two.symbol))) continue;
    const Worst worst = call == nullptr ? Worst{{INFINITY}} : worst_of_two(options, two, call);
    std::printf("%.*s: %.3f ulp at %a %a%s\n", int(two.symbol.size()), two.symbol.data(), worst.error, double(worst.x),
                double(worst.y), worst.error <= two.limit ? "" : ", which is too much");
    std::fflush(stdout);
    holds &= worst.error <= two.limit;
  }
  return holds;
}

} // namespace moonshade::exhaustive
