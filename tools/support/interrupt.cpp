// A signal handler can only see static storage: the one place of the programs that has any.
#include "tools/support/interrupt.h"

#include "tools/support/exit_status.h"

#include <csignal>
#include <unistd.h>

namespace moonshade::tools {

namespace {

std::atomic<const char*> files_to_delete[size_t(FileSlot::Count)] = {};
std::atomic<std::atomic<bool>*> to_cancel{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void end_process(int) {
  // Only functions that POSIX allows in a signal handler.
  std::atomic<bool>* cancel = to_cancel.load();
  if (cancel && !cancel->exchange(true)) return;
  for (const auto& file : files_to_delete)
    if (const char* path = file.load()) unlink(path);
  _exit(kInterrupted);
}

} // namespace

void exit_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = end_process;
  action.sa_flags = SA_RESTART; // what goes on after the first signal is not to fail by it
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void cancel_on_interrupt(std::atomic<bool>* cancel) { to_cancel.store(cancel); }

void set_file_to_delete(const char* path, FileSlot slot) { files_to_delete[size_t(slot)].store(path); }

} // namespace moonshade::tools
