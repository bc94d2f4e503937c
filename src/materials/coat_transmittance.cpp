#include "materials/coat_transmittance.h"

#include "materials/dielectric.h"
#include "math/hash.h"

namespace duet {

namespace {

/// Rows of a table for any roughness, at alpha = (k / (kCoatRows − 1))².
constexpr int kCoatRows = 20;
/// Points of the square per cosine, and of the cube for diffuse light.
constexpr uint32_t kFacetPoints = 1024, kDiffusePoints = 16384;

/// Van der Corput's sequence in base 3.
float in_base_3(uint32_t i) {
  float x = 0, digit = 1.0f / 3;
  for (; i > 0; i /= 3, digit /= 3) x += float(i % 3) * digit;
  return x;
}

float crossing(float thickness, float cosine) {
  return std::exp(-thickness / std::max(std::abs(cosine), 1e-6f));
}

/// What of the light from `o` gets through the coat to the base.
float mean_transmittance(const RoughDielectricModel& coat, const Vector3f& o, float thickness) {
  double sum = 0;
  for (uint32_t i = 0; i < kFacetPoints; ++i) {
    const Point2f v{(float(i) + 0.5f) / kFacetPoints, to_unit_float(reverse_bits(i))};
    if (const auto s = coat.sample(o, 0.5f, v, Transport::importance))
      sum += double(s->weight.r * crossing(thickness, s->wi.z));
  }
  return float(sum / kFacetPoints);
}

}  // namespace

float smooth_coat_transmittance(float cosine, float eta, float thickness) {
  const DielectricFresnel f = fresnel_dielectric(cosine, eta);
  return (1 - f.reflectance) * crossing(thickness, f.cos_t);
}

CoatDiffuseShares smooth_coat_shares(float eta, float thickness) {
  constexpr int n = 4096;
  double returned = 0, received = 0;
  for (int i = 0; i < n; ++i) {
    // Diffuse light has the density 2 μ of the cosine μ: that of the root of an even number.
    const float mu = std::sqrt((float(i) + 0.5f) / n);
    returned += double(fresnel_dielectric(mu, 1 / eta).reflectance * crossing(thickness, mu) *
                       crossing(thickness, mu));
    received += double(smooth_coat_transmittance(mu, eta, thickness));
  }
  return {float(returned / n), float(received / n)};
}

CoatTransmittance::CoatTransmittance(float eta, float thickness, float alpha) {
  add_row(eta, thickness, alpha);
}

CoatTransmittance::CoatTransmittance(float eta, float thickness) {
  for (int k = 0; k < kCoatRows; ++k) add_row(eta, thickness, sqr(float(k) / float(kCoatRows - 1)));
}

void CoatTransmittance::add_row(float eta, float thickness, float alpha) {
  const Microfacet facets(MicrofacetDistribution::ggx_correlated, alpha, alpha, true);
  const RoughDielectricModel passing{facets, eta, Spectrum(0), Spectrum(1)};
  const RoughDielectricModel reflecting{facets, eta, Spectrum(1), Spectrum(0)};
  const size_t first = rows_.size();
  for (int k = 0; k < CoatRow::kSize; ++k) {
    const float mu = std::max(sqr(float(k) / float(CoatRow::kSize - 1)), 1e-5f);
    rows_.push_back(mean_transmittance(passing, {safe_sqrt(1 - mu * mu), 0, mu}, thickness));
  }
  const CoatRow row(rows_.data() + first, 0);
  double returned = 0, received = 0;
  for (uint32_t i = 0; i < kDiffusePoints; ++i) {
    const float mu = std::sqrt((float(i) + 0.5f) / kDiffusePoints);
    received += double(row(mu));
    const auto s =
        reflecting.sample({safe_sqrt(1 - mu * mu), 0, -mu}, 0.5f,
                          {to_unit_float(reverse_bits(i)), in_base_3(i)}, Transport::importance);
    if (s) returned += double(s->weight.r * crossing(thickness, mu) * crossing(thickness, s->wi.z));
  }
  shares_.push_back({float(returned / kDiffusePoints), float(received / kDiffusePoints)});
}

CoatTransmittance::Lookup CoatTransmittance::operator()(float alpha) const {
  if (shares_.size() == 1) return {{rows_.data(), 0}, shares_[0]};
  const float x = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * float(kCoatRows - 1);
  const int k = std::min(int(x), kCoatRows - 2);
  const float blend = x - float(k);
  const CoatDiffuseShares &a = shares_[size_t(k)], &b = shares_[size_t(k) + 1];
  return {{rows_.data() + k * CoatRow::kSize, blend},
          {lerp(a.returned, b.returned, blend), lerp(a.received, b.received, blend)}};
}

}  // namespace duet
