// The implementations of one workload, ready to run: stock Lua, compiled code of every width, hand-written C++.
#pragma once

#include "tests/bench/workloads.h"

#include <functional>
#include <string>
#include <vector>

namespace moonshade::bench {

/// What an implementation is, for ratios.
enum class Kind : uint8_t { StockLua, LuaJit, Compiled, CompiledAvx2, Hand, HandAvx2 };

struct Contestant {
  std::string name; ///< "stock Lua", "compiled 16", "hand 32", ...
  Kind kind = Kind::Compiled;
  unsigned width = 1;
  bool chosen = false; ///< compiled code of the width that the compiler chooses
  double compile_ms = 0;
  /// Shades points begin .. begin + Grid::batch; results go to `results` from row `to` on.
  std::function<void(size_t begin, size_t to)> run;
  /// Result of a component at a row.
  std::function<double(unsigned component, size_t row)> result;

  std::vector<double> seconds; ///< a point, of each repetition
  double max_difference = 0;   ///< from stock Lua
  size_t differing = 0;        ///< points beyond the tolerance
  bool agrees = true;

  double median() const;
  double mpoints() const { return 1e-6 / median(); }
  /// Half the range of the middle half of the repetitions, as a share of the median.
  double spread() const;
};

struct Lineup {
  std::string error;
  std::vector<Contestant> contestants; ///< the first is stock Lua
};

/// Compiles and prepares; the contestants refer to `grid`.
Lineup line_up(const Workload& workload, const Grid& grid);

/// Runs every contestant over all points and compares with stock Lua.
void compare(const Workload& workload, Lineup& lineup);

/// One repetition of each, interleaved; `least_seconds` of each.
void repeat(Lineup& lineup, double least_seconds);

/// Runs LuaJIT as a child process, if there is one, for as many repetitions; its values stand in its own results.
bool add_luajit(const Workload& workload, Lineup& lineup, unsigned repetitions, double least_seconds);

} // namespace moonshade::bench
