#include "support/mis_oracle.h"

#include <cmath>

namespace duet::test {

namespace {

double distance2(const Surface& a, const Surface& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::pow(double(a.position[i]) - double(b.position[i]), 2);
  return sum;
}

double cosine(const Normal3f& n, const Vector3f& w) {
  return std::abs(double(n.x) * double(w.x) + double(n.y) * double(w.y) +
                  double(n.z) * double(w.z));
}

}  // namespace

std::vector<double> technique_densities(const Scene& scene, const OraclePath& path,
                                        const Shares& shares, double merge_area,
                                        const MergeShares& merges) {
  const int k = path.segments(), n = k - 1;
  if (n == 0) return {shares(0, 2), 0};
  // Surface i of the path is surfaces[i - 1].
  const auto at = [&](int i) -> const Surface& { return path.surfaces[size_t(i - 1)]; };
  const auto direction = [&](int from, int to) {
    if (to == 0) return path.to_light;
    if (to == k) return path.to_lens;
    return normalize(at(to).position - at(from).position);
  };
  const auto medium = [&](int i) {
    return path.media.empty() ? nullptr : path.media[size_t(i - 1)];
  };
  /// What makes densities per solid angle of x_i per area or volume.
  const auto projected = [&](int i, const Vector3f& w) {
    return medium(i) ? double(medium(i)->nominal_extinction(at(i).position)) : cosine(at(i).ng, w);
  };
  const auto edge = [&](int i) {
    return path.transmittance.empty() ? 1.0 : path.transmittance[size_t(i)];
  };
  /// Density per solid angle of going on from x_i to `next` after `previous`.
  const auto scattered = [&](int i, int previous, int next, Transport transport) {
    if (path.specular[size_t(i - 1)]) {
      if (transport == Transport::importance) return 1.0;
      const double eye = cosine(at(i).shading.n, direction(i, next == i - 1 ? i + 1 : i - 1));
      const double light = cosine(at(i).shading.n, direction(i, i - 1));
      const double eta = path.eta[size_t(i - 1)];
      // Solid angle towards the eye per solid angle towards the light.
      return eta == 1 ? 1.0 : light / (eye * eta * eta);
    }
    if (medium(i))
      return double(medium(i)
                        ->phase()
                        .eval(at(i).position, direction(i, previous), direction(i, next))
                        .value);
    const Bsdf bsdf = scene.materials[at(i).shape->material]->bind(at(i), direction(i, previous));
    return double(bsdf.eval(direction(i, next), transport).pdf.value);
  };
  const auto to_area = [&](double p, int from, int to) {
    return p * edge(std::min(from, to)) * projected(to, direction(to, from)) /
           distance2(at(from), at(to));
  };
  const size_t count = size_t(k);
  std::vector<double> p(count), q(count);  // of x_0 … x_{k-1}
  p[0] = 1;
  p[1] = path.emission * projected(1, path.to_light) * edge(0);
  for (int i = 2; i <= n; ++i)
    p[size_t(i)] = to_area(scattered(i - 1, i - 2, i, Transport::importance), i - 1, i);
  q[size_t(n)] = path.importance * projected(n, path.to_lens) * edge(n);
  for (int i = n - 1; i >= 1; --i)
    q[size_t(i)] = to_area(scattered(i + 1, i + 2, i, Transport::radiance), i + 1, i);
  q[0] = path.light_can_be_hit ? scattered(1, 2, 0, Transport::radiance) * edge(0) : 0.0;

  const auto connectible = [&](int i) { return i == 0 || i == k || !path.specular[size_t(i - 1)]; };
  const auto product = [&](int s) {
    double log_density = 0;
    for (int i = 0; i < k; ++i) {
      const double v = i >= s ? q[size_t(i)] : i == 0 && s == 1 ? path.direct : p[size_t(i)];
      log_density += std::log(v);
    }
    return log_density;
  };
  std::vector<double> result;
  const double reference = [&] {
    double most = -INFINITY;
    for (int s = 0; s <= k; ++s) {
      const double l = product(s);
      if (std::isfinite(l)) most = std::max(most, l);
    }
    return most;
  }();
  for (int s = 0; s <= k; ++s) {
    const bool connections = s == 0 ? path.light_can_be_hit
                                    : !(s == 1 && k == 1) && connectible(s - 1) && connectible(s);
    double share = connections ? shares(s, k + 1 - s) : 0;
    if (s <= 1 && k == 2) share *= path.gain;
    result.push_back(share > 0 ? share * std::exp(product(s) - reference) : 0.0);
  }
  for (int i = 1; i < k; ++i) {
    // The light sub-path goes on to x_i, which the eye sub-path has reached too.
    const double share = connectible(i) && !medium(i) ? merges(i) : 0;
    result.push_back(share > 0 ? share * merge_area * p[size_t(i)] *
                                     std::exp(product(i) - reference) / (i == 1 ? path.direct : 1.0)
                               : 0.0);
  }
  return result;
}

}  // namespace duet::test
