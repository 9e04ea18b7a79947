// What the exit status of every program says (part of the command line's contract).
#pragma once

namespace moonshade::tools {

enum ExitStatus : int {
  kDone = 0,
  kInputAtFault = 1,   ///< diagnostics are on standard error
  kCallAtFault = 2,    ///< a wrong option or argument
  kMachineAtFault = 3, ///< disk, memory, a defect of ours
  kInterrupted = 130,
};

} // namespace moonshade::tools
