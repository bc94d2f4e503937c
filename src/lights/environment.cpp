#include "lights/environment.h"

#include <array>
#include <cassert>
#include <numbers>

#include "math/warp.h"

namespace duet {

double EnvironmentLight::sphere_power(double radius, double mean) {
  return 4 * std::numbers::pi * std::numbers::pi * radius * radius * mean;
}

LightSample EnvironmentLight::from_afar(const Vector3f& wi, const Spectrum& radiance,
                                        PdfW pdf) const {
  LightSample s;
  s.wi = wi;
  s.weight = radiance / pdf.value;
  s.pdf = pdf;
  s.emission = pdf.value * sphere_.density();
  s.finite = false;
  return s;
}

std::optional<EmissionSample> EnvironmentLight::sample_emission(const Point2f& position,
                                                                const Point2f& direction) const {
  const auto s = sample_direct({}, direction);
  if (!s || s->weight.is_black()) return std::nullopt;
  return EmissionSample{sphere_.enter(s->wi, position), s->weight / sphere_.density(), s->emission,
                        ShapePoint{}};
}

Frame rotation(const Matrix4& m) {
  using V = std::array<double, 3>;
  std::array<V, 3> axis;
  for (size_t j = 0; j < 3; ++j) {
    V v{m.m[0][j], m.m[1][j], m.m[2][j]};
    for (size_t k = 0; k < j; ++k) {
      const double p = v[0] * axis[k][0] + v[1] * axis[k][1] + v[2] * axis[k][2];
      for (size_t i = 0; i < 3; ++i) v[i] -= p * axis[k][i];
    }
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (size_t i = 0; i < 3; ++i) axis[j][i] = v[i] / length;
  }
  const auto vector = [](const V& v) { return Vector3f(float(v[0]), float(v[1]), float(v[2])); };
  return {vector(axis[0]), vector(axis[1]), Normal3f(vector(axis[2]))};
}

std::optional<LightSample> ConstantEnvironment::sample_direct(const Point3f&,
                                                              const Point2f& u) const {
  return from_afar(square_to_sphere(u), radiance_, pdf_direct({}, {}));
}

double ConstantEnvironment::power(double scene_radius) const {
  return sphere_power(scene_radius, double(radiance_.luminance()));
}

EnvironmentMap::EnvironmentMap(int width, int height, std::vector<Spectrum> texels,
                               const Matrix4& to_world)
    : width_(width),
      height_(height),
      texels_(std::move(texels)),
      row_weights_(size_t(height)),
      axes_(rotation(to_world)) {
  assert(width >= 1 && width < BilinearDistribution::kMaxWidth && height >= 2);
  assert(texels_.size() == size_t(width) * size_t(height));
  const double step = std::numbers::pi / (height - 1);
  for (int y = 0; y < height; ++y) row_weights_[size_t(y)] = float(std::sin(y * step));
  // The density interpolates the product with sin θ, which is zero at the poles; what shines there
  // still has to be found if everything around is black.
  const float pole = height > 2 ? row_weights_[1] / 8 : 1.0f;
  row_weights_.front() = row_weights_.back() = pole;
  distribution_ =
      BilinearDistribution(width + 1, height, [&](int x, int y) { return weight(x, y); });
  // Mean over the sphere: the hat function of each row, times sin θ, integrated by hand.
  for (int y = 0; y < height; ++y) {
    const double share = y == 0 || y == height - 1
                             ? 1 - std::sin(step) / step
                             : std::sin(y * step) * 2 * (1 - std::cos(step)) / step;
    for (int x = 0; x < width; ++x)
      mean_ += 0.5 * share / width * double(std::max(texel(x, y).luminance(), 0.0f));
  }
}

inline PdfW EnvironmentMap::to_pdf(float density, float sin_theta) const {
  // (u, v) = (φ / 2π, θ / π), dω = sin θ dθ dφ = 2π² sin θ du dv
  return {density / (2 * kPi * kPi * std::max(sin_theta, 1e-7f))};
}

inline EnvironmentMap::Place EnvironmentMap::find(const Vector3f& wi) const {
  const Vector3f d = axes_.to_local(wi);
  const float r = std::sqrt(d.x * d.x + d.z * d.z);
  // Texel centres are half a column off the image's edge; φ = 0 is the edge.
  float x = atan2_turns(d.x, -d.z) * float(width_) - 0.5f;
  x += x < 0 ? float(width_) : 0.0f;
  const float y = 2 * atan2_turns(r, d.y) * float(height_ - 1);
  const int i = std::min(int(x), width_ - 1), j = std::min(int(y), height_ - 2);
  return {i, j, x - float(i), y - float(j), r};
}

inline Spectrum EnvironmentMap::radiance(const Place& p) const {
  return lerp(lerp(texel(p.x, p.y), texel(p.x + 1, p.y), p.dx),
              lerp(texel(p.x, p.y + 1), texel(p.x + 1, p.y + 1), p.dx), p.dy);
}

Spectrum EnvironmentMap::emitted(const Point3f&, const Vector3f& wi) const {
  return radiance(find(wi));
}

PdfW EnvironmentMap::pdf_direct(const Point3f&, const Vector3f& wi) const {
  const Place p = find(wi);
  const auto node = [&](int x, int y) { return weight(x, y); };
  return to_pdf(distribution_.density(p.x, p.y, p.dx, p.dy, node), p.sin_theta);
}

std::optional<LightSample> EnvironmentMap::sample_direct(const Point3f&, const Point2f& u) const {
  const auto s = distribution_.sample(u, [&](int x, int y) { return weight(x, y); });
  float sin_theta, cos_theta, sin_phi, cos_phi;
  sincos_turns(0.5f * (float(s.y) + s.dy) / float(height_ - 1), sin_theta, cos_theta);
  sincos_turns((float(s.x) + s.dx + 0.5f) / float(width_), sin_phi, cos_phi);
  const Place place{s.x, s.y, s.dx, s.dy, sin_theta};
  const PdfW pdf = to_pdf(s.density, sin_theta);
  if (!(pdf.value > 0)) return std::nullopt;
  const Vector3f d(sin_phi * sin_theta, cos_theta, -cos_phi * sin_theta);
  return from_afar(axes_.to_world(d), radiance(place), pdf);
}

double EnvironmentMap::power(double scene_radius) const {
  return sphere_power(scene_radius, mean_);
}

EnvironmentSum::EnvironmentSum(std::vector<std::unique_ptr<EnvironmentLight>> parts)
    : parts_(std::move(parts)) {
  std::vector<float> powers;
  for (const auto& p : parts_) powers.push_back(float(p->power(1)));
  choice_ = DiscreteDistribution(powers);
}

std::optional<LightSample> EnvironmentSum::sample_direct(const Point3f& from,
                                                         const Point2f& u) const {
  const DiscreteDistribution::Pick part = choice_.sample(u.x, u);
  const auto s = parts_[part.index]->sample_direct(from, {part.remapped, u.y});
  if (!s) return std::nullopt;
  const PdfW pdf = pdf_direct(from, s->wi);
  if (!(pdf.value > 0)) return std::nullopt;
  return from_afar(s->wi, emitted(from, s->wi), pdf);
}

Spectrum EnvironmentSum::emitted(const Point3f& from, const Vector3f& wi) const {
  Spectrum sum;
  for (const auto& p : parts_) sum += p->emitted(from, wi);
  return sum;
}

PdfW EnvironmentSum::pdf_direct(const Point3f& from, const Vector3f& wi) const {
  float sum = 0;
  for (size_t i = 0; i < parts_.size(); ++i)
    sum += choice_.probability(uint32_t(i)) * parts_[i]->pdf_direct(from, wi).value;
  return {sum};
}

double EnvironmentSum::power(double scene_radius) const {
  double sum = 0;
  for (const auto& p : parts_) sum += p->power(scene_radius);
  return sum;
}

}  // namespace duet
