#include "support/flux.h"

#include <doctest/doctest.h>

#include <array>

#include "math/frame.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/statistics.h"

namespace duet::test {

namespace {

using Flux = std::array<Moments, 3>;

void add(Flux& flux, const Spectrum& s) {
  for (int k = 0; k < 3; ++k) flux[size_t(k)].add(double(s[k]));
}

bool passes(const Ray& ray, const Probe& probe, const Normal3f& n) {
  const float cosine = -dot(n, ray.direction);
  const float t = dot(ray.origin - probe.center, n) / cosine;
  return cosine > 0 && t > 0 &&
         distance(ray.origin + ray.direction * t, probe.center) < probe.radius;
}

}  // namespace

void check_flux(const Light& light, const Probe& probe, const std::string& name) {
  INFO(name);
  const Normal3f n(normalize(probe.normal));
  const Frame frame(n);
  Sampler sampler(SampleSequence::independent, 5, 0, 0);
  Flux emitted, received;
  constexpr int kSamples = 300000;
  for (int i = 0; i < kSamples; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    const auto e = light.sample_emission(position, direction);
    add(emitted, e && passes(e->ray, probe, n) ? e->weight : Spectrum());
    const Point2f p = square_to_disk(sampler.next_2d()) * probe.radius;
    const auto s =
        light.sample_direct(probe.center + frame.to_world({p.x, p.y, 0}), sampler.next_2d());
    const float cosine = s ? std::max(dot(n, s->wi), 0.0f) : 0.0f;
    add(received, s ? s->weight * (cosine * kPi * sqr(probe.radius)) : Spectrum());
  }
  for (size_t k = 0; k < 3; ++k) {
    const Moments &a = emitted[k], &b = received[k];
    const double error = std::hypot(a.error(), b.error());
    CHECK(b.mean() > 0);
    CHECK_MESSAGE(error < 0.02 * b.mean(), "error ", error, " of ", b.mean());
    CHECK_MESSAGE(std::abs(a.mean() - b.mean()) < 4 * error, a.mean(), " and ", b.mean(), " ± ",
                  error);
  }
}

}  // namespace duet::test
