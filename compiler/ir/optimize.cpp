// optimize: all passes in their order.
#include "compiler/ir/passes.h"
#include "compiler/ir/print.h"
#include "compiler/ir/verify.h"

#include <cstdio>
#include <cstdlib>

namespace moonshade::ir {
namespace {

/// In debug builds: a pass that breaks the rules is a defect, reported with the module as it left it.
void check([[maybe_unused]] const Module& module, [[maybe_unused]] const char* pass) {
#ifndef NDEBUG
  const std::vector<std::string> violations = verify(module);
  if (violations.empty()) return;
  for (const std::string& violation : violations)
    std::fprintf(stderr, "after %s: %s\n", pass, violation.c_str());
  std::fprintf(stderr, "%s", to_text(module).c_str());
  std::abort();
#endif
}

} // namespace

void optimize(Module& module, Precision precision) {
  check(module, "build");
  remove_unreachable(module);
  check(module, "remove_unreachable");
  simplify(module);
  check(module, "simplify");
  if (precision == Precision::F32) fuse(module);
  check(module, "fuse");
  remove_bounded_steps(module);
  check(module, "remove_bounded_steps");
  for (Function& function : module.functions)
    split_counters(function);
  check(module, "split_counters");
  remove_unreachable(module); // calls behind folded ifs are gone
  check(module, "remove_unreachable");
}

} // namespace moonshade::ir
