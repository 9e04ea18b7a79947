// The default floating-point environment for as long as this lives. Embree asks for flushed denormals while it builds
// and its threads are also ours: nothing of that may reach shading, whose bits must not depend on the thread.
#pragma once

#include <cfenv>

namespace moonshade::renderer {

class DefaultFloatEnvironment {
public:
  DefaultFloatEnvironment() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV); // with SSE's control word: no flushing, no denormals-are-zero, nearest, all masked
  }
  ~DefaultFloatEnvironment() { std::fesetenv(&before_); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

private:
  std::fenv_t before_;
};

} // namespace moonshade::renderer
