#include "lights/delta.h"

#include <array>
#include <numbers>
#include <span>

#include "math/angles.h"
#include "math/equal_area.h"
#include "math/trig.h"
#include "math/warp.h"

namespace duet {

namespace {

/// Light of the given intensity at a point that is `away` from an emitter at `position`, whose rays
/// have the density `emission` there.
std::optional<LightSample> from_point(const Point3f& position, const Vector3f& away,
                                      const Spectrum& intensity, float emission) {
  const float d2 = length_squared(away);
  if (!(d2 > 0)) return std::nullopt;
  LightSample s;
  s.wi = -away * (1 / std::sqrt(d2));
  s.target = position;
  s.weight = intensity / d2;
  s.emission = emission;
  s.delta = true;
  return s;
}

/// The ray by which light comes from an emitter at a point.
std::optional<EmissionSample> reversed(const std::optional<LightSample>& s,
                                       float distance_squared) {
  if (!s || s->weight.is_black()) return std::nullopt;
  const Spectrum intensity = s->weight * distance_squared;
  return EmissionSample{
      {s->target, -s->wi, INFINITY}, intensity / s->emission, s->emission, ShapePoint{}};
}

/// The ratio of two lengths, given squared, to the power of three: what a linear map does to solid
/// angles in a direction that it stretches by that much, if its determinant is 1.
float cubed_ratio(float a2, float b2) {
  const float ratio = a2 / b2;
  return ratio * std::sqrt(ratio);
}

double inverse_determinant(const Transform& t) {
  const auto& r = t.rows();
  const auto minor = [&](size_t i, size_t j) {
    return double(r[1][i]) * double(r[2][j]) - double(r[1][j]) * double(r[2][i]);
  };
  return 1 / std::abs(double(r[0][0]) * minor(1, 2) - double(r[0][1]) * minor(0, 2) +
                      double(r[0][2]) * minor(0, 1));
}

/// Bounds of a light at a point that shines into a pyramid: within corners at z = 1 of its own
/// space.
LightBounds pyramid_bounds(const Point3f& position, const Transform& to_world,
                           std::span<const Point2f> corners) {
  LightBounds b{{position, position}, {normalize(to_world(Vector3f(0, 0, 1)))}, 0};
  float least = 1;
  for (const Point2f& c : corners)
    least = std::min(least, dot(b.normals.axis, normalize(to_world(Vector3f(c.x, c.y, 1)))));
  // The corners are the furthest from the axis as long as all are before it.
  if (!(least > 0.1f)) return LightBounds::around(b.box);
  b.normals.angle = std::acos(least) + 1e-3f;
  return b;
}

/// To look up a texture on no surface. The position is that at which a volume is looked up.
Surface at_uv(const Point2f& uv, const Point3f& position) {
  Surface s;
  s.position = position;
  s.uv = uv;
  return s;
}

}  // namespace

std::optional<LightSample> PointEmitter::sample_direct(const Point3f& from, const Point2f&) const {
  return from_point(position_, from - position_, intensity_, 0.25f * kInvPi);
}

std::optional<EmissionSample> PointEmitter::sample_emission(const Point2f&,
                                                            const Point2f& direction) const {
  const Vector3f away = square_to_sphere(direction);
  return reversed(from_point(position_, away, intensity_, 0.25f * kInvPi), length_squared(away));
}

std::optional<Point2f> PointEmitter::direction_numbers(const Vector3f& w) const {
  return sphere_to_square(w);
}

double PointEmitter::power(double) const {
  return 4 * std::numbers::pi * double(intensity_.luminance());
}

SpotEmitter::SpotEmitter(const Transform& to_world, const Spectrum& intensity, double cutoff,
                         double beam_width, const Texture* texture, SpotFalloff falloff)
    : PositionEmitter(to_world(Point3f(0, 0, 0))),
      to_world_(to_world),
      intensity_(intensity),
      cutoff_(cutoff),
      beam_width_(std::min(beam_width, cutoff)),
      cutoff_angle_(float(cutoff)),
      inv_transition_(float(1 / std::max(cutoff_ - beam_width_, 1e-30))),
      uv_scale_(float(0.5 / std::tan(cutoff))),
      falloff_(falloff),
      cos_cutoff_(float(std::cos(cutoff))),
      inv_cosines_(float(1 / std::max(std::cos(beam_width_) - std::cos(cutoff_), 1e-30))),
      span_(float(2 * std::sin(0.5 * cutoff) * std::sin(0.5 * cutoff))),
      density_(float(inverse_determinant(to_world) / (2 * std::numbers::pi * double(span_)))),
      texture_(texture) {}

std::optional<LightSample> SpotEmitter::sample_direct(const Point3f& from, const Point2f&) const {
  return send(from - position_);
}

std::optional<LightBounds> SpotEmitter::bounds() const {
  constexpr size_t kCorners = 8;
  std::array<Point2f, kCorners> corners;  // around the circle
  const float r = std::tan(cutoff_angle_) / std::cos(kPi / kCorners);
  for (size_t i = 0; i < kCorners; ++i) {
    const float phi = 2 * kPi * float(i) / kCorners;
    corners[i] = {r * std::cos(phi), r * std::sin(phi)};
  }
  if (!(cutoff_angle_ < 1.4f)) return PositionEmitter::bounds();
  return pyramid_bounds(position_, to_world_, corners);
}

inline float SpotEmitter::falloff(float angle) const {
  if (falloff_ == SpotFalloff::linear)
    return std::min((cutoff_angle_ - angle) * inv_transition_, 1.0f);
  const float t = std::clamp((std::cos(angle) - cos_cutoff_) * inv_cosines_, 0.0f, 1.0f);
  return falloff_ == SpotFalloff::smooth ? t * t * (3 - 2 * t) : t * t * t * t;
}

inline std::optional<LightSample> SpotEmitter::send(const Vector3f& away) const {
  const Vector3f local = to_world_.inverse(away);
  // By the arc tangent, because the arc cosine knows nothing about narrow cones.
  const float angle =
      2 * kPi * atan2_turns(std::sqrt(local.x * local.x + local.y * local.y), local.z);
  if (!(angle < cutoff_angle_)) return std::nullopt;
  Spectrum intensity = intensity_ * falloff(angle);
  if (texture_)
    intensity *= texture_->color(at_uv(
        {0.5f + uv_scale_ * local.x / local.z, 0.5f + uv_scale_ * local.y / local.z}, position_));
  const float stretch = cubed_ratio(length_squared(away), length_squared(local));
  return from_point(position_, away, intensity, density_ * stretch);
}

std::optional<EmissionSample> SpotEmitter::sample_emission(const Point2f&,
                                                           const Point2f& direction) const {
  const Vector3f away = to_world_(square_to_cone(direction, span_));
  return reversed(send(away), length_squared(away));
}

std::optional<Point2f> SpotEmitter::direction_numbers(const Vector3f& w) const {
  return cone_to_square(normalize(to_world_.inverse(w)), span_);
}

double SpotEmitter::power(double) const {
  // ∫ falloff(θ) sin θ dθ. What depends on the cosine alone adds its mean times the difference of
  // the cosines: one half of t²(3 − 2t), one fifth of t⁴.
  double integral = 0;
  if (falloff_ != SpotFalloff::linear) {
    const double mean = falloff_ == SpotFalloff::smooth ? 0.5 : 0.2;
    const double full = std::cos(beam_width_), none = std::cos(cutoff_);
    integral = 1 - full + mean * (full - none);
  } else if (const double fade = cutoff_ - beam_width_; fade > 1e-9) {
    integral = 1 - (std::sin(cutoff_) - std::sin(beam_width_)) / fade;
  } else {
    integral = 1 - std::cos(cutoff_);
  }
  const Spectrum mean = texture_ ? intensity_ * texture_->average() : intensity_;
  return 2 * std::numbers::pi * integral * double(mean.luminance());
}

ProjectorEmitter::ProjectorEmitter(const Transform& to_world, const ColorSlot& irradiance,
                                   float scale, double horizontal_fov, double aspect,
                                   bool is_intensity)
    : PositionEmitter(to_world(Point3f(0, 0, 0))),
      to_world_(to_world),
      axis_(to_world(Vector3f(0, 0, 1))),
      irradiance_(irradiance),
      scale_(scale),
      is_intensity_(is_intensity) {
  const double width = 2 * std::tan(0.5 * horizontal_fov * kRadians);
  inv_width_ = float(1 / width);
  inv_height_ = float(aspect / width);
  density_ = inv_width_ * inv_height_ * float(inverse_determinant(to_world));
}

std::optional<LightSample> ProjectorEmitter::sample_direct(const Point3f& from,
                                                           const Point2f&) const {
  return send(from - position_);
}

std::optional<LightBounds> ProjectorEmitter::bounds() const {
  const float x = 0.5f / inv_width_, y = 0.5f / inv_height_;
  const std::array<Point2f, 4> corners{{{x, y}, {-x, y}, {-x, -y}, {x, -y}}};
  return pyramid_bounds(position_, to_world_, corners);
}

inline std::optional<LightSample> ProjectorEmitter::send(const Vector3f& away) const {
  const Vector3f local = to_world_.inverse(away);
  // A sheared projector may turn its image's back on part of what lies before it.
  const float facing = dot(axis_, away);
  if (!(local.z > 0 && facing > 0)) return std::nullopt;
  // The image's first row is at the top; +x is at its left.
  const Point2f uv{0.5f - local.x / local.z * inv_width_, 0.5f - local.y / local.z * inv_height_};
  if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return std::nullopt;
  // Mitsuba looks up volumes at the origin of the world here, and at the light in a spot light.
  const Spectrum texel = irradiance_(at_uv(uv, Point3f(0.0f))) * scale_;
  // The distance along the axis counts in the projector's units, that to the light in the world's.
  const float d2 = length_squared(away), z2 = local.z * local.z;
  const float inv_distance = 1 / std::sqrt(d2);
  LightSample s;
  s.wi = -away * inv_distance;
  s.target = position_;
  s.weight = is_intensity_ ? texel / d2 : texel * kPi / (z2 * facing * inv_distance);
  s.emission = density_ * cubed_ratio(d2, z2);
  s.delta = true;
  return s;
}

std::optional<EmissionSample> ProjectorEmitter::sample_emission(const Point2f&,
                                                                const Point2f& direction) const {
  const Vector3f away =
      to_world_(Vector3f((0.5f - direction.x) / inv_width_, (0.5f - direction.y) / inv_height_, 1));
  return reversed(send(away), length_squared(away));
}

double ProjectorEmitter::power(double) const {
  if (is_intensity_) {
    const double a = 0.5 / double(inv_width_), b = 0.5 / double(inv_height_);
    const double solid_angle = 4 * std::atan(a * b / std::sqrt(1 + a * a + b * b));
    return solid_angle * double(scale_) * double(irradiance_.average().luminance());
  }
  return std::numbers::pi * double(scale_) * double(irradiance_.average().luminance()) /
         (double(inv_width_) * double(inv_height_));
}

GoniometricEmitter::GoniometricEmitter(const Transform& to_world, int n,
                                       std::vector<Spectrum> texels)
    : PositionEmitter(Point3f(0, 0, 0)), n_(n), texels_(std::move(texels)) {
  place(to_world);
  std::vector<float> weights;
  weights.reserve(texels_.size());
  for (const Spectrum& t : texels_) weights.push_back(std::max(t.luminance(), 0.0f));
  choice_ = DiscreteDistribution(weights);
}

void GoniometricEmitter::place(const Transform& to_world) {
  position_ = to_world(Point3f(0, 0, 0));
  to_world_ = to_world;
  density_ = float(inverse_determinant(to_world) * double(n_) * n_ / (4 * std::numbers::pi));
}

std::optional<LightSample> GoniometricEmitter::sample_direct(const Point3f& from,
                                                             const Point2f&) const {
  return send(from - position_);
}

inline std::optional<LightSample> GoniometricEmitter::send(const Vector3f& away) const {
  const Vector3f local = to_world_.inverse(away);
  const float l2 = length_squared(local);
  if (!(l2 > 0)) return std::nullopt;
  const Point2f uv = sphere_to_square_equal_area(local * (1 / std::sqrt(l2)));
  const int x = std::clamp(int(uv.x * float(n_)), 0, n_ - 1),
            y = std::clamp(int(uv.y * float(n_)), 0, n_ - 1);
  const uint32_t texel = uint32_t(y) * uint32_t(n_) + uint32_t(x);
  return from_point(position_, away, texels_[texel],
                    density_ * choice_.probability(texel) * cubed_ratio(length_squared(away), l2));
}

std::optional<EmissionSample> GoniometricEmitter::sample_emission(const Point2f& position,
                                                                  const Point2f& direction) const {
  const auto pick = choice_.sample(direction.x, position);
  const int x = int(pick.index) % n_, y = int(pick.index) / n_;
  const Vector3f away = to_world_(square_to_sphere_equal_area(
      {(float(x) + pick.remapped) / float(n_), (float(y) + direction.y) / float(n_)}));
  return reversed(send(away), length_squared(away));
}

double GoniometricEmitter::power(double) const {
  return 4 * std::numbers::pi * choice_.sum() / double(texels_.size());
}

DirectionalEmitter::DirectionalEmitter(const Transform& to_world, const Spectrum& irradiance)
    : Light(LightKind::direction) {
  const Vector3f z = to_world(Vector3f(0, 0, 1));
  toward_light_ = -normalize(z);
  irradiance_ = irradiance * length(z);
}

std::optional<LightSample> DirectionalEmitter::sample_direct(const Point3f&, const Point2f&) const {
  LightSample s;
  s.wi = toward_light_;
  s.weight = irradiance_;
  s.emission = sphere_.density();
  s.finite = false;
  s.delta = true;
  return s;
}

std::optional<EmissionSample> DirectionalEmitter::sample_emission(const Point2f& position,
                                                                  const Point2f&) const {
  if (irradiance_.is_black()) return std::nullopt;
  return EmissionSample{sphere_.enter(toward_light_, position), irradiance_ / sphere_.density(),
                        sphere_.density(), ShapePoint{}};
}

float DirectionalEmitter::direct_density(const EmissionSample&, const Point3f&) const {
  return 1;
}

double DirectionalEmitter::power(double scene_radius) const {
  return std::numbers::pi * scene_radius * scene_radius * double(irradiance_.luminance());
}

}  // namespace duet
