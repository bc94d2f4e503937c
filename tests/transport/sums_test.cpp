// The running sums against the definition on paths of random densities, merges included; and that
// the weights of all techniques of a path sum to one.
#include <cmath>

#include "math/sampler.h"
#include "support/transport_scene.h"
#include "transport/weights.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A path of k segments with random densities: index i for vertex x_i.
struct RandomPath {
  int k;
  std::vector<float> sigma_light, sigma_eye;  ///< per solid angle at x_i, towards x_{i+1}, x_{i-1}
  std::vector<float> cos_light, cos_eye;      ///< at x_i, towards x_{i-1} and x_{i+1}
  std::vector<float> d2;                      ///< between x_i and x_{i+1}
  std::vector<bool> specular;
  std::vector<bool> merges;  ///< whether photons are merged at x_i, if anywhere
  float direct, emission, importance;
  bool light_can_be_hit;
  LightSampleVariance light_sample{};  ///< PathVertex::light_sample of x_1

  explicit RandomPath(Sampler& r) : k(2 + int(r.next_1d() * 9)) {
    const auto log_uniform = [&](float low, float high) {
      return low * std::pow(high / low, r.next_1d());
    };
    for (int i = 0; i <= k; ++i) {
      specular.push_back(i > 0 && i < k && r.next_1d() < 0.25f);
      merges.push_back(r.next_1d() < 0.7f);
      // Through a delta lobe the two densities are one and the Jacobian.
      sigma_light.push_back(specular.back() ? 1.0f : log_uniform(0.01f, 30));
      sigma_eye.push_back(specular.back() ? log_uniform(0.4f, 2.5f) : log_uniform(0.01f, 30));
      cos_light.push_back(log_uniform(0.05f, 1));
      cos_eye.push_back(log_uniform(0.05f, 1));
      d2.push_back(log_uniform(0.01f, 100));
    }
    direct = log_uniform(0.05f, 50);
    emission = log_uniform(0.01f, 10);
    importance = log_uniform(10, 1e5f);
    light_can_be_hit = r.next_1d() < 0.8f;
    if (k == 2)
      light_sample = {r.next_1d(), light_can_be_hit
                                       ? INFINITY
                                       : log_uniform(0.1f, 10) / (importance * cos_eye[1])};
  }

  double p(int i) const {  // of x_i from the light's side; x_0 and x_1 together
    if (i == 1) return double(emission) * double(cos_light[1]);
    return double(sigma_light[size_t(i - 1)]) * double(cos_light[size_t(i)]) /
           double(d2[size_t(i - 1)]);
  }
  double q(int i) const {
    if (i == 0) return light_can_be_hit ? double(sigma_eye[1]) : 0.0;
    if (i == k - 1) return double(importance) * double(cos_eye[size_t(i)]);
    return double(sigma_eye[size_t(i + 1)]) * double(cos_eye[size_t(i)]) / double(d2[size_t(i)]);
  }
  float gain() const { return light_sample.gain(1 / (importance * cos_eye[1])); }
  bool connectible(int i) const { return !specular[size_t(i)]; }
};

/// Samples times density of every technique and of every merge.
struct Densities {
  std::vector<double> connections, merges;
  double sum = 0;

  Densities(const RandomPath& x, const TechniqueSet& set) {
    for (int s = 0; s <= x.k; ++s) {
      const double connection = set.connections ? double(set.connection_share) : 0.0;
      const double one = s <= 1 ? double(x.gain()) : 1.0;
      double d = s == x.k ? double(set.light_paths) : s >= 2 ? connection : one;
      if (s == 0 ? !x.light_can_be_hit : !(x.connectible(s - 1) && x.connectible(s))) d = 0;
      for (int i = 0; i < x.k; ++i)
        if (i < s)
          d *= s == 1 ? double(x.direct) : i == 0 ? 1.0 : x.p(i);
        else
          d *= x.q(i);
      connections.push_back(d);
      sum += d;
    }
    for (int i = 1; i < x.k; ++i) {
      const bool merged = set.merges && x.connectible(i) && x.merges[size_t(i)];
      double d = merged ? double(set.light_paths) * double(set.merge_area) : 0;
      for (int j = 1; j <= i; ++j) d *= x.p(j);
      for (int j = i; j < x.k; ++j) d *= x.q(j);
      merges.push_back(d);
      sum += d;
    }
  }
};

/// The sums of both sub-paths at each vertex, and of the eye sub-path on leaving x_1 for the light.
struct Sums {
  std::vector<Partials> light, eye;
  Partials leaving_for_light;

  Sums(const RandomPath& x, const TechniqueSet& set) : light(size_t(x.k)), eye(size_t(x.k)) {
    const auto next = [&](const Partials& at, int i, bool to_light) {
      const size_t v = size_t(i);
      const float out = to_light ? x.cos_light[v] : x.cos_eye[v];
      const float forward = to_light ? x.sigma_eye[v] : x.sigma_light[v];
      const float reverse = to_light ? x.sigma_light[v] : x.sigma_eye[v];
      return x.specular[v] ? leave_specular(at, out, reverse / forward)
                           : leave(at, {forward, reverse, out}, set, x.merges[v]);
    };
    const float scale = 1 / (x.emission * x.cos_light[1] * set.connection_share);
    light[1].vcm = x.direct * scale;
    light[1].vc = x.light_can_be_hit ? scale : 0.0f;
    light[1].vm = light[1].vc * set.subpath_connection_term();
    for (int i = 1; i + 1 < x.k; ++i)
      light[size_t(i + 1)] = arrive(next(light[size_t(i)], i, false), x.d2[size_t(i)],
                                    x.cos_light[size_t(i + 1)], set.subpath_connections());
    eye[size_t(x.k - 1)].vcm = set.light_paths / (set.connection_share * float(x.q(x.k - 1)));
    for (int i = x.k - 1; i > 1; --i)
      eye[size_t(i - 1)] = arrive(next(eye[size_t(i)], i, true), x.d2[size_t(i - 1)],
                                  x.cos_eye[size_t(i - 1)], set.subpath_connections());
    leaving_for_light = next(eye[1], 1, true);
  }
};

/// The techniques of a pixel.
TechniqueSet in_pixel(TechniqueSet set, bool merging) {
  set.merges &= merging;
  return set;
}

/// Weights of all techniques as connections would get them in a pixel with or without merging.
double check_path(const RandomPath& x, const TechniqueSet& set, bool merging,
                  const PathVertex& any) {
  const Densities expected(x, in_pixel(set, merging));
  const Sums sums(x, set);
  const BalanceWeights weights(set, merging);
  double total = 0, worst = 0;
  const auto compare = [&](double got, double density) {
    total += got;
    worst = std::max(worst, std::abs(got - density / expected.sum));
  };
  const auto at = [&](const Partials& p) {
    PathVertex v = any;
    v.partials = p;
    return v;
  };
  if (expected.connections[0] > 0) {
    Subpath subpath;
    subpath.partials = sums.leaving_for_light;
    compare(double(weights.hit(subpath, x.direct, x.emission, x.light_sample)),
            expected.connections[0]);
  }
  if (expected.connections[1] > 0) {
    // Reverse density at x_1 of going on to x_2.
    const ConnectionEnd end{x.emission * x.cos_light[1] / x.direct, x.sigma_light[1], x.merges[1],
                            x.light_sample};
    compare(double(weights.light_sample(at(sums.eye[1]), x.direct,
                                        x.light_can_be_hit ? x.sigma_eye[1] : 0.0f, end)),
            expected.connections[1]);
  }
  for (int s = 2; s <= x.k; ++s) {
    if (!(expected.connections[size_t(s)] > 0)) continue;
    const size_t y = size_t(s - 1), z = size_t(s);
    const ConnectionEnd light_end{float(x.q(s - 1)), x.sigma_eye[y], x.merges[y], x.light_sample};
    if (s == x.k) {
      compare(double(weights.camera(at(sums.light[y]), light_end)),
              expected.connections[size_t(s)]);
      continue;
    }
    const ConnectionEnd eye_end{float(x.p(s)), x.sigma_light[z], x.merges[z]};
    compare(double(weights.connection(at(sums.light[y]), light_end, at(sums.eye[z]), eye_end)),
            expected.connections[size_t(s)]);
  }
  for (int i = 1; i < x.k; ++i) {
    if (!(expected.merges[size_t(i - 1)] > 0)) continue;
    LightVertex photon;
    photon.partials = sums.light[size_t(i)];
    photon.set_light_sample(x.light_sample);
    compare(double(weights.merge(photon, x.sigma_eye[size_t(i)], at(sums.eye[size_t(i)]),
                                 x.sigma_light[size_t(i)])),
            expected.merges[size_t(i - 1)]);
  }
  CHECK(worst < 1e-4);
  return total;
}

}  // namespace

TEST_CASE("running sums give the weights of the definition, which sum to one") {
  const TransportScene scene(camera_xml("0,-3,1", "0,0,1", 8) + room_xml(grey("0.5")) +
                             lamp_xml("0.3", "1"));
  const Ray ray = scene.scene->camera->sample_ray({4, 4}, {});
  Hit hit;
  REQUIRE(scene.scene->accel->closest_hit(ray, hit));
  const PathVertex any(*scene.scene, scene.scene->surface(ray, hit), -ray.direction, Spectrum(1),
                       {}, 1);
  Sampler random(SampleSequence::independent, 3, 0, 0);
  int summed = 0;
  for (uint32_t i = 0; i < 100000; ++i) {
    random.start_sample(i);
    const RandomPath x(random);
    TechniqueSet set;
    set.hits = set.light_samples = set.camera_connections = true;
    set.connections = random.next_1d() < 0.7f;
    set.light_paths = std::pow(10.0f, 1 + 5 * random.next_1d());
    set.connection_share = random.next_1d() < 0.5f ? 1.0f : 0.05f + 30 * sqr(random.next_1d());
    set.merges = random.next_1d() < 0.6f;
    set.merge_area = std::pow(10.0f, -1 - 5 * random.next_1d());
    set.partly_merged = set.merges && random.next_1d() < 0.5f;
    for (const bool merging : {true, false}) {
      if (!merging && !set.partly_merged) continue;
      const Densities d(x, in_pixel(set, merging));
      if (!(d.sum > 0)) continue;  // a chain of specular vertices that nothing can make
      ++summed;
      CHECK(std::abs(check_path(x, set, merging, any) - 1) < 1e-4);
    }
  }
  CHECK(summed > 80000);
}
