// bake_parameters: parameters become data that nobody stores, which forward_constant_globals knows to be constant.
//
// It runs on a module that is optimised already: which products and sums are one rounding was decided before (fuse),
// and what is folded from there on gives the bits that it would have had at run time. So baked code gives what code
// with these values gives.
#include "compiler/ir/passes.h"

namespace moonshade::ir {

namespace {

/// The global's data: `value` in its type.
void set_data(Global& global, const Constant& value) {
  if (const auto* boolean = std::get_if<bool>(&value)) {
    global.integers = {*boolean ? 1 : 0};
  } else if (const auto* integer = std::get_if<int64_t>(&value)) {
    if (global.type == ValueType::Integer)
      global.integers = {*integer};
    else
      global.numbers = {static_cast<double>(*integer)};
  } else if (const auto* number = std::get_if<double>(&value)) {
    global.numbers = {*number};
  } else if (const auto* vector = std::get_if<std::vector<double>>(&value)) {
    global.numbers = *vector;
  }
}

} // namespace

void bake_parameters(Module& module, const std::vector<Constant>& values) {
  for (Global& global : module.globals) {
    if (global.parameter == kNone) continue;
    set_data(global, values[global.parameter]);
    global.parameter = kNone;
  }
  // What the top level makes of constants is known once init is folded, and then what it makes of that.
  size_t globals = 0;
  do {
    globals = module.globals.size();
    simplify(module);
  } while (module.globals.size() < globals);
  remove_bounded_steps(module);
  remove_unreachable(module);
}

} // namespace moonshade::ir
