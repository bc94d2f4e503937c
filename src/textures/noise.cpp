#include "textures/noise.h"

#include <cstdint>

namespace duet {

namespace {

constexpr uint8_t kPermutation[256] = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180};

uint8_t permuted(int i) {
  return kPermutation[i & 255];
}

/// One of twelve gradients, chosen by the lattice point, times the offset from it.
float slope_at(int x, int y, int z, float dx, float dy, float dz) {
  const int h = permuted(permuted(permuted(x) + y) + z) & 15;
  const bool last = h == 12 || h == 13;
  const float u = h < 8 || last ? dx : dy;
  const float v = h < 4 || last ? dy : dz;
  return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

/// 6 t⁵ − 15 t⁴ + 10 t³
float smooth_step(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

/// Rounded down; far away, where all digits are in front of the point, periodic.
int cell_of(float& x) {
  x = std::fmod(x, 0x1p30f);
  const float floor = std::floor(x);
  x -= floor;
  return int(floor);
}

/// How much the frequency grows from octave to octave: not by two, so that zeros do not fall on
/// zeros.
constexpr float kLacunarity = 1.99f;

Point3f scaled(const Point3f& p, float s) {
  return {p.x * s, p.y * s, p.z * s};
}

template <class F>
float octave_sum(const Point3f& p, float roughness, int octaves, const F& f, float& amplitude) {
  float sum = 0, frequency = 1;
  amplitude = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * f(perlin_noise(scaled(p, frequency)));
    frequency *= kLacunarity;
    amplitude *= roughness;
  }
  return sum;
}

}  // namespace

float perlin_noise(const Point3f& p) {
  float dx = p.x, dy = p.y, dz = p.z;
  const int x = cell_of(dx), y = cell_of(dy), z = cell_of(dz);
  const float wx = smooth_step(dx), wy = smooth_step(dy), wz = smooth_step(dz);
  const auto along_x = [&](int j, int k) {
    const float a = slope_at(x, y + j, z + k, dx, dy - float(j), dz - float(k));
    const float b = slope_at(x + 1, y + j, z + k, dx - 1, dy - float(j), dz - float(k));
    return a + wx * (b - a);
  };
  const auto along_y = [&](int k) {
    const float a = along_x(0, k), b = along_x(1, k);
    return a + wy * (b - a);
  };
  const float a = along_y(0), b = along_y(1);
  return a + wz * (b - a);
}

float fractal_noise(const Point3f& p, float roughness, int octaves) {
  float amplitude;
  return octave_sum(
      p, roughness, octaves, [](float n) { return n; }, amplitude);
}

float turbulence(const Point3f& p, float roughness, int octaves) {
  float amplitude;
  const float sum = octave_sum(
      p, roughness, octaves, [](float n) { return std::abs(n); }, amplitude);
  return sum + 0.2f * amplitude;
}

}  // namespace duet
