// Vectors, points and normals of three (and two) single-precision components.
//
// The three kinds share their arithmetic but do not convert into one another silently: a point
// minus a point is a vector, a point plus a vector is a point, and a normal becomes a vector only
// by an explicit conversion, because the two transform differently.
#pragma once

#include <algorithm>
#include <cmath>

namespace duet {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;

/// One of the three geometric meanings of a triple of numbers.
enum class TupleKind { vector, point, normal };

/// Three floats. `Vector3f v;` leaves them unset (it is in structs that are filled at each hit);
/// `Vector3f v{};` is zero.
template <TupleKind K>
struct Tuple3 {
  float x, y, z;

  Tuple3() = default;
  constexpr Tuple3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  explicit constexpr Tuple3(float v) : x(v), y(v), z(v) {}
  template <TupleKind J>
  requires(J != K) explicit constexpr Tuple3(const Tuple3<J>& o) : x(o.x), y(o.y), z(o.z) {}

  constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr bool operator==(const Tuple3&) const = default;
  constexpr Tuple3 operator-() const { return {-x, -y, -z}; }
  constexpr Tuple3 operator*(float s) const { return {x * s, y * s, z * s}; }
  constexpr Tuple3 operator/(float s) const { return *this * (1.0f / s); }
  friend constexpr Tuple3 operator*(float s, const Tuple3& a) { return a * s; }
};

using Vector3f = Tuple3<TupleKind::vector>;
using Point3f = Tuple3<TupleKind::point>;
using Normal3f = Tuple3<TupleKind::normal>;

constexpr Vector3f operator+(const Vector3f& a, const Vector3f& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Normal3f operator+(const Normal3f& a, const Normal3f& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Point3f operator+(const Point3f& a, const Vector3f& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vector3f operator-(const Vector3f& a, const Vector3f& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Point3f operator-(const Point3f& a, const Vector3f& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vector3f operator-(const Point3f& a, const Point3f& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vector3f& operator+=(Vector3f& a, const Vector3f& b) {
  return a = a + b;
}

template <TupleKind K, TupleKind J>
constexpr float dot(const Tuple3<K>& a, const Tuple3<J>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <TupleKind K, TupleKind J>
constexpr Vector3f cross(const Tuple3<K>& a, const Tuple3<J>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <TupleKind K>
constexpr float length_squared(const Tuple3<K>& a) {
  return dot(a, a);
}
template <TupleKind K>
inline float length(const Tuple3<K>& a) {
  return std::sqrt(dot(a, a));
}
template <TupleKind K>
[[gnu::always_inline]] inline Tuple3<K> normalize(const Tuple3<K>& a) {
  return a * (1.0f / std::sqrt(dot(a, a)));
}
template <TupleKind K>
constexpr float max_abs(const Tuple3<K>& a) {
  return std::max(std::max(std::abs(a.x), std::abs(a.y)), std::abs(a.z));
}
template <TupleKind K>
inline bool is_finite(const Tuple3<K>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
inline float distance(const Point3f& a, const Point3f& b) {
  return length(b - a);
}

/// A pair of numbers: film positions, texture coordinates, uniform variates. `Point2f p;` is unset.
struct Point2f {
  float x, y;
  constexpr bool operator==(const Point2f&) const = default;
  constexpr Point2f operator+(const Point2f& b) const { return {x + b.x, y + b.y}; }
  constexpr Point2f operator-(const Point2f& b) const { return {x - b.x, y - b.y}; }
  constexpr Point2f operator*(float s) const { return {x * s, y * s}; }
};

struct Point2i {
  int x = 0, y = 0;
  constexpr bool operator==(const Point2i&) const = default;
};

constexpr float sqr(float x) {
  return x * x;
}
inline float safe_sqrt(float x) {
  return std::sqrt(std::max(x, 0.0f));
}
constexpr float lerp(float a, float b, float t) {
  return a * (1 - t) + b * t;
}

/// A ray segment from `origin` along `direction` (unit length unless said otherwise) up to `tmax`.
struct Ray {
  Point3f origin;
  Vector3f direction;
  float tmax;
};

}  // namespace duet
