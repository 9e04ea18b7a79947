// Scopes while parsing, as lparser.c keeps them: which locals are visible, to which function they belong, and where
// `goto` and `break` lead. All operations take constant time, but for the visible gotos that each leaving of a block
// looks at.
#pragma once

#include "compiler/base/diagnostics.h"
#include "compiler/syntax/ast.h"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace moonshade::syntax {

class Scopes {
public:
  explicit Scopes(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// A function and its outermost block.
  void open_function(Function& function);
  void close_function();
  Function* current_function() const { return functions_.empty() ? nullptr : functions_.back().function; }

  /// A block; `loop` where it is that of a loop which `break` leaves.
  void open_block(Stat* loop = nullptr);
  void close_block();

  /// From here on the local is visible.
  void declare(Local& local);

  struct Resolved {
    Local* local = nullptr; // null: not a local
    bool is_upvalue = false;
  };
  /// The visible local of that name; marks it as captured where it is an outer function's.
  Resolved resolve(std::string_view name);

  void add_goto(GotoStat& stat);
  /// `is_last`: only labels and semicolons follow in the block, so that its locals are out of scope already.
  void add_label(LabelStat& label, bool is_last);
  void add_break(BreakStat& stat);

  /// Part of the current function could not be parsed: labels that cannot be found are no errors then.
  void note_syntax_error();

private:
  static constexpr uint32_t kNone = UINT32_MAX;

  struct VisibleLocal {
    Local* local;
    uint32_t shadowed; // index of the local of the same name that it hides, or kNone
  };
  struct PendingGoto {
    GotoStat* stat;
    size_t visible; // locals visible at the goto, those of blocks left since not counted
  };
  struct BlockScope {
    Stat* loop;
    size_t visible_begin;
    size_t first_goto;
    size_t first_label;
  };
  struct FunctionScope {
    Function* function;
    size_t first_block;
    bool had_syntax_error = false;
    std::vector<PendingGoto> gotos;
    std::unordered_map<std::string_view, std::vector<size_t>> unresolved; // indices into gotos, ascending
    std::vector<LabelStat*> labels;                                       // of the open blocks
    std::unordered_map<std::string_view, LabelStat*> label_by_name;
  };

  void report_unresolved(const FunctionScope& function);

  Diagnostics& diagnostics_;
  std::vector<VisibleLocal> visible_;
  std::unordered_map<std::string_view, uint32_t> innermost_; // index into visible_, or kNone
  std::vector<BlockScope> blocks_;
  std::vector<FunctionScope> functions_;
};

} // namespace moonshade::syntax
