// A signal handler can only see static storage: the one place of the programs that has any.
#include "tools/support/interrupt.h"

#include "tools/support/exit_status.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace moonshade::tools {

namespace {

std::atomic<const char*> file_to_delete{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free);

extern "C" void end_process(int) {
  // Only functions that POSIX allows in a signal handler.
  if (const char* path = file_to_delete.load()) unlink(path);
  _exit(kInterrupted);
}

} // namespace

void exit_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = end_process;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void set_file_to_delete(const char* path) { file_to_delete.store(path); }

} // namespace moonshade::tools
