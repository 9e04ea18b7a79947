// Entry points: which global functions a host may ask for, with which inputs, and whether they give what they must.
#pragma once

#include "compiler/sema/context.h"

#include <vector>

namespace moonshade::sema {

struct EntryPlan {
  const Global* global;
  std::vector<Type> inputs; ///< Unknown for a parameter that is no input
  bool is_in_table;         ///< of the manual's table, with a result of its own
  bool is_selected;         ///< belongs to the program; others are only checked
  Work* work = nullptr;
};

/// A name of the manual's table.
bool is_entry_of_table(std::string_view name);

/// Refuses parameters that are no inputs, and entries asked for that do not exist.
std::vector<EntryPlan> plan_entries(Context& context, const std::vector<std::string>& asked);

/// After the reporting walk: refuses wrong results and describes the selected entries in the program.
void finish_entry(Context& context, const EntryPlan& plan);

} // namespace moonshade::sema
