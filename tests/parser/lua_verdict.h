// What the reference implementation says of a text: liblua5.4's own parser, called in process.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>

struct lua_State;

namespace moonshade::test {

enum class Verdict { Accepts, Refuses, OutOfCapacity };

class Lua {
public:
  Lua();

  struct Result {
    Verdict verdict;
    std::string message;
    int line = 0; // of the error
  };
  /// As `luac -p` reads a file: a byte order mark and a first line that begins with '#' are skipped.
  Result load(std::string_view text);

  /// The compiled code without its debugging information; empty where the text does not load. Line numbers of
  /// functions stay in it.
  std::string code(std::string_view text);

  using Value = std::variant<std::monostate, long long, double, std::string>;
  /// The value of `return LITERAL`; monostate where it does not load.
  Value literal(std::string_view literal);

private:
  void renew_if_large();

  std::unique_ptr<lua_State, void (*)(lua_State*)> state_;
};

} // namespace moonshade::test
