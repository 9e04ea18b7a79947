// In place of TBB's header under the preset `tsan`: the thread sanitizer sees nothing of how TBB's own code hands work
// from thread to thread, and would take all that a loop reads for a race with what was written before it. Told here:
// what comes before the loop, its tasks, what comes behind it; and a task comes behind those that had ended when it
// began, for these may have been of its place in the arena. Tasks that run at once stay apart.
#pragma once

#include_next <tbb/parallel_for.h>

#include <sanitizer/tsan_interface.h>
#include <utility>

namespace tbb {

template <class Range, class Body, class... Options>
void annotated_parallel_for(const Range& range, const Body& body, Options&&... options) {
  char begun = 0, ended = 0;
  __tsan_release(&begun);
  const auto task = [&](const Range& part) {
    __tsan_acquire(&begun);
    __tsan_acquire(&ended);
    body(part);
    __tsan_release(&ended);
  };
  tbb::parallel_for(range, task, std::forward<Options>(options)...);
  __tsan_acquire(&ended);
}

} // namespace tbb

#define parallel_for annotated_parallel_for
