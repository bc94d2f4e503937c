// Numbers of many rays or paths as arrays, one number of each after the other, for loops that
// compilers turn into code for wide registers.
#pragma once

#include <array>
#include <cstdint>

#include "math/vector.h"

namespace duet {

/// So many at most; a multiple of what any register or packet of rays holds.
inline constexpr int kBatch = 256;

/// The length is not a power of two, so that elements of the same index lie in different sets of
/// the cache: loops read and write a dozen arrays at once.
template <class T>
struct alignas(64) BatchArray : std::array<T, kBatch + 64 / sizeof(T)> {
  // Indices are int, of which compilers may assume that they do not wrap around.
  [[gnu::always_inline]] T& operator[](int i) { return this->data()[i]; }
  [[gnu::always_inline]] const T& operator[](int i) const { return this->data()[i]; }
};

/// A triple of numbers for each.
struct BatchTriples {
  BatchArray<float> x, y, z;

  [[gnu::always_inline]] Point3f point(int i) const { return {x[i], y[i], z[i]}; }
  [[gnu::always_inline]] Vector3f vector(int i) const { return {x[i], y[i], z[i]}; }
  [[gnu::always_inline]] Normal3f normal(int i) const { return {x[i], y[i], z[i]}; }
  [[gnu::always_inline]] void set(int i, float a, float b, float c) {
    x[i] = a, y[i] = b, z[i] = c;
  }
  template <TupleKind K>
  [[gnu::always_inline]] void set(int i, const Tuple3<K>& v) {
    set(i, v.x, v.y, v.z);
  }
};

}  // namespace duet
