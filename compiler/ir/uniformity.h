// Uniformity: which values differ between the lanes of one call, and which control flow they divide. Code generation
// for W lanes keeps a uniform value in a scalar and a varying one in a vector; where nothing varies in the arguments
// (or W = 1), nothing varies at all, so one emitter serves every width.
//
// The emitter keeps a mask of the lanes that execute. CONTRACT, what it must do with the answers:
//
//   values       A uniform value has, for every lane that executes it, the same value: compute it as a scalar.
//                A varying one is a vector; uniform operands are broadcast where an instruction is varying.
//   variables    A uniform variable is a scalar slot; every store to it is one scalar store, whatever the mask. A
//   varying
//                variable is a vector slot; stores blend by the mask. (A varying index makes gathers and scatters.)
//   if           varying: run block 0 under mask & c and block 1 under mask & ~c; behind it the mask is the union of
//   what
//                both left. A block that contains a loop or a call must be skipped where its mask is empty (a uniform
//                loop that no lane executes need not end); others may be skipped. Uniform: a branch on the scalar.
//   break        varying: the lanes of the mask wait behind the target, the mask becomes empty. Where the break ends a
//                block of a varying `if`, the union behind the `if` drops them. Not varying: all lanes that are still
//                in the target take it, so it is a jump to the code behind the target.
//   return       the same with the function as target: varying: store the results under the mask, drop its lanes to the
//                end of the function. Not varying: a jump there. (Results: see results_varying.)
//   loop, scope  varying: some lanes may leave it while others stay: behind it the mask is the mask at its beginning
//   less
//                the lanes that left for further out (break of an outer label, return, fault). A varying loop ends when
//                its mask is empty. Not varying: left by jumps alone, the mask is not touched.
//   fault, step  Kill lanes: they execute nothing from there on, in this function or its callers; the rest of the batch
//                goes on. Dead lanes make nothing varying, whether the condition was uniform or not: stores to uniform
//                variables go on without them. Because they may be the last lanes, a construct with `may_kill` must be
//                left when no live lane remains: test the mask at the back edge of each loop with may_kill (else the
//                step limit would not end it), and after a call with may_kill that is followed by a loop. Code that
//                runs without live lanes in between must be harmless: clamp element indices by select, or skip.
//   call         runs the callee for the signature in `calls`, with the current mask. Captures are passed as pointers
//   to
//                slots, scalar or vector by Signature::captures_varying. (The callee's stores to uniform captures are
//                right for the mask it is entered with: the analysis made varying what would not be.)
//   results      results_varying says how the callee gives each result back.
//
// A function is compiled once for each signature that is really used: start from the entries, follow `calls`.
#pragma once

#include "compiler/ir/ir.h"

#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace moonshade::ir {

/// What a caller says of a call.
struct Signature {
  std::vector<bool> arguments_varying; ///< by parameter
  std::vector<bool> captures_varying;  ///< by capture: the slot that is bound is a vector
  /// The lanes that call are not all the lanes that see the captured variables afterwards; always false without
  /// captures. The emitter need not look at it, but it is part of the key: what is varying inside depends on it.
  bool partial = false;

  friend bool operator<(const Signature& a, const Signature& b) {
    return std::tie(a.arguments_varying, a.captures_varying, a.partial) <
           std::tie(b.arguments_varying, b.captures_varying, b.partial);
  }
  friend bool operator==(const Signature&, const Signature&) = default;
};

/// The answers for one function and signature.
struct Uniformity {
  std::vector<bool> value_varying;    ///< by ValueId; of calls: their first result
  std::vector<bool> variable_varying; ///< by VariableId, captures included
  std::vector<bool> control_varying;  ///< by ValueId of If, Loop, Scope, Break and Return
  std::vector<bool> may_kill;         ///< by ValueId: a Fault or Step, a Call, If, Loop or Scope that contains one
  std::vector<bool> results_varying;  ///< by result
  bool function_may_kill = false;
  std::unordered_map<ValueId, Signature> calls; ///< by ValueId of a Call: what it asks of its callee

  bool varying(ValueId value) const { return value_varying[value]; }
};

/// Answers so far, shared by one compilation. References to its entries stay valid.
using UniformityTable = std::map<std::pair<FunctionId, Signature>, Uniformity>;

/// The answers for `function` called as `signature` says; those of its callees are in the table afterwards too.
/// `signature.captures_varying` must already hold for the caller's variables (analyse of the caller sees to it; an
/// entry has no captures).
const Uniformity& analyse_uniformity(const Module& module, FunctionId function, const Signature& signature,
                                     UniformityTable& table);

/// The signature of an entry whose inputs all vary, except those for which `uniform_inputs` is set.
Signature entry_signature(const Function& function, const std::vector<bool>& uniform_inputs = {});

} // namespace moonshade::ir
