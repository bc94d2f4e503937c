#include "lights/light_bounds.h"

namespace duet {

void DirectionCone::extend(const DirectionCone& c) {
  if (angle >= kPi) return;
  if (c.angle >= kPi) {
    *this = c;
    return;
  }
  const float between = std::atan2(length(cross(axis, c.axis)), dot(axis, c.axis));
  if (between + c.angle <= angle) return;
  if (between + angle <= c.angle) {
    *this = c;
    return;
  }
  // From the far side of one to the far side of the other.
  const float half = 0.5f * (angle + between + c.angle);
  const float turn = half - angle, sine = std::sin(between);
  constexpr float kNoTurn = 1e-6f;
  if (between < kNoTurn) {
    angle = std::max(angle, c.angle + between);
  } else if (half >= kPi || !(sine > kNoTurn)) {
    // Between opposite axes there is no way that is shorter than the others.
    *this = all();
  } else {
    axis = normalize(axis * std::sin(between - turn) + c.axis * std::sin(turn));
    angle = half;
  }
}

void LightBounds::extend(const LightBounds& b) {
  if (b.box.empty()) return;
  if (box.empty()) {
    *this = b;
    return;
  }
  box.extend(b.box);
  normals.extend(b.normals);
  spread = std::max(spread, b.spread);
  power += b.power;
}

float LightBounds::measure() const {
  const float a = normals.angle, t = std::clamp(spread, 0.0f, std::max(kPi - a, 0.0f));
  // 2π ∫ cos(x) sin(a + x) dx for x from 0 to t
  const float fading = 0.25f * (std::cos(a) - std::cos(2 * t + a)) + 0.5f * t * std::sin(a);
  return 2 * kPi * ((1 - std::cos(a)) + fading);
}

}  // namespace duet
