// The hand-written noises on one lane for LuaJIT's FFI.
#include "tests/bench/hand/perlin.h"
#include "tests/bench/hand/simplex.h"
#include "tests/bench/hand/worley.h"

extern "C" {
#define EXPORT [[gnu::visibility("default")]]
EXPORT float hand_noise(float x, float y, float z) { return hand::Simplex<1>::noise({x, y, z}); }
EXPORT float hand_perlin(float x, float y, float z) { return hand::perlin<1>({x, y, z}); }
EXPORT float hand_worley(float x, float y, float z) { return hand::Worley<1>().run({x, y, z}); }
EXPORT void hand_noise_gradient(float x, float y, float z, hand::Vec3<1>* gradient) {
  *gradient = hand::Simplex<1>::gradient({x, y, z});
}
}
