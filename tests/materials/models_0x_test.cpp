// Models that only Mitsuba 0.6 has: against what their papers say of them.
#include "math/sampler.h"
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;
using nlohmann::json;

namespace {

const Vector3f kViews[] = {{0, 0, 1}, {0.4f, -0.3f, 0.8f}, {-0.7f, 0.5f, 0.25f}, {1, 0.3f, 0.1f}};

/// f itself, without the cosine.
float f(const TestMaterial& m, const Vector3f& wo, const Vector3f& wi) {
  return m->bind(flat_surface(), normalize(wo)).eval(normalize(wi), Transport::radiance).value.r /
         std::abs(normalize(wi).z);
}

double albedo(const TestMaterial& m, const Vector3f& wo) {
  const Bsdf bsdf = m->bind(flat_surface(), normalize(wo));
  Moments sum;
  Sampler sampler(SampleSequence::sobol, 3, 0, 0);
  for (uint32_t i = 0; i < 16384; ++i) {
    sampler.start_sample(i);
    const Point2f v = sampler.next_2d();
    const auto s = bsdf.sample(sampler.next_1d(), v, Transport::radiance);
    sum.add(s ? double(s->weight.r) : 0.0);
  }
  return sum.mean();
}

TestMaterial make(const std::string& text) {
  return TestMaterial(json::parse(text));
}

}  // namespace

TEST_SUITE("models of Mitsuba 0.6") {
  TEST_CASE("they are reciprocal") {
    for (const char* text :
         {R"({"type": "phong", "exponent": 20})", R"({"type": "ward", "alpha_u": 0.4})",
          R"({"type": "ward", "variant": "ward"})", R"({"type": "ward", "variant": "ward-duer"})",
          R"({"type": "roughdiffuse", "alpha": 0.7})",
          R"({"type": "roughdiffuse", "alpha": 0.7, "fast": true})"}) {
      CAPTURE(std::string(text));
      const TestMaterial m = make(text);
      for (const Vector3f& a : kViews)
        for (const Vector3f& b : kViews)
          CHECK(f(m, a, b) == doctest::Approx(double(f(m, b, a))).epsilon(1e-4));
    }
  }

  TEST_CASE("they reflect no more than they get") {
    for (
        const char* text :
        {R"({"type": "phong", "exponent": 20, "diffuse_reflectance": 0, "specular_reflectance": 1})",
         R"({"type": "ward", "alpha_u": 0.4, "diffuse_reflectance": 0, "specular_reflectance": 1})",
         R"({"type": "roughdiffuse", "alpha": 0.7, "reflectance": 1})",
         R"({"type": "difftrans", "transmittance": 1})"}) {
      CAPTURE(std::string(text));
      for (const Vector3f& w : kViews) CHECK(albedo(make(text), w) < 1.003);
    }
  }

  TEST_CASE("Phong's lobe is normalised for light along the normal") {
    for (const int exponent : {0, 1, 10, 200})
      CHECK(albedo(TestMaterial({{"type", "phong"},
                                 {"exponent", exponent},
                                 {"diffuse_reflectance", 0},
                                 {"specular_reflectance", 1}}),
                   {0, 0, 1}) == doctest::Approx(1).epsilon(0.01));
  }

  TEST_CASE("Ward's narrow lobes reflect all light along the normal in each variant") {
    for (const char* variant : {"ward", "ward-duer", "balanced"})
      CHECK(albedo(TestMaterial({{"type", "ward"},
                                 {"variant", variant},
                                 {"alpha_u", 0.05},
                                 {"alpha_v", 0.02},
                                 {"diffuse_reflectance", 0},
                                 {"specular_reflectance", 1}}),
                   {0, 0, 1}) == doctest::Approx(1).epsilon(0.02));
  }

  TEST_CASE("rough diffuse reflection is Lambert's without roughness, and backscatters with it") {
    const TestMaterial smooth = make(R"({"type": "roughdiffuse", "alpha": 0, "reflectance": 0.5})");
    for (const Vector3f& a : kViews)
      CHECK(f(smooth, a, {0.1f, 0.5f, 0.6f}) == doctest::Approx(0.5 / 3.14159265).epsilon(1e-4));
    for (const char* text : {R"({"type": "roughdiffuse", "alpha": 0.5})",
                             R"({"type": "roughdiffuse", "alpha": 0.5, "fast": true})"}) {
      const TestMaterial rough = make(text);
      const Vector3f low(0.9f, 0, 0.3f);
      CHECK(f(rough, low, low) > 1.3f * f(rough, low, {-0.9f, 0, 0.3f}));
    }
  }
}
