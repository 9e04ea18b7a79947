// Programs of the IR at random: nested control flow that divides the lanes in every way, calls with captures, arrays,
// faults, few steps. Every width must give the bits and faults of one lane.
//
// MOONSHADE_RANDOM_PROGRAMS sets how many programs are tried, MOONSHADE_RANDOM_SEED the first one's seed.
#include "runtime/module_fixture.h"

#include <cstdlib>

namespace moonshade {
namespace {

using enum ValueType;
using ir::Op;
using ir::ValueId;
using namespace testing;

constexpr unsigned kFunctions = 3; ///< function 0 is the entry, 1 init, the others callees
constexpr uint32_t kNumbers = 3, kIntegers = 3, kElements = 4;

/// Writes the body of one function. Variables: numbers, integers, a vector, an array; callees have the first number and
/// the array as captures.
class RandomFunction {
public:
  RandomFunction(std::mt19937& random, ir::Function& function, unsigned self)
      : random_(random), b_(function), self_(self), budget_(self == 0 ? 60 : 25) {}

  void write() {
    const bool callee = self_ != 0;
    numbers_.push_back(callee ? 0 : b_.variable("n0", Number));
    array_ = callee ? 1 : b_.variable("array", Number, kElements);
    for (uint32_t i = 1; i < kNumbers; ++i)
      numbers_.push_back(b_.variable("n" + std::to_string(i), Number));
    for (uint32_t i = 0; i < kIntegers; ++i)
      integers_.push_back(b_.variable("k" + std::to_string(i), Integer));
    vector_ = b_.variable("v", Vec2);
    if (!callee) {
      b_.store(numbers_[0], b_.argument(0));
      for (uint32_t i = 0; i < kElements; ++i)
        store_element(b_, array_, b_.integer(i), b_.number(i));
    }
    for (uint32_t i = 1; i < kNumbers; ++i)
      b_.store(numbers_[i], pick(2) ? b_.argument(0) : b_.number(i));
    for (uint32_t i = 0; i < kIntegers; ++i)
      b_.store(integers_[i], pick(2) ? b_.argument(1) : b_.integer(i));
    b_.store(vector_, b_.construct(Vec2, {b_.argument(0), b_.number(1)}));
    block(0);
    if (!b_.terminated()) leave();
  }

private:
  unsigned pick(unsigned count) { return std::uniform_int_distribution<unsigned>(0, count - 1)(random_); }

  ValueId number(int depth) {
    switch (depth > 3 ? pick(4) : pick(12)) {
    case 0:
      return b_.number((static_cast<int>(pick(17)) - 8) / 4.0);
    case 1:
      return b_.argument(0);
    case 2:
    case 3:
      return b_.load(numbers_[pick(kNumbers)]);
    case 4:
      return b_.convert(integer(depth + 1), Number);
    case 5:
      return b_.binary(Op::Add, number(depth + 1), number(depth + 1));
    case 6:
      return b_.binary(Op::Sub, number(depth + 1), number(depth + 1));
    case 7:
      return b_.binary(Op::Mul, number(depth + 1), number(depth + 1));
    case 8:
      return b_.binary(Op::Div, number(depth + 1), number(depth + 1));
    case 9:
      return load_element(b_, array_, inside(), Number);
    case 10:
      return b_.component(b_.load(vector_), pick(2));
    default:
      return b_.select(condition(depth + 1), number(depth + 1), number(depth + 1));
    }
  }

  ValueId integer(int depth) {
    switch (depth > 3 ? pick(4) : pick(8)) {
    case 0:
      return b_.integer(static_cast<int>(pick(9)) - 4);
    case 1:
      return b_.argument(1);
    case 2:
    case 3:
      return b_.load(integers_[pick(kIntegers)]);
    case 4:
      return b_.binary(Op::Add, integer(depth + 1), integer(depth + 1));
    case 5:
      return b_.binary(Op::Mul, integer(depth + 1), integer(depth + 1));
    case 6:
      return b_.binary(Op::Xor, integer(depth + 1), integer(depth + 1));
    default:
      return b_.call_library(row("op_mod_integer"), Integer, {integer(depth + 1), b_.integer(5)});
    }
  }

  ValueId condition(int depth) {
    switch (pick(6)) {
    case 0:
      return b_.compare(Op::Lt, integer(depth + 1), integer(depth + 1));
    case 1:
      return b_.compare(Op::Eq, b_.binary(Op::And, integer(depth + 1), b_.integer(3)), b_.integer(pick(4)));
    case 2:
      return b_.compare(Op::Le, number(depth + 1), number(depth + 1));
    case 3:
      return depth > 2 ? b_.boolean(pick(2)) : b_.unary(Op::Not, condition(depth + 1));
    case 4:
      return b_.compare(Op::Ne, b_.load(vector_), b_.construct(Vec2, {number(depth + 1)}));
    default:
      return b_.compare(Op::Lt, b_.argument(0), b_.number(static_cast<int>(pick(9)) - 4));
    }
  }

  ValueId inside() { return b_.binary(Op::And, integer(2), b_.integer(kElements - 1)); }

  void leave() { b_.return_values({number(1), integer(1)}); }

  void block(int depth) {
    const unsigned statements = 1 + pick(4);
    for (unsigned i = 0; i < statements && budget_ > 0 && !b_.terminated(); ++i)
      statement(depth);
  }

  void statement(int depth) {
    --budget_;
    switch (depth > 5 ? pick(5) : pick(14)) {
    case 0:
    case 1:
      return b_.store(numbers_[pick(kNumbers)], number(0));
    case 2:
      return b_.store(integers_[pick(kIntegers)], integer(0));
    case 3:
      return b_.store(vector_, b_.construct(Vec2, {number(1), number(1)}));
    case 4:
      return store_element(b_, array_, inside(), number(1));
    case 5:
    case 6:
      b_.if_else(condition(0), b_.block([&] { block(depth + 1); }), b_.block([&] {
        if (pick(2)) block(depth + 1);
      }));
      return;
    case 7:
    case 8:
      return loop(depth);
    case 9: {
      const auto label = b_.label();
      labels_.push_back(label);
      b_.scope(label, b_.block([&] { block(depth + 1); }));
      labels_.pop_back();
      return;
    }
    case 10:
      if (labels_.empty()) return;
      b_.if_else(condition(0), b_.block([&] { b_.break_to(labels_[pick(labels_.size())]); }));
      return;
    case 11:
      if (pick(2)) b_.if_else(condition(0), b_.block([&] { leave(); }));
      return;
    case 12:
      if (pick(3) == 0)
        b_.fault(b_.binary(Op::And, condition(0), condition(0)), pick(2) ? FaultCode::Assert : FaultCode::Index);
      return;
    default:
      return call();
    }
  }

  void loop(int depth) {
    const auto i = b_.variable("i", Integer);
    const auto label = b_.label();
    const ValueId count = pick(2) ? b_.binary(Op::And, integer(1), b_.integer(7)) : b_.integer(pick(6));
    b_.store(i, b_.integer(0));
    labels_.push_back(label);
    b_.loop(label, b_.block([&] {
      b_.step();
      if (pick(8) != 0) b_.if_else(b_.compare(Op::Le, count, b_.load(i)), b_.block([&] { b_.break_to(label); }));
      b_.store(i, b_.binary(Op::Add, b_.load(i), b_.integer(1)));
      if (pick(2)) {
        const auto own = b_.variable("own", Number); // declared in the loop
        b_.store(own, number(1));
        b_.if_else(condition(1), b_.block([&] { b_.store(own, number(1)); }));
        b_.store(numbers_[pick(kNumbers)], b_.load(own));
      }
      block(depth + 1);
    }));
    labels_.pop_back();
  }

  void call() {
    const unsigned callee = self_ == 0 ? 2 + pick(kFunctions - 1) : self_ + 1;
    if (callee > kFunctions) return;
    static constexpr ValueType results[] = {Number, Integer};
    const auto got = b_.call(callee, results, {number(1), integer(1)}, {numbers_[pick(kNumbers)], array_});
    b_.store(numbers_[pick(kNumbers)], got);
    b_.store(integers_[pick(kIntegers)], b_.result(got, 1, Integer));
  }

  std::mt19937& random_;
  ir::Builder b_;
  unsigned self_;
  int budget_;
  ir::VariableId array_ = 0, vector_ = 0;
  std::vector<ir::VariableId> numbers_, integers_;
  std::vector<ir::LabelId> labels_;
};

ir::Module random_module(unsigned seed) {
  std::mt19937 random(seed);
  ir::Module module;
  module.functions.resize(kFunctions + 1);
  for (unsigned i = 0; i < module.functions.size(); ++i) {
    ir::Function& function = module.functions[i];
    function.name = "f" + std::to_string(i);
    if (i == 1) continue;
    function.parameters = {Number, Integer};
    function.parameter_names = {"x", "k"};
    function.results = {Number, Integer};
    if (i > 1) {
      function.variables = {{"captured", Number, 1}, {"elements", Number, kElements}};
      function.captures = 2;
    }
    RandomFunction(random, function, i).write();
  }
  module.entries.push_back({"main", 0});
  module.init = 1;
  module.step_limit = 20 + random() % 200;
  return module;
}

unsigned setting(const char* name, unsigned otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? static_cast<unsigned>(std::atoi(text)) : otherwise;
}

using RandomPrograms = DomainTest;
INSTANTIATE_TEST_SUITE_P(, RandomPrograms, both_precisions(), precision_name);

TEST_P(RandomPrograms, AgreeAtEveryWidth) {
  const unsigned first = setting("MOONSHADE_RANDOM_SEED", 1), count = setting("MOONSHADE_RANDOM_PROGRAMS", 25);
  constexpr size_t kPoints = 75;
  std::vector<int64_t> keys;
  for (int64_t i = 0; i < int64_t{kPoints}; ++i)
    keys.push_back((i * 29) % 23 - 7);
  for (unsigned seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    codegen::Options options;
    if (seed % 4 == 0) options.uniform_inputs = {"k"};
    const std::vector<int64_t> integers_given = seed % 4 == 0 ? std::vector<int64_t>{5} : keys;
    same_everywhere(random_module(seed), precision(), {numbers(some_numbers(kPoints)), integers(integers_given)},
                    kPoints, options);
    if (HasFailure()) return;
  }
}

} // namespace
} // namespace moonshade
