// The two kinds of test. Each gives what is wrong, one line a finding; empty where all is well.
#pragma once

#include "tests/lang/directives.h"

#include <string>

namespace moonshade::lang_test {

/// Stock Lua and every variant of compiled code agree, and with what the program expects.
std::string check_agreement(const std::string& name, const std::string& text, const Directives& directives);

/// The program is plain Lua, and is refused with exactly the expected diagnostics.
std::string check_refusal(const std::string& name, const std::string& text, const Directives& directives);

} // namespace moonshade::lang_test
