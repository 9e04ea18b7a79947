// lang_test [--refused|--malformed] FILE.lua...: runs test programs (README.md); prints what is wrong and exits 1 where
// something is.
#include "tests/lang/checks.h"
#include "tools/support/files.h"

#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
  using namespace moonshade;
  using namespace moonshade::lang_test;
  const bool refused = argc > 1 && std::strcmp(argv[1], "--refused") == 0;
  const bool malformed = argc > 1 && std::strcmp(argv[1], "--malformed") == 0;
  int status = 0;
  for (int i = refused || malformed ? 2 : 1; i < argc; ++i) {
    const tools::FileText file = tools::read_file(argv[i]);
    std::string problem = file.error;
    if (problem.empty()) {
      const Directives directives = read_directives(file.text);
      if (!directives.problem.empty())
        problem = "directive not understood: " + directives.problem + "\n";
      else
        problem = malformed ? check_malformed(argv[i], file.text, directives)
                            : (refused ? check_refusal : check_agreement)(argv[i], file.text, directives);
    }
    if (problem.empty()) continue;
    std::printf("%s:\n%s", argv[i], problem.c_str());
    status = 1;
  }
  return status;
}
