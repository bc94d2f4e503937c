#include "materials/microfacet.h"

namespace duet {

Microfacet::Core Microfacet::beckmann_core(const Vector3f& o, const Vector3f& i,
                                           const Vector3f& h) const {
  return beckmann().core(o, i, h);
}

Vector3f Microfacet::sample_all(const Point2f& u) const {
  const Point2f p = square_to_disk(u);
  const float r2 = std::min(p.x * p.x + p.y * p.y, kBelowOne);
  // Slopes of unit roughness at the distance that belongs to the quantile r².
  const float tan2_over_r2 = ggx_ ? 1 / (1 - r2) : (r2 > 1e-6f ? -std::log1p(-r2) / r2 : 1.0f);
  const float scale = std::sqrt(tan2_over_r2);
  return normalize(Vector3f(alpha_u_ * p.x * scale, alpha_v_ * p.y * scale, 1));
}

Vector3f Microfacet::sample_visible_beckmann(const Vector3f& o, const Point2f& u) const {
  return beckmann().sample(o, u);
}

}  // namespace duet
