#include "materials/rough_transmittance.h"

#include <numbers>
#include <utility>

#include "materials/microfacet.h"

namespace duet {

namespace {

constexpr int kSize = TransmittanceRow::kSize;
/// Rows of a table for any roughness, at alpha = kLargestAlpha · (k / (kRows − 1))².
constexpr int kRows = 20;
constexpr float kLargestAlpha = 2;

/// Gauss-Legendre quadrature on [0, 1]; the weights sum to one.
struct Quadrature {
  std::vector<float> nodes, weights;

  explicit Quadrature(int n) : nodes(size_t(n)), weights(size_t(n)) {
    for (int i = 0; i < n; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), derivative = 1;
      for (int step = 0; step < 8; ++step) {
        double p0 = 1, p1 = x;
        for (int k = 2; k <= n; ++k)
          p0 = std::exchange(p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k);
        derivative = n * (x * p1 - p0) / (x * x - 1);
        x -= p1 / derivative;
      }
      nodes[size_t(i)] = float(0.5 * (1 - x));
      weights[size_t(i)] = float(1 / ((1 - x * x) * derivative * derivative));
    }
  }
};

/// The visible facets as nodes of a product quadrature. Where a facet distribution is narrow this
/// quadrature is off by up to 1 % of what is integrated; to agree with Mitsuba 3 it has to be the
/// same, down to the map from the square to visible normals (Heitz, "Sampling the GGX Distribution
/// of Visible Normals", JCGT 7(4), 2018; Jakob 2014). Half of the nodes is enough, as the facets
/// are symmetric about the plane of incidence. Loops are written so that the compiler can vectorise
/// them.
class VisibleFacets {
 public:
  VisibleFacets(MicrofacetDistribution distribution, float alpha, int n)
      : microfacet_(distribution, alpha, alpha, true),
        alpha_(std::max(alpha, Microfacet::kMinAlpha)),
        ggx_(distribution != MicrofacetDistribution::beckmann),
        correlated_(distribution == MicrofacetDistribution::ggx_correlated),
        quadrature_(n),
        disk_x_(ggx_ ? size_t(n) * size_t(n) / 2 : 0),
        disk_y_(disk_x_.size()),
        across_(size_t(n) / 2) {
    for (size_t b = 0; b < size_t(n) / 2; ++b) {
      const float v = quadrature_.nodes[b];
      if (!ggx_) across_[b] = slopes(microfacet_.sample({0, 0, 1}, {0.5f, v})).y;
      for (size_t a = 0; ggx_ && a < size_t(n); ++a) {
        const Point2f p = square_to_disk({v, quadrature_.nodes[a]});
        disk_x_[b * size_t(n) + a] = p.x, disk_y_[b * size_t(n) + a] = p.y;
      }
    }
  }

  /// Share of the light from o, which has o.y = 0, that passes or is reflected at an interface of
  /// relative index `eta` after one encounter with a facet, and is not masked.
  float transmittance(const Vector3f& o, float eta) const { return mean<true>(o, eta); }
  float reflectance(const Vector3f& o, float eta) const { return mean<false>(o, eta); }

 private:
  static constexpr size_t kMaxNodes = 128;

  /// Slopes of the surface, scaled to unit roughness, at which a facet has the normal m.
  Point2f slopes(const Vector3f& m) const { return {-m.x / (m.z * alpha_), -m.y / (m.z * alpha_)}; }

  template <bool kTransmitted>
  float mean(const Vector3f& o, float eta) const {
    const size_t n = quadrature_.nodes.size();
    float along[kMaxNodes], across[kMaxNodes], values[kMaxNodes];
    for (size_t a = 0; !ggx_ && a < n; ++a)
      along[a] = slopes(microfacet_.sample(o, {quadrature_.nodes[a], 0.5f})).x;
    float sum = 0;
    for (size_t b = 0; b < n / 2; ++b) {
      if (ggx_) {
        ggx_slopes(o, b, along, across);
      } else {
        std::fill_n(across, n, across_[b]);
      }
      weigh<kTransmitted>(o, eta, along, across, values);
      float row = 0;
      for (size_t a = 0; a < n; ++a) row += quadrature_.weights[a] * values[a];
      sum += quadrature_.weights[b] * row;
    }
    return 2 * sum;
  }

  /// From points of the disk to slopes of facets that are visible from o, for unit roughness.
  void ggx_slopes(const Vector3f& o, size_t b, float* along, float* across) const {
    const size_t n = quadrature_.nodes.size();
    const Vector3f w = normalize(Vector3f(alpha_ * o.x, 0, o.z));
    const float s = 0.5f * (1 + w.z);
    const float *x = disk_x_.data() + b * n, *y = disk_y_.data() + b * n;
    for (size_t a = 0; a < n; ++a) {
      const float xx = x[a] * x[a];
      const float up = std::sqrt(std::max(1 - xx, 0.0f)) * (1 - s) + y[a] * s;
      const float z = std::sqrt(std::max(1 - xx - up * up, 0.0f));
      const float scale = 1 / (w.x * up + w.z * z);
      along[a] = (w.z * up - w.x * z) * scale;
      across[a] = x[a] * scale;
    }
  }

  /// What the facets at these slopes pass on or reflect.
  template <bool kTransmitted>
  void weigh(const Vector3f& o, float eta, const float* along, const float* across,
             float* values) const {
    const float alpha = alpha_, inv_eta = 1 / eta;
    const size_t n = quadrature_.nodes.size();
    float cosines[kMaxNodes];
    for (size_t a = 0; a < n; ++a) {
      const float slope2 = along[a] * along[a] + across[a] * across[a];
      const float cos_n = 1 / std::sqrt(1 + alpha * alpha * slope2);
      const float c = cos_n * (o.z - alpha * along[a] * o.x);
      // fresnel_dielectric() without branches.
      const float cos2_t = 1 - (1 - c * c) * (inv_eta * inv_eta);
      const float cos_t = std::sqrt(std::max(cos2_t, 0.0f));
      const float b = c + eta * cos_t, d = eta * c + cos_t;
      const float p = (c - eta * cos_t) * d, q = (eta * c - cos_t) * b;
      const float f = 0.5f * (p * p + q * q) / (b * b * d * d);
      const float reflected = cos2_t > 0 ? f : 1.0f;
      const float z =
          kTransmitted ? o.z * inv_eta - cos_n * (c * inv_eta - cos_t) : 2 * c * cos_n - o.z;
      cosines[a] = std::max(z, 0.0f);
      values[a] = c > 0 ? (kTransmitted ? 1 - reflected : reflected) : 0.0f;
    }
    if (correlated_) {
      const float far = stretched(o.z);
      for (size_t a = 0; a < n; ++a)
        values[a] *= (o.z + far) * cosines[a] / (far * cosines[a] + o.z * stretched(cosines[a]));
    } else if (ggx_) {
      for (size_t a = 0; a < n; ++a) values[a] *= ggx_masking(cosines[a]);
    } else {
      for (size_t a = 0; a < n; ++a) values[a] *= beckmann_masking(cosines[a]);
    }
  }

  /// Microfacet::masking() at the cosine z.
  float ggx_masking(float z) const { return 2 * z / (z + stretched(z)); }
  /// Length of the direction with this cosine after stretching it by the roughness.
  float stretched(float z) const {
    const float z2 = z * z;
    return std::sqrt(z2 + alpha_ * alpha_ * std::max(1 - z2, 0.0f));
  }
  float beckmann_masking(float z) const {
    const float a = z / std::sqrt(alpha_ * alpha_ * std::max(1 - z * z, 1e-20f));
    const float rational = a * (3.535f + 2.181f * a) / (1 + a * (2.276f + 2.577f * a));
    return a < 1.6f ? rational : 1.0f;
  }

  Microfacet microfacet_;
  float alpha_;
  bool ggx_, correlated_;
  Quadrature quadrature_;
  std::vector<float> disk_x_, disk_y_, across_;
};

int quadrature_size(float eta) {
  return eta > 1 ? 32 : 128;
}

}  // namespace

RoughTransmittance::RoughTransmittance(MicrofacetDistribution distribution, float eta,
                                       float alpha) {
  add_row(distribution, eta, alpha);
  external_.push_back(external_.back());
}

RoughTransmittance::RoughTransmittance(MicrofacetDistribution distribution, float eta) {
  for (int k = 0; k < kRows; ++k)
    add_row(distribution, eta, kLargestAlpha * sqr(float(k) / float(kRows - 1)));
  external_.push_back(external_.back());
}

void RoughTransmittance::add_row(MicrofacetDistribution distribution, float eta, float alpha) {
  const VisibleFacets outside(distribution, alpha, quadrature_size(eta));
  const VisibleFacets inside(distribution, alpha, quadrature_size(1 / eta));
  float internal = 0;
  for (int k = 0; k < kSize; ++k) {
    const float mu = std::max(1e-6f, float(k) / float(kSize - 1));
    const Vector3f o(std::sqrt(1 - mu * mu), 0, mu);
    // By rounding the sum may exceed one.
    external_.push_back(std::min(outside.transmittance(o, eta), 1.0f));
    internal += inside.reflectance(o, 1 / eta) * mu;
  }
  internal_.push_back(2 * internal / float(kSize));
}

RoughTransmittance::Lookup RoughTransmittance::operator()(float alpha) const {
  if (internal_.size() == 1) return {{external_.data(), 0}, internal_[0]};
  const float x =
      std::min(std::sqrt(std::max(alpha, 0.0f) / kLargestAlpha), 1.0f) * float(kRows - 1);
  const int row = std::min(int(x), kRows - 2);
  const float blend = x - float(row);
  return {{external_.data() + row * kSize, blend},
          lerp(internal_[size_t(row)], internal_[size_t(row) + 1], blend)};
}

}  // namespace duet
