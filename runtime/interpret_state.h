// One sandboxed Lua state that holds one loaded shader.
#pragma once

#include "runtime/image_set.h"
#include "runtime/interpret_fault.h"
#include "runtime/shader.h"
#include "stdlib/lua_images.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

struct lua_State;

namespace moonshade {

/// What a Lua state is made from; shared by the states of one shader, never changed.
struct InterpretSource {
  struct File {
    std::string module; ///< for `require`; empty for the shader itself
    std::string name;   ///< the file's, for messages
    std::string text;   ///< as written, without a first line that Lua's loader of files skips
    std::string loaded; ///< what Lua is given: the text, with counted steps where they are to be counted
  };
  std::vector<File> files; ///< the shader first, then what it requires
  uint32_t library = 0;    ///< the library's own Lua among them; 0: the shader calls none of it
  ShaderInfo info;
  std::map<std::string, Constant> parameters; ///< overrides, checked
  std::shared_ptr<const ImageSet> images;
  uint64_t step_limit = 0;
  bool impatient = false;
};

class InterpretState {
public:
  ~InterpretState();
  InterpretState(const InterpretState&) = delete;
  InterpretState& operator=(const InterpretState&) = delete;

  /// A state in which the top level has run; null with the reason in `error` where that failed.
  static std::unique_ptr<InterpretState> open(const InterpretSource& source, std::string& error);

  /// Calls an entry for point `row` of the batch and stores its results; what it prints goes to `prints`.
  FaultCode call(size_t entry, const Batch& batch, uint64_t row, uint64_t step_limit,
                 const PrintSink* prints = nullptr);
  /// Of the last call.
  uint64_t steps_left() const;
  /// Of the last call that faulted.
  InterpretFault last_fault() const;

  struct Record;

private:
  explicit InterpretState(const InterpretSource& source);
  bool load(std::string& error);
  void push_inputs(const EntryInfo& entry, const Batch& batch, uint64_t row);
  FaultCode store_results(const EntryInfo& entry, const Batch& batch, uint64_t row);
  FaultCode wrong_result(int at);
  void store_zeros(const EntryInfo& entry, const Batch& batch, uint64_t row);
  void start_counting(uint64_t limit);

  const InterpretSource& source_;
  std::unique_ptr<Record> record_; // at a fixed address: the Lua state points to it
  LuaImages images_ = {};
  lua_State* lua_ = nullptr;
};

} // namespace moonshade
