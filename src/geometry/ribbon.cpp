#include "geometry/ribbon.h"

#include <algorithm>

#include "geometry/surface.h"
#include "math/frame.h"

namespace duet {

namespace {

struct Control {
  Vector3f p;
  float r;

  Control operator+(const Control& o) const { return {p + o.p, r + o.r}; }
  Control operator*(float w) const { return {p * w, r * w}; }
};

/// A stretch of a segment as a cubic Bézier curve; its radius is one, too.
struct Stretch {
  Control c[4];
  float u0, u1;  ///< along the segment

  /// No radius of the stretch is larger.
  float widest() const { return std::max(std::max(c[0].r, c[1].r), std::max(c[2].r, c[3].r)); }
};

/// The curve's polar form: for equal arguments the point of the curve.
/// Source: Ramshaw, "Blossoming: A Connect-the-Dots Approach to Splines", 1987.
Control blossom(const Control c[4], float u, float v, float w) {
  const auto mix = [](const Control& x, const Control& y, float t) { return x * (1 - t) + y * t; };
  const Control q0 = mix(c[0], c[1], u), q1 = mix(c[1], c[2], u), q2 = mix(c[2], c[3], u);
  return mix(mix(q0, q1, v), mix(q1, q2, v), w);
}

/// The same from 0 to 1/2 and from 1/2 to 1, by the algorithm of de Casteljau.
std::pair<Stretch, Stretch> halves_of(const Stretch& s) {
  const auto mean = [](const Control& x, const Control& y) { return (x + y) * 0.5f; };
  const Control a = mean(s.c[0], s.c[1]), m = mean(s.c[1], s.c[2]), d = mean(s.c[2], s.c[3]);
  const Control b = mean(a, m), c = mean(m, d), middle = mean(b, c);
  const float u = (s.u0 + s.u1) * 0.5f;
  return {{{s.c[0], a, b, middle}, s.u0, u}, {{middle, c, d, s.c[3]}, u, s.u1}};
}

/// A whole segment of uniform B-splines, relative to `origin`.
Stretch whole_segment(const CurveSet& curves, uint32_t segment, const Point3f& origin) {
  const TubePoint* const q = &curves.points[curves.segments[segment]];
  const auto at = [&](int i) { return Control{q[i].position - origin, q[i].radius}; };
  const Control a = at(0), b = at(1), c = at(2), d = at(3);
  constexpr float kSixth = 1.0f / 6, kThird = 1.0f / 3;
  return {{(a + b * 4 + c) * kSixth, (b * 2 + c) * kThird, (b + c * 2) * kThird,
           (b + c * 4 + d) * kSixth},
          0,
          1};
}

Stretch part_of(const Stretch& whole, uint32_t part) {
  const float u = float(part % kRibbonParts) / kRibbonParts, v = u + 1.0f / kRibbonParts;
  const Control* const c = whole.c;
  return {
      {blossom(c, u, u, u), blossom(c, u, u, v), blossom(c, u, v, v), blossom(c, v, v, v)}, u, v};
}

/// Looks for the nearest hit of a ray that runs along +z through the origin.
class Search {
 public:
  Search(float near, float far, float widest) : near_(near), far_(far), widest_(widest) {}

  void piece(const Stretch& s) {
    if (!passes(s)) refine(s, depth_of(s));
  }
  bool found() const { return found_; }
  float distance() const { return far_; }
  float u() const { return u_; }

 private:
  /// Whether the ray is certain not to meet the stretch: it is outside of the box of the control
  /// points, along the chord and across it, by more than the radius.
  static bool passes(const Stretch& s) {
    const float dx = s.c[3].p.x - s.c[0].p.x, dy = s.c[3].p.y - s.c[0].p.y;
    const float r = s.widest(), bound = r * r * (dx * dx + dy * dy);
    const auto outside = [&](float a, float b, float c, float d) {
      const float low = std::min(std::min(a, b), std::min(c, d));
      const float high = std::max(std::max(a, b), std::max(c, d));
      return (low > 0 && low * low > bound) || (high < 0 && high * high > bound);
    };
    const auto across = [&](int i) { return s.c[i].p.x * dy - s.c[i].p.y * dx; };
    const auto along = [&](int i) { return s.c[i].p.x * dx + s.c[i].p.y * dy; };
    return outside(across(0), across(1), across(2), across(3)) ||
           outside(along(0), along(1), along(2), along(3));
  }

  /// How often pbrt halves a piece: until it is off its chord by 1/20 of the width at most.
  /// pbrt takes the largest coordinate of second differences, across the chord and along it.
  int depth_of(const Stretch& s) const {
    float cx = s.c[3].p.x - s.c[0].p.x, cy = s.c[3].p.y - s.c[0].p.y;
    const float l = std::sqrt(cx * cx + cy * cy);
    if (l > 0)
      cx /= l, cy /= l;
    else
      cx = 1, cy = 0;
    float bend = 0;
    for (int i = 0; i < 2; ++i) {
      const Vector3f d = s.c[i].p - s.c[i + 1].p * 2 + s.c[i + 2].p;
      bend = std::max(
          {bend, std::abs(d.x * cx + d.y * cy), std::abs(d.y * cx - d.x * cy), std::abs(d.z)});
    }
    const float tolerance = 2 * widest_ * 0.05f;
    if (!(bend > 0) || !(tolerance > 0)) return 0;
    // Half the logarithm to base 2, which is rounded first: that is what the other √2 is for.
    const float ratio = std::sqrt(2.0f) * 6 * bend / (8 * tolerance);
    return std::clamp(std::ilogb(std::sqrt(2.0f) * ratio) / 2, 0, 10);
  }

  void refine(const Stretch& s, int depth) {
    if (depth == 0) return nearly_straight(s);
    const auto [first, second] = halves_of(s);
    if (!passes(first)) refine(first, depth - 1);
    if (!passes(second)) refine(second, depth - 1);
  }

  void nearly_straight(const Stretch& s) {
    // It ends across its tangents at either end.
    const auto beyond = [](const Control& end, const Control& inner) {
      return end.p.x * (end.p.x - inner.p.x) + end.p.y * (end.p.y - inner.p.y) < 0;
    };
    if (beyond(s.c[0], s.c[1]) || beyond(s.c[3], s.c[2])) return;
    const Vector3f &p = s.c[0].p, chord = s.c[3].p - p;
    const float l2 = chord.x * chord.x + chord.y * chord.y;
    if (!(l2 > 0)) return;
    const float w = std::clamp(-(p.x * chord.x + p.y * chord.y) / l2, 0.0f, 1.0f);
    const Control at = blossom(s.c, w, w, w);
    const float d2 = at.p.x * at.p.x + at.p.y * at.p.y;
    if (!(at.r > 0) || d2 > at.r * at.r || !(at.p.z > near_ && at.p.z < far_)) return;
    found_ = true;
    far_ = at.p.z;
    u_ = s.u0 + (s.u1 - s.u0) * w;
  }

  float near_, far_, widest_;
  float u_ = 0;
  bool found_ = false;
};

}  // namespace

bool intersect_ribbon(const CurveSet& curves, uint32_t part, const Ray& ray, float tnear,
                      RibbonHit& hit) {
  const Stretch whole = whole_segment(curves, part / kRibbonParts, ray.origin);
  Stretch s = part_of(whole, part);
  const float l = length(ray.direction);
  const Frame along(Normal3f(ray.direction / l));
  for (Control& c : s.c) c.p = along.to_local(c.p);
  Search search(tnear * l, ray.tmax * l, whole.widest());
  search.piece(s);
  if (!search.found()) return false;
  hit = {search.distance() / l, search.u()};
  return true;
}

Bounds ribbon_bounds(const CurveSet& curves, uint32_t part) {
  const Stretch s = part_of(whole_segment(curves, part / kRibbonParts, Point3f(0)), part);
  Bounds b;
  for (const Control& c : s.c) b.extend(Point3f(c.p));
  const Vector3f margin(s.widest() + kOffsetScale * std::max(max_abs(b.lower), max_abs(b.upper)));
  b.lower = b.lower - margin, b.upper = b.upper + margin;
  return b;
}

}  // namespace duet
