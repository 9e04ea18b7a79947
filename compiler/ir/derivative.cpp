// The derivative of functions by rewriting them (derivative.h): one walk over the blocks of a function makes its
// derivative, with the activity of each value known before (derivative_activity.h).
#include "compiler/ir/derivative.h"

#include "compiler/ir/builder.h"
#include "compiler/ir/derivative_activity.h"
#include "compiler/ir/waits.h"
#include "compiler/ir/walk.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <string>
#include <unordered_map>

namespace moonshade::ir {
namespace {

/// The derivatives of a value: a number by component and direction, or kNone where it is zero. Empty: all are.
using Tangents = std::vector<ValueId>;

/// Calls visit(component, direction) for each that is set.
template <class Visit> void for_each_active(const Activity& activity, ValueType type, Visit&& visit) {
  for (unsigned c = 0; c < component_count(type); ++c)
    for (unsigned k = 0; k < kMaxDirections; ++k)
      if (activity.at(c, k)) visit(c, k);
}

class Differentiator;

/// Makes one function's derivative.
class Writer {
public:
  Writer(Differentiator& owner, const Module& module, const ActivityKey& key, const FunctionActivity& activity,
         std::span<const uint32_t> seeds)
      : owner_(owner), source_(module.functions[key.function]), key_(key), activity_(activity), seeds_(seeds),
        values_(source_.instructions.size(), kNone), tangents_(source_.instructions.size()) {}

  Function write();

private:
  void declare_signature();
  void declare_variables();
  void clear_captures();
  void walk(const Block& block);
  void visit(ValueId id);
  void copy(ValueId id);
  void argument(ValueId id);
  void load(ValueId id);
  void store(ValueId id);
  void return_values(ValueId id);
  void arithmetic(ValueId id);
  void compose(ValueId id);
  void library_call(ValueId id);
  void inverse(ValueId id);
  void library_call_by_component(ValueId id);
  void derivative_call(ValueId id);
  ValueId differentiate_call(const LibraryFunction& row, unsigned parameters, const std::vector<ValueId>& operands,
                             const std::vector<Tangents>& tangents, std::vector<Tangents>& results);
  void call(ValueId id);
  void nested(ValueId id);

  std::vector<ValueId> values_of(const std::vector<ValueId>& sources) const {
    std::vector<ValueId> values(sources.size());
    std::ranges::transform(sources, values.begin(), [&](ValueId id) { return values_[id]; });
    return values;
  }
  bool is_root() const { return !seeds_.empty(); }
  const Instruction& source(ValueId id) const { return source_.instructions[id]; }
  ValueId component(ValueId value, unsigned c) {
    return b_->type_of(value) == ValueType::Number ? value : b_->component(value, c);
  }
  ValueId tangent(ValueId id, unsigned c, unsigned k) const { return at(tangents_[id], c, k); }
  bool has_tangent(ValueId id, unsigned c) const {
    for (unsigned k = 0; k < kMaxDirections; ++k)
      if (tangent(id, c, k) != kNone) return true;
    return false;
  }
  static ValueId at(const Tangents& tangents, unsigned c, unsigned k) {
    return tangents.empty() ? kNone : tangents[c * kMaxDirections + k];
  }
  static void set(Tangents& tangents, unsigned c, unsigned k, ValueId value) {
    if (value == kNone) return;
    if (tangents.empty()) tangents.assign(16 * kMaxDirections, kNone);
    tangents[c * kMaxDirections + k] = value;
  }
  ValueId or_zero(ValueId value) { return value == kNone ? b_->number(0) : value; }
  bool is_one(ValueId value) const { return b_->at(value).op == Op::ConstNumber && b_->at(value).number == 1; }

  // Sums and products of derivatives that may be zero.
  ValueId product(ValueId factor, ValueId tangent) {
    if (tangent == kNone || is_one(factor)) return tangent;
    if (is_one(tangent)) return factor;
    // weight * (slope * scale) is slope * (weight * scale) where both are there first, and often the same everywhere.
    const Instruction& made = b_->at(tangent);
    if (made.op == Op::Mul && waits_(factor) < waits_(made.operands[0]) &&
        waits_(made.operands[1]) < waits_(made.operands[0])) {
      const ValueId slope = made.operands[0], scale = made.operands[1];
      return b_->binary(Op::Mul, slope, product(factor, scale));
    }
    return b_->binary(Op::Mul, factor, tangent);
  }
  /// The slope of a function of the library times what its argument has. Functions of numbers (min, clamp, smoothstep)
  /// are flat over ranges, where the argument's derivative may be infinite or none: 0 there. Anywhere else the product
  /// itself, whose own derivative counts too; noise and patterns, flat at single points, are spared the comparisons.
  /// `flat` keeps the comparison for other directions.
  ValueId slope_product(const LibraryFunction& row, ValueId slope, ValueId tangent, ValueId& flat) {
    const ValueId made = product(slope, tangent);
    if (!row.componentwise || tangent == kNone || is_one(slope) || is_one(tangent)) return made;
    if (flat == kNone) flat = b_->compare(Op::Eq, slope, b_->number(0));
    return b_->select(b_->compare(Op::Eq, made, made), made, b_->select(flat, b_->number(0), made));
  }
  ValueId sum(ValueId a, ValueId b) { return a == kNone ? b : b == kNone ? a : b_->binary(Op::Add, a, b); }
  ValueId difference(ValueId a, ValueId b) {
    if (b == kNone) return a;
    return a == kNone ? b_->unary(Op::Neg, b) : b_->binary(Op::Sub, a, b);
  }

  Differentiator& owner_;
  const Function source_; ///< a copy: the module grows meanwhile
  const ActivityKey& key_;
  const FunctionActivity& activity_;
  const std::span<const uint32_t> seeds_; ///< of the root: the parameters that it is differentiated by
  Function function_;
  Builder* b_ = nullptr;
  Waits waits_{function_};
  std::vector<ValueId> values_;    ///< by ValueId of the source
  std::vector<Tangents> tangents_; ///< by ValueId of the source; of calls: of their first result
  std::unordered_map<ValueId, std::vector<Tangents>> call_tangents_;
  std::vector<VariableId> variables_;       ///< by VariableId of the source
  std::vector<Tangents> variable_tangents_; ///< the same: variables instead of values
  std::vector<std::vector<ValueId>> argument_tangents_;
};

class Differentiator {
public:
  explicit Differentiator(Module& module) : module_(module), analysis_(module) {}

  FunctionId root(const ActivityKey& key, std::span<const uint32_t> seeds) { return make(key, seeds); }

  /// The derivative of a function for what its arguments and captures have.
  FunctionId derivative(const ActivityKey& key) {
    if (const auto known = made_.find(key); known != made_.end()) return known->second;
    const FunctionId id = make(key, {});
    made_.emplace(key, id);
    return id;
  }
  const FunctionActivity& activity(const ActivityKey& key) { return analysis_.of(key); }
  const Function& function(FunctionId id) const { return module_.functions[id]; }
  void report_missing(const LibraryFunction& row) {
    module_.problems.push_back("the library has no second derivative of '" + std::string(row.name) +
                               "' by all that changes here");
  }

private:
  FunctionId make(const ActivityKey& key, std::span<const uint32_t> seeds) {
    Function made = Writer(*this, module_, key, analysis_.of(key), seeds).write();
    module_.functions.push_back(std::move(made));
    return static_cast<FunctionId>(module_.functions.size() - 1);
  }

  Module& module_;
  ActivityAnalysis analysis_;
  std::map<ActivityKey, FunctionId> made_;
};

// ---------------------------------------------------------------------------------------------------- The function

Function Writer::write() {
  function_.name = source_.name + "'";
  function_.span = source_.span;
  function_.next_label = source_.next_label;
  declare_signature();
  declare_variables();
  {
    Builder builder(function_);
    b_ = &builder;
    if (is_root()) clear_captures();
    walk(source_.body);
  }
  return std::move(function_);
}

/// Parameters and results, then those of the derivatives; of the root, whole gradients.
void Writer::declare_signature() {
  function_.parameters = source_.parameters;
  function_.parameter_names = source_.parameter_names;
  function_.results = source_.results;
  if (is_root()) {
    for (const ValueType type : source_.results)
      if (type != ValueType::Boolean && type != ValueType::Integer)
        for (unsigned c = 0; c < component_count(type); ++c)
          for (const uint32_t seed : seeds_)
            function_.results.push_back(source_.parameters[seed]);
    return;
  }
  for (size_t i = 0; i < source_.parameters.size(); ++i)
    for_each_active(key_.arguments[i], source_.parameters[i], [&](unsigned c, unsigned k) {
      function_.parameters.push_back(ValueType::Number);
      const std::string name = i < source_.parameter_names.size() ? source_.parameter_names[i] : std::to_string(i);
      function_.parameter_names.push_back(name + "'" + std::to_string(c) + std::to_string(k));
    });
  for (size_t i = 0; i < source_.results.size(); ++i)
    for_each_active(activity_.results[i], source_.results[i],
                    [&](unsigned, unsigned) { function_.results.push_back(ValueType::Number); });
}

/// Captures, the captures' derivatives (which are the root's own), then all other variables, each followed by its
/// derivatives.
void Writer::declare_variables() {
  variables_.resize(source_.variables.size());
  variable_tangents_.resize(source_.variables.size());
  const auto declare = [&](Variable variable) {
    function_.variables.push_back(std::move(variable));
    return static_cast<VariableId>(function_.variables.size() - 1);
  };
  const auto declare_tangents = [&](VariableId id) {
    const Variable& variable = source_.variables[id];
    for_each_active(activity_.variables[id], variable.type, [&](unsigned c, unsigned k) {
      const std::string name = variable.name + "'" + std::to_string(c) + std::to_string(k);
      set(variable_tangents_[id], c, k, declare({name, ValueType::Number, variable.count}));
    });
  };
  for (VariableId id = 0; id < source_.captures; ++id)
    variables_[id] = declare(source_.variables[id]);
  for (VariableId id = 0; id < source_.captures; ++id)
    declare_tangents(id);
  function_.captures = is_root() ? source_.captures : static_cast<uint32_t>(function_.variables.size());
  for (VariableId id = source_.captures; id < source_.variables.size(); ++id) {
    variables_[id] = declare(source_.variables[id]);
    declare_tangents(id);
  }
}

/// What the root finds in its captures is constant; what it stores there may not be.
void Writer::clear_captures() {
  for (VariableId id = 0; id < source_.captures; ++id)
    for_each_active(activity_.variables[id], source_.variables[id].type, [&](unsigned c, unsigned k) {
      const VariableId variable = at(variable_tangents_[id], c, k);
      for (uint32_t i = 0; i < source_.variables[id].count; ++i) {
        if (source_.variables[id].count == 1) {
          b_->store(variable, b_->number(0));
          continue;
        }
        Instruction store{};
        store.op = Op::StoreElement;
        store.index = variable;
        store.operands = {b_->integer(i), b_->number(0)};
        b_->append(std::move(store));
      }
    });
}

void Writer::walk(const Block& block) {
  for (const ValueId id : block.instructions)
    visit(id);
}

void Writer::visit(ValueId id) {
  b_->set_span(source(id).span);
  switch (source(id).op) {
  case Op::Argument:
    return argument(id);
  case Op::Load:
  case Op::LoadElement:
    return load(id);
  case Op::Store:
  case Op::StoreElement:
    return store(id);
  case Op::Add:
  case Op::Sub:
  case Op::Mul:
  case Op::Div:
  case Op::Neg:
  case Op::Fma:
    return arithmetic(id);
  case Op::Select:
  case Op::Construct:
  case Op::Component:
    return compose(id);
  case Op::CallLibrary:
    return library_call(id);
  case Op::Call:
    return call(id);
  case Op::Result:
    copy(id);
    if (const auto found = call_tangents_.find(source(id).operands[0]); found != call_tangents_.end())
      tangents_[id] = found->second[source(id).index];
    return;
  case Op::If:
  case Op::Loop:
  case Op::Scope:
    return nested(id);
  case Op::Return:
    return return_values(id);
  default:
    return copy(id);
  }
}

/// The instruction itself, of the new values and variables.
void Writer::copy(ValueId id) {
  Instruction instruction = source(id);
  instruction.operands = values_of(instruction.operands);
  for (VariableId& variable : instruction.variables)
    variable = variables_[variable];
  if (instruction.op == Op::Load || instruction.op == Op::Store || instruction.op == Op::LoadElement ||
      instruction.op == Op::StoreElement)
    instruction.index = variables_[instruction.index];
  values_[id] = b_->append(std::move(instruction));
}

void Writer::nested(ValueId id) {
  Instruction instruction = source(id);
  instruction.operands = values_of(instruction.operands);
  for (Block& block : instruction.blocks)
    block = b_->block([&, inner = block] { walk(inner); });
  values_[id] = b_->append(std::move(instruction));
}

/// A root's argument has derivative 1 in its own direction; others come as further arguments.
void Writer::argument(ValueId id) {
  copy(id);
  const uint32_t index = source(id).index;
  uint32_t next = static_cast<uint32_t>(source_.parameters.size());
  if (!is_root())
    for (uint32_t i = 0; i < index; ++i)
      next += key_.arguments[i].count();
  for_each_active(key_.arguments[index], source_.parameters[index], [&](unsigned c, unsigned k) {
    set(tangents_[id], c, k, is_root() ? b_->number(1) : b_->argument(next++));
  });
}

void Writer::load(ValueId id) {
  copy(id);
  const Instruction& instruction = source(id);
  const VariableId variable = instruction.index;
  for_each_active(activity_.variables[variable], instruction.type, [&](unsigned c, unsigned k) {
    Instruction load = instruction;
    load.type = ValueType::Number;
    load.index = at(variable_tangents_[variable], c, k);
    load.operands = values_of(load.operands);
    set(tangents_[id], c, k, b_->append(std::move(load)));
  });
}

void Writer::store(ValueId id) {
  copy(id);
  const Instruction& instruction = source(id);
  const VariableId variable = instruction.index;
  for_each_active(activity_.variables[variable], source_.variables[variable].type, [&](unsigned c, unsigned k) {
    Instruction store = instruction;
    store.index = at(variable_tangents_[variable], c, k);
    store.operands = values_of(store.operands);
    store.operands.back() = or_zero(tangent(instruction.operands.back(), c, k));
    b_->append(std::move(store));
  });
}

void Writer::return_values(ValueId id) {
  const std::vector<ValueId>& operands = source(id).operands;
  std::vector<ValueId> results = values_of(operands);
  for (size_t i = 0; i < operands.size(); ++i) {
    const ValueType type = source_.results[i];
    if (!is_root()) {
      for_each_active(activity_.results[i], type,
                      [&](unsigned c, unsigned k) { results.push_back(or_zero(tangent(operands[i], c, k))); });
      continue;
    }
    if (type == ValueType::Boolean || type == ValueType::Integer) continue;
    for (unsigned c = 0; c < component_count(type); ++c) {
      unsigned k = 0;
      for (const uint32_t seed : seeds_) {
        std::vector<ValueId> gradient(component_count(source_.parameters[seed]));
        for (ValueId& component : gradient)
          component = or_zero(tangent(operands[i], c, k++));
        results.push_back(gradient.size() == 1 ? gradient[0]
                                               : b_->construct(source_.parameters[seed], std::move(gradient)));
      }
    }
  }
  b_->return_values(std::move(results));
}

// -------------------------------------------------------------------------------------------------------- Arithmetic

void Writer::arithmetic(ValueId id) {
  copy(id);
  const Instruction& instruction = source(id);
  const auto operand = [&](size_t i, unsigned c) { return component(values_[instruction.operands[i]], c); };
  for (unsigned c = 0; c < component_count(instruction.type); ++c) {
    if (!activity_.values[id].any(c)) continue;
    ValueId inverse = kNone;
    for (unsigned k = 0; k < kMaxDirections; ++k) {
      const auto d = [&](size_t i) { return tangent(instruction.operands[i], c, k); };
      if (!activity_.values[id].at(c, k)) continue;
      ValueId result = kNone;
      switch (instruction.op) {
      case Op::Add:
        result = sum(d(0), d(1));
        break;
      case Op::Sub:
        result = difference(d(0), d(1));
        break;
      case Op::Neg:
        result = difference(kNone, d(0));
        break;
      case Op::Div:
        // (a/b)' = (a' - (a/b) b') / b
        if (inverse == kNone) inverse = b_->binary(Op::Div, b_->number(1), operand(1, c));
        result = d(1) == kNone ? d(0) : difference(d(0), product(component(values_[id], c), d(1)));
        result = product(inverse, result);
        break;
      default: // Mul, Fma
        if (d(0) != kNone) result = product(operand(1, c), d(0));
        if (d(1) != kNone) result = sum(result, product(operand(0, c), d(1)));
        if (instruction.op == Op::Fma) result = sum(result, d(2));
      }
      set(tangents_[id], c, k, result);
    }
  }
}

void Writer::compose(ValueId id) {
  copy(id);
  const Instruction& instruction = source(id);
  for_each_active(activity_.values[id], instruction.type, [&](unsigned c, unsigned k) {
    ValueId result = kNone;
    if (instruction.op == Op::Component) {
      result = tangent(instruction.operands[0], instruction.index, k);
    } else if (instruction.op == Op::Construct) {
      result = tangent(instruction.operands[instruction.operands.size() == 1 ? 0 : c], 0, k);
    } else {
      const ValueId yes = tangent(instruction.operands[1], c, k), no = tangent(instruction.operands[2], c, k);
      if (yes != kNone || no != kNone) result = b_->select(values_[instruction.operands[0]], or_zero(yes), or_zero(no));
    }
    set(tangents_[id], c, k, result);
  });
}

// ------------------------------------------------------------------------------------------------------------- Calls

/// A call of the row's derivative and the chain rule, for each of its results; the value is returned.
ValueId Writer::differentiate_call(const LibraryFunction& row, unsigned parameters,
                                   const std::vector<ValueId>& operands, const std::vector<Tangents>& tangents,
                                   std::vector<Tangents>& results) {
  results.assign(row.result_count, {});
  const LibraryDerivative* derivative = library_derivative(row, parameters);
  if (derivative == nullptr) return b_->call_library(row, row.results[0], operands);
  const ValueId made = b_->call_library(derivative->function, row.results[0], operands);
  unsigned column = 0;
  for (size_t i = 0; i < operands.size(); ++i) {
    if ((derivative->parameters >> i & 1) == 0) continue;
    for (unsigned c = 0; c < component_count(row.parameters[i]); ++c, ++column) {
      for (unsigned n = 0; n < row.result_count; ++n) {
        const unsigned index = derivative->index(column, n);
        ValueId slope = kNone;
        for (unsigned r = 0; r < component_count(row.results[n]); ++r) {
          if ((derivative->used[index] >> r & 1) == 0) continue;
          ValueId slope_component = kNone, flat = kNone;
          for (unsigned k = 0; k < kMaxDirections; ++k) {
            if (at(tangents[i], c, k) == kNone) continue;
            if (slope == kNone) slope = b_->result(made, row.result_count + index, row.results[n]);
            if (slope_component == kNone) slope_component = component(slope, r);
            set(results[n], r, k,
                sum(at(results[n], r, k), slope_product(row, slope_component, at(tangents[i], c, k), flat)));
          }
        }
      }
    }
  }
  return made;
}

/// Of an inverse: d(M^-1) = -M^-1 dM M^-1.
void Writer::inverse(ValueId id) {
  copy(id);
  const ValueId operand = source(id).operands[0];
  const unsigned size = matrix_size(source(id).type);
  const auto entry = [&](unsigned row, unsigned column) { return component(values_[id], column * size + row); };
  for (unsigned k = 0; k < kMaxDirections; ++k) {
    if (!activity_.values[id].at(0, k)) continue;
    for (unsigned column = 0; column < size; ++column) {
      std::vector<ValueId> right(size, kNone); // dM M^-1
      for (unsigned row = 0; row < size; ++row)
        for (unsigned i = 0; i < size; ++i)
          if (const ValueId d = tangent(operand, i * size + row, k); d != kNone)
            right[row] = sum(right[row], product(entry(i, column), d));
      for (unsigned row = 0; row < size; ++row) {
        ValueId slope = kNone;
        for (unsigned i = 0; i < size; ++i)
          if (right[i] != kNone) slope = sum(slope, product(entry(row, i), right[i]));
        if (slope != kNone) set(tangents_[id], column * size + row, k, difference(kNone, slope));
      }
    }
  }
}

void Writer::library_call(ValueId id) {
  const Instruction& instruction = source(id);
  if (is_derivative_export(instruction.library->symbol)) return derivative_call(id);
  const bool one_result = instruction.library->result_count == 1;
  if (one_result && !activity_.values[id].any()) return copy(id);
  if (instruction.library->name == "inverse") return inverse(id);
  if (instruction.library->componentwise && is_vector(instruction.type)) return library_call_by_component(id);
  const std::vector<ValueId> operands = values_of(instruction.operands);
  std::vector<Tangents> tangents(operands.size());
  std::ranges::transform(instruction.operands, tangents.begin(), [&](ValueId operand) { return tangents_[operand]; });
  const unsigned parameters = ActivityAnalysis::active_parameters(instruction, activity_);
  std::vector<Tangents> results;
  values_[id] = differentiate_call(*instruction.library, parameters, operands, tangents, results);
  tangents_[id] = results[0];
  if (!one_result) call_tangents_[id] = std::move(results);
}

/// A call of a derivative stays, and beside it comes one of the second derivative.
void Writer::derivative_call(ValueId id) {
  copy(id);
  const Instruction& instruction = source(id);
  const SecondCall call(*instruction.library, ActivityAnalysis::active_parameters(instruction, activity_));
  if (call.second == nullptr) {
    if (call.is_missing) owner_.report_missing(*call.first->row);
    return;
  }
  const LibraryFunction& function = call.second->function;
  const unsigned count = call.first->row->result_count;
  const ValueId made = b_->call_library(function, function.results[0], values_of(instruction.operands));
  std::vector<Tangents> results(instruction.library->result_count);
  unsigned column = 0;
  for (size_t i = 0; i < instruction.operands.size(); ++i) {
    if ((call.whole->parameters >> i & 1) == 0) continue;
    const ValueId operand = instruction.operands[i];
    for (unsigned c = 0; c < component_count(source(operand).type); ++c, ++column)
      for (uint32_t index = 0; index < results.size() && has_tangent(operand, c); ++index) {
        const unsigned list = index < count ? 1 + column : call.second->list(call.columns[index / count - 1], column);
        const uint32_t slope_index = list * count + index % count;
        for (unsigned r = 0; r < component_count(function.results[slope_index]); ++r) {
          if ((call.used(index, column) >> r & 1) == 0) continue;
          const ValueId slope = component(b_->result(made, slope_index, function.results[slope_index]), r);
          ValueId flat = kNone;
          for (unsigned k = 0; k < kMaxDirections; ++k)
            set(results[index], r, k,
                sum(at(results[index], r, k), slope_product(*call.first->row, slope, tangent(operand, c, k), flat)));
        }
      }
  }
  tangents_[id] = results[0];
  call_tangents_[id] = std::move(results);
}

void Writer::library_call_by_component(ValueId id) {
  const Instruction& instruction = source(id);
  std::vector<ValueId> results;
  for (unsigned c = 0; c < component_count(instruction.type); ++c) {
    std::vector<ValueId> operands;
    std::vector<Tangents> tangents;
    unsigned parameters = 0;
    for (size_t i = 0; i < instruction.operands.size(); ++i) {
      const ValueId operand = instruction.operands[i];
      const unsigned from = operand_component(source_, operand, c);
      operands.push_back(component(values_[operand], from));
      tangents.emplace_back();
      for (unsigned k = 0; k < kMaxDirections; ++k)
        set(tangents.back(), 0, k, tangent(operand, from, k));
      if (!tangents.back().empty()) parameters |= 1u << i;
    }
    std::vector<Tangents> result;
    results.push_back(differentiate_call(*instruction.library, parameters, operands, tangents, result));
    for (unsigned k = 0; k < kMaxDirections; ++k)
      set(tangents_[id], c, k, at(result[0], 0, k));
  }
  values_[id] = b_->construct(instruction.type, std::move(results));
}

void Writer::call(ValueId id) {
  const Instruction& instruction = source(id);
  const ActivityKey key = ActivityAnalysis::key_of(instruction, activity_);
  const FunctionActivity& callee = owner_.activity(key);
  const auto is_any = [](const Activity& activity) { return activity.any(); };
  if (std::ranges::none_of(key.arguments, is_any) && std::ranges::none_of(callee.variables, is_any)) return copy(id);
  std::vector<ValueId> operands = values_of(instruction.operands);
  std::vector<VariableId> captures(instruction.variables.size());
  std::ranges::transform(instruction.variables, captures.begin(), [&](VariableId id) { return variables_[id]; });
  for (size_t i = 0; i < instruction.operands.size(); ++i)
    for_each_active(key.arguments[i], source(instruction.operands[i]).type, [&](unsigned c, unsigned k) {
      operands.push_back(or_zero(tangent(instruction.operands[i], c, k)));
    });
  for (const VariableId variable : instruction.variables)
    for_each_active(activity_.variables[variable], source_.variables[variable].type,
                    [&](unsigned c, unsigned k) { captures.push_back(at(variable_tangents_[variable], c, k)); });
  const FunctionId made = owner_.derivative(key);
  const std::vector<ValueType> types = owner_.function(instruction.index).results;
  values_[id] = b_->call(made, types, std::move(operands), std::move(captures));
  std::vector<Tangents> results(types.size());
  uint32_t next = static_cast<uint32_t>(types.size());
  for (size_t i = 0; i < types.size(); ++i)
    for_each_active(callee.results[i], types[i], [&](unsigned c, unsigned k) {
      set(results[i], c, k, b_->result(values_[id], next++, ValueType::Number));
    });
  if (!results.empty()) tangents_[id] = results[0];
  call_tangents_[id] = std::move(results);
}

} // namespace

unsigned derivative_order(const Module& module, FunctionId function) {
  std::vector<FunctionId> pending{function};
  std::set<FunctionId> seen{function};
  unsigned order = 0;
  while (!pending.empty()) {
    const Function& current = module.functions[pending.back()];
    pending.pop_back();
    for_each_instruction(current, [&](ValueId id) {
      const Instruction& instruction = current.instructions[id];
      if (instruction.op == Op::CallLibrary) order = std::max(order, export_order(instruction.library->symbol));
      if (instruction.op == Op::Call && seen.insert(instruction.index).second) pending.push_back(instruction.index);
    });
  }
  return order;
}

FunctionId add_gradient(Module& module, FunctionId function, std::span<const uint32_t> parameters) {
  ActivityKey key{function, {}, {}};
  key.arguments.resize(module.functions[function].parameters.size());
  unsigned direction = 0;
  for (const uint32_t parameter : parameters)
    for (unsigned c = 0; c < component_count(module.functions[function].parameters[parameter]); ++c)
      key.arguments[parameter].set(c, direction++);
  return Differentiator(module).root(key, parameters);
}

} // namespace moonshade::ir
