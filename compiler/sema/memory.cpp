// A shader has no memory between points: what an entry point can reach must not assign the top level's variables. The
// way to such a write is the shortest chain of calls. Functions that only the top level calls, while it runs, could do
// it; that is not built yet.
#include "compiler/sema/context.h"

#include <deque>

namespace moonshade::sema {

using Code = DiagnosticCode;

namespace {

/// How a specialisation is reached first, breadth first.
struct Step {
  const Work* caller = nullptr;
  Span call{};
};
using Steps = std::unordered_map<const Work*, Step>;

Steps reachable_from(const std::vector<const Work*>& roots) {
  Steps steps;
  std::deque<const Work*> queue;
  for (const Work* root : roots)
    if (steps.try_emplace(root).second) queue.push_back(root);
  for (; !queue.empty(); queue.pop_front())
    for (const auto& [id, callee] : queue.front()->callees)
      if (steps.try_emplace(callee.work, Step{queue.front(), callee.call}).second) queue.push_back(callee.work);
  return steps;
}

void refuse(Context& context, const Work& work, const Work::TopLevelWrite& write, const Steps& steps) {
  const std::string name(write.local->name);
  Diagnostic& diagnostic = context.error(Code::NoMemory, write.place, {name});
  if (&diagnostic == &context.silent) return;
  diagnostic.note(Code::NoteDeclaredHere, write.local->span, {name});
  constexpr int kMostNotes = 8;
  const Work* at = &work;
  for (int notes = 0; notes < kMostNotes; ++notes) {
    const auto step = steps.find(at);
    if (step == steps.end() || step->second.caller == nullptr) break;
    diagnostic.note(Code::NoteInSpecialisation, step->second.call, {signature(*at)});
    at = step->second.caller;
  }
}

} // namespace

void check_memory(Context& context, const std::vector<Work*>& entries, const Work& top) {
  const Steps from_entries = reachable_from({entries.begin(), entries.end()});
  const Steps from_top = reachable_from({&top});
  for (const bool while_shading : {true, false}) // a place that both can reach is refused for good
    for (const Work* work : context.in_order)
      for (const Work::TopLevelWrite& write : work->top_level_writes) {
        const bool by_top_alone = from_top.contains(work) && !from_entries.contains(work);
        if (by_top_alone == while_shading) continue;
        if (while_shading) {
          refuse(context, *work, write, from_entries);
        } else {
          context.error(Code::NotAvailableYet, write.place,
                        {"assignments by functions to variables of the top level, while it runs, are"});
        }
      }
}

} // namespace moonshade::sema
