// Of `goto` the dialect has the idioms `continue` and nested `break`: the label ends a block around the goto, or
// follows the statement that holds it. Both leave blocks forwards, so control stays structured.
#include "compiler/sema/walker.h"

#include <algorithm>

namespace moonshade::sema {

using namespace syntax;

void Walker::collect_labels(const Block& block) {
  bool ends_block = true;
  for (size_t i = block.stats.size(); i-- > 0;) {
    const auto* label = try_as<LabelStat>(block.stats[i]);
    if (label != nullptr) labels_[label] = {&block, i, ends_block};
    ends_block = ends_block && label != nullptr;
  }
  for (size_t i = 1; i < block.stats.size(); ++i) {
    const auto* before = try_as<LabelStat>(block.stats[i - 1]);
    const auto* label = try_as<LabelStat>(block.stats[i]);
    if (before != nullptr && label != nullptr) labels_[label].run_begin = labels_[before].run_begin;
  }
}

void Walker::check_goto(const GotoStat& stat) {
  if (stat.target == nullptr || !context_.report) return; // without a target: refused by the parser
  const auto place = labels_.find(stat.target);
  if (place != labels_.end()) {
    const auto depth = std::ranges::find(blocks_, place->second.block) - blocks_.begin();
    if (place->second.ends_block) return;
    if (positions_[static_cast<size_t>(depth)] + 1 == place->second.run_begin) return;
  }
  error(DiagnosticCode::GotoForm, stat.span, {std::string(stat.label.text)});
}

} // namespace moonshade::sema
