// Programs that must be refused.
#include "tests/lang/checks.h"

#include <lua.hpp>

#include <algorithm>
#include <memory>
#include <sstream>

namespace moonshade::lang_test {

namespace {

/// What stock Lua's parser says against the text; empty where it takes it.
std::string lua_syntax_error(const std::string& text) {
  std::unique_ptr<lua_State, decltype(&lua_close)> lua(luaL_newstate(), lua_close);
  if (luaL_loadbufferx(lua.get(), text.data(), text.size(), "=file", "t") == LUA_OK) return "";
  return lua_tostring(lua.get(), -1);
}

std::string list(const std::vector<ExpectedError>& errors) {
  std::string text;
  for (const ExpectedError& error : errors)
    text += "    " + error.place + " " + error.code + "\n";
  return text;
}

} // namespace

std::string compare_diagnostics(const CheckedShader& shader, Severity severity,
                                const std::vector<ExpectedError>& expected) {
  std::vector<ExpectedError> found;
  for (const Diagnostic* diagnostic : shader.diagnostics().sorted()) {
    if (diagnostic->severity != severity) continue;
    const LineColumn place = shader.sources().position(diagnostic->span.file, diagnostic->span.begin);
    found.push_back(
        {std::to_string(place.line) + ":" + std::to_string(place.column), std::string(name_of(diagnostic->code))});
  }
  if (found == expected) return "";
  std::ostringstream messages;
  print_text(shader.diagnostics(), shader.sources(), messages);
  return "  expected:\n" + list(expected) + "  found:\n" + list(found) + messages.str();
}

std::string check_refusal(const std::string& name, const std::string& text, const Directives& directives) {
  if (directives.errors.empty()) return "the program expects no error\n";
  const std::string syntax = lua_syntax_error(text);
  if (!syntax.empty()) return "stock Lua does not take it either: " + syntax + "\n";
  return compare_diagnostics(CheckedShader(name, text, {}, modules_beside(name)), Severity::Error, directives.errors);
}

std::string check_malformed(const std::string& name, const std::string& text, const Directives& directives) {
  if (directives.errors.empty()) return "the program expects no error\n";
  if (lua_syntax_error(text).empty()) return "stock Lua takes it\n";
  return compare_diagnostics(CheckedShader(name, text, {}, modules_beside(name)), Severity::Error, directives.errors);
}

} // namespace moonshade::lang_test
