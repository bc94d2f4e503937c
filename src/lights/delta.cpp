#include "lights/delta.h"

namespace duet {

namespace {

constexpr double kPiD = 3.14159265358979323846;

/// Light of the given intensity from a point.
std::optional<LightSample> from_point(const Point3f& position, const Point3f& from,
                                      const Spectrum& intensity) {
  const Vector3f d = position - from;
  const float d2 = length_squared(d);
  if (!(d2 > 0)) return std::nullopt;
  LightSample s;
  s.wi = d * (1 / std::sqrt(d2));
  s.target = position;
  s.weight = intensity / d2;
  s.delta = true;
  return s;
}

/// Looks up a texture on no surface.
Surface at_uv(const Point2f& uv) {
  Surface s;
  s.uv = uv;
  return s;
}

}  // namespace

std::optional<LightSample> PointEmitter::sample_direct(const Point3f& from, const Point2f&) const {
  return from_point(position_, from, intensity_);
}

double PointEmitter::power(double) const {
  return 4 * kPiD * double(intensity_.luminance());
}

SpotEmitter::SpotEmitter(const Transform& to_world, const Spectrum& intensity, double cutoff,
                         double beam_width, const Texture* texture)
    : Light(LightKind::position),
      to_world_(to_world),
      position_(to_world(Point3f(0, 0, 0))),
      intensity_(intensity),
      cutoff_(cutoff),
      beam_width_(std::min(beam_width, cutoff)),
      cutoff_angle_(float(cutoff)),
      inv_transition_(float(1 / std::max(cutoff_ - beam_width_, 1e-30))),
      uv_scale_(float(0.5 / std::tan(cutoff))),
      texture_(texture) {}

std::optional<LightSample> SpotEmitter::sample_direct(const Point3f& from, const Point2f&) const {
  const Vector3f local = to_world_.inverse(from - position_);
  // By the arc tangent, because the arc cosine knows nothing about narrow cones.
  const float angle = std::atan2(std::sqrt(local.x * local.x + local.y * local.y), local.z);
  if (!(angle < cutoff_angle_)) return std::nullopt;
  const float falloff = std::min((cutoff_angle_ - angle) * inv_transition_, 1.0f);
  Spectrum intensity = intensity_ * falloff;
  if (texture_)
    intensity *= texture_->color(
        at_uv({0.5f + uv_scale_ * local.x / local.z, 0.5f + uv_scale_ * local.y / local.z}));
  return from_point(position_, from, intensity);
}

double SpotEmitter::power(double) const {
  // 2π ∫ falloff(θ) sin θ dθ
  const double fade = cutoff_ - beam_width_;
  const double solid_angle =
      fade > 1e-9 ? 2 * kPiD * (1 - (std::sin(cutoff_) - std::sin(beam_width_)) / fade)
                  : 2 * kPiD * (1 - std::cos(cutoff_));
  const Spectrum mean = texture_ ? intensity_ * texture_->average() : intensity_;
  return solid_angle * double(mean.luminance());
}

ProjectorEmitter::ProjectorEmitter(const Transform& to_world, const ColorSlot& irradiance,
                                   float scale, double horizontal_fov, double aspect)
    : Light(LightKind::position),
      to_world_(to_world),
      position_(to_world(Point3f(0, 0, 0))),
      axis_(to_world(Vector3f(0, 0, 1))),
      irradiance_(irradiance),
      scale_(scale) {
  const double width = 2 * std::tan(0.5 * horizontal_fov * kPiD / 180);
  inv_width_ = float(1 / width);
  inv_height_ = float(aspect / width);
}

std::optional<LightSample> ProjectorEmitter::sample_direct(const Point3f& from,
                                                           const Point2f&) const {
  const Vector3f local = to_world_.inverse(from - position_);
  if (!(local.z > 0)) return std::nullopt;
  // The image's first row is at the top; +x is at its left.
  const Point2f uv{0.5f - local.x / local.z * inv_width_, 0.5f - local.y / local.z * inv_height_};
  if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) return std::nullopt;
  const Spectrum image = irradiance_(at_uv(uv)) * (kPi * scale_);
  // The distance along the axis counts in the projector's units, that to the light in the world's.
  const Vector3f d = position_ - from;
  const float inv_distance = 1 / std::sqrt(length_squared(d));
  LightSample s;
  s.wi = d * inv_distance;
  s.target = position_;
  s.weight = image / (local.z * local.z * -dot(axis_, s.wi));
  s.delta = true;
  return s;
}

double ProjectorEmitter::power(double) const {
  return kPiD * double(scale_) * double(irradiance_.average().luminance()) /
         (double(inv_width_) * double(inv_height_));
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
  s.finite = false;
  s.delta = true;
  return s;
}

double DirectionalEmitter::power(double scene_radius) const {
  return kPiD * scene_radius * scene_radius * double(irradiance_.luminance());
}

}  // namespace duet
