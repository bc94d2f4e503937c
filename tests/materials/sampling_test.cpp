// What sample() returns, against eval() and against how often it returns it.
#include <doctest/doctest.h>
#include <map>

#include "math/sampler.h"
#include "support/bsdf_checks.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

const Vector3f kSamplingViews[] = {{0, 0, 1},           {0.4f, -0.3f, 0.8f},  {-0.9f, 0.4f, 0.1f},
                                   {0.2f, 0.3f, -0.9f}, {-0.7f, 0.5f, -0.3f}, {0.9f, 0.2f, -0.05f}};

/// Calls f(bsdf, wo) for the views.
template <class F>
void for_each_view(const json& bsdf, const F& f) {
  const Surface surface = flat_surface();
  const TestMaterial material(bsdf);
  for (const Vector3f& view : kSamplingViews) {
    const Vector3f wo = normalize(view);
    f(material->bind(surface, wo), wo);
  }
}

}  // namespace

TEST_SUITE("samples of materials") {
  TEST_CASE("weight is value over density, and the density is that of eval") {
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      Failures failures(c["name"]);
      for_each_view(c["bsdf"], [&](const Bsdf& bsdf, const Vector3f&) {
        Sampler sampler(SampleSequence::independent, 3, 0, 0);
        for (uint32_t i = 0; i < 400; ++i) {
          sampler.start_sample(i);
          const Point2f v = sampler.next_2d();
          const Transport transport = kTransports[i % 2];
          const auto s = bsdf.sample(sampler.next_1d(), v, transport);
          if (!s || s->delta) continue;
          const BsdfEval e = bsdf.eval(s->wi, transport);
          ++compared;
          // Rounding of a direction moves it by 1e-7, across a lobe of width 0.01.
          if (!close(double(s->pdf.value), double(e.pdf.value), 5e-3) ||
              !close(s->weight * s->pdf.value, e.value, 5e-3))
            failures.add(fmt::format("density {}, eval {}; value {}, eval {}", s->pdf.value,
                                     e.pdf.value, text(s->weight * s->pdf.value), text(e.value)));
        }
      });
    }
    CHECK(compared > 100000);
  }

  TEST_CASE("delta lobes come as often as they say") {
    const int n = 10000;
    int lobes = 0;
    for (const json& c : mitsuba_cases()) {
      Failures failures(c["name"]);
      for_each_view(c["bsdf"], [&](const Bsdf& bsdf, const Vector3f&) {
        for (const Transport transport : kTransports) {
          std::map<std::array<float, 4>, int> counts;
          for (int i = 0; i < n; ++i) {
            const auto s = bsdf.sample((float(i) + 0.5f) / float(n), {0.3f, 0.6f}, transport);
            if (!s) continue;
            if (s->delta) ++counts[{s->wi.x, s->wi.y, s->wi.z, s->pdf.value}];
            if (s->delta ? !bsdf.has_delta() : !bsdf.has_smooth())
              failures.add("a lobe of a kind that there is not");
          }
          for (const auto& [lobe, count] : counts) {
            ++lobes;
            if (std::abs(lobe[3] - float(count) / n) > 1e-3f)
              failures.add(fmt::format("probability {}, frequency {}", lobe[3], float(count) / n));
          }
        }
      });
    }
    CHECK(lobes > 100);
  }

  TEST_CASE("delta lobes lead back with the same probability and coefficient") {
    const Surface surface = flat_surface();
    int compared = 0;
    for (const json& c : mitsuba_cases()) {
      const TestMaterial material(c["bsdf"]);
      // A normal that is turned to the eye is turned at random where the eye is not known.
      const bool same_probability = !perturbs(c["bsdf"]);
      Failures failures(c["name"]);
      for_each_view(c["bsdf"], [&](const Bsdf& bsdf, const Vector3f& wo) {
        if (!bsdf.has_delta()) return;
        for (const float u : {0.001f, 0.2f, 0.5f, 0.8f, 0.999f}) {
          const auto s = bsdf.sample(u, {0.3f, 0.6f}, Transport::radiance);
          if (!s || !s->delta) continue;
          // ∫ f |cos| dω for either end, where cosines and solid angles change at refraction.
          const float exchange = s->wi.z * wo.z > 0 ? std::abs(wo.z / s->wi.z) : s->eta * s->eta;
          const Spectrum expected = s->weight * (s->pdf.value * exchange);
          const Bsdf back = material->bind(surface, s->wi);
          bool found = false;
          for (int i = 0; i < 1000 && !found; ++i) {
            const auto r =
                back.sample((float(i) + 0.5f) * 1e-3f, {0.3f, 0.6f}, Transport::importance);
            found = r && r->delta && length(r->wi - wo) < 1e-3f &&
                    close(r->weight * r->pdf.value, expected, 1e-3) &&
                    (!same_probability || close(double(r->pdf.value), double(s->pdf.value), 1e-3));
          }
          ++compared;
          if (!found)
            failures.add(fmt::format("no way back from {} to {}: probability {}, coefficient {}",
                                     text(s->wi), text(wo), s->pdf.value, text(expected)));
        }
      });
    }
    CHECK(compared > 100);
  }

  TEST_CASE("the choice is not looked at where it is said not to matter") {
    for (const json& c : mitsuba_cases()) {
      Failures failures(c["name"]);
      for_each_view(c["bsdf"], [&](const Bsdf& bsdf, const Vector3f&) {
        if (bsdf.needs_choice()) return;
        for (const Transport transport : kTransports) {
          const auto a = bsdf.sample(0, {0.3f, 0.6f}, transport);
          const auto b = bsdf.sample(0x1.fffffep-1f, {0.3f, 0.6f}, transport);
          if (a.has_value() != b.has_value() || (a && !(a->wi == b->wi)))
            failures.add("the choice matters");
        }
      });
    }
  }
}
