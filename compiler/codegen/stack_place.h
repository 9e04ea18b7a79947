// Where the stack of compiled code lies. Kernels that spill store to the stack and load constants all the time. Where
// addresses agree in their last 12 bits, processors take such a load for one of what was just stored ("4K aliasing")
// and wait; constants have these bits from where they were linked, the stack by chance, anew in every process, and a
// third of the places make a kernel of 32 lanes a fifth slower.
#pragma once

#include <cstddef>

namespace moonshade::codegen {

inline constexpr size_t kPlaces = 4096;

/// Calls `function` with the stack's end at an address that is `place` modulo kPlaces, a multiple of 16.
template <class Function> [[gnu::noinline]] void call_with_stack_at(size_t place, const Function& function) {
  size_t least = 16;
  asm volatile("" : "+r"(least)); // what has a size that is not known beforehand lies at the stack's very end
  const auto end = reinterpret_cast<size_t>(__builtin_alloca(least));
  void* moved = __builtin_alloca((end - place) % kPlaces);
  asm volatile("" : : "r"(moved) : "memory");
  function();
}

} // namespace moonshade::codegen
