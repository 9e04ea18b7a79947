// The library's main functions as one writes them by hand in C++, a point at a time, over the points of moonbench:
// prints million evaluations a second by name, as JSON. docs/library/speed.md stands them beside the library's
// (scripts/reference --measure). Built for this machine, without automatic vectors: what a scalar renderer would call.
//
// Perlin's and simplex noise go through Perlin's permutation table and 12 gradients, as in the published programs
// (K. Perlin, "Improving noise", 2002; S. Gustavson, "Simplex noise demystified", 2005); the rest is written plainly.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace {

struct Point {
  float x, y, z;
};

// Tables --------------------------------------------------------------------------------------------------------------

/// A permutation of 0..255, twice over; which one does not matter for the time.
std::array<uint8_t, 512> make_permutation() {
  std::array<uint8_t, 512> table{};
  std::iota(table.begin(), table.begin() + 256, uint8_t(0));
  std::shuffle(table.begin(), table.begin() + 256, std::mt19937(1));
  std::copy(table.begin(), table.begin() + 256, table.begin() + 256);
  return table;
}
const std::array<uint8_t, 512> kPermutation = make_permutation();

constexpr float kGradient[12][3] = {{1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                                    {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1}};

int fast_floor(float x) {
  const int i = int(x);
  return x < float(i) ? i - 1 : i;
}

uint32_t mix_bits(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}
uint32_t hash_cell(int x, int y, int z) {
  return mix_bits(uint32_t(x) * 0x9e3779b1u ^ uint32_t(y) * 0x85ebca77u ^ uint32_t(z) * 0xc2b2ae3du);
}
float unit_number(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

// Noise ---------------------------------------------------------------------------------------------------------------

float simplex(Point p) {
  constexpr float kSkew = 1 / 3.0f, kUnskew = 1 / 6.0f;
  const float s = (p.x + p.y + p.z) * kSkew;
  const int i = fast_floor(p.x + s), j = fast_floor(p.y + s), k = fast_floor(p.z + s);
  const float t = float(i + j + k) * kUnskew;
  const float x0 = p.x - (float(i) - t), y0 = p.y - (float(j) - t), z0 = p.z - (float(k) - t);
  int i1 = 0, j1 = 0, k1 = 0, i2 = 0, j2 = 0, k2 = 0;
  if (x0 >= y0) {
    if (y0 >= z0)
      i1 = i2 = j2 = 1;
    else if (x0 >= z0)
      i1 = i2 = k2 = 1;
    else
      k1 = i2 = k2 = 1;
  } else {
    if (y0 < z0)
      k1 = j2 = k2 = 1;
    else if (x0 < z0)
      j1 = j2 = k2 = 1;
    else
      j1 = i2 = j2 = 1;
  }
  const auto corner = [&](int di, int dj, int dk, float x, float y, float z) {
    const float r = 0.5f - x * x - y * y - z * z;
    if (r < 0) return 0.0f;
    const uint8_t* const table = kPermutation.data();
    const int h = table[(i + di) & 255], hh = table[(h + j + dj) & 255];
    const float* g = kGradient[table[(hh + k + dk) & 255] % 12];
    return r * r * r * r * (g[0] * x + g[1] * y + g[2] * z);
  };
  const float sum =
      corner(0, 0, 0, x0, y0, z0) +
      corner(i1, j1, k1, x0 - float(i1) + kUnskew, y0 - float(j1) + kUnskew, z0 - float(k1) + kUnskew) +
      corner(i2, j2, k2, x0 - float(i2) + 2 * kUnskew, y0 - float(j2) + 2 * kUnskew, z0 - float(k2) + 2 * kUnskew) +
      corner(1, 1, 1, x0 - 0.5f, y0 - 0.5f, z0 - 0.5f);
  return 76.88f * sum;
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float lerp(float t, float a, float b) { return a + t * (b - a); }

float perlin(Point p) {
  const auto gradient = [](int hash, float x, float y, float z) {
    const int h = hash & 15;
    const float u = h < 8 ? x : y, v = h < 4 ? y : h == 12 || h == 14 ? x : z;
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
  };
  const int ix = fast_floor(p.x), iy = fast_floor(p.y), iz = fast_floor(p.z), X = ix & 255, Y = iy & 255, Z = iz & 255;
  const float x = p.x - float(ix), y = p.y - float(iy), z = p.z - float(iz), u = fade(x), v = fade(y), w = fade(z);
  const uint8_t* const t = kPermutation.data();
  const int A = t[X] + Y, AA = t[A & 255] + Z, AB = t[(A + 1) & 255] + Z;
  const int B = t[X + 1] + Y, BA = t[B & 255] + Z, BB = t[(B + 1) & 255] + Z;
  const auto at = [t](int i) { return int(t[i & 255]); };
  return lerp(w,
              lerp(v, lerp(u, gradient(at(AA), x, y, z), gradient(at(BA), x - 1, y, z)),
                   lerp(u, gradient(at(AB), x, y - 1, z), gradient(at(BB), x - 1, y - 1, z))),
              lerp(v, lerp(u, gradient(at(AA + 1), x, y, z - 1), gradient(at(BA + 1), x - 1, y, z - 1)),
                   lerp(u, gradient(at(AB + 1), x, y - 1, z - 1), gradient(at(BB + 1), x - 1, y - 1, z - 1))));
}

float value_noise(Point p) {
  const int i = fast_floor(p.x), j = fast_floor(p.y), k = fast_floor(p.z);
  const float u = fade(p.x - float(i)), v = fade(p.y - float(j)), w = fade(p.z - float(k));
  const auto at = [&](int a, int b, int c) { return unit_number(hash_cell(i + a, j + b, k + c)); };
  return 2 * lerp(w, lerp(v, lerp(u, at(0, 0, 0), at(1, 0, 0)), lerp(u, at(0, 1, 0), at(1, 1, 0))),
                  lerp(v, lerp(u, at(0, 0, 1), at(1, 0, 1)), lerp(u, at(0, 1, 1), at(1, 1, 1)))) -
         1;
}

float cell_noise(Point p) { return unit_number(hash_cell(fast_floor(p.x), fast_floor(p.y), fast_floor(p.z))); }

/// F1 and F2 and the cell's number, added so that all are computed.
float worley(Point p) {
  const int i = fast_floor(p.x), j = fast_floor(p.y), k = fast_floor(p.z);
  float first = 1e30f, second = 1e30f;
  uint32_t cell = 0;
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a) {
        const uint32_t h = hash_cell(i + a, j + b, k + c);
        const float x = float(i + a) + float(h & 1023) / 1024 - p.x;
        const float y = float(j + b) + float(h >> 10 & 1023) / 1024 - p.y;
        const float z = float(k + c) + float(h >> 20 & 1023) / 1024 - p.z, square = x * x + y * y + z * z;
        if (square < first)
          second = first, first = square, cell = h;
        else if (square < second)
          second = square;
      }
  return std::sqrt(first) + std::sqrt(second) + unit_number(mix_bits(cell));
}

template <float (*Noise)(Point), bool Folded> float octaves(Point p) {
  float sum = 0, scale = 1;
  for (int i = 0; i < 6; ++i, scale *= 0.5f) {
    const float n = Noise({p.x / scale, p.y / scale, p.z / scale});
    sum += scale * (Folded ? std::abs(n) : n);
  }
  return sum;
}

// Patterns, unfiltered ------------------------------------------------------------------------------------------------

float checker(Point p) { return float((fast_floor(p.x) + fast_floor(p.y)) & 1); }

float brick(Point p) {
  const int row = fast_floor(p.y);
  const float x = p.x / 2 + (row & 1 ? 0.5f : 0.0f), y = p.y - float(row);
  const int column = fast_floor(x);
  const float along = (x - float(column)) * 2;
  const float edge = std::min(std::min(along, 2 - along), std::min(y, 1 - y)) - 0.05f;
  return (edge > 0 ? 1.0f : 0.0f) + unit_number(hash_cell(column, row, 0)) + edge;
}

float voronoi(Point p) {
  const int i = fast_floor(p.x), j = fast_floor(p.y);
  const auto site = [&](int a, int b) {
    const uint32_t h = hash_cell(a, b, 0);
    return std::pair(float(a) + float(h & 65535) / 65536 - p.x, float(b) + float(h >> 16) / 65536 - p.y);
  };
  float nearest = 1e30f;
  int ci = i, cj = j;
  for (int b = j - 1; b <= j + 1; ++b)
    for (int a = i - 1; a <= i + 1; ++a) {
      const auto [x, y] = site(a, b);
      if (x * x + y * y < nearest) nearest = x * x + y * y, ci = a, cj = b;
    }
  const auto [nx, ny] = site(ci, cj);
  float distance = 1e30f;
  for (int b = cj - 2; b <= cj + 2; ++b)
    for (int a = ci - 2; a <= ci + 2; ++a) {
      const auto [x, y] = site(a, b);
      const float dx = x - nx, dy = y - ny, square = dx * dx + dy * dy;
      if (square > 1e-12f) distance = std::min(distance, ((x + nx) * dx + (y + ny) * dy) * 0.5f / std::sqrt(square));
    }
  const float edge = distance - 0.025f;
  return (edge > 0 ? 1.0f : 0.0f) + unit_number(hash_cell(ci, cj, 1)) + edge;
}

// Numbers and vectors -------------------------------------------------------------------------------------------------

float smooth_step(float a, float b, float x) {
  const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Measuring -----------------------------------------------------------------------------------------------------------

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

const std::vector<Point>& points() {
  static const std::vector<Point> all = [] {
    std::vector<Point> made;
    for (int row = 0; row < 256; ++row)
      for (int column = 0; column < 256; ++column)
        made.push_back({(float(column) + 0.5f) / 32, (float(row) + 0.5f) / 32, 0.37f});
    return made;
  }();
  return all;
}

const char* separator = "{\n ";

template <class F> void measure(const char* name, F function) {
  std::vector<float> results(points().size());
  const auto once = [&] {
    for (size_t i = 0; i < results.size(); ++i)
      results[i] = function(points()[i]);
    asm volatile("" : : "r"(results.data()) : "memory");
  };
  once();
  double best = 1e30;
  for (int repetition = 0; repetition < 5; ++repetition) {
    const double start = thread_seconds();
    int calls = 0;
    do
      once(), ++calls;
    while (thread_seconds() - start < 0.02);
    best = std::min(best, (thread_seconds() - start) / calls);
  }
  std::printf("%s\"%s\": %.4g", separator, name, double(results.size()) / best * 1e-6);
  separator = ",\n ";
}

} // namespace

int main() {
  measure("noise(vec3)", simplex);
  measure("perlin(vec3)", perlin);
  measure("valuenoise(vec3)", value_noise);
  measure("cellnoise(vec3)", cell_noise);
  measure("worley(vec3)", worley);
  measure("fbm(vec3)", octaves<simplex, false>);
  measure("turbulence(vec3)", octaves<simplex, true>);
  measure("checker(vec2)", checker);
  measure("brick(vec2)", brick);
  measure("voronoi(vec2)", voronoi);
  measure("hash(vec3)", [](Point p) {
    return unit_number(hash_cell(int(__builtin_bit_cast(uint32_t, p.x)), int(__builtin_bit_cast(uint32_t, p.y)),
                                 int(__builtin_bit_cast(uint32_t, p.z))));
  });
  measure("mix(number, number, number)", [](Point p) { return p.x + (p.y - p.x) * p.z; });
  measure("smoothstep(number, number, number)", [](Point p) { return smooth_step(p.x, p.y, p.z); });
  measure("sin(number)", [](Point p) { return std::sin(p.x); });
  measure("exp(number)", [](Point p) { return std::exp(p.x); });
  measure("log(number)", [](Point p) { return std::log(p.x); });
  measure("pow(number, number)", [](Point p) { return std::pow(p.x, p.y); });
  measure("atan(number)", [](Point p) { return std::atan(p.x); });
  measure("sqrt(number)", [](Point p) { return std::sqrt(p.x); });
  measure("length(vec3)", [](Point p) { return std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z); });
  std::printf("\n}\n");
}
