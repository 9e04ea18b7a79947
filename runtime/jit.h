// Machine code in this process: an object file made by codegen, linked by ORC. Each has a session of its own.
#pragma once

#include <memory>
#include <string>

namespace moonshade {

class JitCode {
public:
  /// Links the object file; what it needs from outside are the library's externals and the batch driver's functions.
  static JitCode load(std::string object);
  ~JitCode();
  JitCode(JitCode&&) noexcept;
  JitCode& operator=(JitCode&&) noexcept;

  const std::string& error() const { return error_; } ///< empty where the code was loaded
  /// The address of a function; null where there is none.
  void* function(const std::string& symbol) const;

private:
  struct Session;
  JitCode();
  std::unique_ptr<Session> session_;
  std::string error_;
};

} // namespace moonshade
