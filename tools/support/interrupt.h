// Ctrl-C in programs that have nothing to save: the process ends with status 130 and leaves no half-written file.
#pragma once

namespace moonshade::tools {

/// From now on SIGINT and SIGTERM end the process with status 130, after deleting the registered temporary file.
void exit_on_interrupt();

/// The temporary file to delete on an interrupt; null for none. The text must live until the next call. At most one
/// file is being written at a time.
void set_file_to_delete(const char* path);

} // namespace moonshade::tools
