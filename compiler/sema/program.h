// The result of sema: which specialisations of which functions a shader consists of, and what each node of their
// syntax trees means there. `ir::build` translates it without deciding anything again.
//
// A specialisation is one function for one list of argument types. The same syntax node has other facts in other
// specialisations, so facts are kept per specialisation, by the node's id.
//
// The top level of the file is specialisation 0 ("the top level", `function` is the chunk's main function): it becomes
// the module's init function. A function that is called while the top level runs has specialisations of its own for
// that; what shading reads of the top level's variables, frozen by then, becomes a Global.
//
// What has storage at run time is a Slot: a variable, or a leaf of a table. It belongs to one specialisation, its home,
// in whose calls it lives; functions called from there that use it get it by reference (captures). A variable or table
// that outlives the call that made it (a result, or captured by a function that is a result) lives in the caller: the
// function is then specialised for that very call, so that each call has tables of its own.
#pragma once

#include "compiler/base/diagnostics.h"
#include "compiler/sema/shader_info.h"
#include "compiler/syntax/ast.h"
#include "stdlib/library.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace moonshade::sema {

struct Specialisation;
struct Table;
struct Work; ///< of inference; outside of sema it only tells functions of different calls apart

/// A static type. `Function` is known at compile time: `function` says which syntax it stands for.
struct Type {
  enum class Kind : uint8_t {
    Unknown,  ///< not inferred yet, or an error that was reported: agrees with everything
    None,     ///< no value: the result of a function that returns nothing
    Value,    ///< `value`
    String,   ///< a compile-time constant, `text`; of a parameter (`is_parameter`) the parameter's name
    Function, ///< a function of the shader, `function`, made in the call `frame`
    Library,  ///< a function or table of the library, `text` its name ("noise", "math.sin", "math"); no storage
    Table,    ///< `table`; at run time the number of the element that it is, where it stands in an array
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
  Work* frame = nullptr;
  Table* table = nullptr;

  static Type of(ValueType value) {
    Type type;
    type.kind = Kind::Value;
    type.value = value;
    return type;
  }
  bool is_value() const { return kind == Kind::Value; }
  bool is(ValueType other) const { return kind == Kind::Value && value == other; }
  bool operator==(const Type&) const = default;
};

/// Storage at run time: `count` values of one type.
struct Slot {
  uint32_t id = 0; ///< in order of their making
  std::string name;
  ValueType type = ValueType::Number;
  uint32_t count = 1;
};

/// The type of a variable as far as it is inferred, and what made it so.
struct Variable {
  Type type;
  Type first_type; ///< of the first value given to it, and where
  Span first{};
  /// The first value that did not fit. Kept, for where the value depends on the variable itself the conflict is not met
  /// again: by then the variable's type is the conflicting one.
  Type conflict_type;
  Span conflict{};
  const syntax::Expr* integer_given = nullptr; ///< an integer given to it, for `mixed-number`
  Work* owner = nullptr;                       ///< whose call it belongs to; of a table's leaf the table knows
  Table* table = nullptr;                      ///< of which it is a leaf
  bool is_captured = false;                    ///< local functions use it
  uint32_t parameter = ~0u;                    ///< the shader's parameter whose value it is, where it is just that
  Slot* slot = nullptr;                        ///< where it is used at run time
};

/// A table that the compiler knows: what all the tables have in common that one constructor makes (in an array of
/// tables: that all its elements are). Its values stand in the slots of its leaves, one for each element of the arrays
/// around it.
struct Table {
  enum class Kind : uint8_t { Unknown, Array, Record };
  struct Field {
    std::string_view name; ///< empty for an array's elements
    Span span;
    Variable variable;          ///< a leaf, or a reference (its type a table, or a function)
    Table* inner = nullptr;     ///< a table that stands in this slot: part of this one
    std::vector<Constant> data; ///< of a leaf, where the outermost table is data
  };
  Kind kind = Kind::Unknown;
  uint32_t length = 0;              ///< of an array
  std::vector<Field*> fields;       ///< of an array one, for all its elements
  Table* outer = nullptr;           ///< the table of which it is part
  Work* maker = nullptr;            ///< in whose call it is made
  Work* owner = nullptr;            ///< in whose call it lives (of the outermost)
  Span span{};                      ///< its constructor
  const void* syntax = nullptr;     ///< what makes it, where several tables meet
  const Field* stands_in = nullptr; ///< of a record that refers to it
  bool is_data = false;             ///< of the outermost: written as constants and never changed, so stored as data
  bool is_mutated = false;          ///< something is assigned to a slot after its construction
  std::vector<std::unique_ptr<Field>> storage;

  const Table* outermost() const {
    const Table* at = this;
    while (at->outer != nullptr)
      at = at->outer;
    return at;
  }
  /// Whether there are several of it, told apart at run time by a number from 0.
  bool is_element() const {
    for (const Table* at = outer; at != nullptr; at = at->outer)
      if (at->kind == Kind::Array) return true;
    return false;
  }
  /// How many of it there are.
  uint64_t instances() const {
    uint64_t count = 1;
    for (const Table* at = outer; at != nullptr; at = at->outer)
      if (at->kind == Kind::Array) count *= at->length;
    return count;
  }
  Field* find(std::string_view name) const {
    for (Field* field : fields)
      if (field->name == name) return field;
    return nullptr;
  }
};

/// What a name stands for.
enum class NameKind : uint8_t {
  Local,    ///< the variable `slot`, of this function or captured
  Global,   ///< Program::globals[index]: a variable of the top level, while shading
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
  Print,          ///< print(...): values, and strings by the types of their facts
  Modf,           ///< math.modf: an integer, for which no 64-bit integer faults IntegerRange, and the rest
  Gradient,       ///< gradient(f, p): `callee` or, where that is null, `library`, of one parameter, by it
  Fwidth,         ///< fwidth(f, p, fw): the length of that, times the magnitude of fw
  TableFunction,  ///< ramp(x, t) and the like: `table_function`; `field` is t's element, `library` what goes between
                  ///< values: mix, catmullrom, bspline
  Texture,        ///< texture(file, uv, width): image `index` of ShaderInfo::images; width 0 where there is none
  Ipairs,         ///< ipairs(t), of a `for` alone
  Require,        ///< require "name": the module has run
};

/// How a call of CallKind::TableFunction takes the values of its array.
enum class TableFunction : uint8_t {
  Ramp,       ///< linear, from the first at 0 to the last at 1; clamped
  Palette,    ///< linear, one span each, and from the last back to the first: of period 1
  Catmullrom, ///< from the second at 0 to the one before the last at 1
  Bspline,    ///< the same spans
};

/// Where a slot is found at run time.
struct Place {
  const Slot* slot = nullptr; ///< own or captured
  uint32_t global = ~0u;      ///< else Program::globals[global]
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
  uint32_t index = 0;         ///< Global; parameter (also of OperatorForm::Parameter)
  const Slot* slot = nullptr; ///< NameKind::Local
  /// `t.x`, `t[i]`: the field of the table that is the object's type. Of ipairs(t) its element.
  const Table::Field* field = nullptr;
  double constant = 0;          ///< NameKind::Constant of type number
  int64_t integer_constant = 0; ///< NameKind::Constant of type integer
  CallKind call = CallKind::Specialisation;
  Specialisation* callee = nullptr;
  std::vector<double> trailing;               ///< CallKind::Specialisation: passed behind the arguments
  const LibraryFunction* library = nullptr;   ///< CallKind::Library and ToInteger; operators given by a row "op.*"
  ValueType operand_type = ValueType::Number; ///< operators: type to which both operands are converted first
  OperatorForm form = OperatorForm::Plain;
  TableFunction table_function = TableFunction::Ramp;
  bool is_dynamic = false;         ///< `v[i]` of a vector, i from 1; faults Index outside
  std::vector<uint8_t> components; ///< component access and swizzles (`v.x`, `v.zyx`, `v[1]`): indices from 0
};

/// A local variable of a function.
struct LocalFact {
  Type type;                  ///< Value: a variable at run time; Table: one where it is an element. Else no storage
  const Slot* slot = nullptr; ///< null: no storage
};

struct Specialisation {
  uint32_t id = 0;
  const syntax::Function* function = nullptr;
  std::string name;        ///< for messages and the IR: "height", "falloff#2"
  bool is_library = false; ///< of the library's own Lua: its calls are no steps
  /// Of the arguments as passed: a parameter to which the body gives a number too may be an integer here and a number
  /// in `locals` (converted on entry). String parameters have no storage and are not passed at run time. A call may
  /// have more arguments than these; the rest is evaluated and dropped.
  std::vector<Type> parameters;
  std::vector<Type> results; ///< converted to by every return
  /// Slots of other homes that this function or those it calls use, by reference, in the order of the IR function's
  /// captures. A caller passes its own slot, or its own capture of it.
  std::vector<const Slot*> captures;
  std::unordered_map<uint32_t, ExpressionFact> expressions;   ///< by Expr::id
  std::unordered_map<const syntax::Local*, LocalFact> locals; ///< its own
  /// Where the leaves of the tables are that it uses.
  std::unordered_map<const Table::Field*, Place> leaves;
  std::set<const Table*> placed; ///< tables all of whose leaves are there
};

/// A top-level variable that shading reads: becomes an ir::Global.
struct GlobalSlot {
  std::string name;
  ValueType type;
  uint32_t count = 1;
  const Slot* slot = nullptr; ///< of the top level: copied when it ends; null where there is data
  const std::vector<Constant>* data = nullptr;
  uint32_t parameter = ~0u; ///< the shader's parameter whose value this is, where it is just that
};

struct EntryPoint {
  std::string name; ///< inputs and results: ShaderInfo::entries, same order
  Specialisation* specialisation;
};

struct Program {
  const syntax::Chunk* chunk = nullptr;
  /// The top levels of the modules that run before a statement of the shader's file or of a module's, in this order.
  std::unordered_map<const syntax::Stat*, std::vector<Specialisation*>> modules_before;
  ShaderInfo info;
  std::vector<std::unique_ptr<Specialisation>> specialisations;
  std::vector<GlobalSlot> globals;
  std::vector<std::unique_ptr<Slot>> slots;
  std::vector<std::unique_ptr<Table>> tables;
  std::vector<EntryPoint> entries;
};

/// A module's syntax; or, where there is none, the reason.
struct LoadedModule {
  const syntax::Chunk* chunk = nullptr;
  std::string error;
};

struct Options {
  std::vector<std::string> entries; ///< only these; empty: all
  /// Finds and parses the module of a name, "patterns.stone", for `require`; asked once for each. Syntax errors go to
  /// the same diagnostics.
  std::function<LoadedModule(const std::string& name)> load_module = {};
  /// Parses the library's own Lua (library_lua), for the functions of it that a shader calls; asked once, where there
  /// are any.
  std::function<const syntax::Chunk*()> load_library = {};
};

/// The arguments of a call of `texture` that are values: all but its options.
std::span<syntax::Expr* const> texture_operands(const syntax::CallExpr& expr);

/// Checks `chunk`. Reports every refusal; the program is meaningful only where no error was reported.
Program check(const syntax::Chunk& chunk, const Options& options, Diagnostics& diagnostics);

} // namespace moonshade::sema
