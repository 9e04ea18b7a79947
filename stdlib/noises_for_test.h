// Every noise with what it promises, over the lane type W: for the tests of all of them (noise_families_test.cpp), and
// for the long ones (tests/exhaustive).
#pragma once

#include "stdlib/curl.h"
#include "stdlib/gabor.h"
#include "stdlib/periodic_noise.h"
#include "stdlib/perlin.h"
#include "stdlib/worley.h"

#include <ostream>
#include <vector>

namespace moonshade::stdlib {

/// A noise of up to four dimensions.
template <class W> struct Noise {
  const char* name;
  int dimensions;
  W (*at)(const Vec<4, W>&);
  double low, high, mean, deviation;
  bool smooth;

  friend void PrintTo(const Noise& noise, std::ostream* out) { *out << noise.name; }
};

template <int N, class W> Vec<N, W> first_of(const Vec<4, W>& p) {
  Vec<N, W> q;
  for (int i = 0; i < N; ++i)
    q[i] = p[i];
  return q;
}

/// A vector of one number in all components and lanes.
template <int N, class W> Vec<N, W> vector_of(double x) {
  return map<N, W>([](W x) { return x; }, constant<W>(x));
}

/// Points all over a block of side 1000, by a counter.
template <class W> struct RandomPoints {
  uint64_t state = 1;
  double next() {
    state += 0x9e3779b97f4a7c15u;
    uint64_t x = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return double(int64_t(x ^ (x >> 31))) * 0x1p-63 * 500;
  }
  Vec<4, W> block(int dimensions) {
    Vec<4, W> p = vector_of<4, W>(0);
    for (int i = 0; i < dimensions; ++i)
      for (int lane = 0; lane < width_of<W>; ++lane)
        p[i][lane] = next();
    return p;
  }
};

#define OF(N, expression)                                                                                              \
  N, [](const Vec<4, W>& p4) -> W {                                                                                    \
    [[maybe_unused]] const auto p = first_of<N, W>(p4);                                                                \
    return expression;                                                                                                 \
  }

// Limits, mean and standard deviation as the headers state them or follow from what they state; where only a sum of
// everything's maxima bounds the range, what the points looked at have shown, rounded up.
template <class W> std::vector<Noise<W>> all_noises() {
  return {
      {"noise1", OF(1, noise<W>(p)), -1, 1, 0, 0.330, true},
      {"noise2", OF(2, noise<W>(p)), -1, 1, 0, 0.544, true},
      {"noise3", OF(3, noise<W>(p)), -1, 1, 0, 0.392, true},
      {"noise4", OF(4, noise<W>(p)), -1, 1, 0, 0.254, true},
      {"perlin1", OF(1, perlin<W>(p[0])), -1, 1, 0, 0.194, true},
      {"perlin2", OF(2, perlin<W>(p)), -1, 1, 0, 0.256, true},
      {"perlin3", OF(3, perlin<W>(p)), -1.04, 1.04, 0, 0.271, true},
      {"perlin4", OF(4, perlin<W>(p)), -1.5, 1.5, 0, 0.293, true},
      {"valuenoise1", OF(1, valuenoise<W>(p)), -1, 1, 0, 0.517, true},
      {"valuenoise2", OF(2, valuenoise<W>(p)), -1, 1, 0, 0.454, true},
      {"valuenoise3", OF(3, valuenoise<W>(p)), -1, 1, 0, 0.400, true},
      {"valuenoise4", OF(4, valuenoise<W>(p)), -1, 1, 0, 0.354, true},
      {"cellnoise1", OF(1, cellnoise<W>(p)), 0, 1, 0.5, 0.2887, false},
      {"cellnoise3", OF(3, cellnoise<W>(p)), 0, 1, 0.5, 0.2887, false},
      {"cellnoise4", OF(4, cellnoise<W>(p)), 0, 1, 0.5, 0.2887, false},
      {"worley1", OF(1, worley<W>(p).first), 0, 1, 0.292, 0.201, false},
      {"worley2", OF(2, worley<W>(p).first), 0, 1.4143, 0.429, 0.190, false},
      {"worley3", OF(3, worley<W>(p).first), 0, 1.7321, 0.520, 0.172, false},
      {"worley4", OF(4, worley<W>(p).first), 0, 2, 0.590, 0.156, false},
      {"worley3 F2", OF(3, worley<W>(p).second), 0, 2.07, 0.717, 0.143, false},
      {"worley3 cell", OF(3, worley<W>(p).third), 0, 1, 0.5, 0.2887, false},
      {"worley3 manhattan", OF(3, worley<W>(p, constant<W>(1)).first), 0, 3, 0.765, 0.255, false},
      {"worley3 chebyshev", OF(3, worley<W>(p, infinity<W>()).first), 0, 1, 0.421, 0.140, false},
      {"gabor1", OF(1, gabor<W>(p, constant<W>(4))), -8, 8, 0, 0.333, true},
      {"gabor2", OF(2, gabor<W>(p, constant<W>(4))), -8, 8, 0, 0.333, true},
      {"gabor3", OF(3, gabor<W>(p, constant<W>(4))), -8, 8, 0, 0.333, true},
      {"gabor3 wave", OF(3, gabor<W>(p, vector_of<3, W>(2.5))), -8, 8, 0, 0.333, true},
      {"pnoise1", OF(1, pnoise<W>(p, vector_of<1, W>(4096))), -1, 1, 0, 0.330, true},
      {"pnoise2", OF(2, pnoise<W>(p, vector_of<2, W>(113))), -1, 1, 0, 0.452, true},
      {"pnoise3", OF(3, pnoise<W>(p, vector_of<3, W>(113))), -1, 1, 0, 0.393, true},
      {"pnoise4", OF(4, pnoise<W>(p, vector_of<4, W>(113))), -1, 1, 0, 0.351, true},
      {"pperlin3", OF(3, pperlin<W>(p, vector_of<3, W>(113))), -1.04, 1.04, 0, 0.271, true},
      {"pvaluenoise3", OF(3, pvaluenoise<W>(p, vector_of<3, W>(113))), -1, 1, 0, 0.400, true},
      {"pcellnoise3", OF(3, pcellnoise<W>(p, vector_of<3, W>(113))), 0, 1, 0.5, 0.2887, false},
      {"pworley3", OF(3, pworley<W>(p, vector_of<3, W>(113), constant<W>(2)).first), 0, 1.7321, 0.520, 0.172, false},
      {"pgabor2", OF(2, pgabor<W>(p, vector_of<2, W>(113), constant<W>(4))), -8, 8, 0, 0.333, true},
      {"vnoise3 y", OF(3, vnoise<W>(p)[1]), -1, 1, 0, 0.392, true},
      {"vnoise4 z", OF(4, vnoise<W>(p)[2]), -1, 1, 0, 0.254, true},
      {"vperlin3 z", OF(3, vperlin<W>(p)[2]), -1.04, 1.04, 0, 0.271, true},
      {"vvaluenoise2 y", OF(2, vvaluenoise<W>(p)[1]), -1, 1, 0, 0.454, true},
      {"vcellnoise3 z", OF(3, vcellnoise<W>(p)[2]), 0, 1, 0.5, 0.2887, false},
      {"curl2 x", OF(2, curl<W>(p)[0]), -10, 10, 0, 2.60, false},
      {"curl3 y", OF(3, curl<W>(p)[1]), -10, 10, 0, 2.48, false},
      {"curl4 z", OF(4, curl<W>(p)[2]), -10, 10, 0, 1.555, false},
  };
}

#undef OF

} // namespace moonshade::stdlib
