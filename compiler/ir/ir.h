// The intermediate representation: typed, monomorphised, structured. One function for each specialisation.
//
// SEMANTICS
//
// A function is executed for one point. (Lanes are codegen's matter: a lane that is switched off executes nothing.)
// It has a body, a block: a sequence of instructions executed in order. An instruction that gives a value is named by
// its index in Function::instructions; a value may be used by any later instruction of its block and of the blocks
// nested there. Values are immutable; what changes lives in variables.
//
// Variables hold `count` values of one type (count 1: a plain variable). They live as long as a call of their function
// and are undefined until stored; sema guarantees a store before each load. The first `captures` variables of a
// function stand for variables of the caller, named at the call: they are references, so stores are seen by the
// caller. Two captures may name one variable. Globals belong to the instance: parameters and top-level values, stored
// by the `init` function alone, before any point, and constants from then on.
//
// Numbers are IEEE 754, `float` or `double` by the domain for which code is made, rounded to nearest even; nothing is
// reassociated, contracted or assumed absent (NaN, infinities, signed zeros, denormals). Integers are 64 bit and wrap.
// Vectors and matrices work by component; operands of arithmetic have the type of the result (a number beside a vector
// or matrix is made one by `construct` first).
//   const.n      a double, rounded to the domain's number
//   add sub mul neg    integer, number, vector, matrix (by component)
//   div          number, vector, matrix
//   fma          a*b + c with one rounding; number, vector; only the `fuse` pass makes it, only for f32
//   and or xor not     integer (bits) or boolean; both operands are evaluated
//   eq ne        one type on both sides: boolean, integer, number, vector, matrix
//                (eq: all components equal; ne: not eq)
//   lt le        integer, number; false where an operand is NaN
//   integer_to_number  rounded to nearest even
//   select c a b       a where c, else b; both are evaluated
//   construct    as many numbers as the type has components; one number alone counts for each component
//   component    number `index` of a vector or matrix
//   call_library       the exported body of a library function; operands have its parameter types, except for a
//                componentwise function, where the instruction's type is a vector and each operand is a number or that
//                vector. More than one result: the value is the first, `result` gives the others.
//                `%`, `//`, `^`, shifts and comparisons of an integer with a number are library functions named "op.*"
//   call         runs another function of the module with the operands as arguments and `variables` as its captures.
//                There is no recursion. The value is the first result, `result` gives the others.
//   result       result `index` (from 0) of a call or call_library
//   load_element store_element   variable[index], index an integer from 0, in range (a `fault` before it sees to that);
//   load_global_element store_global_element   the same of a global
//
// Control. `if` runs block 0 or block 1. `loop` runs its block again and again until a `break` or `return` leaves it.
// `scope` runs its block once; a `break` may leave it early. `break` names, by label, an enclosing loop or scope and
// goes on behind it. `return` gives the function's results. Nothing follows break or return in their block. A function
// with results ends in a return on every path.
//
// Prints. `print` gives a line to whoever asked for it: its text, in which kPrintValue stands for the next operand, of
// any type, and kPrintEscape for the character behind it, whatever that is.
//
// Faults. `fault` with a true condition ends the execution of the point, in whatever depth of calls; the point's
// outputs are zero and the fault is reported with its kind and span. `step` counts one step of the point; the count of
// Module::step_limit + 1 faults with StepLimit. Arithmetic never faults.
#pragma once

#include "compiler/base/fault.h"
#include "compiler/base/source.h"
#include "stdlib/library.h"

#include <cstdint>
#include <string>
#include <vector>

namespace moonshade::ir {

enum class Op : uint8_t {
#define OP(name, text, operands, shape) name,
#include "compiler/ir/ops.def"
};

enum class OpShape : uint8_t { Value, Effect, Block };

struct OpInfo {
  const char* name;
  int operands;
  OpShape shape;
};
const OpInfo& info(Op op);

using ValueId = uint32_t;
using VariableId = uint32_t;
using FunctionId = uint32_t;
using GlobalId = uint32_t;
using LabelId = uint32_t;
inline constexpr uint32_t kNone = ~0u;

/// In the text of a Print.
inline constexpr char kPrintValue = '\x01', kPrintEscape = '\x02';

struct Block {
  std::vector<ValueId> instructions;
};

struct Instruction {
  Op op;
  /// Type of the value; Boolean where there is none.
  ValueType type = ValueType::Boolean;
  Span span{};
  std::vector<ValueId> operands;

  // What only some operations have.
  int64_t integer = 0;                      // ConstBoolean (0, 1), ConstInteger
  double number = 0;                        // ConstNumber
  uint32_t index = 0;                       // Argument, Component, Result: which; Load*/Store*: the variable or global;
                                            // Call: the function; Loop, Scope: own label; Break: target label
  FaultCode fault{};                        // Fault
  std::string text;                         // Fault: message of assert and error; Print: the line
  const LibraryFunction* library = nullptr; // CallLibrary
  std::vector<VariableId> variables;        // Call: bound to the callee's captures
  std::vector<Block> blocks;                // If: then, else; Loop, Scope: body
};

struct Variable {
  std::string name;
  ValueType type;
  uint32_t count = 1;
};

struct Function {
  std::string name;
  Span span{};
  std::vector<ValueType> parameters;
  std::vector<std::string> parameter_names;
  std::vector<ValueType> results;
  std::vector<Variable> variables;
  uint32_t captures = 0;
  /// The arena of instructions; blocks refer to it by index. Passes may leave unreferenced ones behind.
  std::vector<Instruction> instructions;
  Block body;
  LabelId next_label = 0;
};

/// A value of the instance: a parameter of the shader or a top-level variable that functions read.
struct Global {
  std::string name;
  ValueType type;
  uint32_t count = 1;
  /// Index into the shader's parameters (sema::ShaderInfo::parameters), or kNone.
  uint32_t parameter = kNone;
  /// What it holds from the beginning, where nothing stores it: `count` integers or booleans, or all numbers of `count`
  /// numbers or vectors.
  std::vector<int64_t> integers = {};
  std::vector<double> numbers = {};
  bool has_data() const { return !integers.empty() || !numbers.empty(); }
};

/// A function that a host can call. Its arguments are the inputs, in the order of its parameters.
struct Entry {
  std::string name;
  FunctionId function;
};

struct Module {
  std::vector<Function> functions;
  std::vector<Global> globals;
  std::vector<Entry> entries;
  /// Runs once for each instance, after the parameters have been stored into their globals: fills the other globals.
  FunctionId init = kNone;
  uint64_t step_limit = 1'000'000;
  /// What could not be translated, for the user; such a module must not be executed.
  std::vector<std::string> problems;
};

} // namespace moonshade::ir
