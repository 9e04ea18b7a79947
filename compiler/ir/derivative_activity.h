// Which derivatives exist: for each value and variable of a function, the components and directions in which it may
// depend on what is differentiated by. A part of `derivative` (derivative.h).
#pragma once

#include "compiler/ir/derivative.h"

#include <bitset>
#include <map>
#include <vector>

namespace moonshade::ir {

/// Bit component * kMaxDirections + direction.
class Activity {
public:
  bool at(unsigned component, unsigned direction) const { return bits_[component * kMaxDirections + direction]; }
  void set(unsigned component, unsigned direction) { bits_.set(component * kMaxDirections + direction); }
  bool any() const { return bits_.any(); }
  bool any(unsigned component) const {
    for (unsigned direction = 0; direction < kMaxDirections; ++direction)
      if (at(component, direction)) return true;
    return false;
  }
  unsigned count() const { return static_cast<unsigned>(bits_.count()); }

  /// Adds what another has; true where that was new.
  bool add(const Activity& other) {
    const auto before = bits_;
    bits_ |= other.bits_;
    return bits_ != before;
  }
  void add_component(unsigned component, const Activity& other, unsigned from) {
    for (unsigned direction = 0; direction < kMaxDirections; ++direction)
      if (other.at(from, direction)) set(component, direction);
  }

  friend bool operator==(const Activity&, const Activity&) = default;
  friend bool operator<(const Activity& a, const Activity& b) {
    for (size_t i = 0; i < a.bits_.size(); ++i)
      if (a.bits_[i] != b.bits_[i]) return b.bits_[i];
    return false;
  }

private:
  std::bitset<16 * kMaxDirections> bits_;
};

/// A function and what its arguments and captures have.
struct ActivityKey {
  FunctionId function;
  std::vector<Activity> arguments, captures;
  friend bool operator<(const ActivityKey& a, const ActivityKey& b) {
    return std::tie(a.function, a.arguments, a.captures) < std::tie(b.function, b.arguments, b.captures);
  }
};

struct FunctionActivity {
  std::vector<Activity> values;    ///< by ValueId; of calls: their first result
  std::vector<Activity> variables; ///< by VariableId; captures as they are after the call
  std::vector<Activity> results;
  bool any() const;
};

class ActivityAnalysis {
public:
  explicit ActivityAnalysis(const Module& module) : module_(module) {}

  /// References stay valid.
  const FunctionActivity& of(const ActivityKey& key);

  /// What a call asks of its callee, by the activity of the function in which it stands.
  static ActivityKey key_of(const Instruction& call, const FunctionActivity& activity);

  /// By which of its parameters a call of the library has a derivative here: a bit each.
  static unsigned active_parameters(const Instruction& call, const FunctionActivity& activity);

private:
  FunctionActivity analyse(const ActivityKey& key);
  Activity value(const Function& function, ValueId id, const ActivityKey& key, FunctionActivity& activity,
                 bool& changed);

  const Module& module_;
  std::map<ActivityKey, FunctionActivity> known_;
};

/// What the derivative of a call of a derivative of the library takes, by `parameters` (a bit each): the second
/// derivative of the same row by all parameters that either has, and which of its columns are those of the first.
struct SecondCall {
  const LibraryDerivative* first = nullptr;
  const LibraryDerivative* whole = nullptr;
  const LibrarySecondDerivative* second = nullptr; ///< null where there is none
  bool is_missing = false;                         ///< there should be one
  std::vector<unsigned> columns;

  SecondCall(const LibraryFunction& derivative, unsigned parameters);
  /// A bit for each component of result `index` of the first that can depend on column k of the whole.
  unsigned used(uint32_t index, unsigned k) const;
};

/// Components of the operand of a call of the library by component, where the call's component is `component`.
inline unsigned operand_component(const Function& function, ValueId operand, unsigned component) {
  return component_count(function.instructions[operand].type) == 1 ? 0 : component;
}

} // namespace moonshade::ir
