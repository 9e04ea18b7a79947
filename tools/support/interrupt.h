// Ctrl-C: the process ends with status 130 and leaves no half-written file; or, where there is work to save, the first
// one asks for an end in order.
#pragma once

#include <atomic>

namespace moonshade::tools {

/// From now on SIGINT and SIGTERM end the process with status 130, after deleting the registered temporary files.
void exit_on_interrupt();

/// For as long as `cancel` is not null, the first signal only sets it; the next one ends the process.
void cancel_on_interrupt(std::atomic<bool>* cancel);

/// The temporary file to delete on an interrupt; null for none. The text must live until the next call of the same
/// slot: each slot is for one file at a time.
enum class FileSlot { Output, Image, Count };
void set_file_to_delete(const char* path, FileSlot slot = FileSlot::Output);

} // namespace moonshade::tools
