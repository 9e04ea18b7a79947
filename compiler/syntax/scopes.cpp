#include "compiler/syntax/scopes.h"

#include <algorithm>

namespace moonshade::syntax {

void Scopes::open_function(Function& function) {
  functions_.push_back({});
  functions_.back().function = &function;
  functions_.back().first_block = blocks_.size();
  open_block();
}

void Scopes::close_function() {
  close_block();
  if (!functions_.back().had_syntax_error) report_unresolved(functions_.back());
  functions_.pop_back();
}

void Scopes::report_unresolved(const FunctionScope& function) {
  for (const PendingGoto& pending : function.gotos) {
    const Name& label = pending.stat->label;
    if (pending.stat->target == nullptr)
      diagnostics_.report(DiagnosticCode::UndefinedLabel, label.span, {std::string(label.text)});
  }
}

void Scopes::open_block(Stat* loop) {
  const FunctionScope& function = functions_.back();
  blocks_.push_back({loop, visible_.size(), function.gotos.size(), function.labels.size()});
}

void Scopes::close_block() {
  FunctionScope& function = functions_.back();
  const BlockScope block = blocks_.back();
  blocks_.pop_back();
  while (visible_.size() > block.visible_begin) {
    innermost_[visible_.back().local->name] = visible_.back().shadowed;
    visible_.pop_back();
  }
  for (; function.labels.size() > block.first_label; function.labels.pop_back())
    function.label_by_name.erase(function.labels.back()->label.text);
  for (size_t i = block.first_goto; i < function.gotos.size(); ++i)
    function.gotos[i].visible = std::min(function.gotos[i].visible, block.visible_begin);
}

void Scopes::declare(Local& local) {
  const auto [found, is_new] = innermost_.try_emplace(local.name, kNone);
  visible_.push_back({&local, found->second});
  found->second = static_cast<uint32_t>(visible_.size() - 1);
}

Scopes::Resolved Scopes::resolve(std::string_view name) {
  const auto found = innermost_.find(name);
  if (found == innermost_.end() || found->second == kNone) return {};
  Local* local = visible_[found->second].local;
  const bool is_upvalue = local->function != current_function();
  local->is_captured = local->is_captured || is_upvalue;
  return {local, is_upvalue};
}

/// A label that is visible already is the target; otherwise the goto waits for one.
void Scopes::add_goto(GotoStat& stat) {
  FunctionScope& function = functions_.back();
  if (const auto found = function.label_by_name.find(stat.label.text); found != function.label_by_name.end()) {
    stat.target = found->second;
    return;
  }
  function.unresolved[stat.label.text].push_back(function.gotos.size());
  function.gotos.push_back({&stat, visible_.size()});
}

void Scopes::add_label(LabelStat& label, bool is_last) {
  FunctionScope& function = functions_.back();
  const BlockScope& block = blocks_.back();
  const auto [entry, is_new] = function.label_by_name.try_emplace(label.label.text, &label);
  if (!is_new) {
    diagnostics_.report(DiagnosticCode::DuplicateLabel, label.label.span, {std::string(label.label.text)})
        .note(DiagnosticCode::NoteLabelHere, entry->second->span, {std::string(label.label.text)});
    return;
  }
  function.labels.push_back(&label);
  const size_t visible = is_last ? block.visible_begin : visible_.size();

  // The gotos of this block and of those inside it lead here; they must see every local that is visible here.
  const auto waiting = function.unresolved.find(label.label.text);
  if (waiting == function.unresolved.end()) return;
  std::vector<size_t>& indices = waiting->second;
  for (; !indices.empty() && indices.back() >= block.first_goto; indices.pop_back()) {
    const PendingGoto& pending = function.gotos[indices.back()];
    pending.stat->target = &label;
    if (pending.visible >= visible) continue;
    const Local& entered = *visible_[pending.visible].local;
    diagnostics_
        .report(DiagnosticCode::GotoIntoScope, pending.stat->span,
                {std::string(label.label.text), std::string(entered.name)})
        .note(DiagnosticCode::NoteDeclaredHere, entered.span, {std::string(entered.name)})
        .note(DiagnosticCode::NoteLabelHere, label.span, {std::string(label.label.text)});
  }
}

void Scopes::add_break(BreakStat& stat) {
  const FunctionScope& function = functions_.back();
  for (size_t i = blocks_.size(); i-- > function.first_block;) {
    if (blocks_[i].loop == nullptr) continue;
    stat.loop = blocks_[i].loop;
    return;
  }
  if (!function.had_syntax_error) diagnostics_.report(DiagnosticCode::BreakOutsideLoop, stat.span);
}

void Scopes::note_syntax_error() {
  for (FunctionScope& function : functions_)
    function.had_syntax_error = true;
}

} // namespace moonshade::syntax
