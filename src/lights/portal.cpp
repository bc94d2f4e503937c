#include "lights/portal.h"

#include <algorithm>

#include "math/warp.h"

namespace duet {

namespace {

/// Rays closer to the rectangle's plane than this are neither emitted nor looked for.
constexpr float kLeastCosine = 1e-6f;

}  // namespace

PortalEnvironment::PortalEnvironment(std::unique_ptr<EnvironmentLight> environment,
                                     const std::array<Point3f, 4>& corners, float environment_share)
    : environment_(std::move(environment)),
      corner_(corners[0]),
      sides_{corners[3] - corners[0], corners[1] - corners[0]},
      normal_(normalize(cross(sides_[0], sides_[1]))),
      area_(length(cross(sides_[0], sides_[1]))),
      share_(environment_share) {}

float PortalEnvironment::window_density(const Point3f& from, const Vector3f& wi) const {
  const float cosine = dot(normal_, wi);
  const float ahead = dot(normal_, corner_ - from);
  if (!(cosine > kLeastCosine && ahead > 0)) return 0;
  const float t = ahead / cosine;
  const Vector3f in_plane = from + wi * t - corner_;
  for (const Vector3f& side : sides_) {
    const float x = dot(in_plane, side);
    if (!(x >= 0 && x <= length_squared(side))) return 0;
  }
  return sqr(t) / (area_ * cosine);
}

inline PdfW PortalEnvironment::mixed(const Point3f& from, const Vector3f& wi, float window) const {
  const float environment = share_ > 0 ? environment_->pdf_direct(from, wi).value : 0;
  return {share_ * environment + (1 - share_) * window};
}

Spectrum PortalEnvironment::emitted(const Point3f& from, const Vector3f& wi) const {
  if (window_density(from, wi) == 0) return {};
  return environment_->emitted(from, wi);
}

PdfW PortalEnvironment::pdf_direct(const Point3f& from, const Vector3f& wi) const {
  const float window = window_density(from, wi);
  return window == 0 ? PdfW{0} : mixed(from, wi, window);
}

std::optional<LightSample> PortalEnvironment::sample_direct(const Point3f& from,
                                                            const Point2f& u) const {
  if (!(dot(normal_, corner_ - from) > 0)) return std::nullopt;
  Vector3f wi;
  if (u.x < share_) {
    const auto chosen = environment_->sample_direct(from, {std::min(u.x / share_, kBelowOne), u.y});
    if (!chosen) return std::nullopt;
    wi = chosen->wi;
  } else {
    const float x = (u.x - share_) / (1 - share_);
    wi = normalize(corner_ + sides_[0] * x + sides_[1] * u.y - from);
  }
  const float window = window_density(from, wi);
  if (window == 0) return std::nullopt;
  LightSample s = from_afar(wi, environment_->emitted(from, wi), mixed(from, wi, window));
  s.emission = emission_density(wi);
  return s;
}

double PortalEnvironment::power(double) const {
  // The environment's mean radiance, through the rectangle's front side.
  const double mean = environment_->power(1) / sphere_power(1, 1);
  return double(kPi) * double(area_) * mean;
}

std::optional<EmissionSample> PortalEnvironment::sample_emission(const Point2f& position,
                                                                 const Point2f& direction) const {
  const auto s = environment_->sample_direct({}, direction);
  if (!s || s->weight.is_black()) return std::nullopt;
  const float density = emission_density(s->wi);
  if (density == 0) return std::nullopt;
  const Point3f through = corner_ + sides_[0] * position.x + sides_[1] * position.y;
  const Ray ray = sphere().enter(s->wi, through);
  return EmissionSample{ray, s->weight * (s->pdf.value / density), density, ShapePoint{},
                        dot(through - ray.origin, ray.direction)};
}

float PortalEnvironment::emission_density(const Vector3f& wi) const {
  const float cosine = dot(normal_, wi);
  if (!(cosine > kLeastCosine)) return 0;
  return environment_->pdf_direct({}, wi).value / (area_ * cosine);
}

void PortalEnvironment::surround(const Point3f& center, float radius) {
  EnvironmentLight::surround(center, radius);
  environment_->surround(center, radius);
}

}  // namespace duet
