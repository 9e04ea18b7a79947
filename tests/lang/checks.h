// The kinds of test. Each gives what is wrong, one line a finding; empty where all is well.
#pragma once

#include "runtime/frontend.h"
#include "tests/lang/directives.h"

#include <filesystem>
#include <string>

namespace moonshade::lang_test {

/// Modules stand in the program's folder or the one above.
inline ModuleReader modules_beside(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(name).parent_path();
  return folder_modules({folder.string(), (folder / "..").string()});
}

/// Stock Lua and every variant of compiled code agree, and with what the program expects.
std::string check_agreement(const std::string& name, const std::string& text, const Directives& directives);

/// The places and codes of the shader's diagnostics of one severity are the expected ones.
std::string compare_diagnostics(const CheckedShader& shader, Severity severity,
                                const std::vector<ExpectedError>& expected);

/// The program is plain Lua, and is refused with exactly the expected diagnostics.
std::string check_refusal(const std::string& name, const std::string& text, const Directives& directives);

/// The same for what is no Lua: stock Lua refuses it too.
std::string check_malformed(const std::string& name, const std::string& text, const Directives& directives);

} // namespace moonshade::lang_test
