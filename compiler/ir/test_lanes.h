// For tests: executes a function for several points at once as code for W lanes does, by the contract in uniformity.h:
// one scalar for what the analysis calls uniform, masks where it says varying. Whatever the contract promises of what
// is not varying is checked on the way.
#pragma once

#include "compiler/ir/test_interpreter.h"
#include "compiler/ir/uniformity.h"

namespace moonshade::ir::test {

struct LanesOutcome {
  std::vector<Outcome> lanes;
  std::vector<std::string> broken_promises;
};

/// `points[lane][argument]`; arguments for which `uniform_inputs` is set are the same in all lanes.
LanesOutcome run_lanes(const Module& module, const std::vector<Value>& parameters, FunctionId entry,
                       const std::vector<std::vector<Value>>& points, const std::vector<bool>& uniform_inputs);

} // namespace moonshade::ir::test
