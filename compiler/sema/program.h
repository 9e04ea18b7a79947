// The result of sema: which specialisations of which functions a shader consists of, and what each node of their
// syntax trees means there. `ir::build` translates it without deciding anything again.
//
// A specialisation is one function for one list of argument types. The same syntax node has other facts in other
// specialisations, so facts are kept per specialisation, by the node's id.
//
// The top level of the file is specialisation 0 ("the top level", `function` is the chunk's main function): it becomes
// the module's init function. A top-level local (or a global variable) whose value functions read becomes a Global
// slot. Locals of a function that local functions read or assign are passed to their calls by reference (captures).
#pragma once

#include "compiler/base/diagnostics.h"
#include "compiler/sema/shader_info.h"
#include "compiler/syntax/ast.h"
#include "stdlib/library.h"

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace moonshade::sema {

struct Specialisation;

/// A static type. `Function` is known at compile time: `function` says which syntax it stands for.
struct Type {
  enum class Kind : uint8_t {
    Unknown,  ///< not inferred yet, or an error that was reported: agrees with everything
    None,     ///< no value: the result of a function that returns nothing
    Value,    ///< `value`
    String,   ///< a compile-time constant, `text`; of a parameter (`is_parameter`) the parameter's name
    Function, ///< a function of the shader, `function`
    Library,  ///< a function or table of the library, `text` its name ("noise", "math.sin", "math"); no storage
  };
  Kind kind = Kind::Unknown;
  ValueType value = ValueType::Boolean;
  const syntax::Function* function = nullptr;
  std::string_view text;
  /// A number that stock Lua may hold as an integer (both were given to it): the same at run time, but `//`, `%` and
  /// math.type of it are refused. `is(Number)` holds.
  bool mixed = false;
  /// A string whose text is a parameter of the shader, so not known while compiling.
  bool is_parameter = false;

  static Type of(ValueType value) { return {Kind::Value, value, nullptr, {}, false, false}; }
  bool is_value() const { return kind == Kind::Value; }
  bool is(ValueType other) const { return kind == Kind::Value && value == other; }
  bool operator==(const Type&) const = default;
};

/// What a name stands for.
enum class NameKind : uint8_t {
  Local,    ///< a variable of this function, or a captured one of an enclosing function (not the top level's)
  Global,   ///< slot `index` of Program::globals (inside the top level too)
  Function, ///< a function of the shader, known at compile time; no value at run time
  Library,  ///< a function or table of the library; no value at run time
  Constant, ///< a number or integer constant of the library: math.pi, math.maxinteger
};

/// What a call does.
enum class CallKind : uint8_t {
  Specialisation, ///< runs `callee`
  Library,        ///< `library`; by component where the call's type is a vector; missing trailing arguments take the
                  ///< row's defaults. math.max and math.min: any number of arguments, the row is folded from the left
  Construct,      ///< vec2, vec3, vec4, rgb: numbers and vectors strung together, or one number for each component;
                  ///< mat3, mat4: the same by columns, one number on the diagonal, or a matrix cut or grown
  Convert,        ///< the argument itself, converted to the call's type (math.floor of an integer, ...)
  ToInteger,      ///< math.floor, math.ceil: the row `library` gives integer and ok; faults IntegerRange where not ok
  Parameter,      ///< param: Program::info.parameters[index]
  Assert,         ///< assert(c, message)
  Error,          ///< error(message)
  Gradient,       ///< gradient(f, p): `callee` or, where that is null, `library`, of one parameter, by it
  Fwidth,         ///< fwidth(f, p, fw): the length of that, times the magnitude of fw
};

/// How an operator expression is to be computed.
enum class OperatorForm : uint8_t {
  Plain,       ///< operands converted to the operation's type (`operand_type`)
  Mixed,       ///< comparison of an integer with a number: library row "op.lt", "op.le" or "op.eq" in `library`. Its
               ///< parameters tell the order: `a > b` is op.lt(b, a), `a >= b` op.le(b, a); op.eq takes the integer
               ///< first; `~=` is the negation
  Logical,     ///< `and`, `or`, `not` on booleans; the right side is evaluated only where Lua does
  Conditional, ///< an `or` whose left side is `c and a`: c decides between a and b, results converted to the type.
               ///< In a chain `c and a or d and b or e` the inner `or` (the left side) is marked Conditional too, with
               ///< the type of the whole; so is every `and` that is an arm. The left side may stand in parentheses
  Parameter, ///< the string parameter `index` compared with the constant number `integer_constant` of those that it is
             ///< compared with (ParameterInfo::compared); operands are not evaluated
  Constant,  ///< known while compiling, `integer_constant` (boolean: 0 or 1); operands are not evaluated:
             ///< `#"text"`, comparisons of constant strings
};

/// Facts about an expression node.
struct ExpressionFact {
  Type type;                 ///< of its (first) value
  std::vector<Type> results; ///< of a call: all results
  NameKind name = NameKind::Local;
  uint32_t index = 0;           ///< Global slot; parameter (also of OperatorForm::Parameter)
  double constant = 0;          ///< NameKind::Constant of type number
  int64_t integer_constant = 0; ///< NameKind::Constant of type integer
  CallKind call = CallKind::Specialisation;
  Specialisation* callee = nullptr;
  const LibraryFunction* library = nullptr;   ///< CallKind::Library and ToInteger; operators given by a row "op.*"
  ValueType operand_type = ValueType::Number; ///< operators: type to which both operands are converted first
  OperatorForm form = OperatorForm::Plain;
  std::vector<uint8_t> components; ///< component access and swizzles (`v.x`, `v.zyx`, `v[1]`): indices from 0
};

/// A variable that a specialisation owns.
struct LocalFact {
  Type type;                     ///< Value: a variable at run time. Function, Library, String, Unknown: no storage
  bool captured_by_call = false; ///< a local function reads or assigns it
};

struct Specialisation {
  uint32_t id = 0;
  const syntax::Function* function = nullptr;
  std::string name; ///< for messages and the IR: "height", "falloff#2"
  /// Of the arguments as passed: a parameter to which the body gives a number too may be an integer here and a number
  /// in `locals` (converted on entry). String parameters have no storage and are not passed at run time. A call may
  /// have more arguments than these; the rest is evaluated and dropped.
  std::vector<Type> parameters;
  std::vector<Type> results; ///< converted to by every return
  /// Variables of enclosing functions (not the top level) that this function or those it calls use, by reference, in
  /// the order of the IR function's captures. A caller passes its own variable, or its own capture, of the same local.
  std::vector<const syntax::Local*> captures;
  std::unordered_map<uint32_t, ExpressionFact> expressions;   ///< by Expr::id
  std::unordered_map<const syntax::Local*, LocalFact> locals; ///< own and captured
  /// Top-level locals that have a Global slot (the top level stores them there, functions load them).
};

/// A top-level variable that functions read: becomes an ir::Global.
struct GlobalSlot {
  std::string name;
  ValueType type;
  const syntax::Local* local = nullptr; ///< null for a global variable
  uint32_t parameter = ~0u;             ///< the shader's parameter whose value this is, where it is just that
};

struct EntryPoint {
  std::string name; ///< inputs and results: ShaderInfo::entries, same order
  Specialisation* specialisation;
};

struct Program {
  const syntax::Chunk* chunk = nullptr;
  ShaderInfo info;
  std::vector<std::unique_ptr<Specialisation>> specialisations;
  std::vector<GlobalSlot> globals;
  std::vector<EntryPoint> entries;
};

struct Options {
  std::vector<std::string> entries; ///< only these; empty: all
};

/// Checks `chunk`. Reports every refusal; the program is meaningful only where no error was reported.
Program check(const syntax::Chunk& chunk, const Options& options, Diagnostics& diagnostics);

} // namespace moonshade::sema
