#include "math/motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "math/polar.h"

namespace duet {

namespace {

using Quaternion = std::array<double, 4>;

/// Source: Shepperd, "Quaternion from Rotation Matrix", J. Guidance and Control 1(3), 1978: the
/// component that is largest comes from the diagonal, the others from it.
Quaternion quaternion(const Matrix4& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  double squares[4];  // four times those of the components
  for (int i = 0; i < 3; ++i) squares[i] = 1 + 2 * r[i][size_t(i)] - trace;
  squares[3] = 1 + trace;
  const size_t largest = size_t(std::max_element(squares, squares + 4) - squares);
  Quaternion q{};
  q[largest] = 0.5 * std::sqrt(squares[largest]);
  const double scale = 0.25 / q[largest];
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double difference = scale * (r[int(k)][j] - r[int(j)][k]),  // of i and the real part
        sum = scale * (r[int(k)][j] + r[int(j)][k]);                  // of j and k
    if (largest == 3) q[i] = difference;
    if (largest == i) q[3] = difference;
    if (largest == j) q[k] = sum;
    if (largest == k) q[j] = sum;
  }
  return q;
}

/// The rotation a share of the shorter way from a to b. Source: Shoemake, "Animating Rotation with
/// Quaternion Curves", SIGGRAPH 1985.
Quaternion slerp(const Quaternion& a, Quaternion b, double share) {
  double cosine = 0;
  for (size_t i = 0; i < 4; ++i) cosine += a[i] * b[i];
  if (cosine < 0) {
    // Both signs are the same rotation.
    for (double& v : b) v = -v;
    cosine = -cosine;
  }
  double wa = 1 - share, wb = share;
  // In a small angle the sines are the angles, but not so small that the quotient is lost.
  if (const double angle = std::acos(std::min(cosine, 1.0)); angle > 1e-4) {
    wa = std::sin((1 - share) * angle) / std::sin(angle);
    wb = std::sin(share * angle) / std::sin(angle);
  }
  Quaternion q{};
  double squares = 0;
  for (size_t i = 0; i < 4; ++i) q[i] = wa * a[i] + wb * b[i], squares += q[i] * q[i];
  for (double& v : q) v /= std::sqrt(squares);
  return q;
}

Matrix4 rotation(const Quaternion& q) {
  const auto [x, y, z, w] = q;
  Matrix4 m;
  m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0};
  m[1] = {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0};
  m[2] = {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0};
  return m;
}

}  // namespace

Motion::Motion(std::vector<Keyframe> keyframes) {
  if (keyframes.empty()) return;
  Way way{std::move(keyframes), {}};
  for (const Keyframe& k : way.keyframes) {
    assert(way.parts.empty() || way.keyframes[way.parts.size() - 1].time < k.time);
    way.parts.push_back(parts(k.pose));
  }
  way_ = std::move(way);
}

const std::vector<Keyframe>& Motion::keyframes() const {
  static const std::vector<Keyframe> none;
  return way_ ? way_->keyframes : none;
}

Motion::Parts Motion::parts(const Matrix4& pose) {
  const PolarParts polar = polar_parts(pose);
  Parts p{};
  p.rotation = quaternion(polar.rotation);
  for (int i = 0; i < 3; ++i) {
    p.translation[size_t(i)] = pose[i][3];
    for (size_t j = 0; j < 3; ++j) p.stretch[size_t(i)][j] = polar.stretch[i][j];
  }
  return p;
}

Matrix4 Motion::between(const Parts& a, const Parts& b, double share) {
  Matrix4 stretch;
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      stretch[i][j] = (1 - share) * a.stretch[size_t(i)][j] + share * b.stretch[size_t(i)][j];
  Matrix4 m = rotation(slerp(a.rotation, b.rotation, share)) * stretch;
  for (int i = 0; i < 3; ++i)
    m[i][3] = (1 - share) * a.translation[size_t(i)] + share * b.translation[size_t(i)];
  return m;
}

Matrix4 Motion::at(double time) const {
  if (empty()) return {};
  const auto& [keyframes, parts] = *way_;
  const auto next = std::upper_bound(keyframes.begin(), keyframes.end(), time,
                                     [](double t, const Keyframe& k) { return t < k.time; });
  if (next == keyframes.begin()) return next->pose;
  const Keyframe& last = *std::prev(next);
  if (next == keyframes.end() || last.time == time || last.pose == next->pose) return last.pose;
  const size_t i = size_t(next - keyframes.begin());
  return between(parts[i - 1], parts[i], (time - last.time) / (next->time - last.time));
}

bool Motion::is_still(double first, double last) const {
  const Matrix4 pose = at(first);
  for (const Keyframe& k : keyframes())
    if (k.time > first && k.time < last && k.pose != pose) return false;
  return at(last) == pose;
}

}  // namespace duet
