// Machine code in this process: an object file made by codegen, linked by JITLink. Each has memory of its own.
#pragma once

#include <map>
#include <memory>
#include <string>

namespace moonshade {

class JitCode {
public:
  /// Links the object file; what it needs from outside are the library's externals, its machine code, and the batch
  /// driver's functions.
  static JitCode load(const std::string& object);
  ~JitCode();
  JitCode(JitCode&&) noexcept;
  JitCode& operator=(JitCode&&) noexcept;

  const std::string& error() const { return error_; } ///< empty where the code was loaded
  /// The address of a function; null where there is none.
  void* function(const std::string& symbol) const;

private:
  struct Memory;
  class Context;
  JitCode();
  std::unique_ptr<Memory> memory_;
  std::map<std::string, void*> functions_;
  std::string error_;
};

} // namespace moonshade
