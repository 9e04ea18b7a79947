#include "renderer/kernels/kernels.h"

namespace moonshade::renderer {

extern const Kernels kKernelsBase;
#ifdef MOONSHADE_X86_KERNELS
extern const Kernels kKernelsV3, kKernelsV4;
#endif

std::vector<const Kernels*> runnable_kernels() {
  std::vector<const Kernels*> runnable = {&kKernelsBase};
#ifdef MOONSHADE_X86_KERNELS
  if (__builtin_cpu_supports("x86-64-v3")) runnable.push_back(&kKernelsV3);
  if (__builtin_cpu_supports("x86-64-v4")) runnable.push_back(&kKernelsV4);
#endif
  return runnable;
}

const Kernels& kernels() {
  static const Kernels& best = *runnable_kernels().back();
  return best;
}

} // namespace moonshade::renderer
