// What the parts of one check share: the specialisations found so far and their inferred types, the round of inference,
// the diagnostics. Inference walks every reachable body again and again, silently, until no type changes; then it walks
// once more, reports, and records the facts.
#pragma once

#include "compiler/sema/globals.h"
#include "compiler/sema/hidden_names.h"
#include "compiler/sema/program.h"
#include "compiler/sema/types.h"

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace moonshade::sema {

/// Specialisations and parameters of one shader, calls inside each other, levels of syntax and calls walked inside each
/// other, facts recorded, and nodes visited by inference: what exceeds them is `too-large`.
inline constexpr size_t kMaxSpecialisations = 4096;
inline constexpr size_t kMaxParameters = 4096;
inline constexpr unsigned kMaxCallDepth = 200;
inline constexpr unsigned kMaxWalkDepth = 3000;
inline constexpr size_t kMaxFacts = 2'000'000;
/// Elements of one table, and of all; they lie on the stack of the compiled code.
inline constexpr uint64_t kMaxTableElements = 1 << 16;
inline constexpr size_t kMaxRecordFields = 4096;
/// Elements that constructors fill with what is no constant.
inline constexpr uint64_t kMaxConstructedElements = 2048;
inline constexpr size_t kMaxImages = 1024;
inline constexpr uint64_t kMaxVisits = 100'000'000;
/// How often what stands inside each other may be differentiated.
inline constexpr unsigned kMaxDerivativeOrder = 2;

/// A variable that a specialisation may read before it assigns it: a local of an enclosing function, or a global.
struct Requirement {
  const void* variable; ///< the syntax::Local or the Global
  std::string_view name;
  Span place;
};

/// A specialisation while it is being inferred.
struct Work {
  const syntax::Function* function = nullptr;
  /// The specialisation of the enclosing function inside which this one is; null for the top level.
  Work* parent = nullptr;
  std::vector<Type> arguments;
  /// It runs while the top level does; else while shading.
  bool is_init = false;
  /// Of the top level when this one runs, for names that hide the library's; its own are at the places of its body.
  unsigned moment = HiddenNames::kShading;
  /// The only one who calls it; null where anybody may.
  Work* site = nullptr;
  /// In whose call its captured variables live, where a result captures them; null: in its own.
  Work* frame_home = nullptr;

  /// The locals of this function, in every scope.
  std::unordered_map<const syntax::Local*, Variable> variables;
  /// Set by the first `return`.
  bool has_results = false;
  /// Some `return` of the last walk gives values that are not known (an error, or not inferred yet).
  bool has_open_return = false;
  /// Its returns give different counts of values, which is reported; callers know nothing of them.
  bool has_unequal_returns = false;
  std::vector<Type> results;
  std::vector<Type> first_results; ///< those of the first `return`
  Span first_return{};
  Type conflict_type; ///< of the first result that did not fit, as Variable's
  Span conflict{};
  size_t conflict_index = 0;
  /// First expression of each result, for messages.
  std::vector<Span> result_spans;

  unsigned round = 0;     ///< in which it was walked last
  bool is_done = false;   ///< the reporting walk is over
  Work* caller = nullptr; ///< who called it first, and where (of the reporting walk)
  Span call_span{};

  // What the reporting walk finds.
  bool has_several_targets = false;      ///< some assignment has several elements of tables for targets
  std::unique_ptr<Specialisation> owned; ///< until the program takes it
  Specialisation* spec = nullptr;
  struct Callee {
    Work* work;
    Span call;
  };
  std::unordered_map<uint32_t, Callee> callees; ///< by id of the call expression
  std::set<Variable*> used;                     ///< of other homes, by this function itself
  std::vector<Variable*> captures;              ///< of other homes, by it or its callees, as Specialisation::captures
  /// Of it and its callees.
  std::vector<Requirement> requires_assigned;
  /// Locals of enclosing functions that it assigns whenever it returns; of the top level all its variables.
  /// Sorted.
  std::vector<const void*> assigns_always;
  unsigned derivative_order = 0; ///< how many gradients stand inside each other, in it and in what it calls
  bool never_returns = false;    ///< every path ends in error() or an endless loop
  /// Variables and leaves of other homes that it or its callees assign.
  std::set<Variable*> outer_writes;
};

struct WorkKey {
  const syntax::Function* function;
  Work* parent;
  bool is_init;
  Work* site;    ///< for functions whose results outlive the call: the one who calls
  uint32_t call; ///< and the id of the call
  std::vector<Type> arguments;
  unsigned moment = HiddenNames::kShading;
  bool operator==(const WorkKey&) const = default;
};
struct WorkKeyHash {
  size_t operator()(const WorkKey& key) const;
};

/// The library's own Lua. Its top level defines functions and never runs; its names are its own and the library's.
struct LibraryChunk {
  const syntax::Chunk* chunk = nullptr;
  Globals globals;
  Work* work = nullptr;
};

struct Context {
  const syntax::Chunk& chunk;
  Diagnostics& diagnostics;
  Program& program;
  Globals globals;
  HiddenNames hidden_names;
  Work* top = nullptr; ///< the top level
  /// A file that is required, and its top level.
  struct Module {
    std::string name;
    const syntax::Chunk* chunk = nullptr;
    Span required{}; ///< first
    Work* work = nullptr;
    const syntax::Stat* before = nullptr; ///< the statement of the file that requires it first, before which it runs
    bool is_certain = true;               ///< stock Lua runs it there, whatever happens
    size_t first = 0;                     ///< it, and those that run while it does: [first, its number]
  };
  std::deque<Module> modules;                ///< in the order in which they run
  std::optional<LibraryChunk> library_chunk; ///< once it is needed
  const std::function<const syntax::Chunk*()>& load_library;

  std::unordered_map<WorkKey, std::unique_ptr<Work>, WorkKeyHash> works;
  std::vector<Work*> in_order; ///< of being made: hash tables have no order of their own
  /// A reporting walk of each function, for those nested in it.
  std::unordered_map<const syntax::Function*, Work*> walked;
  std::unordered_map<const Variable*, uint32_t> globals_of; ///< variables of the top level: index in Program::globals
  /// Functions whose results are tables of their own, or functions that capture variables of theirs.
  std::set<const syntax::Function*> makers;
  /// Tables by the call and the syntax that makes them (and which one of several).
  std::map<std::tuple<const Work*, const void*, unsigned>, Table*> tables;
  uint64_t constructed_elements = 0; ///< one by one, by code
  uint64_t table_elements = 0;
  /// Locals that some declaration leaves without a value (or with too few).
  std::set<const syntax::Local*> unset_locals;

  bool report = false;
  bool collect = false;            ///< specialisations met now belong to the program
  bool specialise_unknown = false; ///< bodies that nothing calls are walked with unknown arguments
  unsigned round = 0;
  bool changed = false;
  uint64_t visits = 0;
  unsigned walk_depth = 0;
  unsigned call_depth = 0;
  size_t facts = 0;
  bool exhausted = false; ///< a limit was met: all walks end

  /// An expression of the program without a type: some error must have been reported.
  const syntax::Expr* untyped = nullptr;
  std::set<std::tuple<FileId, uint32_t, uint32_t>> reported; ///< spans, so that each place is reported once
  std::set<std::pair<const void*, const void*>> recursions;  ///< reported ones, by caller and callee
  /// Variables (syntax::Local or Global) whose values depend on the shader's parameters.
  std::set<const void*> from_parameters;
  std::unordered_map<std::string, unsigned> name_counts;
  Diagnostic silent; ///< takes the notes of messages that are not reported

  Context(const syntax::Chunk& c, const Options& options, Diagnostics& d, Program& p);

  /// The shader's file and its modules.
  std::vector<const syntax::Chunk*> chunks() const;
  const Module* find_module(std::string_view name) const;
  /// The top level of the file in which a function stands.
  Work* top_level_of(const syntax::Function& function) const;
  bool is_library_code(const Work& work) const {
    return library_chunk && top_level_of(*work.function) == library_chunk->work;
  }
  /// At which moment a place in this function is reached.
  unsigned moment_of(const Work& work, Span place) const {
    const bool is_top_level = work.is_init && work.function->parent == nullptr;
    return is_top_level ? hidden_names.moment_at(place) : work.moment;
  }
  /// The global variable or function that a name is there for this function; null where there is none, so that it is
  /// the library's or unknown. `is_open` tells that it may be both.
  Global* find_global(const Work& work, const syntax::NameExpr& name, bool* is_open = nullptr);
  /// A function of the library's own Lua; null where this host has none of it.
  const syntax::Function* library_function(std::string_view name);
  /// In whose call that lives which one call hands over to another: what files make lives as long as the shader.
  Work* residence(Work* work) const { return work->function->parent == nullptr ? top : work; }

  /// The specialisation, made where it is new; null where there are too many.
  Work* find_or_make(WorkKey key, Span place);

  /// In whose call the variable lives.
  Work* home_of(const Variable& variable) const;
  /// While shading, the top level's variables are constants.
  bool is_frozen_for(const Work& work, const Variable& variable) const {
    return !work.is_init && home_of(variable)->is_init;
  }
  /// Where a variable or leaf is to be found by a function, which uses it from now on (reporting walk).
  Place place_for(Work& work, Variable& variable, std::string_view name);
  /// The variable that a local is in a function or those around it; null where there is none.
  Variable* find_variable(Work& work, const syntax::Local& local) const;

  /// The table that this syntax makes in this call.
  Table* table_of(Work& work, const void* syntax, unsigned which, Span span);
  /// The table inside a field, made where it is new.
  Table* inner_table(Table& outer, Table::Field& field, Span span);

  /// Walks the body if it was not walked in this round yet.
  void analyse(Work& work);
  /// Silent rounds over `roots` until no type changes.
  void infer(const std::vector<Work*>& roots);
  /// The round that reports and records; it may be continued with further roots.
  void report_walk(const std::vector<Work*>& roots);
  void continue_report_walk(const std::vector<Work*>& roots);

  /// Reports in the reporting round, each place once.
  Diagnostic& error(DiagnosticCode code, Span span, std::initializer_list<std::string> args = {});
  /// A limit is exceeded: reported at once, and everything ends.
  void too_large(Span span, std::string what, size_t limit);
  /// error(), with notes "in height(vec3), called here" up to the entry point.
  bool is_reported(Span span) const { return reported.contains({span.file, span.begin, span.end}); }
  Diagnostic& type_error(const Work& work, DiagnosticCode code, Span span,
                         std::initializer_list<std::string> args = {});
};

/// Reports that a value of this type, at this place, does not fit what was given before.
void refuse_conflict(Context& context, const Work& work, const Variable& variable, std::string_view name,
                     const Type& type, Span place);
void refuse_result(Context& context, const Work& work, size_t index, const Type& type, Span place);

/// "height(vec3)"
std::string signature(const Work& work);

/// Definite assignment and missing results (assigned.cpp): after the reporting walk of the body.
void check_assigned(Context& context, Work& work);
/// At the end: the top level must have defined the entry point and assigned what it reads.
void check_assigned_for_entry(Context& context, const Work& top, const Global& global, const Work& entry);
/// Reports an assignment to what is frozen while shading (memory.cpp).
void refuse_memory(Context& context, const Work& work, std::string_view name, Span declared, Span place);
/// Order of evaluation and the sets of outer variables read and assigned (order.cpp).
void check_order(Context& context, Work& work);

} // namespace moonshade::sema
