// Generated inputs for the parser, reproducible from a seed: programs that are nearly always valid, random streams of
// tokens, and mutations of valid programs by token and by byte. The pools of names and labels are small on purpose, so
// that scopes, constants and gotos meet.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace moonshade::test {

class Generator {
public:
  explicit Generator(uint64_t seed) : random_(seed) {}

  std::string program();
  /// Without a line break.
  std::string program_on_one_line();
  /// Little but blocks, locals, labels and gotos.
  std::string program_of_jumps();
  std::string token_stream();
  std::string mutated(std::string_view program);
  std::string numeral();
  std::string string_literal();

private:
  unsigned below(unsigned limit) { return std::uniform_int_distribution<unsigned>(0, limit - 1)(random_); }
  bool chance(unsigned percent) { return below(100) < percent; }
  template <class Pool> std::string_view pick(const Pool& pool) {
    return pool[below(static_cast<unsigned>(pool.size()))];
  }
  void put(std::string_view token);
  void gap();

  void jumps(int depth);
  void jump_stat(int depth);
  void block(int depth);
  void stat(int depth);
  void loop(int depth);
  void local(int depth);
  void function_rest(int depth);
  void exprs(int depth);
  void expr(int depth);
  void suffixed(int depth, bool must_be_call);
  void var(int depth);
  void table(int depth);
  std::string any_token();
  std::string mutate_tokens(std::string_view program);
  std::string mutate_bytes(std::string_view program);

  std::mt19937_64 random_;
  std::string out_;
  int loops_ = 0;
  bool has_line_breaks_ = true;
  bool is_vararg_ = true;
};

} // namespace moonshade::test
