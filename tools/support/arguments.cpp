// Help and version are standard output, errors of the call standard error.
#include "tools/support/arguments.h"

#include "compiler/base/printable.h"
#include "tools/support/exit_status.h"
#include "tools/support/files.h"

#include <iostream>

namespace moonshade::tools {

std::optional<int> parse_arguments(CLI::App& app, int argc, char** argv, const char* program) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return finish_output(program);
  } catch (const CLI::CallForVersion& call) {
    std::cout << call.what() << "\n";
    return finish_output(program);
  } catch (const CLI::ParseError& error) {
    std::cerr << program << ": error: " << printable(error.what(), "\n\t") << "\nTry '" << program << " --help'.\n";
    return kCallAtFault;
  }
  return std::nullopt;
}

} // namespace moonshade::tools
